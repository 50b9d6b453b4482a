"""The shut line of a checked panel is drawn: green within its mark, red beyond it; and told in the panel.
Blender goes on while it is checked, and Esc leaves the last check as it was.
"""
import sys
import time

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d

import scenes
import window
from picture import Steps, look, prepare

GAP, CELLS = 0.02, 24
PATIENCE = 60.0  # seconds


def half(name: str, low: float, high: float, step: float) -> bpy.types.Object:
    columns, rows = np.linspace(low, high, CELLS + 1), np.linspace(-1.0, 1.0, 2 * CELLS + 1)
    points = [(x, y, scenes.crown(x, y) + step * (1.0 + y)) for y in rows for x in columns]
    return scenes.linked(name, points, scenes.quads(len(columns), len(rows)))


def read_colors(driver: window.Window, ob: bpy.types.Object) -> Steps:
    """Returns how much redder than green each edge of the shut line is drawn: #E, ascending y."""
    picture, found = (yield from look(driver, 'POST_VIEW'))[:, :, :3].astype(float), []
    segments = sys.modules["reflection_lines"].state.last_checks.find_check(ob.name).segments
    for middle in sorted(segments.mean(axis=1).tolist(), key=lambda place: place[1])[2:-2]:
        at = location_3d_to_region_2d(driver.region(), driver.region_3d(), middle)
        near = picture[int(at.y), int(at.x) - 3:int(at.x) + 4]
        color = near[np.ptp(near, axis=1).argmax()]
        found.append(color[0] - color[1])
    return np.array(found)


def build_halves(driver: window.Window) -> bpy.types.Object:
    """Builds two panels beside each other, and selects one in Edit Mode."""
    with driver.override():
        scenes.remove_all()
        half("Wing", 0.5 * GAP, 1.0, 0.0004)
        ob = half("Door", -1.0, -0.5 * GAP, 0.0)
        scenes.look_from_above()
        bpy.context.view_layer.update()
    prepare(driver, ob)
    bpy.context.scene.reflection_lines.stripes.scope = 'VISIBLE'
    with driver.override():
        scenes.activate(ob)
        scenes.edit(ob)
        scenes.select_faces(ob, lambda _face: True)
    return ob


def begin(driver: window.Window) -> None:
    """Checks as the button does, and returns while that is at work."""
    with driver.override():
        assert bpy.ops.reflines.check('INVOKE_DEFAULT', True) == {'RUNNING_MODAL'}


def wait() -> Steps:
    """Waits until no operator runs; returns how often Blender came to do something else."""
    turns, begun = 0, time.monotonic()
    while sys.modules["reflection_lines"].interactive.running_operators._running:
        assert time.monotonic() - begun < PATIENCE
        turns += 1
        yield 0.01
    return turns


def test_the_shut_line_is_green_within_the_mark_and_red_beyond(driver: window.Window) -> Steps:
    ob = build_halves(driver)
    begin(driver)
    assert (yield from wait()) > 1
    colors = yield from read_colors(driver, ob)
    height = np.linspace(-1.0, 1.0, len(colors))
    assert colors[height < 0.1].max() < -50.0 and colors[height > 0.4].min() > 50.0  # a step of half a millimetre
    yield from window.take_picture(driver, "shut_line")
    assert any("Shut line 1, Wing: gap" in shown.describe() for shown in ob.reflection_lines.check.list_shut_lines())


def test_escape_leaves_the_last_check(driver: window.Window) -> Steps:
    ob, last_checks = build_halves(driver), sys.modules["reflection_lines"].state.last_checks
    with driver.override():
        assert bpy.ops.reflines.check('EXEC_DEFAULT', True) == {'FINISHED'}
    rows = [(row.name, row.after, row.passes) for row in ob.reflection_lines.check.rows]
    drawn = last_checks.find_check(ob.name)
    bpy.context.scene.reflection_lines.marks.shut_line = 1.0  # by which every row of the other check would pass
    begin(driver)
    driver.key('ESC')
    yield from wait()
    yield 0.2
    assert [(row.name, row.after, row.passes) for row in ob.reflection_lines.check.rows] == rows
    assert last_checks.find_check(ob.name) is drawn and driver.read_last_report().endswith("the last check stays")
    begin(driver)
    yield from wait()
    assert all(row.passes for row in ob.reflection_lines.check.rows if "flush" in row.name)
    assert last_checks.find_check(ob.name) is not drawn


def test_a_panel_that_moves_meanwhile_keeps_its_last_check(driver: window.Window) -> Steps:
    ob, last_checks = build_halves(driver), sys.modules["reflection_lines"].state.last_checks
    with driver.override():
        assert bpy.ops.reflines.check('EXEC_DEFAULT', True) == {'FINISHED'}
    drawn = last_checks.find_check(ob.name)
    begin(driver)
    ob.location.z += 0.001
    bpy.context.view_layer.update()
    yield from wait()
    assert last_checks.find_check(ob.name) is drawn
    assert driver.read_last_report().endswith("Door was changed while it was checked: check it again")
