"""Live warp: the panel follows its lattice while that is edited with Blender's own tools."""
