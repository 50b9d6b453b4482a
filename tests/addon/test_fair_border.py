"""Smooth with a faired border in Blender: the native function's result, and what it must not touch."""
import bmesh
import bpy
import numpy as np
import pytest
from reflection_lines import native
from reflection_lines.state import solve_history

import scenes
from test_borders import set_border

CELLS, MARGIN = 48, 10
ROW = CELLS + 1


def noisy(x: float, y: float) -> float:
    """The clean panel with waves that run across the border of the region, at x, y = +-0.58."""
    return scenes.crown(x, y) + 6e-4 * np.sin(40.0 * x + 1.0) * np.cos(38.0 * y)


def ready() -> bpy.types.Object:
    return scenes.edited_panel(height=noisy, cells=CELLS, margin=MARGIN)


def rim() -> np.ndarray:
    """Vertices of the region's border (#V, bool)."""
    i, j = np.arange(ROW**2) % ROW, np.arange(ROW**2) // ROW
    edge = np.maximum(np.abs(i - CELLS // 2), np.abs(j - CELLS // 2))
    return edge == CELLS // 2 - MARGIN


def own_vertices() -> np.ndarray:
    i, j = np.arange(ROW**2) % ROW, np.arange(ROW**2) // ROW
    return np.maximum(np.abs(i - CELLS // 2), np.abs(j - CELLS // 2)) <= CELLS // 2 - MARGIN


def test_a_press_gives_the_positions_of_the_native_function_to_the_bit() -> None:
    ob = ready()
    before = scenes.positions(ob)
    assert scenes.smooth(fair_border=True) == {'FINISHED'}
    last, scene = solve_history.find_last_solve(ob.name), bpy.context.scene.reflection_lines
    patch = last.patch
    positions, told = native.reflines.smooth_panel(
        patch.V, patch.F, view_direction=scenes.axis_z(scene.camera), line_direction=scenes.axis_z(scene.light),
        around=(patch.around.V, patch.around.F), fair_border=np.ones(len(patch.V), dtype=bool))
    assert told.applied and np.array_equal(last.positions, positions)
    moved = (scenes.positions(ob) != before).any(axis=1)
    assert moved[rim()].mean() > 0.9 and not moved[~own_vertices()].any()


def test_all_faces_within_the_reach_are_read() -> None:
    """Two lengths of a seventh of the diagonal, which the native press takes in, and no smaller number of rings."""
    ob = ready()
    scenes.smooth(fair_border=True)
    patch = solve_history.find_last_solve(ob.name).patch
    edge = 2.0 / CELLS
    outside = np.abs(patch.around.V[:, :2]).max(axis=1) - np.abs(patch.V[:, :2]).max()
    assert outside.max() >= patch.diagonal / 7.0 and outside.max() > 5.5 * edge
    scenes.smooth()
    near = solve_history.find_last_solve(ob.name).patch.around.V
    assert np.abs(near[:, :2]).max() - np.abs(patch.V[:, :2]).max() == pytest.approx(4.0 * edge, rel=1e-3)


def test_segments_with_a_border_of_their_own_are_held() -> None:
    ob = scenes.panel(height=noisy, cells=CELLS)
    scenes.look_from_above()
    scenes.edit(ob)
    side = np.flatnonzero(rim() & (np.arange(ROW**2) % ROW == MARGIN))
    set_border(ob, side.tolist(), 'fixed')
    scenes.select_faces(ob, scenes.inner(CELLS, MARGIN))
    before = scenes.positions(ob)
    assert scenes.smooth(fair_border=True) == {'FINISHED'}
    moved = (scenes.positions(ob) != before).any(axis=1)
    others = rim()
    others[side] = False
    assert not moved[side].any() and moved[others].mean() > 0.9


def test_with_a_length_it_makes_no_difference() -> None:
    """Only the automatic press knows what the border should be; the switch is drawn grey with a length."""
    results = []
    for fair in (False, True):
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        ob = ready()
        scenes.smooth(length=0.3, fair_border=fair)
        results.append(scenes.positions(ob))
    assert np.array_equal(*results)


def test_resolve_fairs_again() -> None:
    ob = ready()
    scenes.smooth(fair_border=True)
    first = scenes.positions(ob)
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT') == {'FINISHED'}
    assert np.array_equal(scenes.positions(ob), first)


def half_below_a_mirror(height: scenes.Height) -> bpy.types.Object:
    """The half x >= 0 of the panel, rows of CELLS // 2 faces."""
    grid = np.linspace(-1.0, 1.0, ROW)
    half, row = grid[CELLS // 2:], CELLS // 2 + 1
    ob = scenes.linked("Half", [(x, y, height(x, y)) for y in grid for x in half], scenes.quads(row, ROW))
    ob.modifiers.new("Mirror", 'MIRROR')
    return ob


def in_half_region(face: int) -> bool:
    return MARGIN <= face // (CELLS // 2) < CELLS - MARGIN and face % (CELLS // 2) < CELLS // 2 - MARGIN


def press_half(*, applied: bool) -> np.ndarray:
    """Moves of the half (ROW x CELLS // 2 + 1) after a press below a Mirror or, with the other half, without it."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    ob = half_below_a_mirror(lambda x, y: scenes.crown(x, y) + 6e-4 * np.cos(40.0 * x) * np.cos(38.0 * y + 0.7))
    count = len(ob.data.polygons)
    if applied:
        bpy.ops.object.modifier_apply(modifier="Mirror")
    scenes.look_from_above(light_degrees=90.0)
    scenes.edit(ob)
    scenes.select_faces(ob, lambda face: in_half_region(face % count))
    before = scenes.positions(ob)
    assert scenes.smooth(fair_border=True) == {'FINISHED'}
    return (scenes.positions(ob) - before)[:ROW * (CELLS // 2 + 1), 2].reshape(ROW, -1)


def test_below_a_mirror_the_border_moves_as_with_the_mirror_applied() -> None:
    """At the seam too, where the faces beside the region go on into their image, and by as many faces beside it."""
    below, applied = press_half(applied=False), press_half(applied=True)
    apart, largest = np.abs(below - applied).max(), np.abs(applied).max()
    print(f"{1e6 * apart:.2f} of {1e6 * largest:.0f} um apart")
    assert np.abs(applied[[MARGIN, CELLS - MARGIN], 0]).min() > 0.3 * largest
    assert apart < 0.01 * largest


@pytest.mark.parametrize("even", [True, False])
def test_a_half_below_a_mirror_is_faired_with_its_image(even: bool) -> None:
    """Lit unevenly it is solved alone, and its seam stays."""
    ob, row = half_below_a_mirror(noisy), CELLS // 2 + 1
    scenes.look_from_above(light_degrees=90.0 if even else 70.0)
    scenes.edit(ob)
    scenes.select_faces(ob, in_half_region)
    before = scenes.positions(ob)
    assert scenes.smooth(fair_border=True) == {'FINISHED'}
    move = np.abs(scenes.positions(ob) - before).max(axis=1).reshape(ROW, row)
    own = slice(MARGIN, CELLS - MARGIN + 1), slice(0, CELLS // 2 - MARGIN + 1)
    assert (move[own][:, -1] > 0.0).mean() > 0.9  # the border
    seam = (move[own][:, 0] > 0.0).mean()
    assert seam > 0.7 if even else seam == 0.0
    outside = np.ones_like(move, dtype=bool)
    outside[own] = False
    assert not move[outside].any()


def test_cages_are_refused_in_a_sentence() -> None:
    ob = ready()
    ob.modifiers.new("Subdivision", 'SUBSURF')
    before = scenes.positions(ob)
    with pytest.raises(RuntimeError, match="the border of a cage cannot be faired"):
        scenes.smooth(fair_border=True)
    assert np.array_equal(scenes.positions(ob), before)


def spoil(kind: str, mesh: bmesh.types.BMesh) -> None:
    """Makes a fault beside the region, three columns of vertices from its border."""
    column = MARGIN - 3
    low, high = (mesh.verts[j * ROW + column] for j in (CELLS // 2, CELLS // 2 + 1))
    if kind == "corner on a line":
        bmesh.ops.bisect_edges(mesh, edges=[mesh.edges.get((low, high))], cuts=1)
    elif kind == "zero area":
        for vertex in (low, high):
            vertex.co = mesh.verts[vertex.index + 1].co
    elif kind == "third face at an edge":
        mesh.faces.new((low, high, mesh.verts.new((low.co.x, low.co.y, 0.3))))
    elif kind == "doubled face":
        mesh.faces.new([mesh.verts.new(v.co) for v in low.link_faces[0].verts])
    elif kind == "no number":
        low.co.z = np.nan


FAULTS = ["corner on a line", "zero area", "third face at an edge", "doubled face", "no number"]


@pytest.mark.parametrize("kind", FAULTS)
def test_a_fault_beside_the_region_is_no_reason_to_refuse_it(kind: str) -> None:
    """The border moves; what is left out beside a fault holds only what is near it."""
    ob = scenes.panel(height=noisy, cells=CELLS)
    scenes.look_from_above()
    mesh = bmesh.new()
    mesh.from_mesh(ob.data)
    for elements in (mesh.verts, mesh.faces):
        elements.ensure_lookup_table()
    spoil(kind, mesh)
    mesh.to_mesh(ob.data)
    mesh.free()
    scenes.edit(ob)
    inside = {polygon.index for polygon in ob.data.polygons
              if max(abs(polygon.center.x), abs(polygon.center.y)) < 1.0 - 2.0 * MARGIN / CELLS}
    scenes.select_faces(ob, inside.__contains__)
    before = scenes.positions(ob)
    assert scenes.smooth(fair_border=True) == {'FINISHED'}
    moved = (scenes.positions(ob) != before)[:ROW**2, 2] & np.isfinite(before[:ROW**2, 2])
    assert moved[rim()].mean() > (0.99 if kind == "corner on a line" else 0.9)
    assert not moved[~own_vertices()].any()
    held = int((rim() & ~moved).sum())
    assert ("it was held there" in ob.reflection_lines.report.notes) == (held > 0)


def test_a_limit_and_a_held_border_are_both_told() -> None:
    ob = scenes.edited_panel(height=noisy, cells=CELLS, margin=0)
    assert scenes.smooth(fair_border=True, limit=1e-5) == {'FINISHED'}
    report = ob.reflection_lines.report
    assert report.limited > 0 and "There are no faces beside the region" in report.notes
