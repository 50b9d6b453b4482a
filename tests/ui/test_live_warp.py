"""Live warp in a window: the panel follows while Blender's own tools edit the lattice, at undo, and after reload."""
import os
import tempfile

import bpy
import numpy as np

import dragging
import scenes
import window
from window import Steps

MIDDLE = 12  # of 5 x 5 control points


def positions() -> np.ndarray:
    return scenes.positions(bpy.data.objects["Panel"])


def lattice() -> bpy.types.Object:
    return bpy.context.scene.reflection_lines.warp.lattice


def says() -> str:
    return bpy.context.window_manager.reflection_lines.live


def started(driver: window.Window, cells: int = 16) -> Steps:
    """In the lattice's Edit Mode with its middle point selected."""
    dragging.panel(driver, cells)
    with driver.override():
        bpy.ops.reflines.add_warp_lattice()
        bpy.ops.object.mode_set(mode='OBJECT')
        bpy.ops.ed.undo_push(message="Lattice")
        bpy.ops.reflines.live_warp('EXEC_DEFAULT', True)
    driver.move(400, 400)
    yield 0.2
    driver.key('TAB')
    yield 0.3
    for index, point in enumerate(lattice().data.points):
        point.select = index == MIDDLE
    with driver.override():
        bpy.ops.ed.undo_push(message="Select")
    yield 0.2


