"""In Edit Mode the cage and what is selected are seen over the stripes, on white ones and on black ones."""
from collections.abc import Generator

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Euler

import scenes
import window
from picture import Steps, captured, striped_panel

CELLS = 10
CHOSEN = 33  # the face that is selected
WHITE, BLACK = (1.0, 1.0, 1.0, 1.0), (0.0, 0.0, 0.0, 1.0)
VIEWS = {"steep": ('ORTHO', (1.0, 0.0, 0.5)), "perspective": ('PERSP', (0.9, 0.0, -0.4))}


def coarse_panel(driver: window.Window, light: tuple, view: str) -> bpy.types.Object:
    """A panel in Edit Mode, with one face selected, under stripes that are all of one colour."""
    old = striped_panel(driver, "Old")
    with driver.override():
        bpy.data.objects.remove(old)
        ob = scenes.panel("Coarse", cells=CELLS)
        scenes.edit(ob)
        scenes.select_faces(ob, lambda face: face == -1)
    stripes = bpy.context.scene.reflection_lines.stripes
    stripes.cage_on_top, stripes.color, stripes.gap_color = True, light, light
    region_3d = driver.region_3d()
    region_3d.view_perspective, turned = VIEWS[view]
    region_3d.view_rotation, region_3d.view_distance = Euler(turned).to_quaternion(), 3.5
    region_3d.update()
    return ob


def place(driver: window.Window, point: np.ndarray) -> tuple[int, int]:
    at = location_3d_to_region_2d(driver.region(), driver.region_3d(), point)
    return int(at.x), int(at.y)


def discs(driver: window.Window, picture: np.ndarray, points: np.ndarray, radius: float) -> np.ndarray:
    """The pixels within a radius around each point: #P x #pixels."""
    reach = range(-8, 9)
    around = np.array([(x, y) for x in reach for y in reach if np.hypot(x, y) <= radius])
    return np.array([[picture[y + dy, x + dx] for dx, dy in around]
                     for x, y in (place(driver, point) for point in points)])


def theme() -> bpy.types.ThemeView3D:
    return bpy.context.preferences.themes[0].view_3d


def linear(value: float) -> float:
    """Returns a value of sRGB's encoded range [0.04, 1] in linear light: IEC 61966-2-1."""
    return ((value + 0.055) / 1.055) ** 2.4


def select_mode(driver: window.Window, kind: str) -> None:
    with driver.override():
        bpy.ops.mesh.select_mode(type=kind)


def test_dots_are_whole_on_white_and_on_black(driver: window.Window) -> Steps:
    for view in VIEWS:
        for light, said in ((WHITE, "white"), (BLACK, "black")):
            ob = coarse_panel(driver, light, view)
            select_mode(driver, 'VERT')
            picture = yield from captured(driver)
            V = scenes.world(ob)
            dark = (discs(driver, picture, V, 1.0) < 0.1).all(axis=1)
            rim = discs(driver, picture, V, 4.5).max(axis=1) > 0.3  # of the dots on black stripes
            print(f"{view}, {said}: {dark.mean():.3f} of the dots are dark in the middle, {rim.mean():.3f} are set off")
            assert dark.all() and rim.all()


def test_selected_vertices_edges_and_faces_are_seen(driver: window.Window) -> Steps:
    for light in (WHITE, BLACK):
        ob = coarse_panel(driver, light, "steep")
        select_mode(driver, 'VERT')
        without = yield from captured(driver)
        with driver.override():
            bpy.ops.mesh.select_all(action='SELECT')
        picture = yield from captured(driver)
        V = scenes.world(ob)
        dots = np.median(discs(driver, picture, V, 1.0), axis=1)
        assert np.abs(dots - linear(theme().vertex_select[1])).max() < 0.05
        corners = V[list(ob.data.polygons[CHOSEN].vertices)]
        inside = corners.mean(axis=0)[None]
        tint = discs(driver, picture, inside, 2.0) - discs(driver, without, inside, 2.0)
        assert np.abs(tint).min() > 0.02
        half = discs(driver, picture, 0.5 * (corners[0] + corners[1])[None], 2.0)
        assert np.abs(half - linear(theme().edge_select[1])).min() < 0.03


def test_off_hides_the_cage(driver: window.Window) -> Steps:
    coarse_panel(driver, WHITE, "steep")
    bpy.context.scene.reflection_lines.stripes.cage_on_top = False
    picture = yield from captured(driver)
    height, width = picture.shape
    assert picture[height // 2 - 40:height // 2 + 40, width // 2 - 60:width // 2 + 60].min() > 0.9


def dense_picture(driver: window.Window, cells: int) -> Generator[float, None, np.ndarray]:
    ob = coarse_panel(driver, WHITE, "steep")
    with driver.override():
        scenes.object_mode()
        bpy.data.objects.remove(ob)
        ob = scenes.panel("Dense", cells=cells)
        scenes.edit_inner(ob, cells, margin=cells // 2 - 2)
    return (yield from captured(driver))


def test_a_dense_cage_leaves_the_stripes_to_see(driver: window.Window) -> Steps:
    coarse = yield from dense_picture(driver, CELLS)
    dense = yield from dense_picture(driver, 150)
    height, width = dense.shape
    away = np.s_[height // 2 + 15:height // 2 + 45, width // 2 - 30:width // 2 + 30]
    middle = np.s_[height // 2 - 5:height // 2 + 5, width // 2 - 5:width // 2 + 5]
    print(f"away: {coarse[away].min():.3f} {dense[away].min():.3f}, middle {dense[middle].min():.3f}")
    assert dense[away].min() > 0.9 > coarse[away].min()
    assert dense[middle].min() < 0.5  # what is selected stays
