"""Borders set by segment are drawn in five colours, in Edit Mode and Object Mode, and follow undo."""
from collections.abc import Generator

import bmesh
import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d

import scenes
import window
from picture import CELLS, Steps, look, striped_panel

ROW = CELLS + 1
SEGMENTS = {"free": 4, "curvature": 12, "fixed": 20, "flow": 28, "clamped": 36}  # condition and column of vertices
HUES = {"free": (0, 1, 0), "fixed": (1, 0.5, 0), "clamped": (0, 0.4, 1), "curvature": (0.6, 0.1, 1),
        "flow": (1, 0, 0.35)}


def select_column(ob: bpy.types.Object, column: int) -> None:
    bpy.ops.mesh.select_all(action='DESELECT')
    mesh = bmesh.from_edit_mesh(ob.data)
    mesh.verts.ensure_lookup_table()
    for k in range(ROW):
        mesh.verts[column + ROW * k].select = True
    mesh.select_flush_mode()
    bmesh.update_edit_mesh(ob.data)


def set_columns(driver: window.Window, ob: bpy.types.Object) -> None:
    with driver.override():
        scenes.edit(ob)
        bpy.context.tool_settings.mesh_select_mode = (True, False, False)
        for name, column in SEGMENTS.items():
            select_column(ob, column)
            assert bpy.ops.reflines.set_border('EXEC_DEFAULT', True, border=name) == {'FINISHED'}
        bpy.ops.mesh.select_all(action='DESELECT')


def colored(driver: window.Window) -> Generator[float, None, np.ndarray]:
    """The 3D view as RGB (height x width x 3, bottom row first), after everything was drawn in it."""
    return (yield from look(driver, 'POST_VIEW'))[:, :, :3] / 255.0


def hue(driver: window.Window, picture: np.ndarray, ob: bpy.types.Object, column: int) -> np.ndarray:
    """The most saturated colour near the middle of a column's edges, as the mean of them."""
    V = scenes.world(ob)[column::ROW]
    found = []
    for point in 0.5 * (V[5:-6] + V[6:-5]):
        at = location_3d_to_region_2d(driver.region(), driver.region_3d(), point)
        near = picture[int(at.y), int(at.x) - 3:int(at.x) + 4]
        found.append(near[np.ptp(near, axis=1).argmax()])
    return np.mean(found, axis=0)


def check_colors(driver: window.Window, ob: bpy.types.Object, *, drawn: bool) -> Steps:
    picture = yield from colored(driver)
    for name, column in SEGMENTS.items():
        color = hue(driver, picture, ob, column)
        away = np.abs(color / max(color.max(), 1e-9) - HUES[name]).max()
        print(f"{name}: {color.round(2)}, {away:.2f} from its hue")
        assert (away < 0.5 and np.ptp(color) > 0.4) if drawn else np.ptp(color) < 0.2


def test_five_colors_in_both_modes(driver: window.Window) -> Steps:
    ob = striped_panel(driver, "Segments")
    set_columns(driver, ob)
    yield from check_colors(driver, ob, drawn=True)
    with driver.override():
        scenes.object_mode()
    yield from check_colors(driver, ob, drawn=True)
    bpy.context.scene.reflection_lines.show_borders = False
    yield from check_colors(driver, ob, drawn=False)
    bpy.context.scene.reflection_lines.show_borders = True


def test_undo_takes_the_last_segment_away(driver: window.Window) -> Steps:
    ob = striped_panel(driver, "Undone")
    with driver.override():
        bpy.ops.ed.undo_push(message="panel")
    set_columns(driver, ob)
    yield from check_colors(driver, ob, drawn=True)
    with driver.override():
        bpy.ops.ed.undo()
        bpy.ops.mesh.select_all(action='DESELECT')
    ob = bpy.context.view_layer.objects.active
    picture = yield from colored(driver)
    assert np.ptp(hue(driver, picture, ob, SEGMENTS["clamped"])) < 0.2
    assert np.ptp(hue(driver, picture, ob, SEGMENTS["fixed"])) > 0.4
