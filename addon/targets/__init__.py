"""Which lines are wanted: for each tool its settings and a function (optimizer, settings) -> Target. No Blender."""
