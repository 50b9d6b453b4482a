"""Takes the manual's pictures of Blender's window: the six of the first use, the drag, the toolbar's tool, the
sidebar, and the brush.

Run by `./run gallery` in a real window with simulated events, which takes Blender 3.4: later ones save black pictures
under Xvfb. What is pressed is what the test of the first use presses, tests/ui/newcomer.py.
"""
import pathlib
import sys

import bpy
import numpy as np

import dragging
import newcomer
import pictures
import window
from window import Steps

FOLDER = pathlib.Path(sys.argv[1]).resolve()
STRIP = ("sample", "smoothed", "camera", "stripes", "swept", "own_smoothed")  # row by row, two in each
COLUMNS, STRIP_WIDTH, WIDTH = 2, 960, 760  # of pictures in a row; pixels of the strip, and of a single picture
QUALITY = 54  # per cent: with it the pictures of the manual stay below what a test allows


def view_picture(name: str) -> Steps:
    """Saves the 3D view with its sidebar, cut out of the window, as a PNG."""
    driver = window.Window()
    driver.redraw()
    yield 0.5
    whole = FOLDER / "window.png"
    bpy.ops.screen.screenshot(filepath=str(whole))
    yield 0.3
    area = driver.area()
    seen = pictures.pixels(whole)[area.y:area.y + area.height, area.x:area.x + area.width]
    whole.unlink()
    save(seen, FOLDER / f"{name}.png")


def save(values: np.ndarray, path: pathlib.Path) -> None:
    """Saves height x width x 4 floats, from the bottom up, as a PNG."""
    image = bpy.data.images.new(path.stem, values.shape[1], values.shape[0])
    image.pixels.foreach_set(np.ascontiguousarray(values, np.float32).ravel())
    image.filepath_raw, image.file_format = str(path), 'PNG'
    image.save()
    bpy.data.images.remove(image)


def join(names: tuple[str, ...]) -> np.ndarray:
    """Joins pictures of one size in rows of COLUMNS, with white between them."""
    parts = [pictures.pixels(FOLDER / f"{name}.png") for name in names]
    height, width = parts[0].shape[:2]
    rows, gutter = -(-len(parts) // COLUMNS), pictures.GUTTER
    joined = np.ones((rows * (height + gutter) - gutter, COLUMNS * (width + gutter) - gutter, 4), np.float32)
    for number, part in enumerate(parts):
        row, column = divmod(number, COLUMNS)
        low, left = (rows - 1 - row) * (height + gutter), column * (width + gutter)
        joined[low:low + height, left:left + width] = part
    return joined


def open_sample(name: str) -> Steps:
    bpy.ops.wm.open_mainfile(filepath=str(newcomer.SAMPLE.with_name(name)), load_ui=True)
    yield 1.5


def drag_by_the_arrow() -> Steps:
    """Takes the toolbar's tool with its gizmos, and a drag of the strength, on the car."""
    yield from open_sample("car.blend")
    driver = window.Window()
    with driver.override():
        bpy.ops.wm.tool_set_by_id(name="reflection_lines.tool")
    yield from view_picture("toolbar")
    driver.move(500, 400)
    with driver.override():
        bpy.ops.reflines.smooth('INVOKE_DEFAULT', True, follow_mouse=True)
    yield 0.3
    driver.move(395, 400)
    yield from dragging.settled(driver)
    yield from view_picture("drag")
    driver.key('ESC')
    yield 0.3


def paint_a_stroke() -> Steps:
    """Takes strokes of the brush over half of the car's bonnet, each twice."""
    yield from open_sample("car.blend")
    driver = window.Window()
    with driver.override():
        bpy.ops.wm.tool_set_by_id(name="reflection_lines.fair_brush")
    bpy.context.scene.reflection_lines.brush.strength = 1.0
    for y in (-1.75, -1.6, -1.45, -1.3, -1.15) * 2:
        newcomer.move_over(driver, (-0.5, y, newcomer.ON_BONNET[2]))
        driver.event('LEFTMOUSE', 'PRESS')
        for x in np.linspace(-0.5, 0.1, 13):
            newcomer.move_over(driver, (x, y, newcomer.ON_BONNET[2]))
            yield 0.2
        driver.event('LEFTMOUSE', 'RELEASE')
        yield 1.0
    yield from view_picture("fair_brush")


def take_all(_: window.Window) -> Steps:
    yield from paint_a_stroke()
    yield from newcomer.use_sample(view_picture)
    yield from newcomer.use_own_model(view_picture)
    yield from drag_by_the_arrow()
    save(join(STRIP), FOLDER / "first_use.png")
    for name, source, width in (("first_use", "first_use", STRIP_WIDTH), ("toolbar", "toolbar", WIDTH),
                                ("drag", "drag", WIDTH), ("sidebar", "smoothed", WIDTH),
                                ("fair_brush", "fair_brush", WIDTH)):
        pictures.shrink(FOLDER / f"{source}.png", FOLDER / f"{name}.jpg", width, QUALITY)


FOLDER.mkdir(parents=True, exist_ok=True)
window.start(window.all_steps((take_all,)))