def grab(driver: window.Window, x: int) -> Steps:
    """G and a way to the right, not yet confirmed."""
    driver.move(400, 400)
    yield 0.1
    driver.key('G')
    yield 0.1
    for step in range(1, 6):
        driver.move(400 + x * step // 5, 400)
        yield 0.1


def warped(driver: window.Window) -> np.ndarray:
    """What Warp makes of the panel as it was at the start, after Discard."""
    with driver.override():
        bpy.ops.reflines.live_warp('EXEC_DEFAULT', True, action='DISCARD')
        bpy.context.view_layer.objects.active = bpy.data.objects["Panel"]
        bpy.ops.reflines.warp('EXEC_DEFAULT', True)
    return positions()


def test_another_panel_of_the_same_name_is_followed_from_its_own_start(driver: window.Window) -> Steps:
    """A script removes the panel and starts the live warp of a smaller one, before Blender has told of either."""
    yield from started(driver)
    yield from grab(driver, 40)
    yield from dragging.struck(driver, 'RET')
    yield from started(driver, cells=14)
    before = positions()
    yield from grab(driver, 40)
    yield from dragging.settled(driver)
    assert np.abs(positions() - before).max() > 1e-4 and not says()
    yield from dragging.struck(driver, 'ESC')
    assert np.array_equal(positions(), before)


def test_the_panel_follows_while_the_lattice_is_dragged(driver: window.Window) -> Steps:
    yield from started(driver)
    before = positions()
    yield from grab(driver, 40)
    yield from dragging.settled(driver)
    held = positions()
    assert np.abs(held - before).max() > 1e-4
    yield from window.take_picture(driver, "live")
    yield from dragging.struck(driver, 'ESC')
    assert np.array_equal(positions(), before)
    yield from grab(driver, 40)
    yield from dragging.struck(driver, 'RET')
    assert np.array_equal(positions(), held)
    assert np.array_equal(warped(driver), held)


def test_what_follows_after_a_rest_is_near_what_is_kept(driver: window.Window) -> Steps:
    """The wish is always about the lines that the panel began with, not about those it shows."""
    yield from started(driver)
    before = positions()
    yield from grab(driver, 30)
    yield from dragging.settled(driver)
    rest = positions()
    driver.move(450, 400)
    while np.array_equal(positions(), rest):
        yield 0.02
    first = positions()
    yield from dragging.settled(driver)
    move = np.abs(positions() - before).max()
    assert np.abs(positions() - rest).max() > 0.2 * move
    assert np.abs(positions() - first).max() < 0.05 * move
    yield from dragging.struck(driver, 'ESC')


def test_undo_and_redo_of_the_lattice_take_the_panel_along(driver: window.Window) -> Steps:
    yield from started(driver)
    shapes = [positions()]
    for way in (40, -25):
        yield from grab(driver, way)
        yield from dragging.struck(driver, 'RET')
        shapes.append(positions())
    assert not np.array_equal(shapes[0], shapes[1]) and not np.array_equal(shapes[1], shapes[2])
    for expected in (shapes[1], shapes[0]):
        yield from dragging.struck(driver, 'Z', ctrl=True)
        assert np.array_equal(positions(), expected)
    yield from dragging.struck(driver, 'Z', ctrl=True, shift=True)
    assert np.array_equal(positions(), shapes[1])


def test_proportional_editing_scaling_and_object_transforms(driver: window.Window) -> Steps:
    yield from started(driver)
    bpy.context.scene.tool_settings.use_proportional_edit = True
    yield from grab(driver, 30)
    yield from dragging.struck(driver, 'RET')
    bpy.context.scene.tool_settings.use_proportional_edit = False
    shapes = [positions()]
    with driver.override():
        bpy.ops.lattice.select_all(action='SELECT')
        bpy.ops.transform.resize('EXEC_DEFAULT', True, value=(1.05, 1.05, 1.0))
    yield from dragging.settled(driver)
    shapes.append(positions())
    driver.key('TAB')
    yield 0.3
    yield from grab(driver, 20)
    yield from dragging.struck(driver, 'RET')
    shapes.append(positions())
    assert len({shape.tobytes() for shape in shapes}) == 3
    yield from dragging.struck(driver, 'Z', ctrl=True)
    assert np.array_equal(positions(), shapes[1])


def test_a_fold_over_is_told_and_the_panel_waits(driver: window.Window) -> Steps:
    yield from started(driver)
    yield from grab(driver, 300)
    yield from dragging.settled(driver)
    assert says().startswith("Panel: The lattice folds over itself"), says()
    waits = positions()
    yield 0.5
    assert np.array_equal(positions(), waits)
    yield from dragging.struck(driver, 'ESC')
    assert says() == ""


def test_the_panel_follows_after_reload(driver: window.Window) -> Steps:
    yield from started(driver)
    before = positions()
    yield from grab(driver, 40)
    yield from dragging.struck(driver, 'RET')
    saved = positions()
    path = os.path.join(tempfile.mkdtemp(), "live.blend")
    with driver.override():
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
    yield 1.0
    driver = window.Window()
    yield from dragging.settled(driver)
    assert np.array_equal(positions(), saved)
    yield from grab(driver, 30)
    yield from dragging.struck(driver, 'RET')
    assert not np.array_equal(positions(), saved)
    with driver.override():
        bpy.ops.reflines.live_warp('EXEC_DEFAULT', True, action='DISCARD')
    assert np.array_equal(positions(), before)


def test_apply_is_one_undo_step_and_the_panel_follows_on_after_it(driver: window.Window) -> Steps:
    yield from started(driver)
    yield from grab(driver, 40)
    yield from dragging.struck(driver, 'RET')
    held = positions()
    with driver.override():
        bpy.ops.reflines.live_warp('EXEC_DEFAULT', True, action='APPLY')
    yield from dragging.settled(driver)
    assert np.array_equal(positions(), held)
    assert bpy.context.mode == 'OBJECT' and bpy.context.scene.reflection_lines.live.panel is None
    yield from dragging.struck(driver, 'Z', ctrl=True)
    assert bpy.context.scene.reflection_lines.live.panel == bpy.data.objects["Panel"]
    assert np.array_equal(positions(), held)
    with driver.override():
        bpy.ops.reflines.live_warp('EXEC_DEFAULT', True, action='DISCARD')


def test_changes_by_hand_are_told_and_not_written_over(driver: window.Window) -> Steps:
    yield from started(driver)
    driver.key('TAB')
    yield 0.3
    ob = bpy.data.objects["Panel"]
    with driver.override():
        lattice().select_set(False)
        scenes.edit(ob)
    yield 0.5
    assert says() == "The live warp waits while Panel is in Edit Mode"
    with driver.override():
        bpy.ops.object.mode_set(mode='OBJECT')
    yield from dragging.settled(driver)
    assert says() == ""
    ob.data.vertices[140].co.z += 0.1
    ob.data.update()
    changed = positions()
    lattice().data.points[MIDDLE].co_deform.x += 0.1
    lattice().data.update_tag()
    yield from dragging.settled(driver)
    assert "was changed by something else" in says()
    assert np.array_equal(positions(), changed)
    with driver.override():
        bpy.ops.reflines.live_warp('EXEC_DEFAULT', True, action='APPLY')
    assert np.array_equal(positions(), changed)
