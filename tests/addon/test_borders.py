"""The border by segment in Blender: what was set on vertices holds in every tool, and bad attributes are refused."""
import itertools
import json
import re
import sys

import bmesh
import bpy
import numpy as np
import pytest

import scenes
from reflection_lines.model.border import CODES, UNSET
from reflection_lines.read import border_segments

ROW = 17  # vertices of a row of the panel


def side(column: int) -> list[int]:
    return [column + ROW * k for k in range(1, ROW - 1)]


def select_vertices(ob: bpy.types.Object, wanted: list[int]) -> None:
    bpy.context.tool_settings.mesh_select_mode = (True, False, False)
    bpy.ops.mesh.select_all(action='DESELECT')
    mesh = bmesh.from_edit_mesh(ob.data)
    mesh.verts.ensure_lookup_table()
    for index in wanted:
        mesh.verts[index].select = True
    mesh.select_flush_mode()
    bmesh.update_edit_mesh(ob.data)


def set_border(ob: bpy.types.Object, wanted: list[int], border: str) -> None:
    select_vertices(ob, wanted)
    assert bpy.ops.reflines.set_border('EXEC_DEFAULT', True, border=border) == {'FINISHED'}


def segmented_panel() -> bpy.types.Object:
    """The rippled panel with its inner faces selected: the left side of their rim fixed, the right one free."""
    ob = scenes.panel()
    scenes.look_from_above()
    scenes.edit(ob)
    set_border(ob, side(1), 'fixed')
    set_border(ob, side(15)[1:-1], 'free')
    scenes.select_faces(ob, scenes.inner())
    return ob


def stored(ob: bpy.types.Object) -> np.ndarray:
    if ob.mode == 'EDIT':
        mesh = bmesh.from_edit_mesh(ob.data)
        return np.array([vertex[mesh.verts.layers.int["reflines_border"]] for vertex in mesh.verts])
    values = np.empty(len(ob.data.vertices), dtype=np.int32)
    ob.data.attributes["reflines_border"].data.foreach_get("value", values)
    return values


# Pulls the line in the middle by a quarter of the radius, which reaches beyond the region.
HANDLES = json.dumps([{"start": (0.0, 0.0, 0.0), "end": (0.0, 0.1, 0.0), "radius": 1.5, "pinned": [], "muted": False}])


def run(tool: str) -> set[str]:
    settings = {"smooth": {"length": 0.6}, "press": {}, "direction": {"density": 1.3, "border": "clamped"},
                "turn": {"angle": 0.2, "border": "clamped"}, "pull_line": {"handles": HANDLES}}[tool]
    name = {"press": "smooth", "turn": "direction"}.get(tool, tool)
    return getattr(bpy.ops.reflines, name)('EXEC_DEFAULT', True, **settings)


@pytest.mark.parametrize("tool", ["smooth", "press", "direction", "turn", "pull_line"])
def test_every_tool_obeys_the_segments(tool: str) -> None:
    ob = segmented_panel()
    before = scenes.positions(ob)
    assert run(tool) == {'FINISHED'}
    moved = (scenes.positions(ob) != before).any(axis=1)
    assert not moved[side(1)].any()          # fixed
    assert moved[side(2)[3:-3]].any()        # whose neighbours move: it is not clamped
    assert moved[side(15)[4:-4]].any()       # free
    assert not moved[[1 * ROW + k for k in range(5, 12)]].any()  # clamped, as the tool has it
    assert not moved[[2 * ROW + k for k in range(5, 12)]].any()


def take_patch(ob: bpy.types.Object) -> tuple[object, object]:
    """The patch of a panel, and its view."""
    addon = sys.modules["reflection_lines"]
    patch = addon.read.gather.gather_patch(ob)
    return patch, addon.view.facing.read_patch_view(bpy.context.scene, patch)


