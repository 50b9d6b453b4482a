"""Stripes in a real window: every pixel against the solver's theta; and what rebuilds a batch, counted."""
import sys

import bmesh
import bpy
import numpy as np

import scenes
import window
from picture import (
    CELLS, Steps, captured, expected_light, fresh_panel, kept_names, prepare, samples, striped_panel, triangles)


def theta_at_samples(driver: window.Window, ob: bpy.types.Object, picture: np.ndarray, corners: np.ndarray
                     ) -> tuple[np.ndarray, np.ndarray]:
    """What is shown at thousands of pixels, and theta of the normals at the triangles' corners (#F x 3 x 3)."""
    pixel, triangle, barycentric = samples(driver, scenes.world(ob), triangles(ob))
    normals = (corners[triangle] * barycentric[:, :, None]).sum(axis=1)
    settings = bpy.context.scene.reflection_lines
    v, a = (np.array(axis.matrix_world)[:3, 2] for axis in (settings.camera, settings.light))
    light = expected_light(sys.modules["reflection_lines"].native.reflines.theta(normals, v, a))
    assert len(light) > 2000
    return picture[pixel[:, 1], pixel[:, 0]], light


def agrees_with_theta(driver: window.Window, ob: bpy.types.Object, share: float = 1.0) -> Steps:
    """Brightness within 3/255 in a share of the pixels."""
    reflines = sys.modules["reflection_lines"].native.reflines
    picture = yield from captured(driver)
    F, V = triangles(ob), scenes.world(ob)
    shown, light = theta_at_samples(driver, ob, picture, reflines.NormalFit(V, F).normals(V)[F])
    good = np.abs(shown - light) < 3.0 / 255.0
    print(f"{len(good)} pixels, {good.mean():.4%} as theta says, largest difference {np.abs(shown - light).max():.4f}")
    assert np.ptp(light) > 0.99
    assert good.mean() >= share


def test_pixels_of_a_turned_scaled_and_mirrored_object(driver: window.Window) -> Steps:
    ob = fresh_panel(driver, "Mirrored")
    # The normals are fitted in object space, so only a similarity leaves them the same to the last bit.
    similar = scenes.TRANSFORMS["turned"] @ scenes.TRANSFORMS["mirrored"] * 0.4
    similar[3][3] = 1.0
    scenes.transformed(ob, similar)
    prepare(driver, ob)
    yield from agrees_with_theta(driver, ob)


# A fit across the crease would bend the lines within two rows of it.
def test_each_side_of_a_crease_is_as_flat_as_it_is(driver: window.Window) -> Steps:
    ob = striped_panel(driver, "Folded")
    with driver.override():
        middle = np.median([vertex.co.y for vertex in ob.data.vertices])
        for vertex in ob.data.vertices:
            vertex.co.z = max(0.0, 0.8 * (vertex.co.y - middle))
        ob.data.update()
    picture = yield from captured(driver)
    V = scenes.world(ob)[triangles(ob)]
    faces = np.cross(V[:, 1] - V[:, 0], V[:, 2] - V[:, 0])
    shown, light = theta_at_samples(driver, ob, picture, np.repeat(faces[:, None], 3, axis=1))
    assert np.ptp(light) > 0.05
    assert (np.abs(shown - light) < 3.0 / 255.0).mean() > 0.995


def test_pixels_in_edit_mode_while_the_mesh_changes(driver: window.Window) -> Steps:
    ob = striped_panel(driver, "Edit Mode")
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
    ob = striped_panel(driver, "Cage")
    with driver.override():
        scenes.edit(ob)
        bpy.ops.mesh.select_all(action='SELECT')
    driver.area().spaces.active.overlay.show_overlays = True
    yield from agrees_with_theta(driver, ob, share=0.95)


def builds() -> int:
    return sys.modules["reflection_lines"].overlay.draw._cache.builds


def test_settings_view_and_light_rebuild_no_batch(driver: window.Window) -> Steps:
    ob = striped_panel(driver, "Settings")
    yield from captured(driver)
    before = builds()
    settings = bpy.context.scene.reflection_lines
    for name, value in (("count", 17), ("width", 0.3), ("softness", 0.6), ("eye", 'VIEWPORT'),
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
    ob = striped_panel(driver, "Moved")
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
    ob = striped_panel(driver, "Dragged")
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
    assert (np.abs(dragged - before) > 0.1).sum() > 200  # the triangles round one face, of 800 pixels
    assert same_picture(after, before)


def test_a_panel_that_is_hidden_wholly(driver: window.Window) -> Steps:
    ob = striped_panel(driver, "Hidden")
    with driver.override():
        scenes.edit_inner(ob, CELLS)
    before = yield from captured(driver)
    with driver.override():
        bpy.ops.mesh.select_all(action='SELECT')
        bpy.ops.mesh.hide('EXEC_DEFAULT', True)
    hidden = yield from captured(driver)
    with driver.override():
        bpy.ops.mesh.reveal('EXEC_DEFAULT', True)
        scenes.select_faces(ob, scenes.inner(CELLS))
    shown = yield from captured(driver)
    assert np.ptp(hidden) < 0.1 < np.ptp(before)
    assert same_picture(shown, before)


def test_stripes_follow_undo_in_both_modes(driver: window.Window) -> Steps:
    ob = striped_panel(driver, "Undone")
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


def test_what_is_gone_or_long_unseen_is_dropped(driver: window.Window) -> Steps:
    draw = sys.modules["reflection_lines"].overlay.draw
    ob = striped_panel(driver, "First")
    yield from captured(driver)
    assert kept_names() == {"First"}  # and none of the tests before
    with driver.override():
        scenes.panel("Second", cells=CELLS)
    yield from captured(driver)
    assert kept_names() == {"First", "Second"}
    draw.UNSEEN_TIME, patience = 0.2, draw.UNSEEN_TIME
    yield 0.3  # a view is redrawn in less time than that
    picture = yield from captured(driver)
    assert kept_names() == {"Second"}
    assert np.ptp(picture) > 0.5
    with driver.override():
        scenes.activate(ob)
    again = yield from captured(driver)
    draw.UNSEEN_TIME = patience
    assert same_picture(again, picture)  # both panels are alike


def test_few_environment_images_are_kept(driver: window.Window) -> Steps:
    draw, stripes = sys.modules["reflection_lines"].overlay.draw, bpy.context.scene.reflection_lines.stripes
    striped_panel(driver, "Surroundings")
    stripes.mode = 'IMAGE'
    for number in range(draw.KEPT_TEXTURES + 2):
        stripes.image = bpy.data.images.new(f"Surroundings {number}", 8, 4)
        driver.redraw()
        yield 0.2
    assert len(draw._cache.textures) == draw.KEPT_TEXTURES
    stripes.mode, stripes.image = 'REFLECTION', None
