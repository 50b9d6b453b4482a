"""The hands on two panels that meet over a gap, both in Edit Mode: what each of them does to both."""
import sys
from collections.abc import Generator

import bmesh
import bpy
import dragging
import numpy as np
import pulling
import scenes
import window
from picture import look

Steps = Generator[float, None, None]
CELLS, GAP = 24, 0.016
LEFT, RIGHT = (260, 290), (400, 290)  # pixels; the gap is seen between them
BRUSH = "reflection_lines.fair_brush"


def rippled(x: float, y: float) -> float:
    return scenes.crown(x, y) + 5e-4 * np.sin(24.0 * x + 1.0) * np.cos(20.0 * y)


def half(name: str, low: float, high: float, *, mirrored: bool) -> bpy.types.Object:
    columns, rows = np.linspace(low, high, CELLS + 1), np.linspace(0.0 if mirrored else -1.0, 1.0, 2 * CELLS + 1)
    points = [(x, y, rippled(x, y)) for y in rows for x in columns]
    ob = scenes.linked(name, points, scenes.quads(len(columns), len(rows)))
    if mirrored:
        ob.modifiers.new("Mirror", 'MIRROR').use_axis = (False, True, False)
    return ob


def start(driver: window.Window, levels: int = 0, *, mirrored: bool = False,
          cages: tuple[str, ...] = ("Wing",)) -> dict[str, np.ndarray]:
    """Builds both panels, of which the door is active, and with `levels` some of them cages; returns their positions.
    """
    with driver.override():
        scenes.remove_all()
        panels = [half("Wing", 0.5 * GAP, 1.0, mirrored=mirrored), half("Door", -1.0, -0.5 * GAP, mirrored=mirrored)]
        for ob in panels if levels else ():
            if ob.name in cages:
                ob.modifiers.new("Subdivision", 'SUBSURF').levels = levels
        scenes.look_from_above()
        scenes.edit(*panels)
        for ob in panels:
            scenes.select_faces(ob, lambda _face: True)
        bpy.context.scene.reflection_lines.stripes.show = True
        bpy.context.scene.reflection_lines.stripes.scope = 'VISIBLE'
        driver.region_3d().view_perspective = 'ORTHO'
        driver.region_3d().view_rotation = (1.0, 0.0, 0.0, 0.0)
        driver.region_3d().view_distance = 4.0
        bpy.ops.ed.undo_push(message="Start")
    return shown()


def shown() -> dict[str, np.ndarray]:
    return {name: scenes.positions(bpy.data.objects[name]) for name in ("Door", "Wing")}


def find_moved(before: dict[str, np.ndarray]) -> list[str]:
    now = shown()
    return [name for name, was in before.items() if not np.array_equal(now[name], was)]


def paint(driver: window.Window, first: tuple[int, int], last: tuple[int, int]) -> Steps:
    brush = bpy.context.scene.reflection_lines.brush
    brush.size, brush.strength = 60, 0.8
    driver.move(*first)
    yield 0.1
    driver.event('LEFTMOUSE', 'PRESS')
    yield 0.2
    for share in (0.25, 0.5, 0.75, 1.0):
        driver.move(*(a + share * (b - a) for a, b in zip(first, last, strict=True)))
        yield 0.2
    driver.event('LEFTMOUSE', 'RELEASE')
    yield 0.3


def comes_back(driver: window.Window, before: dict[str, np.ndarray]) -> Steps:
    """One undo takes back what both have moved."""
    driver.key('Z', ctrl=True)
    for _ in range(100):
        yield 0.05
        if not find_moved(before):
            return
    raise AssertionError("the meshes do not come back")


def test_a_stroke_smooths_what_it_passes_over_on_both_sides_of_the_gap(driver: window.Window) -> Steps:
    for levels in (0, 2):
        before = start(driver, levels)
        yield from dragging.take_tool(driver, BRUSH, LEFT)
        yield from window.take_picture(driver, f"brush_gap_before_{levels}")
        yield from paint(driver, LEFT, RIGHT)
        yield from window.take_picture(driver, f"brush_gap_{levels}")
        assert find_moved(before) == ["Door", "Wing"]
        for name, was in before.items():
            rim = np.abs(was[:, 0]) < GAP
            assert rim.any() and np.array_equal(shown()[name][rim], was[rim])
            report = bpy.data.objects[name].reflection_lines.report
            assert report.score_after < 0.9 * report.score_before, report.headline()
        yield from comes_back(driver, before)


def test_a_stroke_over_the_panel_that_is_not_active_smooths_that_one_alone(driver: window.Window) -> Steps:
    before = start(driver)
    yield from dragging.take_tool(driver, BRUSH, LEFT)
    yield from paint(driver, RIGHT, (430, 290))
    assert find_moved(before) == ["Wing"]
    yield from comes_back(driver, before)


