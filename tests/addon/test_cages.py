"""Below a Subdivision Surface modifier the tools move the cage, and the subdivided surface is what gets better."""
from collections.abc import Callable

import bmesh
import bpy
import numpy as np
import pytest
from reflection_lines.blender import compat
from reflection_lines.read import read_cage, read_snapshot, viewport_cage
from reflection_lines.overlay import solve_maps
from reflection_lines.state import solve_history

import scenes

CELLS = 12


def subdivided(cells: int = CELLS, **settings: object) -> bpy.types.Object:
    """A dented cage seen from above, its inner faces selected in Edit Mode."""
    ob = scenes.panel(cells=cells)
    add_subdivision(ob, **settings)
    scenes.look_from_above()
    scenes.edit_inner(ob, cells)
    return ob


def add_subdivision(ob: bpy.types.Object, **settings: object) -> None:
    modifier = ob.modifiers.new("Subdivision", 'SUBSURF')
    modifier.levels = 2
    for name, value in settings.items():
        setattr(modifier, name, value)


def crease_row(ob: bpy.types.Object, crease: float) -> None:
    """In Object Mode: the edges along y = 0."""
    middle = {vertex.index for vertex in ob.data.vertices if abs(vertex.co.y) < 1e-6}
    values = [crease * middle.issuperset(edge.vertices) for edge in ob.data.edges]
    if bpy.app.version < (4, 0, 0):
        ob.data.edges.foreach_set("crease", values)
    else:
        ob.data.attributes.new("crease_edge", 'FLOAT', 'EDGE').data.foreach_set("value", values)


def shown(ob: bpy.types.Object) -> np.ndarray:
    """Positions (#V x 3) of what the viewport shows."""
    mesh = ob.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    values = np.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", values)
    return values.reshape(-1, 3)


def test_smoothing_moves_the_cage_along_the_view_and_the_wobble_falls() -> None:
    ob = subdivided()
    before = scenes.positions(ob)
    assert scenes.smooth(length=0.8) == {'FINISHED'}
    report = ob.reflection_lines.report
    move = scenes.positions(ob) - before
    assert report.termination == "converged"
    assert report.score_after < 0.5 * report.score_before
    assert np.abs(move[:, 2]).max() > report.largest_move > 0.0  # that of the surface, which follows by halves
    assert not move[:, :2].any()
    assert [modifier.type for modifier in ob.modifiers] == ['SUBSURF']
    assert report.unknowns == (CELLS - 5) ** 2


def test_what_lies_outside_the_region_keeps_its_surface() -> None:
    ob = subdivided()
    scenes.object_mode()
    before = shown(ob)
    scenes.edit_inner(ob, CELLS)
    scenes.smooth(length=0.8)
    scenes.object_mode()
    after = shown(ob)
    outside = np.abs(before[:, :2]).max(axis=1) >= 1.0 - 2.0 / CELLS
    assert not np.array_equal(before, after)
    assert np.array_equal(before[outside], after[outside])


def test_a_border_that_flows_is_one_of_its_own_and_curvature_is_tangent() -> None:
    moved = {}
    for border in ("clamped", "curvature", "flow"):
        ob = subdivided()
        before = scenes.positions(ob)
        assert scenes.smooth(length=0.8, border=border) == {'FINISHED'}
        moved[border] = scenes.positions(ob) - before
    assert np.array_equal(moved["curvature"], moved["clamped"])
    assert not np.array_equal(moved["flow"], moved["clamped"])
    assert np.array_equal(moved["flow"] != 0.0, moved["clamped"] != 0.0)


def test_below_a_hidden_modifier_the_mesh_is_solved_as_without_it() -> None:
    results = {}
    for kind in ("shown", "hidden", "missing"):
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        ob = subdivided()
        ob.modifiers[0].show_viewport = kind == "shown"
        if kind == "missing":
            ob.modifiers.clear()
        scenes.smooth()
        results[kind] = scenes.positions(ob)
    assert np.array_equal(results["hidden"], results["missing"])
    assert not np.array_equal(results["hidden"], results["shown"])


