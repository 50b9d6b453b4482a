"""The toolbar's tool in a real window: its arrow drags Smooth, its ring turns the light, Numpad 0 looks through."""
import sys
from collections.abc import Generator
from math import radians

import bpy
import dragging
import numpy as np

import installation
import picture
import scenes
import window
from dragging import dragged_length, ended, executed, moved, panel, settled, shown, taken_back, undone_and_redone
from scenes import settings
from window import Steps


def take_tool(driver: window.Window) -> Steps:
    driver.area().spaces.active.overlay.show_overlays = False  # no coloured pixels but the gizmos'
    return dragging.take_tool(driver, "reflection_lines.tool")


def drawn(driver: window.Window) -> Generator[float, None, np.ndarray]:
    """The 3D view with its gizmos, bottom row first."""
    return (yield from picture.look(driver, 'POST_PIXEL')).astype(int)


def found(driver: window.Window, color: tuple[float, float, float]) -> Generator[float, None, np.ndarray]:
    """Returns the pixels of a gizmo, x and y: #P x 2."""
    rgb = yield from drawn(driver)
    y, x = np.nonzero((np.abs(rgb[..., :3] - 255.0 * np.array(color)) < 30.0).all(axis=2))
    return np.column_stack([x, y])


def arrow(driver: window.Window) -> Generator[float, None, np.ndarray]:
    """Returns the middle of the arrow's pixels."""
    return (yield from found(driver, gizmos().ARROW_COLOR)).mean(axis=0)


def ring(driver: window.Window) -> Generator[float, None, tuple[np.ndarray, float]]:
    """Returns the middle and the radius of the ring."""
    pixels = yield from found(driver, gizmos().LIGHT_COLOR)
    low, high = pixels.min(axis=0), pixels.max(axis=0)
    assert len(pixels) > 200 and np.ptp(high - low) < 8, (low, high)
    return 0.5 * (low + high), 0.5 * float((high - low).mean())


def gizmos() -> object:
    return sys.modules["reflection_lines"].ui.gizmos


def grab(driver: window.Window, place: np.ndarray) -> Steps:
    """Presses the mouse button over a gizmo, and leaves it pressed."""
    for step in (3, 0):
        driver.move(*(place + step))
        yield 0.2
    driver.event('LEFTMOUSE', 'PRESS')
    yield 0.3


def test_dragging_the_arrow_smooths_and_letting_go_keeps_it(driver: window.Window) -> Steps:
    panel(driver)
    before = shown(driver)
    yield from take_tool(driver)
    place = yield from arrow(driver)
    yield from grab(driver, place)
    yield from settled(driver)
    for step in (-40, -100, -150):
        driver.move(*(place + (step, 20)))
        yield 0.1
    yield from settled(driver)
    yield from window.take_picture(driver, "toolbar_arrow")
    assert np.abs(shown(driver) - before).max() > 1e-4
    driver.event('LEFTMOUSE', 'RELEASE')
    yield from ended(driver)
    kept, strength = shown(driver), settings().strength
    assert abs(strength - 0.5) < 0.02, strength  # 300 pixels for the whole; the sidebar has what was kept
    length = dragged_length()
    yield from undone_and_redone(driver, before, kept)
    assert np.array_equal(kept, executed(driver, strength=strength, length=length))


def test_a_click_on_the_arrow_goes_on_as_a_drag_that_escape_takes_back(driver: window.Window) -> Steps:
    ob = panel(driver)
    yield from take_tool(driver)
    before = scenes.fingerprint(ob)
    place = yield from arrow(driver)
    yield from grab(driver, place)
    driver.event('LEFTMOUSE', 'RELEASE')
    yield from settled(driver)
    yield from moved(driver, *(place - (100, 0)))
    assert scenes.fingerprint(ob) != before
    yield from taken_back(driver)
    assert scenes.fingerprint(bpy.data.objects["Panel"]) == before
    assert settings().strength == 1.0