@pytest.mark.parametrize("levels", [0, 2])
def test_the_brush_obeys_the_segments(levels: int) -> None:
    """On the mesh, and on the cage, where the next row moves the surface at its border, too."""
    ob = segmented_panel()
    if levels:
        ob.modifiers.new("Subdivision", 'SUBSURF').levels = levels
    patch, view = take_patch(ob)
    solver = sys.modules["reflection_lines"].solver
    under = solver.brushed_cage.take_under_brush(patch, view, "clamped")
    for x in (-0.75, 0.75):
        assert under.dab(np.array([x, 0.0, 0.0]), solver.brush.Brush(0.6, 1.0, 0.6, 1.0, 2))
    moved = np.zeros(len(ob.data.vertices), dtype=bool)
    moved[patch.index] = (under.positions != patch.V).any(axis=1)
    assert not moved[side(1)].any()                      # fixed
    assert moved[side(3 if levels else 2)[3:-3]].any()   # not clamped
    assert moved[side(15)[5:-5]].any()                   # free
    assert not moved[[ROW + k for k in range(5, 12)]].any()


def test_a_cage_obeys_the_segments() -> None:
    ob = segmented_panel()
    ob.modifiers.new("Subdivision", 'SUBSURF').levels = 2
    before = scenes.positions(ob)
    assert scenes.smooth(length=0.6) == {'FINISHED'}
    moved = (scenes.positions(ob) != before).any(axis=1)
    assert moved[side(15)[4:-4]].any()
    assert not moved[[1 * ROW + k for k in range(5, 12)]].any()


def test_the_mesh_keeps_what_was_set_through_modes_and_undo() -> None:
    ob = segmented_panel()
    values = stored(ob)
    assert (values[side(1)] == 13000).all()
    assert (values[side(15)[1:-1]] == 1000).all()
    assert np.count_nonzero(values) == len(side(1)) + len(side(15)[1:-1])
    scenes.object_mode()
    assert np.array_equal(stored(ob), values)
    scenes.edit(ob)
    set_border(ob, side(1), 'unset')
    assert not stored(ob)[side(1)].any()


def test_of_faces_the_rim_is_set() -> None:
    ob = scenes.panel()
    scenes.edit(ob)
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    scenes.select_faces(ob, scenes.inner(margin=2))
    assert bpy.ops.reflines.set_border(border='clamped') == {'FINISHED'}
    assert np.count_nonzero(stored(ob)) == 4 * 12


def test_all_of_a_closed_body_has_no_rim() -> None:
    bpy.ops.mesh.primitive_cube_add()
    scenes.edit(bpy.context.object)
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    bpy.ops.mesh.select_all(action='SELECT')
    before = scenes.fingerprint(bpy.context.object)
    with pytest.raises(RuntimeError, match="The selected faces have no rim, since they are all of a closed body"):
        bpy.ops.reflines.set_border(border='clamped')
    assert scenes.fingerprint(bpy.context.object) == before


def two_edited() -> tuple[bpy.types.Object, bpy.types.Object]:
    """Two panels in Edit Mode; the second is active, the first has a selection alone."""
    first, second = scenes.panel("First"), scenes.panel("Second")
    scenes.edit(first, second)
    select_vertices(second, [])
    scenes.select_faces(first, scenes.inner(margin=2))
    return first, second


def test_borders_of_all_edited_meshes_are_set() -> None:
    first, second = two_edited()
    assert bpy.ops.reflines.set_border(border='clamped') == {'FINISHED'}
    assert np.count_nonzero(stored(first)) == first.data.total_vert_sel > 100
    assert "reflines_border" not in bmesh.from_edit_mesh(second.data).verts.layers.int


def test_a_refused_border_is_set_on_no_mesh() -> None:
    for taken in ("First", "Second"):
        first, second = two_edited()
        scenes.object_mode()
        bpy.data.objects[taken].data.attributes.new("reflines_border", 'FLOAT', 'POINT')
        scenes.edit(first, second)
        bpy.ops.mesh.select_all(action='SELECT')
        before = [scenes.fingerprint(ob) for ob in (first, second)]
        with pytest.raises(RuntimeError, match="has another attribute reflines_border"):
            bpy.ops.reflines.set_border(border='fixed')
        assert [scenes.fingerprint(ob) for ob in (first, second)] == before
        for ob in (first, second):
            assert "reflines_border" not in bmesh.from_edit_mesh(ob.data).verts.layers.int
        scenes.object_mode()
        for ob in (first, second):
            bpy.data.objects.remove(ob)


