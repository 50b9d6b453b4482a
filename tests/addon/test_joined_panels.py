"""Tools on panels that face each other over a gap, with the border Neighbours: they are solved as one, so that lines
run on over the gap as they did before, and gap and step stay.
"""
import json
import sys
from collections.abc import Callable

import bmesh
import bpy
import numpy as np
import pytest

import gaps
import scenes
from test_across_gap import start_several

Array = np.ndarray
GAP = 0.008
FOLLOW = 57000  # the border Neighbours as vertices have it
KINK, OFFSET = 0.1, 2.0  # degrees, and percent of the lines' spacing, that a tool may add
FIT = 2e-5  # by which the fits that tell a step err beside a move of two thousandths


def height(x: float, y: float) -> float:
    return scenes.crown(x, y) + 0.002 * np.sin(3.0 * x + 2.0 * y)


def bow(y: float) -> float:
    """Where a curved gap runs."""
    return 0.15 * np.sin(2.0 * y)


def sheet(name: str, columns: Callable[[float], Array], rows: Array, step: float = 0.0) -> bpy.types.Object:
    return gaps.build_sheet(name, columns, rows, lambda x, y: height(x, y) + step)


def start(kind: str = "straight", gap: float = GAP) -> tuple[bpy.types.Object, bpy.types.Object]:
    """Left, which is active, and Right, all faces selected; both have other meshes. Nothing else is left."""
    scenes.remove_all()
    middle = bow if kind == "curved" else (lambda _y: 0.0)
    step = 0.001 if kind == "step" else 0.0
    right = sheet("Right", lambda y: np.linspace(middle(y) + 0.5 * gap, 1.0, 18), np.linspace(-1.0, 1.0, 37), step)
    left = sheet("Left", lambda y: np.linspace(-1.0, middle(y) - 0.5 * gap, 25), np.linspace(-1.0, 1.0, 49))
    start_several(right, left)
    bpy.ops.ed.undo_push(message="Start")
    return left, right


def find_rim(ob: bpy.types.Object, kind: str = "straight") -> Array:
    """The vertices at the gap, without its ends."""
    V = scenes.world(ob)
    return np.flatnonzero((np.abs(V[:, 0] - (bow(V[:, 1]) if kind == "curved" else 0.0)) < GAP)
                          & (np.abs(V[:, 1]) < 0.99))


def measure_gap(left: bpy.types.Object, right: bpy.types.Object) -> dict[str, Array]:
    """What Check measures along the gap, without its ends."""
    addon, scene = sys.modules["reflection_lines"], bpy.context.scene
    panels = [addon.read.gather.gather_patch(ob) for ob in (left, right)]
    seen = addon.view.view_and_light.read_scene_view(scene, addon.model.meeting.find_middle(panels))
    found, middle = gaps.measure(*((scenes.world(ob), list_triangles(ob)) for ob in (left, right)), seen)
    return gaps.choose(found, np.abs(middle[:, 1]) < 0.8)


def list_triangles(ob: bpy.types.Object) -> Array:
    ob.data.calc_loop_triangles()
    return np.array([triangle.vertices[:] for triangle in ob.data.loop_triangles])


def turn(place: tuple[float, float, float] = (-0.1, 0.1, 0.0), **settings: object) -> set[str]:
    """Turns the lines around a place beside the gap."""
    bpy.context.scene.cursor.location = place
    return bpy.ops.reflines.direction('EXEC_DEFAULT', True, **{"angle": 0.3, "centre": 'CURSOR', "radius": 0.5,
                                                               "border": 'follow', **settings})


def straighten(**settings: object) -> set[str]:
    return bpy.ops.reflines.direction('EXEC_DEFAULT', True, **{"direction": 'MEAN', "centre": 'EVERYWHERE',
                                                               "border": 'follow', **settings})


def warp(**settings: object) -> set[str]:
    """Pulls the middle of a lattice over both."""
    bpy.ops.reflines.add_warp_lattice()
    point = bpy.context.scene.reflection_lines.warp.lattice.data.points[12]
    point.co_deform.x, point.co_deform.y = point.co_deform.x + 0.2, point.co_deform.y + 0.3
    return bpy.ops.reflines.warp('EXEC_DEFAULT', True, **{"border": 'follow', **settings})


