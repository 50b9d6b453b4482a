"""The fall-off curve that the artist draws.

Blender's curve widget edits a curve that a data-block owns, and add-ons cannot own one. So the curve is that of a Float
Curve node in a node group of the file, whose name starts with a dot, as the names of Blender's own hidden data do.
"""
import bpy
import numpy as np

NAME = ".Reflection Lines Fall-off"
NODE = 'ShaderNodeFloatCurve'
STEPS = 256


def ensure_curve() -> bpy.types.NodeTree:
    """Returns the node group with the curve; a new curve falls from 1 to 0 as a smooth step."""
    group = bpy.data.node_groups.get(NAME) or bpy.data.node_groups.new(NAME, 'ShaderNodeTree')
    if find_curve_node(group) is None:
        mapping = group.nodes.new(NODE).mapping
        first, last = mapping.curves[0].points
        first.location, last.location = (0.0, 1.0), (1.0, 0.0)
        for place in ((0.25, 0.84375), (0.75, 0.15625)):  # of 1 - t^2 (3 - 2 t)
            mapping.curves[0].points.new(*place)
        mapping.update()
    return group


def find_curve_node(group: bpy.types.NodeTree | None) -> bpy.types.Node | None:
    """Returns the Float Curve node of the group, None where there is none."""
    return None if group is None else next((node for node in group.nodes if node.bl_idname == NODE), None)


def tabulate_curve(group: bpy.types.NodeTree) -> np.ndarray:
    """Returns the values of the curve at equal steps from 0 to 1."""
    mapping = find_curve_node(group).mapping
    mapping.initialize()
    return np.array([mapping.evaluate(mapping.curves[0], t) for t in np.linspace(0.0, 1.0, STEPS + 1)])