def test_other_segments_make_another_optimizer() -> None:
    """A cached optimizer would go on holding what is no longer held, and the other way round."""
    ob = segmented_panel()
    assert scenes.smooth(length=0.6) == {'FINISHED'}
    set_border(ob, side(1), 'unset')
    scenes.select_faces(ob, scenes.inner())
    before = scenes.positions(ob)
    assert scenes.smooth(length=0.7) == {'FINISHED'}
    assert not (scenes.positions(ob) != before).any(axis=1)[side(2)].any()  # clamped, as the tool has it


@pytest.mark.parametrize("cuts", [1, 2, 4, 11])
def test_a_cut_has_the_border_of_both_ends_or_none(cuts: int) -> None:
    names = ['unset', *CODES]
    pairs = list(itertools.combinations_with_replacement(names, 2))
    mesh = bpy.data.meshes.new("Edges")
    mesh.from_pydata([(x, y, 0.0) for x in range(len(pairs)) for y in range(2)],
                     [(2 * k, 2 * k + 1) for k in range(len(pairs))], [])
    ob = bpy.data.objects.new("Edges", mesh)
    bpy.context.collection.objects.link(ob)
    scenes.edit(ob)
    for name in names:
        set_border(ob, [2 * k + end for k, pair in enumerate(pairs) for end in range(2) if pair[end] == name], name)
    bpy.ops.mesh.select_all(action='SELECT')
    bpy.ops.mesh.subdivide(number_cuts=cuts)
    scenes.object_mode()
    cut = [vertex for vertex in mesh.vertices if 0.0 < vertex.co.y < 1.0]
    codes = border_segments.read_border(ob)[[vertex.index for vertex in cut]]
    wanted = [pairs[round(vertex.co.x)] for vertex in cut]
    assert len(cut) == cuts * len(pairs)
    assert [*codes] == [CODES.get(one, UNSET) if one == other else UNSET for one, other in wanted]


@pytest.mark.parametrize("value", [-1, 57001, 2**31 - 1, -2**31])
def test_values_that_are_no_borders_are_refused(value: int) -> None:
    ob = segmented_panel()
    scenes.object_mode()
    ob.data.attributes["reflines_border"].data[side(1)[0]].value = value
    scenes.edit_inner(ob)
    with scenes.refused(ob, "1 vertices have a border that is none of Free, Position, Tangent, Curv"):
        scenes.smooth()
    set_border(ob, [side(1)[0]], 'fixed')
    scenes.select_faces(ob, scenes.inner())
    assert scenes.smooth(length=0.6) == {'FINISHED'}


@pytest.mark.parametrize(("kind", "domain"), [('FLOAT', 'POINT'), ('INT', 'FACE')])
def test_a_name_that_is_taken_is_refused(kind: str, domain: str) -> None:
    ob = scenes.panel()
    ob.data.attributes.new("reflines_border", kind, domain)
    scenes.look_from_above()
    scenes.edit_inner(ob)
    with pytest.raises(RuntimeError, match="has another attribute reflines_border"):
        bpy.ops.reflines.set_border(border='fixed')
    assert scenes.smooth(length=0.6) == {'FINISHED'}


def test_both_halves_below_a_mirror_have_the_borders_of_the_meshs_own() -> None:
    """View and light are symmetric: the half is solved together with its image."""
    grid = np.linspace(0.0, 1.0, 9)
    vertices = [(x, y, scenes.rippled(x, 2 * y - 1)) for y in grid for x in grid]
    ob = scenes.linked("Half", vertices, scenes.quads(9, 9))
    ob.modifiers.new("Mirror", 'MIRROR')
    scenes.look_from_above()
    scenes.edit(ob)
    set_border(ob, [9 * k + 8 for k in range(9)], 'free')
    bpy.ops.mesh.select_all(action='SELECT')
    before = scenes.positions(ob)
    assert scenes.smooth(length=0.6) == {'FINISHED'}
    moved = (scenes.positions(ob) != before).any(axis=1)
    assert moved[[9 * k + 8 for k in range(3, 6)]].all()
    assert not moved[[9 * k + 8 for k in (0, 8)]].any()  # beside the clamped rows at both ends


CELLS, MARGIN = 32, 6  # of the panel with a bent middle, and rings of faces around its region
EDGE = 1.0 - 2.0 * (MARGIN + 1) / CELLS  # where the middle begins to bend otherwise: at the first vertices that move


def bent(x: float, y: float) -> float:
    share = max(1.0 - (x / EDGE) ** 2, 0.0) * max(1.0 - (y / EDGE) ** 2, 0.0)
    return scenes.crown(x, y) + 0.03 * share**2


