"""Every tool under the mouse, in a window: what is kept is what the operator makes with the values of the drag."""

import bpy
import numpy as np

import dragging
import scenes
import window
from window import Steps


def kept_equals_executed(driver: window.Window, operator: str, names: tuple[str, ...]) -> Steps:
    """To 1e-6 of the panel's size: the final solve takes its centre from the mesh as it was dragged."""
    yield from dragging.applied(driver)
    done = bpy.context.window_manager.operators[-1]
    assert done.bl_idname == "REFLINES_OT_" + operator
    kept, values = dragging.shown(driver), {name: getattr(done.properties, name) for name in names}
    dragging.panel(driver)
    before = dragging.shown(driver)
    with driver.override():
        assert getattr(bpy.ops.reflines, operator)('EXEC_DEFAULT', True, **values) == {'FINISHED'}
    assert np.abs(kept - before).max() > 1e-5
    assert np.abs(kept - dragging.shown(driver)).max() < 2e-6


def test_turn_with_the_wheel_for_its_radius(driver: window.Window) -> Steps:
    dragging.panel(driver)
    own = bpy.context.scene.reflection_lines.direction
    own.centre, own.radius, own.angle = 'REGION', 0.5, 0.0
    yield from dragging.press(driver, "direction")
    driver.move(460, 300)
    yield 0.1
    for _ in range(3):
        driver.event('WHEELUPMOUSE', 'PRESS')
        yield 0.05
    yield from dragging.settled(driver)
    yield from window.take_picture(driver, "turn")
    yield from kept_equals_executed(driver, "direction", ("angle", "radius"))
    operator = bpy.context.window_manager.operators[-1].properties
    assert abs(np.degrees(operator.angle) - 15.0) < 1e-3
    assert abs(operator.radius - 0.5 * 2.0**0.4) < 1e-5


def test_density(driver: window.Window) -> Steps:
    dragging.panel(driver)
    bpy.context.scene.reflection_lines.direction.radius = 0.5
    yield from dragging.press(driver, "direction")
    driver.key('TAB')
    yield from dragging.moved(driver, 425, 300)
    yield from kept_equals_executed(driver, "direction", ("angle", "density"))
    operator = bpy.context.window_manager.operators[-1].properties
    assert operator.density > 1.1 and operator.angle == 0.0


def test_pattern(driver: window.Window) -> Steps:
    dragging.panel(driver)
    image = bpy.data.images.new("Ramp", 16, 16, float_buffer=True)
    rows = np.repeat(np.linspace(0.0, 1.0, 16), 16)
    image.pixels.foreach_set(np.repeat(rows, 4).astype(np.float32))
    bpy.context.scene.reflection_lines.pattern.image = image
    yield from dragging.press(driver, "pattern")
    yield from dragging.moved(driver, 380, 300)
    yield from kept_equals_executed(driver, "pattern", ("strength",))


def test_warp_by_a_typed_amount(driver: window.Window) -> Steps:
    """Kept is what the operator makes of half the lattice's way, to the last bit."""
    dragging.panel(driver)
    with driver.override():
        bpy.ops.reflines.add_warp_lattice()
        bpy.context.scene.reflection_lines.warp.lattice.data.points[12].co_deform.x += 0.3
        bpy.ops.object.mode_set(mode='OBJECT')
        bpy.ops.ed.undo_push(message="Lattice")
        bpy.ops.object.mode_set(mode='EDIT')
        bpy.ops.ed.undo_push(message="Edit")
    before = dragging.shown(driver)
    yield from dragging.press(driver, "warp")
    whole = np.abs(dragging.shown(driver) - before).max()
    for key in ('FIVE', 'ZERO'):
        driver.key(key)
        yield 0.05
    yield from dragging.settled(driver)
    assert 0.3 * whole < np.abs(dragging.shown(driver) - before).max() < 0.7 * whole
    yield from dragging.applied(driver)
    kept = dragging.shown(driver)
    assert bpy.context.window_manager.operators[-1].properties.amount == 50.0
    driver.key('Z', ctrl=True)
    yield from dragging.comes_to(driver, before)
    with driver.override():
        assert bpy.ops.reflines.warp('EXEC_DEFAULT', True, amount=50.0) == {'FINISHED'}
    assert np.array_equal(dragging.shown(driver), kept)


def test_smooth_into_a_shape_key(driver: window.Window) -> Steps:
    """Esc leaves no key; Enter makes one of what is kept in the mesh otherwise; one undo takes key and mode back."""
    ob = dragging.panel(driver)
    bpy.context.scene.reflection_lines.result = 'SHAPE_KEY'
    before = scenes.fingerprint(ob)
    for key in ('ESC', 'RET'):
        yield from dragging.press(driver)
        yield from dragging.moved(driver, 250, 300)
        assert scenes.fingerprint(bpy.data.objects["Panel"]) != before
        driver.key(key)
        yield from dragging.ended(driver)
        yield 0.5
        assert (scenes.fingerprint(bpy.data.objects["Panel"]) == before) == (key == 'ESC')
    keys = bpy.data.objects["Panel"].data.shape_keys.key_blocks
    kept = np.array([point.co for point in keys["Reflection Lines"].data], np.float32)
    length = dragging.dragged_length()
    assert np.array([point.co for point in keys["Basis"].data], np.float32).tobytes() == before[0]
    driver.key('Z', ctrl=True)
    for _ in range(100):
        yield 0.3
        if bpy.data.objects["Panel"].mode == 'EDIT':
            break
    ob = bpy.data.objects["Panel"]
    assert ob.mode == 'EDIT' and scenes.fingerprint(ob) == before
    bpy.context.scene.reflection_lines.result = 'MESH'
    assert np.array_equal(kept, dragging.executed(driver, strength=0.5, length=length))
