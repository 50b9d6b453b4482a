"""The set of lights: what fills it, the press of Smooth with it, and what of it cannot be used."""
from collections.abc import Callable
from dataclasses import replace

import bpy
import numpy as np
import pytest
from reflection_lines import native
from reflection_lines.view import facing
from reflection_lines.view.read_light_set import read_light_set
from reflection_lines.interactive.solve_job import SolveJob, SolveRequest
from reflection_lines.model.light_set import Blockers
from reflection_lines.native_call import run_now
from reflection_lines.solver import automatic_smooth
from reflection_lines.solver.automatic_smooth import AutomaticSmooth
from reflection_lines.state import solve_history

import scenes
from keying import pull
from scenes import settings

CELLS, CAGE_CELLS = 32, 20


def dented(x: float, y: float) -> float:
    return scenes.crown(x, y) - 0.003 * float(np.exp(-((x - 0.1)**2 + (y + 0.2)**2) / 0.1**2))


def make_panel(kind: str = "mesh") -> bpy.types.Object:
    """A cage has as many vertices as its surface needs."""
    cells = CAGE_CELLS if kind == "cage" else CELLS
    ob = scenes.edited_panel(height=dented, cells=cells)
    if kind != "mesh":
        ob.modifiers.new("Modifier", {"cage": 'SUBSURF', "mirrored": 'MIRROR'}[kind])
    return ob


def press(**given: object) -> None:
    assert bpy.ops.reflines.smooth('EXEC_DEFAULT', True, lights='SET', **given) == {'FINISHED'}


def walk() -> bpy.types.bpy_prop_collection:
    assert bpy.ops.reflines.light_set('EXEC_DEFAULT', True, action='WALK') == {'FINISHED'}
    return settings().light_set.entries


def add_light() -> bpy.types.PropertyGroup:
    assert bpy.ops.reflines.light_set('EXEC_DEFAULT', True, action='ADD') == {'FINISHED'}
    return settings().light_set.find_active()


def expected(light_set: object) -> np.ndarray:
    """What the native press makes of the region that the last press took."""
    patch = solve_history.find_last_solve(bpy.context.object.name).patch
    view, line = scenes.axis_z(settings().camera), scenes.axis_z(settings().light)
    positions, told = native.reflines.smooth_panel(patch.V, patch.F, view_direction=view, line_direction=line,
                                                   light_set=light_set)
    assert told.applied
    return positions


def test_the_walk_around_has_five_views_and_two_lights() -> None:
    ob = make_panel()
    entries = walk()
    assert len(entries) == 10 and entries[0].name == "The view, light" and entries[3].name == "Its left, crossed"
    assert len({tuple(entry.eye) for entry in entries}) == 5
    walk()
    assert len(entries) == 10
    press()
    found = read_light_set(settings(), [ob])
    assert len(found.lights) == 10 and len(found.blockers[0].F) == 2 * CELLS**2
    eyes, lines = (np.array([getattr(light, name) for light in found.lights]) for name in ("eye", "line"))
    patch = solve_history.find_last_solve(ob.name).patch
    assert np.array_equal(solve_history.find_last_solve(ob.name).positions,
                          expected(native.reflines.LightSet(lines, eyes)))
    assert np.abs(solve_history.find_last_solve(ob.name).positions - patch.V).max() > 0.001


def test_a_light_of_its_own_stays_beside_a_walk_around_and_follows_its_objects() -> None:
    ob = make_panel()
    add_light()
    walk()
    assert len(settings().light_set.entries) == 11
    settings().light.rotation_euler.z += 0.3
    bpy.context.view_layer.update()
    own = read_light_set(settings(), [ob]).lights[0]
    assert np.allclose(own.line, np.array(settings().light.matrix_world)[:3, 2])
    settings().camera.data.type = 'PERSP'
    assert read_light_set(settings(), [ob]).lights[0].is_place


@pytest.mark.parametrize(("kind", "blocked"), [("mirrored", True), ("cage", False)])
def test_a_mirrored_half_and_a_cage_are_pressed_for_the_set(kind: str, blocked: bool) -> None:
    """The faces of a cage lie beside its surface, and so hide nothing."""
    ob = make_panel(kind)
    walk()
    press()
    assert ob.reflection_lines.report.largest_move > 0.001 and not ob.reflection_lines.report.notes
    assert len(read_light_set(settings(), [ob]).blockers) == blocked


