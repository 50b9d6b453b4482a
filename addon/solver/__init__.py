"""The native solver as the add-on uses it: patches in, solutions out, without Blender."""
