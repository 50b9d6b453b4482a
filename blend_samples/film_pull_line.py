"""Films Pull Line in a real window of Blender: a crooked highlight of the car's bonnet is pulled straight. Run it as

    xvfb-run -s "-screen 0 960x720x24" blender --factory-startup --enable-event-simulate --window-geometry 0 0 960 720 \
        -P tests/in_blender.py -- blend_samples/film_pull_line.py FOLDER
    python3 blend_samples/join_film.py FOLDER blend_samples/pull_line.webp
"""
import pathlib
import sys

import bpy
import numpy as np

import car_pictures
import dragging
import newcomer
import window
from window import Steps

FOLDER = pathlib.Path(sys.argv[1])
# Places on the bonnet, metres: of the highlight where it is straight, where it is crooked, and where the mouse rests.
STRAIGHT, CROOKED, REST = (0.215, -1.42, 0.87), (0.290, -1.42, 0.87), (0.05, -1.80, 0.85)
RADIUS = 0.55   # of the pulls, metres
COUNT = 110     # stripes
ZOOM, OFFSET = 66.0, (-0.005, -0.055)  # of the camera's frame in the view
LAST = 10       # pictures of the end


def film(_: window.Window) -> Steps:
    driver = yield from car_pictures.open_car()
    show_bonnet(driver)
    car_pictures.press_smooth(driver)
    yield from pull(driver, STRAIGHT, CROOKED, steps=8, filmed=False)
    driver.key('RET')
    yield from dragging.ended(driver)
    with driver.override():
        bpy.ops.reflines.delete_handles()
    yield from pull(driver, CROOKED, STRAIGHT, steps=24, filmed=True)
    driver.key('RET')
    yield from dragging.ended(driver)
    for _ in range(LAST):
        yield from shoot(driver)


def show_bonnet(driver: window.Window) -> None:
    """Brings the bonnet near, with lines that are close enough to show a bend."""
    settings = bpy.context.scene.reflection_lines
    settings.stripes.count, settings.pull.radius = COUNT, RADIUS
    region_3d = driver.area().spaces.active.region_3d
    region_3d.view_camera_zoom, region_3d.view_camera_offset = ZOOM, OFFSET


def pull(driver: window.Window, start: tuple[float, ...], end: tuple[float, ...], *, steps: int, filmed: bool) -> Steps:
    """Starts Pull Line and pulls the line from one place of the bonnet to another."""
    with driver.override():
        bpy.ops.reflines.pull_line('INVOKE_DEFAULT', True)
    yield from dragging.settled(driver)
    yield from follow(driver, REST, start, steps=steps // 2, filmed=filmed)
    driver.event('LEFTMOUSE', 'PRESS')
    yield 0.1
    yield from follow(driver, start, end, steps=steps, filmed=filmed)
    driver.event('LEFTMOUSE', 'RELEASE')
    yield 0.1
    yield from follow(driver, end, REST, steps=steps // 3, filmed=filmed)


def follow(driver: window.Window, start: tuple[float, ...], end: tuple[float, ...], *, steps: int,
           filmed: bool) -> Steps:
    """Moves the mouse with soft ends, and where that is filmed takes a picture after each step."""
    for step in range(1, steps + 1):
        t = step / steps
        share = t * t * (3.0 - 2.0 * t)
        newcomer.move_over(driver, tuple(np.array(start) + share * (np.array(end) - np.array(start))))
        yield 0.05
        yield from dragging.settled(driver)
        if filmed:
            yield from shoot(driver)


def shoot(driver: window.Window) -> Steps:
    FOLDER.mkdir(parents=True, exist_ok=True)
    driver.redraw()
    yield 0.15
    with driver.override():
        bpy.ops.screen.screenshot_area(filepath=str(FOLDER / f"{len(list(FOLDER.iterdir())):03}.png"))
    yield 0.05


window.run(film)
