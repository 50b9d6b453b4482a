"""What tests of drags share: a panel to drag, the press of the button, and waiting until solves are done."""
import sys

import bpy
import numpy as np
import scenes
import window
from window import Steps

PATIENCE = 60.0  # seconds for a solve on a busy machine


def panel(driver: window.Window, cells: int = 16, levels: int = 0) -> bpy.types.Object:
    """With `levels` it is a cage below a Subdivision Surface. What earlier drags kept in the sidebar is forgotten."""
    settings = bpy.context.scene.reflection_lines
    for name, values in (("strength", settings), ("length", settings), ("density", settings.direction),
                         ("angle", settings.direction), ("strength", settings.pattern), ("amount", settings.warp)):
        values.property_unset(name)
    with driver.override():
        scenes.remove_all()
        ob = scenes.panel(cells=cells)
        if levels:
            ob.modifiers.new("Subdivision", 'SUBSURF').levels = levels
        scenes.look_from_above()
        scenes.edit_inner(ob, cells)
        bpy.context.scene.reflection_lines.stripes.show = True
        driver.region_3d().view_perspective = 'ORTHO'
        driver.region_3d().view_rotation = (1.0, 0.0, 0.0, 0.0)
        driver.region_3d().view_distance = 4.0
        bpy.ops.ed.undo_push(message="Start")
    return ob


def shown(driver: window.Window) -> np.ndarray:
    with driver.override():
        return scenes.positions(bpy.context.view_layer.objects.active)


def executed(driver: window.Window, levels: int = 0, **settings: object) -> np.ndarray:
    """What the operator makes of a fresh panel without a mouse."""
    panel(driver, levels=levels)
    with driver.override():
        scenes.smooth(**settings)
    return shown(driver)


def dragged_length() -> float:
    """The length that the last drag was kept with; 0 is the automatic one."""
    return bpy.context.window_manager.operators[-1].properties.length


def press(driver: window.Window, operator: str = "smooth") -> Steps:
    driver.move(400, 300)
    yield 0.2
    with driver.override():
        getattr(bpy.ops.reflines, operator)('INVOKE_DEFAULT', True, follow_mouse=True)
    yield 0.2
    yield from settled(driver)


def take_tool(driver: window.Window, name: str, place: tuple[float, float] = (300, 300)) -> Steps:
    """Takes a tool of the toolbar, with the mouse at a place of the view."""
    driver.move(*place)
    with driver.override():
        assert bpy.ops.wm.tool_set_by_id(name=name) == {'FINISHED'}
    driver.redraw()
    yield 0.3


def is_running() -> bool:
    """Whether a tool is dragged, or a press is at work."""
    return sys.modules["reflection_lines"].interactive.drag.is_running()


def at_rest() -> bool:
    """Whether no drag and no live warp is solving, or has something to show."""
    interactive = sys.modules["reflection_lines"].interactive
    return not interactive.drag.has_work() and not interactive.live_warp_handlers.has_work()


def settled(driver: window.Window) -> Steps:
    """Waits until the mesh no longer changes."""
    rests = 0
    for _ in range(int(PATIENCE / 0.05)):
        yield 0.05
        rests = rests + 1 if at_rest() else 0
        if rests == 3:  # Blender draws between two looks, and has done what its events ask for
            return
    raise AssertionError("the mesh does not come to rest")


def moved(driver: window.Window, x: float, y: float) -> Steps:
    """Moves the mouse, and waits until the mesh has followed."""
    driver.move(x, y)
    yield 0.1
    yield from settled(driver)


def struck(driver: window.Window, key: str, **modifiers: bool) -> Steps:
    """Presses a key, and waits until the mesh has followed."""
    driver.key(key, **modifiers)
    yield from settled(driver)


def comes_to(driver: window.Window, expected: np.ndarray) -> Steps:
    """Waits until the mesh is this to the last bit."""
    for _ in range(int(PATIENCE / 0.05)):
        yield 0.05
        if np.array_equal(shown(driver), expected):
            return
    raise AssertionError("the mesh does not come to what is expected")


def undone_and_redone(driver: window.Window, before: np.ndarray, after: np.ndarray) -> Steps:
    """One undo gives the mesh from before, one redo that from after, to the last bit."""
    for shift, expected in ((False, before), (True, after)):
        driver.key('Z', ctrl=True, shift=shift)
        yield from comes_to(driver, expected)


def ended(driver: window.Window) -> Steps:
    """Waits until the operator has ended: then the status bar's text is gone and the report is there."""
    for _ in range(int(PATIENCE / 0.1)):
        operator = bpy.context.window_manager.operators
        if operator and operator[-1].bl_idname.startswith("REFLINES_OT"):
            break
        yield 0.1
    yield from settled(driver)


def applied(driver: window.Window) -> Steps:
    """Keeps what is dragged."""
    driver.key('RET')
    yield from ended(driver)


def taken_back(driver: window.Window) -> Steps:
    """Ends what is dragged by Escape."""
    driver.key('ESC')
    yield 0.3


def adjust(driver: window.Window, **settings: object) -> Steps:
    """By the panel Adjust Last Operation, the last one being Smooth."""
    with driver.override():
        operator = bpy.context.active_operator
        assert operator.bl_idname == "REFLINES_OT_smooth"
        for name, value in settings.items():
            setattr(operator.properties, name, value)
        assert bpy.ops.ed.undo_redo() == {'FINISHED'}
    yield 0.5
