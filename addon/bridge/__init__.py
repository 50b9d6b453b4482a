"""Between Blender and numpy: the only readers and writers of mesh data."""