def measure_border_curvature(border: str, transform: str = "none") -> float:
    """The largest difference of curvatures along the border, in percent, after a press that wants next to nothing."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    ob = scenes.panel(height=bent, cells=CELLS)
    scenes.look_from_above()
    scenes.transformed(ob, scenes.TRANSFORMS[transform])
    scenes.edit_inner(ob, CELLS, MARGIN)
    assert scenes.smooth(length=0.02, border=border) == {'FINISHED'}
    assert bpy.ops.reflines.check() == {'FINISHED'}
    return next(row.after for row in ob.reflection_lines.check.rows if row.name == "border curvature")


@pytest.mark.parametrize("transform", ["none", "turned, scaled and mirrored", "mirrored"])
def test_the_curvature_runs_on_from_the_faces_beside(transform: str) -> None:
    clamped, curvature = (measure_border_curvature(border, transform) for border in ("clamped", "curvature"))
    print(f"{clamped:.1f} % clamped, {curvature:.1f} % with the curvature of the faces beside")
    assert curvature < 0.75 * clamped  # the largest is at a corner


def test_flow_joins_as_curvature_does_and_says_nothing_where_the_faces_tell_its_rate() -> None:
    clamped, flow = (measure_border_curvature(border) for border in ("clamped", "flow"))
    print(f"{clamped:.1f} % clamped, {flow:.1f} % with the flow of the faces beside")
    assert flow < 0.75 * clamped
    notes = bpy.context.view_layer.objects.active.reflection_lines.report.kept
    assert "Flow is the same as Curvature" not in notes


def noisy(x: float, y: float) -> float:
    seed = [round(1e3 * (1.0 + x)), round(1e3 * (1.0 + y))]
    return bent(x, y) + 0.0001 * float(np.random.default_rng(seed).standard_normal())


def test_flow_by_segment_is_said_to_fall_back_where_noise_hides_the_rate() -> None:
    """Only the vertices of its segment can: the rest is clamped."""
    ob = scenes.panel(height=noisy, cells=CELLS)
    scenes.look_from_above()
    scenes.edit(ob)
    segment = [MARGIN + (CELLS + 1) * k for k in range(MARGIN + 3, CELLS - MARGIN - 2)]
    set_border(ob, segment, 'flow')
    assert (stored(ob)[segment] == 44000).all()
    scenes.select_faces(ob, scenes.inner(CELLS, MARGIN))
    assert scenes.smooth(length=0.3, border='clamped') == {'FINISHED'}
    said = re.search(r"At (\d+) vertices .* Flow \(G3\) is the same as Curvature", ob.reflection_lines.report.kept)
    assert 0.8 * len(segment) <= int(said[1]) <= len(segment)


@pytest.mark.parametrize("border", ["curvature", "flow"])
def test_without_faces_beside_it_is_said(border: str) -> None:
    ob = scenes.edited_panel(margin=0)
    assert scenes.smooth(length=0.6, border=border) == {'FINISHED'}
    assert "No faces beside the region tell the curvature" in ob.reflection_lines.report.kept


def test_a_half_below_a_mirror_takes_the_curvature_on_both_sides() -> None:
    """The half is solved with its image, whose faces beside are the images of its own."""
    grid = np.linspace(-1.0, 1.0, CELLS + 1)
    half, row = grid[CELLS // 2:], CELLS // 2 + 1
    ob = scenes.linked("Half", [(x, y, bent(x, y)) for y in grid for x in half], scenes.quads(row, CELLS + 1))
    ob.modifiers.new("Mirror", 'MIRROR')
    scenes.look_from_above()
    results = []
    for border in ('clamped', 'curvature'):
        scenes.edit(ob)
        scenes.select_faces(ob, lambda face: MARGIN <= face // (row - 1) < CELLS - MARGIN
                            and face % (row - 1) < CELLS // 2 - MARGIN)
        before = scenes.positions(ob)
        assert scenes.smooth(length=0.02, border=border) == {'FINISHED'}
        results.append(np.abs(scenes.positions(ob) - before).max())
        scenes.object_mode()
        ob.data.vertices.foreach_set("co", before.ravel())
    assert results[1] > 3.0 * results[0]
