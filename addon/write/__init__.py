"""Writes results into Blender: positions, attributes, selections, records and images."""
