"""Stripes in a real window: every pixel against the solver's theta; and what rebuilds a batch, counted."""
import sys
from collections.abc import Generator
from pathlib import Path

import bmesh
import bpy
import gpu
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))

import window  # noqa: E402  (found through the line above)

import scenes  # noqa: E402  (the folder of the add-on's tests is there once `window` is)

CELLS = 40
COUNT, WIDTH = 40, 0.5
SOFT_EDGE = 0.25  # of a period to each side: softness 1 at width 0.5, wider than any pixel here

Steps = Generator[float, None, None]


def prepare(driver: window.Window, ob: bpy.types.Object) -> None:
    """Black and white stripes, nothing else drawn, and the viewport looking as the view camera does."""
    stripes = bpy.context.scene.reflection_lines.stripes
    stripes.show, stripes.count, stripes.width, stripes.softness, stripes.opacity = True, COUNT, WIDTH, 1.0, 1.0
    stripes.eye, stripes.cage_on_top = 'CAMERA', False
    stripes.color, stripes.gap_color = (1.0, 1.0, 1.0, 1.0), (0.0, 0.0, 0.0, 1.0)
    driver.area().spaces.active.overlay.show_overlays = False
    region_3d = driver.region_3d()
    region_3d.view_perspective = 'ORTHO'
    region_3d.view_rotation = bpy.context.scene.reflection_lines.camera.matrix_world.to_quaternion()
    region_3d.view_location = ob.matrix_world.translation
    region_3d.view_distance = 2.0


def fresh_panel(driver: window.Window, name: str) -> bpy.types.Object:
    with driver.override():
        if bpy.context.mode != 'OBJECT':
            bpy.ops.object.mode_set(mode='OBJECT')
        for old in list(bpy.data.objects):
            bpy.data.objects.remove(old)
        ob = scenes.panel(name, cells=CELLS)
        scenes.look_from_above(light_degrees=60.0)
        bpy.context.view_layer.update()
    return ob


def captured(driver: window.Window) -> Generator[float, None, np.ndarray]:
    """Linear brightness (height x width, bottom row first) of the 3D view, after the stripes were drawn."""
    pictures = []
    handle = bpy.types.SpaceView3D.draw_handler_add(lambda: pictures.append(pixels()), (), 'WINDOW', 'POST_VIEW')
    driver.redraw()
    yield 0.5
    bpy.types.SpaceView3D.draw_handler_remove(handle, 'WINDOW')
    encoded = pictures[-1][:, :, 1] / 255.0
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def pixels() -> np.ndarray:
    x, y, width, height = gpu.state.viewport_get()
    data = gpu.state.active_framebuffer_get().read_color(x, y, width, height, 4, 0, 'UBYTE')
    data.dimensions = width * height * 4
    return np.array(data).reshape(height, width, 4)


