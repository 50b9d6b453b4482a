"""Blender's programming interface: what differs between versions, application handlers, units."""