@pytest.mark.parametrize("name", scenes.TRANSFORMS)
def test_transforms_do_not_matter(name: str) -> None:
    moves = []
    for matrix in (scenes.TRANSFORMS["none"], scenes.TRANSFORMS[name]):
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        ob = subdivided()
        scenes.object_mode()
        scenes.transformed(ob, matrix)
        before = scenes.world(ob)
        scenes.edit_inner(ob, CELLS)
        scenes.smooth(length=0.8)
        moves.append(scenes.world(ob) - before)
    assert np.abs(moves[0]).max() > 1e-3
    assert np.abs(moves[0] - moves[1]).max() < 5e-5


@pytest.mark.parametrize("crease", [0.5, 1.0])
def test_a_crease_is_as_sharp_as_blender_makes_it(crease: float) -> None:
    """Ten times its square, on its edges and on no others."""
    ob = scenes.panel(cells=CELLS)
    add_subdivision(ob)
    crease_row(ob, crease)
    faces = np.ones(len(ob.data.polygons), dtype=bool)
    mesh = read_snapshot.read_connectivity(ob.data)
    cage = read_cage.read_cage(ob.data, mesh, faces, np.eye(4), ob.modifiers[0], None, scenes.positions(ob))
    assert len(cage.creases) == CELLS
    assert np.abs(cage.V[cage.creases][:, :, 1]).max() < 1e-6
    assert cage.sharpness == pytest.approx(np.full(CELLS, 10.0 * crease**2))


def test_creases_of_vertices_are_read_in_edit_mode() -> None:
    ob = subdivided()
    mesh = bmesh.from_edit_mesh(ob.data)
    layers = mesh.verts.layers
    crease = layers.crease.verify() if hasattr(layers, "crease") else layers.float.new("crease_vert")
    mesh.verts.ensure_lookup_table()
    mesh.verts[7][crease] = 1.0
    bmesh.update_edit_mesh(ob.data)
    ob.update_from_editmode()
    assert np.flatnonzero(compat.read_vertex_creases(ob.data)).tolist() == [7]


def test_creases_are_the_modifiers() -> None:
    results = []
    for crease, used in ((0.0, True), (0.9, True), (0.9, False)):
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        ob = subdivided(use_creases=used)
        scenes.object_mode()
        crease_row(ob, crease)
        scenes.edit_inner(ob, CELLS)
        scenes.smooth(length=0.8)
        results.append(scenes.positions(ob))
    assert not np.array_equal(results[0], results[1])
    assert np.array_equal(results[0], results[2])