def pull(**settings: object) -> set[str]:
    """Pulls a line of the left panel beside the gap."""
    handle = {"start": (-0.35, 0.0, 0.0), "end": (-0.32, 0.015, 0.0), "radius": 0.6, "pinned": [], "muted": False}
    return bpy.ops.reflines.pull_line('EXEC_DEFAULT', True, **{"handles": json.dumps([handle]), "border": 'follow',
                                                               **settings})


TOOLS = {"turn": turn, "straighten": straighten, "warp": warp, "pull": pull}


@pytest.mark.parametrize("kind", ["straight", "curved", "step"])
@pytest.mark.parametrize("tool", list(TOOLS))
def test_lines_run_on_over_the_gap_as_before(tool: str, kind: str) -> None:
    left, right = start(kind)
    before, was = measure_gap(left, right), [scenes.world(left), scenes.world(right)]
    assert TOOLS[tool]() == {'FINISHED'}
    after = measure_gap(left, right)
    moves = [np.abs(move[:, 2]).max() for move in gaps.find_moves((left, right), was)]
    print(tool, kind, moves, [float(each[name].max()) for each in (before, after) for name in ("kink", "line_offset")],
          float(np.abs(after["flush"] - before["flush"]).max()))
    assert min(moves) > 1e-4
    gaps.assert_kept(before, after, kink=KINK, offset=OFFSET, fit=FIT)
    gaps.assert_undone((left, right), was)


@pytest.mark.parametrize("tool", list(TOOLS))
def test_a_perspective_view_is_that_of_the_middle_of_both(tool: str) -> None:
    """Stripes are drawn so, too, and run on over the gap."""
    left, right = start()
    camera = bpy.context.scene.reflection_lines.camera
    camera.data.type, camera.location = 'PERSP', (0.4, -0.6, 4.0)
    bpy.context.view_layer.update()
    before, was = measure_gap(left, right), [scenes.world(left), scenes.world(right)]
    assert TOOLS[tool]() == {'FINISHED'}
    after = measure_gap(left, right)
    moves = gaps.find_moves((left, right), was)
    assert min(np.abs(move)[find_rim(ob)].max() for ob, move in zip((left, right), moves, strict=True)) > 1e-4
    assert after["kink"].max() < before["kink"].max() + KINK
    assert after["line_offset"].max() < before["line_offset"].max() + OFFSET
    assert np.abs(after["flush"] - before["flush"]).max() < FIT
    middles = [ob.matrix_world @ ob.reflection_lines.center for ob in (left, right)]
    assert (middles[0] - middles[1]).length < 1e-6
    towards = np.array(camera.location) - np.array(middles[0])
    largest = [move[np.linalg.norm(move, axis=1).argmax()] for move in moves]
    assert all(np.linalg.norm(np.cross(each, towards)) < 1e-4 * np.linalg.norm(each) * np.linalg.norm(towards)
               for each in largest)


def test_a_dense_panel_beside_a_coarse_one_gets_no_fold_behind_its_rim() -> None:
    right = sheet("Right", lambda _y: np.linspace(0.5 * GAP, 1.0, 7), np.linspace(-1.0, 1.0, 13))
    left = sheet("Left", lambda _y: np.linspace(-1.0, -0.5 * GAP, 101), np.linspace(-1.0, 1.0, 201))
    start_several(right, left)
    before, was = measure_gap(left, right), scenes.world(left)
    assert straighten() == {'FINISHED'}
    move = (scenes.world(left) - was)[:, 2].reshape(201, 101)
    bend = np.abs(np.diff(move, n=2, axis=1))[20:-20]
    assert bend[:, -3:].max() < 3.0 * bend[:, -12:-6].max()
    assert measure_gap(left, right)["kink"].max() < before["kink"].max() + KINK


@pytest.mark.parametrize("tool", list(TOOLS))
def test_rims_that_touch_move_as_one(tool: str) -> None:
    """Where each vertex of one rim lies on one of the other; the left panel has rows between."""
    rows = np.linspace(-1.0, 1.0, 25)
    right = sheet("Right", lambda _y: np.linspace(0.0, 1.0, 18), rows)
    left = sheet("Left", lambda _y: np.linspace(-1.0, 0.0, 25), np.linspace(-1.0, 1.0, 49))
    start_several(right, left)
    was = [scenes.world(left), scenes.world(right)]
    assert TOOLS[tool]() == {'FINISHED'}
    sides = [move[find_rim(ob), 2] for ob, move in zip((left, right), gaps.find_moves((left, right), was), strict=True)]
    assert np.abs(sides[1]).max() > 1e-4 and np.abs(sides[0][1::2] - sides[1]).max() < 2e-7
    between = 0.5 * (sides[1][1:] + sides[1][:-1]) - sides[0][2:-1:2]
    assert np.abs(between).max() < 0.05 * np.abs(sides[1]).max()


