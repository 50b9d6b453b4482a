"""Pictures of a 3D view as arrays, and the points of a mesh behind their pixels."""
import sys
from collections.abc import Callable, Generator

import bpy
import gpu
import numpy as np
import scenes
import window
from window import Steps

CELLS = 40
COUNT, WIDTH = 40, 0.5
SOFT_EDGE = 0.25  # of a period to each side: softness 1 at width 0.5, wider than any pixel here

# Blender's own overlays; the switch of all of them stays on, for the stripes go by it.
OVERLAYS = ("show_floor", "show_axis_x", "show_axis_y", "show_axis_z", "show_ortho_grid", "show_text", "show_cursor",
            "show_outline_selected", "show_object_origins", "show_relationship_lines", "show_extras")


def kept_names() -> set[str]:
    """The full names of the objects of which anything is kept that is drawn."""
    draw = sys.modules["reflection_lines"].overlay.draw
    cache, fits = draw._cache, draw._cache.fits
    every = (*cache.shown, *cache.uniforms, *cache.limits, *fits.done, *fits.wanted, *fits.started)
    return {name.removeprefix(draw.BEFORE).removeprefix(draw.AFTER) for name in every}


def prepare(driver: window.Window, ob: bpy.types.Object) -> None:
    """Black and white stripes, nothing else drawn, and the viewport looking as the view camera does."""
    stripes = bpy.context.scene.reflection_lines.stripes
    stripes.show, stripes.count, stripes.width, stripes.softness = True, COUNT, WIDTH, 1.0
    stripes.eye, stripes.cage_on_top, stripes.mode, stripes.scope = 'CAMERA', False, 'REFLECTION', 'OBJECT'
    stripes.color, stripes.gap_color = (1.0, 1.0, 1.0, 1.0), (0.0, 0.0, 0.0, 1.0)
    for name in OVERLAYS:
        setattr(driver.area().spaces.active.overlay, name, False)
    region_3d = driver.region_3d()
    region_3d.view_perspective = 'ORTHO'
    region_3d.view_rotation = bpy.context.scene.reflection_lines.camera.matrix_world.to_quaternion()
    region_3d.view_location = ob.matrix_world.translation
    region_3d.view_distance = 2.0


def fresh_panel(driver: window.Window, name: str) -> bpy.types.Object:
    with driver.override():
        scenes.remove_all()
        ob = scenes.panel(name, cells=CELLS)
        scenes.look_from_above(light_degrees=60.0)
        bpy.context.view_layer.update()
    return ob


def striped_panel(driver: window.Window, name: str) -> bpy.types.Object:
    """The only panel of the scene, with stripes that a picture can be compared with."""
    ob = fresh_panel(driver, name)
    prepare(driver, ob)
    return ob


def captured(driver: window.Window) -> Generator[float, None, np.ndarray]:
    """Linear brightness (height x width, bottom row first) of the 3D view, after the stripes were drawn."""
    pictures = []
    handle = bpy.types.SpaceView3D.draw_handler_add(lambda: pictures.append(pixels()), (), 'WINDOW', 'POST_VIEW')
    yield from drawn_at_rest(driver, pictures)
    bpy.types.SpaceView3D.draw_handler_remove(handle, 'WINDOW')
    encoded = pictures[-1][:, :, 1] / 255.0
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def drawn(driver: window.Window) -> Steps:
    """Waits until the view was drawn with nothing left to fit."""
    draws: list[None] = []
    handle = bpy.types.SpaceView3D.draw_handler_add(lambda: draws.append(None), (), 'WINDOW', 'POST_VIEW')
    yield from drawn_at_rest(driver, draws)
    bpy.types.SpaceView3D.draw_handler_remove(handle, 'WINDOW')


def drawn_at_rest(driver: window.Window, pictures: list) -> Steps:
    """Waits until the view was drawn with nothing left to fit, neither before nor after it was."""
    draw, idle = sys.modules["reflection_lines.overlay.draw"], False
    while not idle or draw.is_waiting():
        idle, seen = not draw.is_waiting(), len(pictures)
        driver.redraw()
        while len(pictures) == seen:
            yield 0.03


def look(driver: window.Window, moment: str,
         read: Callable[[], object] | None = None) -> Generator[float, None, object]:
    """Draws the 3D view; returns what `read`, its pixels, gave at this moment of the last draw within half a second."""
    found: list[object] = []
    handle = bpy.types.SpaceView3D.draw_handler_add(lambda: found.append((read or pixels)()), (), 'WINDOW', moment)
    driver.redraw()
    yield 0.5
    while not found:
        yield 0.1
    bpy.types.SpaceView3D.draw_handler_remove(handle, 'WINDOW')
    return found[-1]


def pixels() -> np.ndarray:
    x, y, width, height = gpu.state.viewport_get()
    data = gpu.state.active_framebuffer_get().read_color(x, y, width, height, 4, 0, 'UBYTE')
    data.dimensions = width * height * 4
    return np.array(data).reshape(height, width, 4)


def smoothstep(low: float, high: float, x: np.ndarray) -> np.ndarray:
    t = np.clip((x - low) / (high - low), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def expected_light(theta: np.ndarray, count: int = COUNT) -> np.ndarray:
    period = theta * count / (2.0 * np.pi)
    from_center = np.abs(period - np.round(period))
    return 1.0 - smoothstep(-SOFT_EDGE, SOFT_EDGE, from_center - 0.5 * WIDTH)


def samples(driver: window.Window, V: np.ndarray, F: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(pixel #S x 2, triangle #S, barycentric #S x 3): the pixel at each triangle's centroid, where it lies inside."""
    matrix = np.array(driver.region_3d().perspective_matrix)
    size = np.array([driver.region().width, driver.region().height])
    clip = np.column_stack([V, np.ones(len(V))]) @ matrix.T
    screen = ((clip[:, :2] / clip[:, 3:] + 1.0) * 0.5 * size)[F]
    pixel = np.floor(screen.mean(axis=1)).astype(int)
    edges = np.stack([screen[:, 1] - screen[:, 0], screen[:, 2] - screen[:, 0]], axis=2)
    two = np.linalg.solve(edges, (pixel + 0.5 - screen[:, 0])[:, :, None])[:, :, 0]
    barycentric = np.column_stack([1.0 - two.sum(axis=1), two])
    inside = (barycentric > 0.02).all(axis=1) & (pixel > 0).all(axis=1) & (pixel < size - 1).all(axis=1)
    return pixel[inside], np.flatnonzero(inside), barycentric[inside]


def triangles(ob: bpy.types.Object) -> np.ndarray:
    if ob.mode == 'EDIT':
        ob.update_from_editmode()
    ob.data.calc_loop_triangles()
    return np.array([triangle.vertices for triangle in ob.data.loop_triangles], dtype=np.int32)
