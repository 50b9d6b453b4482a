"""What the tools for the hand, and Check, do to two panels that meet over a gap and are both in Edit Mode. Those that
need a mouse are in tests/ui/test_several_panels.py.
"""
import json
import sys

import bmesh
import bpy
import numpy as np
import pytest

import gaps
import scenes
from test_across_gap import half, start_several

GAP = 0.008
Pair = tuple[bpy.types.Object, bpy.types.Object]


def waved(x: float, y: float) -> float:
    return scenes.crown(x, y) + 0.002 * np.sin(3.0 * x + 2.0 * y)


def start() -> Pair:
    """Both panels with all faces selected, the left one active."""
    right, left = half("Right", 0.5 * GAP, 1.0, waved, 17), half("Left", -1.0, -0.5 * GAP, waved)
    start_several(right, left)
    bpy.ops.ed.undo_push(message="Start")
    return left, right


def direct(pair: Pair, **settings: object) -> list[np.ndarray]:
    """Runs Direction and Density; returns the moves of both panels, and takes them back by one undo."""
    before = [scenes.world(ob) for ob in pair]
    assert bpy.ops.reflines.direction('EXEC_DEFAULT', True, **{"angle": 0.2, **settings}) == {'FINISHED'}
    moves = gaps.find_moves(pair, before)
    gaps.assert_undone(pair, before)
    return moves


def notes(ob: bpy.types.Object) -> str:
    return ob.reflection_lines.report.notes


@pytest.mark.parametrize("kind", ["REGION", "ACTIVE"])
def test_a_fall_off_has_one_centre_for_both(kind: str) -> None:
    left, right = start()
    edit = bmesh.from_edit_mesh(left.data)
    place = min(edit.verts, key=lambda vertex: np.hypot(vertex.co.x + 0.2, vertex.co.y - 0.1))
    edit.select_history.add(place)
    middle = 0.5 * (np.minimum(*(scenes.world(ob).min(axis=0) for ob in (left, right)))
                    + np.maximum(*(scenes.world(ob).max(axis=0) for ob in (left, right))))
    bpy.context.scene.cursor.location = middle if kind == 'REGION' else left.matrix_world @ place.co
    radius = 0.0 if kind == 'REGION' else 0.5
    own, given = (direct((left, right), centre=centre, radius=radius) for centre in (kind, 'CURSOR'))
    for one, other in zip(own, given, strict=True):
        assert np.abs(one).max() > 1e-4 and np.allclose(one, other, atol=1e-7)


def test_panels_that_do_not_meet_have_each_their_own_centre() -> None:
    left, right = start()
    right.location.x += 3.0
    bpy.context.view_layer.update()
    assert all(np.abs(move).max() > 1e-4 for move in direct((left, right), centre='REGION'))


def test_tangent_keeps_gap_and_step_and_free_says_that_they_change() -> None:
    pair = start()
    rims = [np.abs(scenes.world(ob)[:, 0]) < GAP for ob in pair]
    for border in ('clamped', 'free'):
        moved = [np.abs(move[rim]).max() for move, rim in
                 zip(direct(pair, centre='EVERYWHERE', direction='ANGLE', border=border), rims, strict=True)]
        assert (max(moved) == 0.0) == (border == 'clamped')
        assert ("gap and step towards Right change" in notes(pair[0])) == (border == 'free')
    assert "gap and step towards Left change" in notes(pair[1])


def test_what_follows_no_neighbours_says_so() -> None:
    left, right = start()
    assert bpy.ops.reflines.direction('EXEC_DEFAULT', True, angle=0.2, border='follow') == {'FINISHED'}
    assert "here it was Tangent" not in notes(left) + notes(right)
    scenes.select_faces(right, lambda _face: False)
    assert bpy.ops.reflines.direction('EXEC_DEFAULT', True, angle=0.2, border='follow') == {'FINISHED'}
    assert "Neighbours follows panels in Edit Mode that face each other" in notes(left)
    assert "here it was Tangent" in notes(left)
    assert scenes.smooth(border='follow') == {'FINISHED'}
    assert "here it was Tangent" not in notes(left)


@pytest.mark.parametrize("settings", [{"direction": 'MEAN'}, {"direction": 'ANGLE', "angle": 1.3}],
                         ids=["mean", "angle"])
