"""Every panel draws in every state of the work. Blender only prints what a panel raises."""
import os
import tempfile

import bpy

import scenes
import window
from window import Steps


def panels() -> list[str]:
    return sorted(name for name in dir(bpy.types) if name.startswith("VIEW3D_PT_reflines"))


def open_panel(driver: window.Window, name: str) -> Steps:
    """Opens a panel as a popover until it has drawn; one that is not for the present state does not draw."""
    kind, drawn = getattr(bpy.types, name), []

    def note(_self: bpy.types.Panel, _context: bpy.types.Context) -> None:
        drawn.append(name)
    kind.append(note)
    with driver.override():
        expected = not hasattr(kind, "poll") or kind.poll(bpy.context)
        bpy.ops.wm.call_panel(name=name, keep_open=True)
    for _ in range(200 if expected else 1):
        yield 0.02
        if drawn:
            break
    kind.remove(note)
    assert bool(drawn) == expected, name
    driver.key('ESC')
    yield 0.02


def all_panels_draw(driver: window.Window) -> Steps:
    """Opens each as a popover and reads what Blender wrote to the standard error meanwhile."""
    assert len(panels()) >= 5
    with tempfile.TemporaryFile(mode="w+") as errors:
        kept = os.dup(2)
        os.dup2(errors.fileno(), 2)
        try:
            for name in panels():
                yield from open_panel(driver, name)
        finally:
            os.dup2(kept, 2)
        errors.seek(0)
        written = errors.read()
    assert "Traceback" not in written, written


def test_panels_before_anything_is_there(driver: window.Window) -> Steps:
    driver.move(400, 400)
    with driver.override():
        scenes.remove_all()
    yield from all_panels_draw(driver)


def test_panels_with_view_light_and_result(driver: window.Window) -> Steps:
    with driver.override():
        ob = scenes.edited_panel()
        bpy.ops.ed.undo_push(message="Start")
    yield from all_panels_draw(driver)
    with driver.override():
        scenes.smooth()
        assert ob.reflection_lines.report.termination
    yield from all_panels_draw(driver)
    with driver.override():
        bpy.ops.ed.undo()
        assert bpy.context.window_manager.reflection_lines.is_undone(ob)
    yield from all_panels_draw(driver)
    with driver.override():
        bpy.ops.ed.redo()
    with driver.override():
        scenes.object_mode()
    yield from all_panels_draw(driver)


def test_panels_with_a_perspective_camera_and_notes(driver: window.Window) -> Steps:
    bpy.context.scene.reflection_lines.camera.data.type = 'PERSP'
    bpy.data.objects["Panel"].reflection_lines.report.notes = "3 faces turn away from the view.\nAnother sentence."
    bpy.context.scene.reflection_lines.light.hide_viewport = True
    assert bpy.context.scene.reflection_lines.describe_unfollowed(bpy.context.scene.reflection_lines.light)
    yield from all_panels_draw(driver)


def test_panels_with_a_set_of_lights(driver: window.Window) -> Steps:
    """A light of the set has lost its camera: its panel says so."""
    settings = bpy.context.scene.reflection_lines
    settings.lights = 'SET'
    yield from all_panels_draw(driver)
    with driver.override():
        assert bpy.ops.reflines.light_set('EXEC_DEFAULT', True, action='WALK') == {'FINISHED'}
        assert bpy.ops.reflines.light_set('EXEC_DEFAULT', True, action='ADD') == {'FINISHED'}
    settings.light_set.find_active().camera = None
    assert settings.light_set.find_active().find_problem()
    yield from all_panels_draw(driver)
    with driver.override():
        bpy.ops.wm.call_panel(name="VIEW3D_PT_reflines_light_set", keep_open=True)
    yield 0.3
    yield from window.take_picture(driver, "light_set")
    driver.key('ESC')
