"""The last check is drawn: without a run seams that pass green, others red, after one by what is better or worse; a
dot at the worst place; and gone when the mesh changes.
"""
import sys

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector

import scenes
import window
from picture import CELLS, Steps, look, striped_panel

INNER = 10  # rings of faces outside the region


def count_colors(driver: window.Window, ob: bpy.types.Object) -> Steps:
    """Returns the shares of the border's edges that are green and red."""
    picture, found = (yield from look(driver, 'POST_VIEW'))[:, :, :3].astype(float), []
    V = scenes.world(ob).reshape(CELLS + 1, CELLS + 1, 3)[INNER:-INNER, INNER]
    for point in 0.5 * (V[1:-2] + V[2:-1]):
        at = location_3d_to_region_2d(driver.region(), driver.region_3d(), point)
        near = picture[int(at.y), int(at.x) - 3:int(at.x) + 4]
        found.append(near[np.ptp(near, axis=1).argmax()])
    red, green, _ = np.array(found).T
    shares = (green > 1.5 * red).mean(), (red > 1.5 * green).mean()
    print(f"green {shares[0]:.2f}, red {shares[1]:.2f}")
    return shares


def check(driver: window.Window, curvature: float) -> None:
    marks = bpy.context.scene.reflection_lines.marks
    marks.curvature, marks.angle = curvature, 90.0
    with driver.override():
        assert bpy.ops.reflines.check('EXEC_DEFAULT', True) == {'FINISHED'}


def test_seams_are_green_or_red(driver: window.Window) -> Steps:
    ob = striped_panel(driver, "Checked")
    with driver.override():
        scenes.edit_inner(ob, CELLS, INNER)
        check(driver, 1e4)
    assert (yield from count_colors(driver, ob)) == (1.0, 0.0)
    check(driver, 0.0)
    assert (yield from count_colors(driver, ob)) == (0.0, 1.0)
    with driver.override():
        bpy.ops.mesh.select_all(action='DESELECT')
    assert (yield from count_colors(driver, ob))[1] == 1.0  # a selection is no change of the shape
    with driver.override():
        bpy.ops.mesh.select_all(action='SELECT')
        bpy.ops.transform.translate(value=(0.0, 0.0, 0.001))
        bpy.ops.mesh.select_all(action='DESELECT')
    assert (yield from count_colors(driver, ob)) == (0.0, 0.0)


def test_the_worst_place_has_a_red_dot_with_a_white_rim(driver: window.Window) -> Steps:
    ob = striped_panel(driver, "Dotted")
    with driver.override():
        scenes.edit_inner(ob, CELLS, INNER)
        check(driver, 0.0)
    seen = yield from look(driver, 'POST_PIXEL')
    worst = sys.modules["reflection_lines"].state.last_checks.find_check(ob.name).worst[0].tolist()
    at = location_3d_to_region_2d(driver.region(), driver.region_3d(), ob.matrix_world @ Vector(worst))
    ways = np.array([[1, 1], [1, -1], [-1, 1], [-1, -1]]) / np.sqrt(2.0)  # the seams run across and upwards
    for radius, color in ((4.0, (255, 38, 26)), (7.3, (255, 255, 255))):
        x, y = (np.array(at) + radius * ways).astype(int).T
        assert np.abs(seen[y, x, :3].astype(int) - color).max() < 40, (radius, seen[y, x, :3])


def test_after_a_run_the_color_is_the_change(driver: window.Window) -> Steps:
    """Edges that are beyond the mark as before are grey, and the dot there is orange."""
    ob = striped_panel(driver, "Changed")
    with driver.override():
        scenes.edit_inner(ob, CELLS, INNER)
        scenes.smooth(strength=0.0)
        check(driver, 0.0)
    assert ob.reflection_lines.check.failed > 0
    assert (yield from count_colors(driver, ob)) == (0.0, 0.0)
    yield from window.take_picture(driver, "check_unchanged")
    assert not sys.modules["reflection_lines"].state.last_checks.find_check(ob.name).worse.any()