def test_the_background_press_takes_the_set() -> None:
    """A long press runs beside Blender, with what the operator chose before."""
    ob = make_panel()
    walk()
    press()
    found = solve_history.find_last_solve(ob.name)
    asked = AutomaticSmooth("crossed", 1.0, True, light_set=read_light_set(settings(), [ob]))
    job = SolveJob([found.patch], [facing.read_patch_view(bpy.context.scene, found.patch)], "clamped")
    outcome = run_now(job.run(SolveRequest((), (), final=True, press=asked)))
    assert np.array_equal(outcome.solutions[0].positions, found.positions)


@pytest.mark.parametrize("kind", ["mesh", "cage", "mirrored"])
def test_a_drag_of_the_strength_shows_what_the_press_with_the_set_gives(kind: str) -> None:
    ob = make_panel(kind)
    walk()
    press(strength=0.5)
    found = solve_history.find_last_solve(ob.name)
    asked = AutomaticSmooth("crossed", 1.0, True, light_set=read_light_set(settings(), [ob]))
    job = SolveJob([found.patch], [facing.read_patch_view(bpy.context.scene, found.patch)], "clamped")
    shown = [run_now(job.run(SolveRequest((), (), press=replace(asked, strength=strength))))
             for strength in (1.0, 0.5)]
    assert np.array_equal(shown[1].positions[0], found.positions) and not shown[1].refusal
    assert np.abs(shown[0].positions[0] - found.positions).max() > 1e-4


@pytest.mark.parametrize("given", [{"limit": 0.001}, {"length": 0.4}])
def test_re_solve_takes_the_set_as_it_is_now(given: dict) -> None:
    ob = make_panel()
    entries = walk()
    press(**given)
    for entry in entries:
        entry.muted = entry.name != "Above, crossed"
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True) == {'FINISHED'}
    again = scenes.positions(ob)
    press(anew=True, **given)
    assert np.array_equal(scenes.positions(ob), again)
    for entry in entries:
        entry.muted = False
    press(anew=True, **given)
    assert not np.array_equal(scenes.positions(ob), again)


def smooth_by_length(V: np.ndarray, F: np.ndarray, **options: object) -> np.ndarray:
    """What the native module makes of lines that are smoothed by a length in all lights of the set."""
    found = read_light_set(settings(), [])
    eyes, lines = (np.array([getattr(light, name) for light in found.lights]) for name in ("eye", "line"))
    optimizer = native.reflines.ShapeOptimizer(V, F, view_direction=(0.0, 0.0, 1.0), line_direction=lines,
                                               eye_directions=eyes, **options)
    optimizer.solve([native.reflines.smooth(optimizer, length=0.4, family=k) for k in range(len(lines))])
    return optimizer.positions


def test_a_given_length_smooths_the_lines_of_the_set() -> None:
    ob = make_panel()
    walk()
    press(length=0.4, limit=1.0)
    found = solve_history.find_last_solve(ob.name)
    assert np.abs(found.positions - smooth_by_length(found.patch.V, found.patch.F)).max() < 1e-7
    assert np.abs(found.positions - found.patch.V).max() > 0.001
    bpy.ops.reflines.smooth('EXEC_DEFAULT', True, length=0.4, limit=1.0, lights='CROSSED', anew=True)
    assert np.abs(solve_history.find_last_solve(ob.name).positions - found.positions).max() > 1e-5


@pytest.mark.parametrize("kind", ["cage", "mirrored"])
def test_a_given_length_smooths_cages_and_both_halves_for_the_set(kind: str) -> None:
    """An eye on one side sees the halves differently: both are smoothed as it sees them, and move alike."""
    ob = make_panel(kind)
    walk()
    press(length=0.4, limit=1.0)
    report = ob.reflection_lines.report
    assert report.termination == "converged" and report.residual_after < 0.2 * report.residual_before


def test_a_light_of_weight_0_is_no_light() -> None:
    ob = make_panel()
    entries = walk()
    press(length=0.4)
    of_all = scenes.positions(ob)
    for entry in entries:
        entry.weight = 0.0 if entry.name.endswith("crossed") else 1.0
    press(length=0.4, anew=True)
    assert not np.array_equal(scenes.positions(ob), of_all)


