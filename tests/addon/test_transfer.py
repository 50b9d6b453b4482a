"""What the fast ways between Blender and numpy give is what Blender's own slow ways give."""
import bmesh
import bpy
import numpy as np
from reflection_lines.read import gather, read_mesh
from reflection_lines.write import write_mesh

import scenes


def mixed_panel(seed: int = 5) -> bpy.types.Object:
    """Quads jittered so far that some are concave, every fifth of them cut into triangles."""
    ob = scenes.panel(cells=20)
    random = np.random.default_rng(seed)
    for vertex in ob.data.vertices:
        vertex.co.x += random.uniform(-0.045, 0.045)
        vertex.co.y += random.uniform(-0.045, 0.045)
    mesh = bmesh.new()
    mesh.from_mesh(ob.data)
    mesh.faces.ensure_lookup_table()
    bmesh.ops.triangulate(mesh, faces=list(mesh.faces)[::5])
    mesh.to_mesh(ob.data)
    mesh.free()
    return ob


def test_triangles_are_blenders() -> None:
    ob = mixed_panel()
    scenes.look_from_above()
    scenes.edit_inner(ob, cells=20, margin=0)
    patch = gather.gather_patch(ob)
    triangles, owners = read_mesh.read_triangles(ob.data)
    own = triangles[patch.faces[owners]]
    assert {len(polygon.vertices) for polygon in ob.data.polygons} == {3, 4}
    cuts = [tuple(triangle) for triangle in own]
    firsts = {polygon.vertices[0] for polygon in ob.data.polygons if len(polygon.vertices) == 4}
    assert not all(triangle[0] in firsts for triangle in cuts)  # some quads are cut the other way
    np.testing.assert_array_equal(patch.index[patch.F], own)


def test_normals_after_few_moves_are_those_of_all() -> None:
    ob = scenes.panel(cells=60)
    scenes.edit_inner(ob, cells=60, margin=27)
    patch = gather.gather_patch(ob)
    moved = patch.V + np.random.default_rng(1).uniform(0.0, 0.02, len(patch.V))[:, None] * [0.0, 0.0, 1.0]
    assert len(moved) < write_mesh.FEW * 61 * 61
    write_mesh.write_solution(ob, patch, moved)
    mesh = bmesh.from_edit_mesh(ob.data)
    few = np.array([vertex.normal for vertex in mesh.verts])
    mesh.normal_update()
    np.testing.assert_allclose(few, [vertex.normal for vertex in mesh.verts], atol=1e-6)
    assert np.ptp(few[:, 2]) > 0.01
