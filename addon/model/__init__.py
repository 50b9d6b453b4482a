"""The data of the add-on: frozen bundles of arrays, without Blender."""
