"""Reads the surface that the viewport shows of an object: modifiers applied, hidden faces left out."""
import bpy
import numpy as np

from ..model.surface import Surface, Topology
from . import modifiers, read_edit_cage, read_mesh, region_faces


def read_viewport_surface(ob: bpy.types.Object, depsgraph: bpy.types.Depsgraph, last: Topology | None) -> Surface:
    """Reads the evaluated mesh by `to_mesh`, which is right in both modes; its plain data are empty in Edit Mode.

    `last` is the topology of an earlier call: reading 400,000 triangles takes longer than all else together.
    """
    evaluated = ob.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh()
    V = read_mesh.read_values((ob.data if is_sculpted_directly(ob) else mesh).vertices, "co", np.float32, 3)
    topology = read_topology(mesh, last)
    edited = ob.mode == 'EDIT' and not read_edit_cage.has_edit_modifiers(ob)
    selected = read_edit_cage.read_selected_faces(ob) if edited else read_mesh.read_values(
        mesh.polygons, "select", bool)
    evaluated.to_mesh_clear()
    return Surface(V.astype(np.float64), topology, selected[topology.faces])


def is_sculpted_directly(ob: bpy.types.Object) -> bool:
    """Returns whether strokes of Sculpt Mode change the mesh itself, which Blender evaluates when they end the mode."""
    return ob.mode == 'SCULPT' and ob.data.shape_keys is None and not modifiers.find_shaping_modifiers(ob)


def read_topology(mesh: bpy.types.Mesh, last: Topology | None) -> Topology:
    """Reads the triangulation; returns `last` where corners, sizes and visible faces are the same."""
    corners, sizes = read_mesh.read_corners(mesh)
    shown = region_faces.read_visible_faces(mesh)
    if last is not None and last.same(corners, sizes, shown):
        return last
    triangles, faces = read_mesh.read_triangles(mesh)
    seen = shown[faces]
    return Topology(corners, sizes, shown, triangles[seen], faces[seen])