def test_straight_lines_are_for_one_light_and_say_so() -> None:
    ob = make_panel()
    walk()
    press(directional=True, length=0.4)
    assert "Along the Lines is for the light alone" in ob.reflection_lines.report.notes
    alone = scenes.positions(ob)
    bpy.ops.reflines.smooth('EXEC_DEFAULT', True, directional=True, length=0.4, lights='CROSSED', anew=True)
    assert np.array_equal(scenes.positions(ob), alone)


def test_faces_beside_the_region_hide_it_from_a_view() -> None:
    """A roof over the panel, of the same mesh, leaves nothing to see from above."""
    ob = make_panel()
    walk()
    press()
    found = solve_history.find_last_solve(ob.name).patch
    roof = np.array([(-20.0, -20.0, 1.0), (20.0, -20.0, 1.0), (0.0, 30.0, 1.0)])
    asked = read_light_set(settings(), [ob])
    above = replace(asked, blockers=(Blockers(ob.name, roof, np.array([[0, 1, 2]]), np.flatnonzero(~found.faces)[:1]),))
    with pytest.raises(native.InvalidInput, match="No eye direction sees the region"):
        run_now(automatic_smooth.press_panel(run_now(automatic_smooth.build_press(
            found, facing.read_patch_view(bpy.context.scene, found), "clamped",
            AutomaticSmooth("crossed", 1.0, True, light_set=above))), AutomaticSmooth("crossed", 1.0, True)))


def test_two_lights_of_one_camera_have_two_names() -> None:
    make_panel()
    assert [add_light().name for _ in range(3)] == [settings().camera.name + end for end in ("", " 2", " 3")]


def test_an_empty_set_is_pressed_in_crossed_lights_and_says_so() -> None:
    ob = make_panel()
    press()
    assert "crossed lights were taken" in ob.reflection_lines.report.notes
    assert np.array_equal(solve_history.find_last_solve(ob.name).positions, expected(None))


def remove_camera(entry: bpy.types.PropertyGroup) -> None:
    camera = bpy.data.objects.new("Other Camera", bpy.data.cameras.new("Other Camera"))
    bpy.context.scene.collection.objects.link(camera)
    entry.camera = camera
    bpy.data.objects.remove(camera)


def turn_away(entry: bpy.types.PropertyGroup) -> None:
    entry.keeps_directions, entry.eye, entry.line = True, (0.0, 0.0, -1.0), (1.0, 0.0, 0.0)


@pytest.mark.parametrize(("spoil", "sentence"), [(remove_camera, "its camera is gone"),
                                                 (turn_away, "Not seen from Spoilt")])
def test_a_light_that_cannot_be_used_is_named_and_the_rest_works(
        spoil: Callable[[bpy.types.PropertyGroup], None], sentence: str) -> None:
    ob = make_panel()
    add_light()
    entry = add_light()
    entry.name = "Spoilt"
    spoil(entry)
    press()
    assert sentence in ob.reflection_lines.report.notes and ob.reflection_lines.report.largest_move > 0.001
    entry.muted = True
    assert bpy.ops.reflines.smooth('EXEC_DEFAULT', True, lights='SET') == {'FINISHED'}
    assert sentence not in ob.reflection_lines.report.notes


def test_a_light_that_is_parallel_to_its_view_is_refused_by_name() -> None:
    ob = make_panel()
    entry = add_light()
    entry.name, entry.keeps_directions, entry.eye, entry.line = "Along", True, (0, 0, 1), (0, 0, 2)
    before = scenes.fingerprint(ob)
    with pytest.raises(RuntimeError, match="The light Along of the set is parallel to its view"):
        bpy.ops.reflines.smooth('EXEC_DEFAULT', True, lights='SET')
    assert scenes.fingerprint(ob) == before


def test_the_place_that_became_worse_is_told_and_shown() -> None:
    ob = make_deep_dent()
    add_light()
    settings().light_set.find_active().name = "Its light"
    press(limit=0.002)
    report = ob.reflection_lines.report
    assert "; one place worse in Its light: " in report.headline()
    before = settings().light.matrix_world.copy()
    settings().light.rotation_euler.z += 1.0
    assert bpy.ops.reflines.show_spot('EXEC_DEFAULT', True, worse=True) == {'FINISHED'}
    bpy.context.view_layer.update()
    assert np.allclose(np.array(settings().light.matrix_world)[:3, 2], np.array(before)[:3, 2], atol=1e-5)
    place = np.array(report.worse_spot.find_place())
    assert 0.02 < np.linalg.norm(place[:2] - (0.1, -0.2)) < 0.4
    ob.update_from_editmode()
    assert 0 < sum(face.select for face in ob.data.polygons) < 200
    press(strength=0.0)
    assert not report.worse and not bpy.ops.reflines.show_spot.poll()