def smoothstep(low: float, high: float, x: np.ndarray) -> np.ndarray:
    t = np.clip((x - low) / (high - low), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def expected_light(theta: np.ndarray) -> np.ndarray:
    period = theta * COUNT / (2.0 * np.pi)
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


def agrees_with_theta(driver: window.Window, ob: bpy.types.Object, share: float = 1.0) -> Steps:
    """Brightness within 3/255 in a share of thousands of pixels."""
    reflines = sys.modules["reflection_lines"].native.reflines
    picture = yield from captured(driver)
    F, V = triangles(ob), scenes.world(ob)
    pixel, triangle, barycentric = samples(driver, V, F)
    normals = (reflines.NormalFit(V, F).normals(V)[F[triangle]] * barycentric[:, :, None]).sum(axis=1)
    settings = bpy.context.scene.reflection_lines
    v, a = (np.array(axis.matrix_world)[:3, 2] for axis in (settings.camera, settings.light))
    light = expected_light(reflines.theta(normals, v, a))
    shown = picture[pixel[:, 1], pixel[:, 0]]
    good = np.abs(shown - light) < 3.0 / 255.0
    print(f"{len(good)} pixels, {good.mean():.4%} as theta says, largest difference {np.abs(shown - light).max():.4f}")
    assert len(good) > 2000
    assert np.ptp(light) > 0.99
    assert good.mean() >= share


def test_pixels_in_object_mode(driver: window.Window) -> Steps:
    ob = fresh_panel(driver, "Object Mode")
    prepare(driver, ob)
    yield from agrees_with_theta(driver, ob)


def test_pixels_of_a_turned_scaled_and_mirrored_object(driver: window.Window) -> Steps:
    ob = fresh_panel(driver, "Mirrored")
    # The normals are fitted in object space, so only a similarity leaves them the same to the last bit.
    similar = scenes.TRANSFORMS["turned"] @ scenes.TRANSFORMS["mirrored"] * 0.4
    similar[3][3] = 1.0
    scenes.transformed(ob, similar)
    prepare(driver, ob)
    yield from agrees_with_theta(driver, ob)


def test_pixels_in_edit_mode_while_the_mesh_changes(driver: window.Window) -> Steps:
    ob = fresh_panel(driver, "Edit Mode")
    prepare(driver, ob)
    with driver.override():
        scenes.edit(ob)
        bpy.ops.mesh.select_all(action='SELECT')
        mesh = bmesh.from_edit_mesh(ob.data)
        for vertex in mesh.verts:
            vertex.co.z = scenes.crown(vertex.co.x, 2.0 * vertex.co.y)
        bmesh.update_edit_mesh(ob.data)
    yield 0.3
    yield from agrees_with_theta(driver, ob)


def test_pixels_over_the_edit_cage(driver: window.Window) -> Steps:
    ob = fresh_panel(driver, "Cage")
    prepare(driver, ob)
    with driver.override():
        scenes.edit(ob)
        bpy.ops.mesh.select_all(action='SELECT')
    driver.area().spaces.active.overlay.show_overlays = True
    yield from agrees_with_theta(driver, ob, share=0.95)


def builds() -> int:
    return sys.modules["reflection_lines"].draw.batch_builds()


def test_settings_view_and_light_rebuild_no_batch(driver: window.Window) -> Steps:
    ob = fresh_panel(driver, "Settings")
    prepare(driver, ob)
    yield from captured(driver)
    before = builds()
    settings = bpy.context.scene.reflection_lines
    for name, value in (("count", 17), ("width", 0.3), ("softness", 0.6), ("opacity", 0.4), ("eye", 'VIEWPORT'),
                        ("color", (1, 0, 0, 1)), ("gap_color", (0, 1, 0, 1)), ("eye", 'CAMERA'), ("cage_on_top", True)):
        setattr(settings.stripes, name, value)
        picture = yield from captured(driver)
    settings.light.rotation_euler.z += 0.3
    turned = yield from captured(driver)
    assert np.abs(turned - picture).max() > 0.1
    ob.location.x += 0.1
    yield from captured(driver)
    driver.region_3d().view_distance = 3.0
    yield from captured(driver)
    assert builds() == before


def test_a_moved_vertex_rebuilds_one_batch(driver: window.Window) -> Steps:
    ob = fresh_panel(driver, "Moved")
    prepare(driver, ob)
    with driver.override():
        scenes.edit(ob)
    yield from captured(driver)
    before = builds()
    mesh = bmesh.from_edit_mesh(ob.data)
    mesh.verts.ensure_lookup_table()
    mesh.verts[CELLS * CELLS // 2].co.z += 0.05
    bmesh.update_edit_mesh(ob.data)
    yield from captured(driver)
    yield from captured(driver)
    assert builds() == before + 1


def same_picture(a: np.ndarray, b: np.ndarray) -> bool:
    """But for the last levels of brightness, as fits of normals are kept, and for the panel's antialiased outline."""
    return float((np.abs(a - b) > 3.0 / 255.0).mean()) < 2e-3


def test_stripes_follow_a_drag_and_its_escape(driver: window.Window) -> Steps:
    ob = fresh_panel(driver, "Dragged")
    prepare(driver, ob)
    with driver.override():
        scenes.edit(ob)
        scenes.select_faces(ob, lambda face: face == CELLS * CELLS // 2 + CELLS // 2)
    before = yield from captured(driver)
    driver.move(500, 400)
    yield 0.1
    for key in ('G', 'Z'):
        driver.key(key)
        yield 0.1
    for step in range(4):
        driver.move(500, 410 + 10 * step)
        yield 0.1
    dragged = yield from captured(driver)
    driver.key('ESC')
    yield 0.2
    after = yield from captured(driver)
    assert (np.abs(dragged - before) > 0.1).sum() > 500
    assert same_picture(after, before)


def test_stripes_follow_undo_in_both_modes(driver: window.Window) -> Steps:
    ob = fresh_panel(driver, "Undone")
    prepare(driver, ob)
    for enter in (scenes.object_mode, lambda: scenes.edit_inner(bpy.context.object, CELLS)):
        with driver.override():
            scenes.edit_inner(ob, CELLS)
            scenes.smooth(strength=0.0)  # the region for Object Mode
            enter()
            bpy.ops.ed.undo_push(message="start")
        before = yield from captured(driver)
        with driver.override():
            scenes.smooth(length=1.0)
        smoothed = yield from captured(driver)
        with driver.override():
            bpy.ops.ed.undo()
        undone = yield from captured(driver)
        assert (np.abs(smoothed - before) > 0.1).sum() > 5000
        assert same_picture(undone, before)
        ob = bpy.data.objects["Undone"]


window.run(test_pixels_in_object_mode, test_pixels_of_a_turned_scaled_and_mirrored_object,
           test_pixels_in_edit_mode_while_the_mesh_changes, test_pixels_over_the_edit_cage,
           test_settings_view_and_light_rebuild_no_batch, test_a_moved_vertex_rebuilds_one_batch,
           test_stripes_follow_a_drag_and_its_escape, test_stripes_follow_undo_in_both_modes)
