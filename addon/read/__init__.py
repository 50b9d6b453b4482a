"""Reads Blender's meshes and scenes as arrays. What the artist marked on a mesh is read and stored by one module."""