def look_for_worse(ob: bpy.types.Object, name: str) -> None:
    """What became worse is said of a light of the set, and the place is looked at from there."""
    report, worse = ob.reflection_lines.report, ob.reflection_lines.report.worse_spot
    entry = next(each for each in settings().light_set.entries if each.name == name)
    assert f"; one place worse in {name}: " in report.headline()
    assert np.allclose(worse.eye, entry.eye, atol=1e-6) and np.allclose(worse.line, entry.line, atol=1e-6)
    assert bpy.ops.reflines.show_spot('EXEC_DEFAULT', True, worse=True) == {'FINISHED'}
    bpy.context.view_layer.update()
    assert np.allclose(np.array(settings().light.matrix_world)[:3, 2], entry.line, atol=1e-5)


def read_worst_light(ob: bpy.types.Object) -> str:
    return ob.reflection_lines.report.worse.removeprefix("one place worse in ").split(": ")[0]


def leave_to_the_left(entries: bpy.types.bpy_prop_collection) -> None:
    """Mutes all lights but those that are seen from the panel's left."""
    for entry in entries:
        entry.muted = not entry.name.startswith("Its left")


def make_deep_dent(cells: int = 60) -> bpy.types.Object:
    ob = scenes.panel(height=lambda x, y: scenes.crown(x, y) + 3.0 * (dented(x, y) - scenes.crown(x, y)), cells=cells)
    scenes.look_from_above()
    scenes.edit_inner(ob, cells)
    return ob


def test_a_press_in_crossed_lights_is_judged_by_the_set() -> None:
    """A limit leaves an edge round the dent, which is worse from its left than in the press's own lights."""
    ob = make_deep_dent()
    leave_to_the_left(walk())
    assert bpy.ops.reflines.smooth('EXEC_DEFAULT', True, limit=0.0008) == {'FINISHED'}
    assert read_worst_light(ob).startswith("Its left")
    look_for_worse(ob, read_worst_light(ob))
    while len(settings().light_set.entries):
        bpy.ops.reflines.light_set('EXEC_DEFAULT', True, action='REMOVE')
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True) == {'FINISHED'}
    assert "one place worse in the" in ob.reflection_lines.report.headline()


@pytest.mark.parametrize("kind", ["mesh", "cage", "mirrored"])
def test_what_another_tool_made_worse_is_told(kind: str) -> None:
    """A line that is pulled far within a small circle is bent there, and so are those of other lights."""
    ob = make_panel(kind)
    leave_to_the_left(walk())
    along = next(entry for entry in settings().light_set.entries if not entry.muted)
    settings().light_set.entries.add().name = "Along"  # shows no lines, and so judges nothing
    settings().light_set.entries[-1].keeps_directions = True
    settings().light_set.entries[-1].eye = settings().light_set.entries[-1].line = along.eye
    handle = {"start": (0.3, 0.1, 0.0), "end": (0.3, 0.2, 0.0), "radius": 0.2, "pinned": [], "muted": False}
    assert pull(handle) == {'FINISHED'}
    look_for_worse(ob, read_worst_light(ob))


def test_the_choice_is_that_of_the_sidebar_and_the_set_is_emptied() -> None:
    make_panel()
    walk()
    settings().lights = 'SET'
    assert bpy.ops.reflines.smooth('EXEC_DEFAULT', True) == {'FINISHED'}
    assert bpy.ops.reflines.direction('EXEC_DEFAULT', True, density=1.2) == {'FINISHED'}  # as with crossed lights
    for _ in range(10):
        assert bpy.ops.reflines.light_set('EXEC_DEFAULT', True, action='REMOVE') == {'FINISHED'}
    with pytest.raises(RuntimeError, match="The set has no light"):
        bpy.ops.reflines.light_set('EXEC_DEFAULT', True, action='REMOVE')
