"""Films Pull Line in a real window of Blender: two crooked lines of the bonnet are pulled straight. Run it as

    xvfb-run -s "-screen 0 960x720x24" blender --factory-startup --enable-event-simulate --window-geometry 0 0 960 720 \
        -P tests/in_blender.py -- blend_samples/film_pull_line.py FOLDER
    python3 blend_samples/join_film.py FOLDER blend_samples/pull_line.webp
"""
import pathlib
import sys
from collections.abc import Generator

import bpy

import dragging
import window

HERE = pathlib.Path(__file__).resolve().parent
FOLDER = pathlib.Path(sys.argv[1])
OVERLAYS = ("show_floor", "show_axis_x", "show_axis_y", "show_cursor", "show_edges", "show_faces", "show_extras",
            "show_text", "show_outline_selected", "show_object_origins", "show_relationship_lines")
# Ways of the mouse in shares of the view's region, with the button that is pressed at its first place; steps.
CROOKED = (((0.36, 0.50), (0.445, 0.54), False, 5), ((0.445, 0.54), (0.418, 0.545), True, 10))
WAYS = (((0.34, 0.42), (0.418, 0.545), False, 12), ((0.418, 0.545), (0.445, 0.54), True, 24),
        ((0.445, 0.54), (0.52, 0.68), False, 10))
LAST = 8  # pictures of the end

Steps = Generator[float, None, None]


def film(_: window.Window) -> Steps:
    bpy.ops.wm.open_mainfile(filepath=str(HERE / "hood_warp.blend"), load_ui=False)
    yield 1.0
    driver = window.Window()  # that of the file
    show_bonnet(driver)
    yield 1.0
    yield from pull(driver, CROOKED, filmed=False)
    driver.key('RET')
    yield 0.5
    yield from pull(driver, WAYS, filmed=True)
    for _ in range(LAST):
        yield from shoot(driver)


def pull(driver: window.Window, ways: tuple, *, filmed: bool) -> Steps:
    """Starts Pull Line and moves the mouse along the ways."""
    with driver.override():
        bpy.ops.reflines.pull_line('INVOKE_DEFAULT', True)
    yield from dragging.settled(driver)
    for start, end, pressed, steps in ways:
        yield from follow(driver, start, end, pressed=pressed, steps=steps, filmed=filmed)


def show_bonnet(driver: window.Window) -> None:
    """Leaves nothing but the bonnet and its stripes in view."""
    panel = bpy.context.view_layer.objects.active
    region = sys.modules["reflection_lines.bridge.region_faces"]
    panel.update_from_editmode()
    region.store_region(panel.data, region.read_selected_faces(panel.data))
    with driver.override():
        bpy.ops.object.mode_set(mode='OBJECT')  # where no selection tints the stripes
    for ob in bpy.data.objects:
        ob.hide_set(ob.type in {'LATTICE', 'EMPTY'})
    space = driver.area().spaces.active
    space.show_region_ui = space.show_region_toolbar = space.show_gizmo = False
    for name in OVERLAYS:
        setattr(space.overlay, name, False)
    space.region_3d.view_perspective = 'CAMERA'
    space.region_3d.view_camera_zoom = 26.0


def follow(driver: window.Window, start: tuple[float, float], end: tuple[float, float], *, pressed: bool,
           steps: int, filmed: bool) -> Steps:
    """Moves the mouse with soft ends, and where that is filmed takes a picture after each step."""
    if pressed:
        driver.event('LEFTMOUSE', 'PRESS')
        yield 0.1
    size = driver.region().width, driver.region().height
    for step in range(1, steps + 1):
        t = step / steps
        share = t * t * (3.0 - 2.0 * t)
        driver.move(*(length * (a + share * (b - a)) for length, a, b in zip(size, start, end, strict=True)))
        yield 0.05
        yield from dragging.settled(driver)
        if filmed:
            yield from shoot(driver)
    if pressed:
        driver.event('LEFTMOUSE', 'RELEASE')
        yield 0.1


def shoot(driver: window.Window) -> Steps:
    FOLDER.mkdir(parents=True, exist_ok=True)
    driver.redraw()
    yield 0.15
    with driver.override():
        bpy.ops.screen.screenshot_area(filepath=str(FOLDER / f"{len(list(FOLDER.iterdir())):03}.png"))
    yield 0.05


window.run(film)