def test_a_panel_that_cannot_be_brushed_is_named_and_the_other_is_brushed(driver: window.Window) -> Steps:
    start(driver)
    with driver.override():
        edit = bmesh.from_edit_mesh(bpy.data.objects["Wing"].data)
        bmesh.ops.reverse_faces(edit, faces=edit.faces)
        bmesh.update_edit_mesh(bpy.data.objects["Wing"].data)
    before = shown()
    yield from dragging.take_tool(driver, BRUSH, LEFT)
    yield from paint(driver, (270, 290), (290, 290))
    assert find_moved(before) == ["Door"]
    yield from paint(driver, RIGHT, (420, 290))
    assert "the brush met no vertices" in driver.read_last_report()


def lines_shown() -> Steps:
    """Waits until a session has its lines: a press before that is heard then."""
    for _ in range(1200):
        yield 0.05
        if drag_module()._running and pulling.session().surface is not None:
            return
    raise AssertionError("no session begins")


def drag_module() -> object:
    return sys.modules["reflection_lines"].interactive.drag


def pulled(driver: window.Window, tool: str, stroke: tuple[tuple[int, int], ...],
           border: str) -> Generator[float, None, list[str]]:
    """Presses over the wing while the door is active; returns what has moved once that is applied."""
    before, bpy.context.scene.reflection_lines.border = start(driver), border
    yield from dragging.take_tool(driver, f"reflection_lines.{tool}", LEFT)
    yield from pulling.move(driver, *stroke[0])
    driver.event('LEFTMOUSE', 'PRESS')
    yield from lines_shown()
    for place in stroke[1:]:
        yield from pulling.move(driver, *place)
    driver.event('LEFTMOUSE', 'RELEASE')
    yield 0.1
    yield from dragging.settled(driver)
    assert len(pulling.session().handles) == 1 and bpy.context.view_layer.objects.active.name == "Wing"
    yield from window.take_picture(driver, tool)
    yield from dragging.applied(driver)
    assert not drag_module()._running
    moved = find_moved(before)
    bpy.context.scene.reflection_lines.property_unset("border")
    yield from comes_back(driver, before)
    return moved


def test_a_press_pulls_or_draws_the_line_of_the_panel_that_it_lies_on(driver: window.Window) -> Steps:
    assert (yield from pulled(driver, "pull_line", (RIGHT, (400, 294), (400, 298)), 'clamped')) == ["Wing"]
    stroke = (360, 290), (385, 291), (410, 292), (430, 293)
    assert (yield from pulled(driver, "draw_highlight", stroke, 'clamped')) == ["Wing"]


def test_a_session_says_that_the_lines_of_another_panel_are_not_its_own(driver: window.Window) -> Steps:
    before, bpy.context.scene.reflection_lines.border = start(driver), 'clamped'
    yield from pulling.begin(driver)
    yield from pulling.draw(driver, (RIGHT, (400, 300)))
    header = pulling.session().texts[0]
    assert header.startswith("Handles belong to one object, here Door: press Enter, make Wing active"), header
    yield from window.take_picture(driver, "pull_beside")
    yield from pulling.pull(driver, LEFT, (260, 298))
    assert not pulling.session().texts[0].startswith("Handles belong") and find_moved(before) == ["Door"]
    driver.key('ESC')
    yield 0.3
    assert not find_moved(before)
    bpy.context.scene.reflection_lines.property_unset("border")


def test_a_drag_of_direction_moves_both_and_escape_takes_both_back(driver: window.Window) -> Steps:
    own = bpy.context.scene.reflection_lines.direction
    for direction in ('PRESENT', 'MEAN'):
        before = start(driver)
        own.direction, own.centre = direction, 'REGION'
        yield from dragging.press(driver, "direction")
        driver.move(460, 300)
        yield from dragging.settled(driver)
        yield from window.take_picture(driver, f"direction_gap_{direction}")
        assert find_moved(before) == ["Door", "Wing"]
        driver.key('ESC')
        yield 0.3
        assert not find_moved(before)
    own.property_unset("direction")


def rims_moved(before: dict[str, np.ndarray]) -> list[np.ndarray]:
    """How far the rims of the door and the wing have moved along the view, by ascending y."""
    now, sides = shown(), []
    for name, was in before.items():
        rim = np.flatnonzero(np.abs(was[:, 0]) < GAP)
        sides.append((now[name] - was)[rim[np.argsort(was[rim, 1])], 2])
    return sides


def move_alike(before: dict[str, np.ndarray]) -> bool:
    """Both rims have moved, by as much: but for what the move itself turns within the gap."""
    door, wing = rims_moved(before)
    return bool(np.abs(door).max() > 1e-4 and np.abs(door - wing).max() < 0.2 * np.abs(door).max())


