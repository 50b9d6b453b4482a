"""Stripes stay on the panel while light or camera is active, in Sculpt Mode and in every scope; else they say why."""
import sys
import tempfile
from collections.abc import Generator
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix

import scenes
import window
from picture import CELLS, Steps, captured, kept_names, striped_panel
from scenes import settings

GREY = 0.2  # of the environment without an image: a flat colour that only stripes show


def flat_panel(driver: window.Window, name: str) -> bpy.types.Object:
    """A panel whose stripes are one grey, so that its pixels can be counted."""
    ob = striped_panel(driver, name)
    settings().stripes.mode, settings().stripes.image = 'IMAGE', None
    return ob


def count(driver: window.Window) -> Generator[float, None, int]:
    picture = yield from captured(driver)
    return int((np.abs(picture - GREY) < 0.01).sum())


def explained(driver: window.Window) -> str:
    with driver.override():
        return bpy.context.window_manager.reflection_lines.explain_stripes(bpy.context)


def test_stripes_stay_while_light_camera_or_nothing_is_active(driver: window.Window) -> Steps:
    ob = flat_panel(driver, "Stays")
    whole = yield from count(driver)
    assert whole > 10000
    for active in (settings().light, settings().camera, None):
        for scope in ('OBJECT', 'SELECTION'):
            settings().stripes.scope = scope
            with driver.override():
                bpy.ops.object.select_all(action='DESELECT')
                bpy.context.view_layer.objects.active = active
                if active is not None:
                    active.select_set(True)
            shown = yield from count(driver)
            assert shown == whole, (active, scope, shown, whole)
    assert explained(driver) == ""
    with driver.override():
        scenes.activate(ob)


def test_after_opening_a_file_stripes_are_on_what_was_solved(driver: window.Window) -> Steps:
    ob = flat_panel(driver, "Solved")
    with driver.override():
        scenes.edit_inner(ob, CELLS)
        scenes.smooth()
        scenes.object_mode()
        bpy.context.view_layer.objects.active = settings().light
    sys.modules["reflection_lines"].state.last_panels._names.clear()
    assert (yield from count(driver)) > 10000


