"""What the add-on computes with: frozen bundles of arrays, without Blender."""