def half_panel() -> bpy.types.Object:
    """The right half of a panel with its seam at x = 0, mirrored below its subdivision."""
    ob = scenes.panel(cells=CELLS, height=lambda x, y: scenes.crown(x, y) + 0.004 * np.cos(6.0 * x) * np.sin(5.0 * y))
    scenes.edit(ob)
    scenes.select_faces(ob, lambda face: face % CELLS < CELLS // 2)
    bpy.ops.mesh.delete(type='FACE')
    scenes.object_mode()
    mirror = ob.modifiers.new("Mirror", 'MIRROR')
    mirror.use_clip = True
    add_subdivision(ob)
    return ob


@pytest.mark.parametrize("direction", [(0.0, 0.0, 1.0), (0.3, 0.0, 1.0)])
def test_a_mirror_below_keeps_symmetry_and_its_seam(direction: tuple) -> None:
    ob = half_panel()
    bpy.ops.reflines.set_up(part='CAMERA', direction=direction)
    bpy.ops.reflines.set_up(part='LIGHT', direction=(0.0, 1.0, 0.2))
    before = scenes.positions(ob)
    seam = np.abs(before[:, 0]) < 1e-6
    scenes.edit(ob)
    bpy.ops.mesh.select_all(action='SELECT')
    scenes.smooth(length=0.8)
    scenes.object_mode()
    after, surface = scenes.positions(ob), shown(ob)
    assert not np.array_equal(before, after)
    assert (np.abs(after[seam, 0]) < 1e-6).all()
    assert (not np.array_equal(before[seam], after[seam])) == (direction[0] == 0.0)
    right, left = (surface[sign * surface[:, 0] >= -1e-7] * (sign, 1.0, 1.0) for sign in (1.0, -1.0))
    assert len(right) == len(left)
    order = [np.lexsort(np.round(half, 5).T) for half in (right, left)]
    assert np.abs(right[order[0]] - left[order[1]]).max() < 1e-6


@pytest.mark.parametrize(("kind", "said"), [('SOLIDIFY', "Solidify"), ('ARRAY', "Array")])
def test_what_is_not_followed_is_refused_in_words(kind: str, said: str) -> None:
    ob = scenes.panel(cells=CELLS)
    ob.modifiers.new(said, kind)
    add_subdivision(ob)
    scenes.look_from_above()
    scenes.edit_inner(ob, CELLS)
    with scenes.refused(ob, f"{said} below its subdivision"):
        scenes.smooth()


def add_nodes(ob: bpy.types.Object, *kinds: str) -> bpy.types.Modifier:
    """A geometry nodes modifier: these nodes one after the other."""
    group = bpy.data.node_groups.new("Nodes", 'GeometryNodeTree')
    for where in ('INPUT', 'OUTPUT'):
        if bpy.app.version < (4, 0, 0):
            getattr(group, f"{where.lower()}s").new('NodeSocketGeometry', "Geometry")
        else:
            group.interface.new_socket(name="Geometry", in_out=where, socket_type='NodeSocketGeometry')
    chain = [group.nodes.new(kind) for kind in ('NodeGroupInput', *kinds, 'NodeGroupOutput')]
    for one, next_one in zip(chain, chain[1:], strict=False):
        group.links.new(one.outputs[0], next_one.inputs[0])
    modifier = ob.modifiers.new("Nodes", 'NODES')
    modifier.node_group = group
    return modifier


def smoothed_below(add: Callable[[bpy.types.Object], object]) -> tuple[bpy.types.Object, np.ndarray]:
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    ob = subdivided()
    add(ob)
    assert scenes.smooth(length=0.8) == {'FINISHED'}
    return ob, scenes.positions(ob)


def hidden(ob: bpy.types.Object) -> None:
    ob.modifiers.new("Solidify", 'SOLIDIFY').show_viewport = False


@pytest.mark.parametrize("add", [
    lambda ob: ob.modifiers.new("Weighted Normal", 'WEIGHTED_NORMAL'), hidden,
    lambda ob: add_nodes(ob, 'GeometryNodeSetShadeSmooth')], ids=["normals", "hidden", "smooth by angle"])
def test_what_follows_and_moves_nothing_leaves_it_a_cage(add) -> None:
    _, alone = smoothed_below(lambda _: None)
    ob, result = smoothed_below(add)
    assert np.array_equal(result, alone)
    assert ob.reflection_lines.is_cage() and "modifier" not in ob.reflection_lines.report.notes


def add_shell(ob: bpy.types.Object, offset: float = -1.0) -> None:
    shell = ob.modifiers.new("Solid", 'SOLIDIFY')
    shell.thickness, shell.offset = 0.02, offset


def test_a_shell_follows_the_cage_and_its_outer_side_is_what_was_solved() -> None:
    alone, result = smoothed_below(lambda _: None)
    surface = shown(alone)
    ob, now = smoothed_below(add_shell)
    assert np.array_equal(now, result) and ob.reflection_lines.is_cage()
    assert "modifier" not in ob.reflection_lines.report.notes and "shell" not in ob.reflection_lines.report.notes
    assert len(shown(ob)) == 2 * len(surface)
    assert np.abs(shown(ob)[:len(surface)] - surface).max() < 1e-6
    assert viewport_cage.read_viewport_cage(ob) is not None  # the stripes lie on it


@pytest.mark.parametrize("offset", [0.0, 1.0])
def test_a_shell_off_the_surface_is_named_and_carries_the_stripes(offset: float) -> None:
    _, result = smoothed_below(lambda _: None)
    ob, now = smoothed_below(lambda ob: add_shell(ob, offset))
    assert np.array_equal(now, result)
    assert "The shell of Solid lies off the surface" in ob.reflection_lines.report.notes
    assert viewport_cage.read_viewport_cage(ob) is None


@pytest.mark.parametrize("add", [
    lambda ob: ob.modifiers.new("Bevel", 'BEVEL'), lambda ob: add_nodes(ob, 'GeometryNodeTransform')],
    ids=["bevel", "nodes"])
def test_what_follows_and_changes_the_surface_is_named(add) -> None:
    _, mesh = smoothed_below(lambda ob: setattr(ob.modifiers[0], "show_viewport", False))
    ob, result = smoothed_below(add)
    assert np.array_equal(result, mesh)
    assert not ob.reflection_lines.is_cage()
    notes = ob.reflection_lines.report.notes
    assert f"The modifier {ob.modifiers[1].name} follows Subdivision, so the mesh was solved" in notes


def test_a_deforming_modifier_is_named() -> None:
    ob = scenes.panel(cells=CELLS)
    scenes.look_from_above()
    ob.modifiers.new("Bend", 'SIMPLE_DEFORM')
    ob.modifiers.new("Thickness", 'SOLIDIFY')
    scenes.edit_inner(ob, CELLS)
    scenes.smooth()
    assert "without the modifier Bend, which moves what is shown" in ob.reflection_lines.report.notes


@pytest.mark.parametrize(("node", "named"), [('GeometryNodeSetPosition', True), ('GeometryNodeSetShadeSmooth', False)])
def test_geometry_nodes_are_named_where_they_do_more_than_shade(node, named) -> None:
    ob = scenes.panel(cells=CELLS)
    scenes.look_from_above()
    add_nodes(ob, node)
    ob.modifiers.new("Thickness", 'SOLIDIFY')
    scenes.edit_inner(ob, CELLS)
    scenes.smooth()
    said = f"without the modifier {ob.modifiers[0].name}, which moves what is shown"
    assert (said in ob.reflection_lines.report.notes) == named


def test_simple_subdivision_is_refused_in_words() -> None:
    subdivided(subdivision_type='SIMPLE')
    with pytest.raises(RuntimeError, match="Simple"):
        scenes.smooth()


def test_what_could_not_be_reached_is_known_for_the_cages_faces() -> None:
    ob = subdivided()
    scenes.smooth(length=0.8)
    solution = solve_history.find_last_solve(ob.name)
    assert len(solution.residual) == len(solution.patch.F)
    assert solution.residual.min() > 0.0
    pairs = solution.residual.reshape(-1, 2)  # of the triangles of a quad
    assert np.array_equal(pairs[:, 0], pairs[:, 1])
    assert len(np.unique(pairs)) > 10
    V, F, _, share = solve_maps.build_flat_map(solution, 'RESIDUAL')
    assert len(V) == 3 * len(F) == 3 * len(solution.patch.F)
    assert share.max() == 1.0


def test_sharp_creases_are_said_to_be_kept_and_not_held() -> None:
    ob = subdivided()
    scenes.object_mode()
    crease_row(ob, 1.0)
    for vertex in ob.data.vertices:
        vertex.co.z -= 0.8 * abs(vertex.co.y)
    before = scenes.positions(ob)
    scenes.edit_inner(ob, CELLS)
    scenes.smooth(length=0.8)
    notes = ob.reflection_lines.report.kept
    assert "kept sharp" in notes and "held, the lines" not in notes
    middle = np.abs(before[:, 1]) < 1e-6
    assert (scenes.positions(ob) != before)[middle].any()
