"""Stripes of a cage below a Subdivision Surface: its limit surface with the limit's own normals, in every pixel."""
import os
import sys

import bmesh
import bpy
import numpy as np

import scenes
import window
from picture import CELLS, Steps, captured, expected_light, fresh_panel, prepare, samples, striped_panel


def limit_of(ob: bpy.types.Object) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Positions in world space, triangles and normals, from the cage's arrays alone."""
    reflines = sys.modules["reflection_lines"].native.reflines
    corner = (np.arange(CELLS)[:, None] * (CELLS + 1) + np.arange(CELLS)).ravel()
    quads = np.stack([corner, corner + 1, corner + CELLS + 2, corner + CELLS + 1], axis=1)
    V = scenes.world(ob)
    surface = reflines.Subdivision(np.arange(0, quads.size + 1, 4), quads.ravel(), vertices=len(V), level=2, limit=True)
    F = surface.faces[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    return surface.positions(V), F, surface.normals(V)


def cage(driver: window.Window, name: str) -> bpy.types.Object:
    ob = fresh_panel(driver, name)
    modifier = ob.modifiers.new("Subdivision", 'SUBSURF')
    modifier.levels, modifier.use_limit_surface, modifier.boundary_smooth = 2, True, 'ALL'
    prepare(driver, ob)
    return ob


def share_as_theta_says(driver: window.Window, ob: bpy.types.Object, picture_name: str) -> Steps:
    """Share of thousands of pixels whose brightness is that of theta of the limit normals, within 3/255."""
    reflines = sys.modules["reflection_lines"].native.reflines
    picture = yield from captured(driver)
    yield from window.take_picture(driver, picture_name)
    V, F, limit = limit_of(ob)
    pixel, triangle, barycentric = samples(driver, V, F)
    normals = (limit[F[triangle]] * barycentric[:, :, None]).sum(axis=1)
    settings = bpy.context.scene.reflection_lines
    v, a = (np.array(axis.matrix_world)[:3, 2] for axis in (settings.camera, settings.light))
    light = expected_light(reflines.theta(normals, v, a))
    good = np.abs(picture[pixel[:, 1], pixel[:, 0]] - light) < 3.0 / 255.0
    print(f"{len(good)} pixels, {good.mean():.4%} as theta of the limit says")
    assert len(good) > 2000
    assert np.ptp(light) > 0.99
    return good.mean()


def test_every_pixel_shows_the_limit(driver: window.Window) -> Steps:
    assert (yield from share_as_theta_says(driver, cage(driver, "Limit"), "limit")) > 0.999


def test_it_follows_the_cage_in_edit_mode(driver: window.Window) -> Steps:
    ob = cage(driver, "Edited")
    with driver.override():
        scenes.edit(ob)
        mesh = bmesh.from_edit_mesh(ob.data)
        for vertex in mesh.verts:
            vertex.co.z = scenes.crown(vertex.co.x, 2.0 * vertex.co.y) + 0.004 * np.sin(7.0 * vertex.co.x)
        bmesh.update_edit_mesh(ob.data)
    yield 0.5
    share = yield from share_as_theta_says(driver, ob, "limit_edit")
    with driver.override():  # other faces than those stored: nothing fails, the modifier's mesh is shown
        bpy.ops.mesh.select_all(action='SELECT')
        bpy.ops.mesh.delete(type='FACE')
    driver.redraw()
    yield 0.3
    with driver.override():
        scenes.object_mode()
    assert share > 0.97  # the rest lies under the cage's edges and vertices


def test_before_the_last_solve_is_what_was_seen_before_it(driver: window.Window) -> Steps:
    """The old limit surface; the coarse cage's own normals, which were drawn once, show no flaw of the surface. Of a
    result in a shape key, too, at any strength, and where the mesh was solved while its modifier was hidden.
    """
    for shown, result, strength in ((True, 'MESH', 1.0), (True, 'SHAPE_KEY', 1.0), (True, 'SHAPE_KEY', 0.6),
                                    (False, 'MESH', 1.0)):
        ob = cage(driver, "Healed")
        random = np.random.default_rng(1)
        for vertex in ob.data.vertices:
            vertex.co.z += 1e-3 * random.standard_normal()
        ob.data.update()
        seen = yield from captured(driver)
        with driver.override():
            scenes.edit_inner(ob, CELLS)
            ob.modifiers[0].show_viewport = shown
            scenes.smooth(length=0.6, result=result)
            ob.modifiers[0].show_viewport = True
            scenes.object_mode()
        if result == 'SHAPE_KEY':
            ob.data.shape_keys.key_blocks["Reflection Lines"].value = strength
        after = yield from captured(driver)
        stripes = bpy.context.scene.reflection_lines.stripes
        stripes.before, stripes.side_by_side = True, False
        told = yield from captured(driver)
        yield from window.take_picture(driver, f"{shown}_before_{result}_{strength}")
        stripes.before = False
        healed, other = ((np.abs(picture - seen) > 3.0 / 255.0).mean() for picture in (after, told))
        print(f"{shown} {result} {strength}: {healed:.3%} of the pixels were changed, {other:.3%} are not as they were")
        assert healed > 0.05 and other < 0.1 * healed, (shown, result)


def test_what_another_modifier_made_of_the_mesh_before_is_not_shown_as_a_coarse_one(driver: window.Window) -> Steps:
    ob = striped_panel(driver, "Split")
    ob.modifiers.new("Triangulate", 'TRIANGULATE')
    ob.modifiers.new("Simple", 'SUBSURF').subdivision_type = 'SIMPLE'
    with driver.override():
        scenes.edit_inner(ob, CELLS)
        ob.modifiers[-1].show_viewport = False
        scenes.smooth(length=0.6)
        ob.modifiers[-1].show_viewport = True
        scenes.object_mode()
    after = yield from captured(driver)
    stripes = bpy.context.scene.reflection_lines.stripes
    stripes.before, stripes.side_by_side = True, False
    told = yield from captured(driver)
    stripes.before = False
    yield from window.take_picture(driver, "split_told")
    print(f"{(np.abs(told - after) > 3.0 / 255.0).mean():.3%} of the pixels differ")
    assert (np.abs(told - after) > 3.0 / 255.0).mean() < 1e-3


def test_a_file_with_an_edge_of_too_many_faces_shows_the_modifiers_surface(driver: window.Window) -> Steps:
    """OpenSubdiv's limit would overrun its buffers on opening the file."""
    fresh_panel(driver, "Beside")
    with driver.override():
        pages = [(0, 1, 2 + page) for page in range(20)]
        rim = [(np.cos(0.3 * page), np.sin(0.3 * page), 0.5) for page in range(20)]
        ob = scenes.linked("Book", [(0.0, 0.0, 0.0), (0.0, 0.0, 1.0), *rim], pages)
        ob.modifiers.new("Subdivision", 'SUBSURF').levels = 2
        prepare(driver, ob)
        path = os.path.join(bpy.app.tempdir, "book.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
    driver = window.Window()
    draw = sys.modules["reflection_lines.overlay.draw"]
    for _ in range(5):
        driver.redraw()
        yield 0.2
    assert bpy.context.scene.reflection_lines.stripes.show
    shown = draw._cache.shown["Book"]
    mesh = bpy.data.objects["Book"].evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    assert shown.surface.batch is not None
    assert {len(mesh.vertices)} <= {int(shown.topology.corners.max()) + 1}
    with driver.override():
        scenes.edit(bpy.data.objects["Book"])
        bpy.ops.mesh.select_all(action='SELECT')
        before = scenes.fingerprint(bpy.data.objects["Book"])
        scenes.smooth()  # of two objects in Edit Mode the other is solved, and this one left
        assert scenes.fingerprint(bpy.data.objects["Book"]) == before
        scenes.object_mode()