def test_the_ring_turns_the_light_in_edit_mode(driver: window.Window) -> Steps:
    ob = panel(driver)
    yield from take_tool(driver)
    middle, radius = yield from ring(driver)
    turn = settings().light_turn
    for key, wanted in (('ESC', 0.0), ('', 90.0)):
        yield from grab(driver, middle + (0.0, -radius))
        for degrees in (-60.0, -30.0, 0.0):
            driver.move(*(middle + radius * np.array([np.cos(radians(degrees)), np.sin(radians(degrees))])))
            yield 0.1
        yield from window.take_picture(driver, "toolbar_ring")
        driver.key(key) if key else driver.event('LEFTMOUSE', 'RELEASE')
        yield 0.3
        driver.event('LEFTMOUSE', 'RELEASE')
        yield 0.1
        assert abs(np.degrees(settings().light_turn - turn) - wanted) < 3.0, np.degrees(settings().light_turn)
    driver.move(300, 300)  # nothing follows the mouse any longer
    yield 0.2
    assert abs(np.degrees(settings().light_turn - turn) - 90.0) < 3.0 and ob.mode == 'EDIT'


def test_numpad_0_looks_through_the_view_camera_while_the_tool_is_active(driver: window.Window) -> Steps:
    """With any other tool it is Blender's own, which shows the scene's camera."""
    panel(driver)
    space = driver.area().spaces.active
    scenes_own = bpy.data.objects.new("Own", bpy.data.cameras.new("Own"))
    bpy.context.scene.collection.objects.link(scenes_own)
    bpy.context.scene.camera = scenes_own
    for name, camera in (("reflection_lines.tool", settings().camera),
                         ("reflection_lines.pull_line", settings().camera), ("builtin.select_box", scenes_own)):
        with driver.override():
            bpy.ops.wm.tool_set_by_id(name=name)
        driver.move(300, 300)
        yield 0.3
        driver.key('NUMPAD_0')
        yield 0.8
        seen = space.camera if space.use_local_camera else bpy.context.scene.camera
        assert driver.region_3d().view_perspective == 'CAMERA' and seen == camera, name
        driver.key('NUMPAD_0')
        yield 0.8
        assert driver.region_3d().view_perspective == 'ORTHO', name


def test_the_gizmos_stay_beside_the_sidebar(driver: window.Window) -> Steps:
    """Also where the panel fills the view."""
    panel(driver)
    driver.region_3d().view_distance = 1.0
    yield from take_tool(driver)
    driver.area().spaces.active.show_region_ui = True
    yield 0.5
    _, radius = yield from ring(driver)
    pixels = yield from found(driver, gizmos().LIGHT_COLOR)
    edge = driver.region('UI').x - driver.region().x
    yield from window.take_picture(driver, "toolbar_sidebar")
    driver.area().spaces.active.show_region_ui = False
    assert radius > 30 and pixels[:, 0].max() < edge, (pixels[:, 0].max(), edge)


def test_without_a_camera_and_light_there_is_nothing_to_grab(driver: window.Window) -> Steps:
    panel(driver)
    yield from take_tool(driver)
    settings().camera = None
    assert len((yield from found(driver, gizmos().ARROW_COLOR))) < 10
    settings().light = None
    assert len((yield from found(driver, gizmos().LIGHT_COLOR))) < 10


def test_disabled_in_use_the_tool_leaves_no_entry_and_comes_back(driver: window.Window) -> Steps:
    panel(driver)
    yield from take_tool(driver)
    toolbar = bpy.types.VIEW3D_PT_tools_active
    for present in (False, True):
        with driver.override():
            installation.install() if present else bpy.ops.preferences.addon_disable(module=installation.NAME)
        driver.redraw()
        yield 0.5
        for mode in ('EDIT_MESH', 'OBJECT'):
            names = {tool.idname for tool in toolbar._tools_flatten(toolbar._tools[mode]) if tool is not None}
            assert ("reflection_lines.tool" in names) == present
    panel(driver)
    yield from take_tool(driver)
    assert len((yield from found(driver, gizmos().ARROW_COLOR))) > 100