def test_a_map_of_a_mesh_that_has_changed_says_so(driver: window.Window) -> Steps:
    ob = flat_panel(driver, "Mapped")
    with driver.override():
        scenes.edit_inner(ob, CELLS)
        scenes.smooth()
        scenes.object_mode()
    settings().stripes.mode = 'DEVIATION'
    yield from captured(driver)
    assert explained(driver) == ""
    ob.data.vertices[len(ob.data.vertices) // 2].co.z += 0.1
    ob.data.update()
    yield from captured(driver)
    assert explained(driver) == "Mapped is no longer as its solve left it: there is no map of it. Run the tool again"
    settings().stripes.mode = 'REFLECTION'
    yield from captured(driver)
    assert explained(driver) == ""


def test_stripes_follow_a_shape_key_that_is_played(driver: window.Window) -> Steps:
    """Its value is keyed: the surface rises through where the stripes were."""
    ob = flat_panel(driver, "Played")
    with driver.override():
        ob.shape_key_add(name="Basis")
        high = ob.shape_key_add(name="High")
        for point in high.data:
            point.co.z += 0.1
        for frame, value in ((1, 0.0), (9, 1.0)):
            high.value = value
            high.keyframe_insert("value", frame=frame)
    counts = []
    for frame in (1, 5, 9, 1):
        bpy.context.scene.frame_set(frame)
        counts.append((yield from count(driver)))
    assert min(counts) > 10000 and max(counts) < 1.02 * min(counts), counts


def test_all_visible_and_empty_scopes(driver: window.Window) -> Steps:
    ob = flat_panel(driver, "One")
    with driver.override():
        other = scenes.panel("Two", cells=8)
        other.location.x = 2.5
        hidden = scenes.panel("Three", cells=8)
        hidden.location.x = -2.5
        hidden.hide_set(True)
        scenes.activate(ob)
    driver.region_3d().view_distance = 5.0
    one = yield from count(driver)
    settings().stripes.scope = 'VISIBLE'
    both = yield from count(driver)
    assert 1.8 * one < both < 2.2 * one
    settings().stripes.scope, settings().stripes.collection = 'COLLECTION', None
    assert (yield from count(driver)) < 100
    assert "pick a collection" in explained(driver)
    settings().stripes.scope = 'OBJECT'
    with driver.override():
        ob.hide_set(True)
        bpy.context.view_layer.objects.active = ob
    assert explained(driver) == "One: hidden in this view"


def test_a_linked_object_of_the_same_name_has_its_own_stripes(driver: window.Window) -> Steps:
    ob = flat_panel(driver, "Same")
    driver.region_3d().view_distance = 5.0
    one = yield from count(driver)
    draw = sys.modules["reflection_lines"].overlay.draw
    with tempfile.TemporaryDirectory() as folder:
        library = str(Path(folder) / "library.blend")
        bpy.data.libraries.write(library, {ob})
        with bpy.data.libraries.load(library, link=True) as (_, wanted):
            wanted.objects = ["Same"]
        beside = bpy.data.collections.new("Beside")
        bpy.context.scene.collection.children.link(beside)
        beside.objects.link(wanted.objects[0])
        ob.data.transform(Matrix.Translation((2.5, 0.0, 0.0)))
        ob.data.update()
        settings().stripes.scope = 'VISIBLE'
        both = yield from count(driver)
        assert 1.8 * one < both < 2.2 * one, (one, both)
        built = draw._cache.builds
        for _ in range(3):
            yield from count(driver)
        assert draw._cache.builds == built
        bpy.data.objects.remove(wanted.objects[0])
        assert (yield from count(driver)) < 1.2 * one
        assert kept_names() == {"Same"}
    settings().stripes.scope = 'OBJECT'


def test_the_lattice_of_a_deleted_panel_shows_no_panel(driver: window.Window) -> Steps:
    ob = flat_panel(driver, "Gone")
    with driver.override():
        scenes.edit_inner(ob, CELLS)
        bpy.ops.reflines.add_warp_lattice()
        scenes.object_mode()
        lattice = settings().warp.lattice
        bpy.ops.object.select_all(action='DESELECT')
        scenes.activate(ob)
        bpy.ops.object.delete()
        scenes.activate(lattice)
    driver.redraw()
    yield 0.3
    assert lattice.reflection_lines.panel is not None
    assert explained(driver) == "Nothing to show: make the panel's mesh active"


def test_the_overlay_switch_hides_them(driver: window.Window) -> Steps:
    flat_panel(driver, "Overlays")
    overlay = driver.area().spaces.active.overlay
    overlay.show_overlays = False
    gone = yield from count(driver)
    why = explained(driver)
    overlay.show_overlays = True
    assert gone < 100 < 10000 < (yield from count(driver))
    assert why == "Overlays are off in this view: switch them on in its header" and explained(driver) == ""


def test_what_is_missing_is_said(driver: window.Window) -> Steps:
    ob = flat_panel(driver, "Missing")
    yield from captured(driver)
    light, camera = settings().light, settings().camera
    for lack, said in (("light", "No light direction"), ("camera", "No view camera: the stripes are as this view")):
        setattr(settings(), lack, None)
        assert said in explained(driver)
        settings().light, settings().camera = light, camera
    light.matrix_world = camera.matrix_world
    with driver.override():
        bpy.context.view_layer.update()
    assert "along the view" in explained(driver)
    with driver.override():
        bpy.data.objects.remove(ob)
    assert explained(driver) == "Nothing to show: make the panel's mesh active"
    settings().stripes.show = False
    assert explained(driver) == ""


def ensure_brush() -> None:
    """Debian's Blender 4.3 comes without brushes, and a stroke without one does nothing."""
    if bpy.context.tool_settings.sculpt.brush is not None:
        return
    brush = bpy.data.brushes.new("Own", mode='SCULPT')
    brush.sculpt_tool = 'DRAW'
    brush.asset_mark()
    bpy.ops.brush.asset_activate(asset_library_type='LOCAL', relative_asset_identifier="Brush/Own")


def stroke(driver: window.Window) -> Steps:
    region = driver.region()
    driver.move(region.width // 2 - 60, region.height // 2)
    yield 0.1
    driver.event('LEFTMOUSE', 'PRESS')
    yield 0.05
    for step in range(12):
        driver.move(region.width // 2 - 60 + 10 * step, region.height // 2)
        yield 0.05


def test_stripes_follow_a_stroke_in_sculpt_mode(driver: window.Window) -> Steps:
    striped_panel(driver, "Sculpted")
    with driver.override():
        bpy.ops.object.mode_set(mode='SCULPT')
        ensure_brush()
    before = yield from captured(driver)
    assert np.ptp(before) > 0.9
    yield from stroke(driver)
    within = yield from captured(driver)
    driver.event('LEFTMOUSE', 'RELEASE')
    yield 0.3
    after = yield from captured(driver)
    with driver.override():
        scenes.object_mode()
    left = yield from captured(driver)
    changed = [int((np.abs(one - before) > 0.1).sum()) for one in (within, after, left)]
    print(f"pixels changed during the stroke, after it, after leaving Sculpt Mode: {changed}")
    assert changed[2] > 1000
    assert changed[0] > 0.5 * changed[2]
    assert (np.abs(after - left) > 0.1).mean() < 2e-3
