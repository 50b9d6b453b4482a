"""The bridge between Blender and numpy: only modules of this package read or write mesh data."""
