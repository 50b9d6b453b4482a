"""The MatCap shows the solver's theta."""
import sys

import bpy
import numpy as np

import scenes


def test_a_matcap_of_the_solvers_theta_is_installed() -> None:
    scenes.panel()
    scenes.look_from_above(light_degrees=50.0)
    settings = bpy.context.scene.reflection_lines
    settings.stripes.count, settings.stripes.width = 12, 0.4
    settings.stripes.color, settings.stripes.gap_color = (1.0, 1.0, 1.0, 1.0), (0.0, 0.0, 0.0, 1.0)
    for _ in range(2):  # the second replaces the first
        assert bpy.ops.reflines.install_matcap() == {'FINISHED'}
    installed = [light for light in bpy.context.preferences.studio_lights if light.name == "reflection_lines.png"]
    assert len(installed) == 1
    image = bpy.data.images.load(installed[0].path)
    pixels = scenes.pixels(image)[:, :, 0]
    light, sure = expected(image.size[0])
    assert sure.sum() > 50000
    assert np.abs(pixels[sure] - light[sure]).max() < 0.01


def expected(size: int) -> tuple[np.ndarray, np.ndarray]:
    """Light in the middle of every pixel, and where no edge of a stripe is near."""
    reflines = sys.modules["reflection_lines"].native.reflines
    settings = bpy.context.scene.reflection_lines
    place = (np.arange(size) + 0.5) * 2.0 / size - 1.0
    x, y = np.meshgrid(place, place)
    inside = np.hypot(x, y) < 0.95
    local = np.stack([x, y, np.sqrt(np.maximum(0.0, 1.0 - x * x - y * y))], axis=2)[inside]
    axes = np.array(settings.camera.matrix_world.to_3x3())
    v, a, normals = axes[:, 2], np.array(settings.light.matrix_world)[:3, 2], local @ axes.T
    theta = reflines.theta(normals, v, a)
    mirrored = 2.0 * (normals @ v)[:, None] * normals - v
    clear = np.linalg.norm(np.cross(mirrored, a), axis=1) > 0.3  # all stripes meet where a is mirrored
    period = theta * 12 / (2.0 * np.pi)
    from_edge = np.abs(np.abs(period - np.round(period)) - 0.2)
    light, sure = np.zeros((size, size)), np.zeros((size, size), dtype=bool)
    light[inside], sure[inside] = np.abs(period - np.round(period)) < 0.2, clear & (from_edge > 0.08)
    return light, sure


def test_a_light_along_the_view_is_refused() -> None:
    scenes.panel()
    scenes.look_from_above(light_degrees=0.0)
    try:
        bpy.ops.reflines.install_matcap()
    except RuntimeError as error:
        assert "parallel to the view" in str(error)
    else:
        raise AssertionError("no error")


def test_the_picture_is_smooth_and_the_shading_stays() -> None:
    scenes.panel()
    scenes.look_from_above(light_degrees=50.0)
    bpy.context.scene.reflection_lines.stripes.softness = 0.0
    views = [area.spaces.active.shading for screen in bpy.data.screens for area in screen.areas
             if area.type == 'VIEW_3D']
    before = [(shading.type, shading.light, shading.studio_light) for shading in views]
    assert bpy.ops.reflines.install_matcap() == {'FINISHED'}
    assert [(shading.type, shading.light, shading.studio_light) for shading in views] == before
    installed = next(light for light in bpy.context.preferences.studio_lights if light.name == "reflection_lines.png")
    image = bpy.data.images.load(installed.path)
    row = scenes.pixels(image)[:, image.size[0] // 2, 0]
    edges = np.flatnonzero(np.diff((row > 0.5).astype(int)))
    between = ((row > 0.15) & (row < 0.85)).sum()
    print(f"{between} pixels between light and dark at {len(edges)} edges")
    assert len(edges) > 10 and between >= len(edges)