def test_straight_lines_have_one_direction_and_density_on_both(settings: dict) -> None:
    """Each panel by itself takes its own mean: their lines would meet at an angle, and not one for one."""
    pair = start()
    assert bpy.ops.reflines.direction('EXEC_DEFAULT', True, **settings, centre='EVERYWHERE', border='free',
                                      limit=10.0) == {'FINISHED'}
    scene, addon, gradients = bpy.context.scene, sys.modules["reflection_lines"], []
    for ob in pair:
        patch = addon.read.gather.gather_patch(ob)
        optimizer = addon.native_call.run_now(addon.solver.live_optimizer.build_optimizer(
            patch, addon.view.facing.read_patch_view(scene, patch), 'free')).optimizer
        gradients.append(addon.native.reflines.median_gradient(optimizer))
    assert np.linalg.norm(gradients[0] - gradients[1]) < 0.01 * np.linalg.norm(gradients[0])


def test_a_warp_moves_both_and_one_undo_takes_both_back() -> None:
    pair = start()
    assert bpy.ops.reflines.add_warp_lattice() == {'FINISHED'}
    lattice = bpy.context.scene.reflection_lines.warp.lattice
    extent = np.ptp([lattice.matrix_world @ point.co_deform for point in lattice.data.points], axis=0)
    assert np.allclose(extent[:2], 2.0, atol=1e-3)  # over both
    lattice.data.points[12].co_deform.y += 0.5  # the middle one, over the gap
    bpy.ops.ed.undo_push(message="Lattice")
    before = [scenes.world(ob) for ob in pair]
    assert bpy.ops.reflines.warp('EXEC_DEFAULT', True) == {'FINISHED'}
    assert all(np.abs(move).max() > 1e-5 for move in gaps.find_moves(pair, before))
    gaps.assert_undone(pair, before)


def test_an_image_is_one_picture_over_both() -> None:
    """It moves a panel as the same picture does that is put over both by its place and width."""
    image = bpy.data.images.new("Ramp", 32, 32, float_buffer=True)
    image.pixels.foreach_set(np.repeat(np.tile(np.linspace(0.0, 1.0, 32) ** 2, 32), 4).astype(np.float32))
    left, right = start()
    before, moves = scenes.world(left), []
    for chosen, settings in ((True, {}), (False, {"width": 2.0, "offset": (0.5 + 0.25 * GAP, 0.0)})):
        scenes.select_faces(right, lambda _face, chosen=chosen: chosen)
        assert bpy.ops.reflines.pattern('EXEC_DEFAULT', True, image="Ramp", border='free', **settings) == {'FINISHED'}
        moves.append(scenes.world(left) - before)
        bpy.ops.ed.undo()
        left, right = bpy.data.objects["Left"], bpy.data.objects["Right"]
    assert np.abs(moves[0]).max() > 1e-4 and np.allclose(*moves, atol=0.01 * np.abs(moves[0]).max())


def test_check_measures_both_and_the_shut_line_from_both_sides() -> None:
    left, right = start()
    assert bpy.ops.reflines.check('EXEC_DEFAULT', True) == {'FINISHED'}
    for ob, other in ((left, "Right"), (right, "Left")):
        shown, = ob.reflection_lines.check.list_shut_lines()
        assert shown.describe().startswith(f"Shut line 1, {other}: gap 8 mm to 8 mm")


def test_check_leaves_what_it_cannot_measure_and_measures_the_other() -> None:
    left, right = start()
    for vertex in bmesh.from_edit_mesh(right.data).verts:
        vertex.co.x = float("nan")
    with pytest.raises(RuntimeError, match="Right"):
        bpy.ops.reflines.check('EXEC_DEFAULT', True)
    assert len(left.reflection_lines.check.rows) and not len(right.reflection_lines.check.rows)


@pytest.mark.parametrize("tool", ["pull_line", "inspect"])
def test_what_works_on_the_active_object_alone_names_the_other(tool: str) -> None:
    left, _ = start()
    scenes.select_faces(left, lambda _face: False)
    handle = {"start": (0.3, 0.0, 0.0), "end": (0.3, 0.1, 0.0), "radius": 0.5, "pinned": [], "muted": False}
    settings = {"handles": json.dumps([handle])} if tool == "pull_line" else {}
    with pytest.raises(RuntimeError, match="Left is active and has no selected faces: .* or make Right active"):
        getattr(bpy.ops.reflines, tool)('EXEC_DEFAULT', True, **settings)