@pytest.mark.parametrize("tool", list(TOOLS))
def test_by_default_panels_that_face_each_other_are_one(tool: str) -> None:
    left, right = start()
    shapes = []
    for border in ("automatic", "follow"):
        assert TOOLS[tool](border=border) == {'FINISHED'}
        shapes.append([scenes.world(bpy.data.objects[name]) for name in ("Left", "Right")])
        bpy.ops.ed.undo()
    assert bpy.context.scene.reflection_lines.border == 'automatic'
    assert all(np.array_equal(*each) for each in zip(*shapes, strict=True))


@pytest.mark.parametrize("why", ["apart", "tilted", "cage", "alone"])
@pytest.mark.parametrize("tool", list(TOOLS))
def test_by_default_what_faces_nothing_is_as_with_tangent_to_the_bit(tool: str, why: str) -> None:
    shapes, notes = [], []
    for border in ("automatic", "clamped"):
        left, right = start_apart(why)
        assert TOOLS[tool](border=border) == {'FINISHED'}
        shapes.append([scenes.world(ob) for ob in (left, right)])
        notes.append(left.reflection_lines.report.notes)
    assert all(np.array_equal(*each) for each in zip(*shapes, strict=True))
    assert notes[0] == notes[1]


def start_apart(why: str) -> tuple[bpy.types.Object, bpy.types.Object]:
    """Both panels anew, of which one is not to be joined with the other."""
    left, right = start()
    scenes.object_mode()
    if why == "apart":
        right.location.x = 0.1
    elif why == "tilted":
        right.rotation_euler.y = 0.5
    elif why == "cage":
        right.modifiers.new("Subdivision", 'SUBSURF').levels = 1
    right.select_set(why != "alone")
    bpy.context.view_layer.objects.active = left
    bpy.ops.object.mode_set(mode='EDIT')
    return left, right


@pytest.mark.parametrize("gap", [0.0, GAP])
def test_three_panels_that_meet_in_a_t_move_as_one(gap: float) -> None:
    h = 0.5 * gap
    upper = sheet("Upper", lambda _y: np.linspace(h, 1.0, 18), np.linspace(h, 1.0, 21))
    lower = sheet("Lower", lambda _y: np.linspace(h, 1.0, 21), np.linspace(-1.0, -h, 16))
    left = sheet("Left", lambda _y: np.linspace(-1.0, -h, 25), np.linspace(-1.0, 1.0, 49))
    start_several(upper, lower, left)
    every = left, lower, upper
    was = [scenes.world(ob) for ob in every]
    assert turn() == {'FINISHED'}
    corner = [move[np.hypot(*old[:, :2].T).argmin(), 2]
              for move, old in zip(gaps.find_moves(every, was), was, strict=True)]
    assert min(map(abs, corner)) > 1e-4 and np.ptp(corner) < (1e-7 if gap == 0.0 else 0.2 * max(map(abs, corner)))
    for one, other in ((left, lower), (left, upper), (lower, upper)):
        found = measure_gap(one, other)
        assert found["kink"].max() < KINK and found["line_offset"].max() < OFFSET


def test_panels_elsewhere_in_the_same_run_change_no_bit() -> None:
    """Their own pair is one patch, and no part of that of the others."""
    pair, shapes = start(), []
    for beside in (False, True):
        scenes.object_mode()
        for ob in pair if beside else ():
            other = ob.copy()
            other.data, other.location.x, other.scale.z = ob.data.copy(), 3.0, 1.5
            bpy.context.collection.objects.link(other)
            other.select_set(True)
        for ob in pair:
            ob.select_set(True)
        bpy.ops.object.mode_set(mode='EDIT')
        bpy.ops.ed.undo_push(message="Pairs")
        assert straighten(border='follow') == {'FINISHED'}
        shapes.append([scenes.world(bpy.data.objects[name]) for name in ("Left", "Right")])
        bpy.ops.ed.undo()
        pair = [bpy.data.objects[name] for name in ("Left", "Right")]
    assert all(np.array_equal(*each) for each in zip(*shapes, strict=True))