def test_a_drag_moves_both_rims_as_one(driver: window.Window) -> Steps:
    before, scene = start(driver), bpy.context.scene.reflection_lines
    assert scene.border == 'automatic'
    scene.direction.centre, scene.direction.direction = 'REGION', 'PRESENT'
    yield from dragging.press(driver, "direction")
    driver.move(460, 300)
    yield from dragging.settled(driver)
    yield from window.take_picture(driver, "direction_gap_follow")
    assert find_moved(before) == ["Door", "Wing"] and move_alike(before)
    yield from dragging.applied(driver)
    assert move_alike(before)
    yield from comes_back(driver, before)


def test_two_cages_are_dragged_as_one(driver: window.Window) -> Steps:
    scene = bpy.context.scene.reflection_lines
    scene.direction.centre, scene.direction.direction = 'REGION', 'PRESENT'
    before = start(driver, 3, cages=("Door", "Wing"))  # so finely the drag samples the surfaces on few triangles
    yield from window.take_picture(driver, "direction_cages_before")
    yield from dragging.press(driver, "direction")
    driver.move(460, 300)
    yield from dragging.settled(driver)
    assert find_moved(before) == ["Door", "Wing"] and move_alike(before)
    yield from dragging.applied(driver)
    assert move_alike(before)
    yield from window.take_picture(driver, "direction_cages")
    yield from comes_back(driver, before)


def seen_alike() -> bool:
    """The stripes on both panels are those of one view."""
    views = [sys.modules["reflection_lines"].view.view_and_light.read_shown_directions(bpy.context.scene, ob)[0]
             for ob in map(bpy.data.objects.get, ("Door", "Wing"))]
    return bool(np.abs(views[0] - views[1]).max() < 1e-6)


def test_mirrored_panels_are_dragged_with_their_images(driver: window.Window) -> Steps:
    """The gap runs across the seam of both; a perspective view camera stands in the mirror plane."""
    own = bpy.context.scene.reflection_lines.direction
    for kind in ('ORTHO', 'PERSP'):
        before = start(driver, mirrored=True)
        camera = bpy.context.scene.reflection_lines.camera
        if kind == 'PERSP':
            camera.data.type, camera.location = kind, (0.4, 0.0, 4.0)
        own.centre, own.direction = 'REGION', 'PRESENT'
        yield from window.take_picture(driver, f"direction_mirrored_before_{kind}")
        yield from dragging.press(driver, "direction")
        driver.move(460, 300)
        yield from dragging.settled(driver)
        yield from window.take_picture(driver, f"direction_mirrored_{kind}")
        assert find_moved(before) == ["Door", "Wing"] and move_alike(before) and seen_alike()
        yield from dragging.applied(driver)
        assert move_alike(before) and seen_alike()
        yield from window.take_picture(driver, f"direction_mirrored_applied_{kind}")
        for name, was in before.items():
            seam = was[:, 1] == 0.0
            assert np.abs(shown()[name] - was)[seam].max() > 1e-4 and not shown()[name][seam, 1].any()
        yield from comes_back(driver, before)


def test_the_other_panel_follows_a_pull(driver: window.Window) -> Steps:
    moved = yield from pulled(driver, "pull_line", (RIGHT, (400, 294), (400, 298)), 'automatic')
    assert moved == ["Door", "Wing"]
    moved = yield from pulled(driver, "draw_highlight", ((360, 290), (385, 291), (410, 292), (430, 293)), 'automatic')
    assert moved == ["Door", "Wing"]
    before = start(driver)
    yield from pulling.begin(driver)
    yield from pulling.pull(driver, LEFT, (260, 310))
    yield from window.take_picture(driver, "pull_gap_follow")
    assert move_alike(before)
    driver.key('ESC')
    yield 0.3
    assert not find_moved(before)


def test_check_measures_and_draws_both(driver: window.Window) -> Steps:
    start(driver)
    addon = sys.modules["reflection_lines"]
    with driver.override():
        assert bpy.ops.reflines.check('INVOKE_DEFAULT', True) == {'RUNNING_MODAL'}
    for _ in range(600):
        if not addon.interactive.running_operators._running:
            break
        yield 0.05
    drawn = yield from look(driver, 'POST_VIEW', lambda: addon.overlay.draw_check.find_drawn(bpy.context))
    yield from window.take_picture(driver, "check_gap")
    assert sorted(ob.name for ob, _ in drawn) == ["Door", "Wing"]
    for name, other in (("Door", "Wing"), ("Wing", "Door")):
        shown, = bpy.data.objects[name].reflection_lines.check.list_shut_lines()
        assert shown.describe().startswith(f"Shut line 1, {other}: gap 1.6 cm to 1.6 cm"), shown.describe()
    assert driver.read_last_report().startswith("Door: ")  # the active one
