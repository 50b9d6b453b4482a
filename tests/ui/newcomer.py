"""A newcomer, who goes through README's first use with the mouse: first on a sample, then on a model of their own."""
from collections.abc import Callable, Generator
from pathlib import Path

import bpy
import numpy as np
from mathutils import Euler

import scenes
import sidebar
import window
from dragging import ended, settled, shown

Steps = Generator[float, None, None]
Note = Callable[[str], Steps]  # what is done after a step, with its name
SAMPLE = Path(__file__).resolve().parents[2] / "blend_samples" / "hood.blend"


def settings() -> bpy.types.PropertyGroup:
    return bpy.context.scene.reflection_lines


def headline() -> str:
    return bpy.context.view_layer.objects.active.reflection_lines.report.headline()


def press_button(driver: window.Window, command: str) -> Steps:
    x, y = yield from sidebar.find_button(driver, f"bpy.ops.reflines.{command}()")
    yield from sidebar.press(driver, x, y)
    yield 0.3


def scroll_up(driver: window.Window) -> Steps:
    region = driver.region('UI')
    sidebar.point(driver, region.width // 2, region.height - 20)  # the wheel below the last panel is the view's
    for _ in range(40):
        driver.event('WHEELUPMOUSE', 'PRESS')
    yield 0.3


def use_sample(note: Note) -> Steps:
    """Steps 2 and 3: opens the bonnet, smooths it, and takes that back."""
    bpy.ops.wm.open_mainfile(filepath=str(SAMPLE), load_ui=True)
    yield 1.5
    driver = window.Window()
    assert driver.area().spaces.active.show_region_ui  # no key N: that would close the sidebar
    assert (yield from sidebar.shows_tab(driver))
    yield from scroll_up(driver)
    yield from note("sample")
    before = shown(driver)
    yield from press_button(driver, "smooth")
    yield from ended(driver)
    after = shown(driver)
    assert np.abs(after - before).max() > 1e-4
    assert headline().startswith("Flaws healed on ") and ", moved at most 2." in headline(), headline()
    driver.move(300, 300)
    yield from note("smoothed")
    driver.key('Z', ctrl=True)
    yield from settled(driver)
    assert np.array_equal(shown(driver), before)


def bring_own_model(driver: window.Window) -> bpy.types.Object:
    """A rippled panel that lies aslant in the scene, in Edit Mode, with the faces selected that are to be smooth."""
    with driver.override():
        if bpy.context.mode != 'OBJECT':
            bpy.ops.object.mode_set(mode='OBJECT')
        for old in list(bpy.data.objects):
            bpy.data.objects.remove(old)
        settings().stripes.show = False
        for name in ("length", "limit", "strength"):  # what the sample has stays in its file
            settings().property_unset(name)
        ob = scenes.panel("Own", cells=40)
        ob.rotation_euler = (0.3, -0.2, 0.4)
        scenes.edit_inner(ob, 40)
        driver.area().spaces.active.overlay.show_face_center = False
        region_3d = driver.region_3d()
        region_3d.view_perspective, region_3d.view_distance = 'ORTHO', 4.0
        region_3d.view_location = (0.35, 0.0, 0.0)  # the sidebar covers the view's right part
    return ob


def use_own_model(driver: window.Window, note: Note) -> Steps:
    """Step 4: the set-up, a sweep, and the button."""
    ob = bring_own_model(driver)
    driver.region_3d().view_rotation = Euler((1.1, 0.0, 0.5)).to_quaternion()
    driver.redraw()
    yield 0.5
    yield from sidebar.open_tab(driver)
    driver.region_3d().view_rotation = ob.matrix_world.to_quaternion()  # the panel faces the view
    yield 0.3
    yield from note("camera")
    yield from press_button(driver, "set_up")
    assert settings().camera is not None and settings().light is not None and settings().stripes.show
    driver.move(300, 300)
    yield from note("stripes")
    turn = settings().light_turn
    with driver.override():
        bpy.ops.reflines.sweep_light('INVOKE_DEFAULT', True)
    driver.move(200, 300)
    yield 0.2
    driver.move(420, 300)
    yield 0.3
    yield from note("swept")
    driver.key('LEFTMOUSE')
    yield 0.3
    assert abs(settings().light_turn - turn) > 0.3
    before = shown(driver)
    yield from press_button(driver, "smooth")
    yield from ended(driver)
    assert np.abs(shown(driver) - before).max() > 1e-4 and ob.mode == 'EDIT'
    assert headline().startswith("Flaws healed on "), headline()
    driver.move(300, 300)
    yield from note("own_smoothed")