def test_a_pull_moves_no_face_that_is_not_selected() -> None:
    left, right = start()
    scenes.select_faces(right, lambda face: face < 18 * 17)  # the lower half, in rows of 17
    was = scenes.world(right)
    assert pull() == {'FINISHED'}
    moved = np.abs(scenes.world(right) - was)[:, 2] > 0.0
    assert moved.any() and not moved[was[:, 1] > 0.0].any()
    assert np.abs(scenes.world(left)[find_rim(left)][:, 2]).max() > 0.0


@pytest.mark.parametrize("border", ["follow", "clamped"])
def test_a_pull_beside_a_panel_that_is_not_edited_keeps_its_rim_and_the_slope_there(border: str) -> None:
    left, right = start()
    scenes.object_mode()
    right.select_set(False)
    bpy.context.view_layer.objects.active = left
    bpy.ops.object.mode_set(mode='EDIT')
    was, other = scenes.world(left), scenes.world(right)
    assert pull(border=border) == {'FINISHED'}
    moved = np.abs(scenes.world(left) - was)[:, 2] > 0.0
    column = np.arange(len(was)) % 25
    assert moved.any() and not moved[column >= 23].any() and np.array_equal(scenes.world(right), other)


@pytest.mark.parametrize("side", ['OUTWARD', 'INWARD'])
def test_rims_keep_to_the_limit_and_to_its_side(side: str) -> None:
    left, right = start()
    was = [scenes.world(left), scenes.world(right)]
    for ob in (left, right):
        ob.reflection_lines.limit_side = side
    assert turn(limit=4e-4) == {'FINISHED'}
    for ob, move in zip((left, right), gaps.find_moves((left, right), was), strict=True):
        outwards = (1.0 if side == 'OUTWARD' else -1.0) * move[:, 2]
        assert outwards.min() >= -1e-7 and 1e-4 < outwards[find_rim(ob)].max() <= 4.001e-4


def test_only_the_segments_that_follow_move() -> None:
    pair = start()
    rims = [find_rim(ob) for ob in pair]
    for ob, rim in zip(pair, rims, strict=True):
        edit = bmesh.from_edit_mesh(ob.data)
        layer = edit.verts.layers.int.new("reflines_border")
        edit.verts.ensure_lookup_table()
        for v in rim:
            edit.verts[v][layer] = FOLLOW if edit.verts[v].co.y > 0.0 else 0
        bmesh.update_edit_mesh(ob.data)
    was = [scenes.world(ob) for ob in pair]
    assert turn(border='clamped') == {'FINISHED'}
    for ob, old, rim in zip(pair, was, rims, strict=True):
        move, y = np.abs(scenes.world(ob) - old)[rim, 2], old[rim, 1]
        assert move[y > 0.1].max() > 1e-4 and move[y < -0.1].max() == 0.0
        assert np.abs(np.diff(move)).max() < 0.5 * move.max()  # without a tear between


def test_what_cannot_be_joined_is_solved_by_itself_and_says_so() -> None:
    left, right = start()
    right.modifiers.new("Subdivision", 'SUBSURF').levels = 1
    was = scenes.world(left)
    assert turn() == {'FINISHED'}
    assert np.array_equal(scenes.world(left)[find_rim(left)], was[find_rim(left)])
    assert "here it was Tangent" in left.reflection_lines.report.notes


def test_re_solve_refuses_to_leave_the_other_behind() -> None:
    left, right = start()
    assert straighten() == {'FINISHED'}
    scenes.object_mode()
    bpy.context.view_layer.objects.active = left
    bpy.data.objects.remove(right)
    with scenes.refused(left, "Left was moved as one with Right, which has changed since"):
        bpy.ops.reflines.resolve('EXEC_DEFAULT', True)


def test_a_bake_says_that_the_other_panel_does_not_follow() -> None:
    left, _ = start()
    describe = sys.modules["reflection_lines"].interactive.handle_bake.describe_partners
    assert not describe(left)
    assert pull() == {'FINISHED'}
    assert "Right, which followed the pull, stayed" in describe(left)[0]
