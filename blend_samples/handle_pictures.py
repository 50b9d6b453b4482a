"""Takes the manual's pictures of lines by hand, on the car's bonnet, and of the live warp, in a real window. Run it as

    xvfb-run -s "-screen 0 1280x900x24" blender --factory-startup --enable-event-simulate \
        --window-geometry 0 0 1280 900 -P tests/in_blender.py -- blend_samples/handle_pictures.py FOLDER

The JPEGs in FOLDER are those of addon/manual/pictures.
"""
import pathlib
import sys
from collections.abc import Generator, Sequence

import bpy
import numpy as np
from bpy_extras import view3d_utils
from mathutils import Euler, Vector

import car_pictures
import dragging
import newcomer
import pictures
import window
from window import Steps

FOLDER = pathlib.Path(sys.argv[1]).resolve()
COUNT, RADIUS = 110, 0.55       # stripes; metres of the pulls
ZOOM, OFFSET = 66.0, (-0.005, -0.055)  # of the camera's frame in the view
WIDTH, QUALITY = 700, 60        # of the pictures: pixels, per cent
HEIGHT = 0.87                   # of the bonnet, metres
PULL = ((0.215, -1.42), (0.285, -1.42))  # x and y on the bonnet, as of the stroke
STROKE = ((0.285, -1.08), (0.275, -1.20), (0.270, -1.32), (0.250, -1.44), (0.210, -1.56), (0.165, -1.66))
BENT = (0.395, 0.42)            # of the picture of the hood: where the line that is made straight passes
SHIFT = 110, 25                 # pixels that the lattice's middle control point is moved
LATTICE = (1.0, 0.55, 0.1)      # colour of its lines, which are black on black stripes else
TURNED, SHOWN = (0.75, 0.0, 0.4), 1.45  # the view of the warped bonnet: angles, and metres
MIDDLE = (0.0, -0.05, 0.0)      # of that bonnet, in its object's space
PANEL = "VIEW3D_PT_reflines_handles"


def open_bonnet() -> Generator[float, None, window.Window]:
    """Opens the car with a bonnet without flaws near by."""
    driver = yield from car_pictures.open_car()
    settings = bpy.context.scene.reflection_lines
    settings.stripes.count, settings.pull.radius = COUNT, RADIUS
    space = driver.area().spaces.active
    space.show_region_header = True
    space.region_3d.view_camera_zoom, space.region_3d.view_camera_offset = ZOOM, OFFSET
    car_pictures.press_smooth(driver)
    yield 0.5
    return driver


def begin(driver: window.Window) -> Steps:
    with driver.override():
        assert bpy.ops.reflines.pull_line('INVOKE_DEFAULT', True) == {'RUNNING_MODAL'}
    yield from dragging.settled(driver)


def move_through(driver: window.Window, places: Sequence[tuple[float, float]], *, pressed: bool = False,
                 steps: int = 6) -> Steps:
    """Moves the mouse through places of the bonnet, with the left button where it is pressed."""
    newcomer.move_over(driver, (*places[0], HEIGHT))
    yield 0.2
    if pressed:
        driver.event('LEFTMOUSE', 'PRESS')
        yield 0.1
    for start, end in zip(places[:-1], places[1:], strict=True):
        for share in np.linspace(0.0, 1.0, steps + 1)[1:]:
            x, y = np.array(start) + share * (np.array(end) - np.array(start))
            newcomer.move_over(driver, (x, y, HEIGHT))
            yield 0.05
    if pressed:
        driver.event('LEFTMOUSE', 'RELEASE')
        yield 0.1
    yield from dragging.settled(driver)


def take_pulled() -> Steps:
    """Takes a line that was pulled aside."""
    driver = yield from open_bonnet()
    yield from begin(driver)
    yield from move_through(driver, PULL, pressed=True)
    yield from save("pull_line")
    driver.key('RET')
    yield from dragging.ended(driver)


def take_keyed() -> Steps:
    """Takes the panel of the handles that were left, with keys, over the lines."""
    driver, ob = window.Window(), bpy.context.view_layer.objects.active
    handles = ob.reflection_lines.handles
    for handle in handles.kept:
        for name in ("place", "radius"):
            handle.keyframe_insert(name, frame=1)
    handles.active = len(handles.kept) - 1
    region = driver.region()
    driver.move(0.80 * region.width, 0.62 * region.height)
    yield 0.2
    with driver.override():
        bpy.ops.wm.call_panel(name=PANEL, keep_open=True)
    yield 0.5
    yield from save("keyed_handles")
    driver.key('ESC')
    yield 0.2


def take_drawn() -> Steps:
    """Takes a line that was laid along a stroke."""
    driver = yield from open_bonnet()
    yield from begin(driver)
    driver.key('D')
    yield from move_through(driver, STROKE, pressed=True, steps=3)
    yield from save("draw_highlight")
    driver.key('ESC')
    yield from dragging.settled(driver)


def take_straightened() -> Steps:
    """Takes a bent line that was made straight."""
    driver = yield from open_hood()
    yield from begin(driver)
    region = driver.region()
    driver.move(BENT[0] * region.width, BENT[1] * region.height)
    yield 0.3
    driver.key('S')
    yield 0.2
    yield from dragging.settled(driver)
    yield from save("straighten")
    driver.key('ESC')
    yield from dragging.settled(driver)


def take_live() -> Steps:
    """Takes a control point of the lattice while it is moved, and the panel that follows."""
    driver = yield from open_hood()
    lattice = bpy.context.scene.reflection_lines.warp.lattice
    with driver.override():
        bpy.ops.reflines.live_warp('EXEC_DEFAULT', True)
        lattice.hide_set(False)
        bpy.context.view_layer.objects.active = lattice
        bpy.ops.object.mode_set(mode='EDIT')
    driver.area().spaces.active.overlay.show_extras = True
    theme = bpy.context.preferences.themes[0].view_3d
    theme.wire = theme.wire_edit = LATTICE
    columns, rows = lattice.data.points_u, lattice.data.points_v
    middle = rows // 2 * columns + columns // 2
    for index, point in enumerate(lattice.data.points):
        point.select = index == middle
    yield 0.5
    grabbed = lattice.matrix_world @ lattice.data.points[middle].co_deform
    x, y = view3d_utils.location_3d_to_region_2d(driver.region(), driver.region_3d(), grabbed)
    driver.move(x, y)
    yield 0.1
    driver.key('G')
    for share in np.linspace(0.1, 1.0, 10):
        driver.move(x + share * SHIFT[0], y + share * SHIFT[1])
        yield 0.2
    yield 2.0
    yield from save("live")
    driver.key('ESC')
    yield 0.5


def open_hood() -> Generator[float, None, window.Window]:
    """Opens the bonnet with a lattice, seen askance, with nothing but that and its stripes in view."""
    bpy.ops.wm.open_mainfile(filepath=str(car_pictures.HERE / "hood_warp.blend"), load_ui=False)
    yield 1.0
    driver, panel = window.Window(), bpy.context.view_layer.objects.active
    with driver.override():
        bpy.ops.reflines.smooth(strength=0.0)  # keeps the faces for Object Mode
    car_pictures.show_car(driver)
    bpy.context.scene.reflection_lines.warp.lattice.hide_set(True)
    space = driver.area().spaces.active
    space.show_region_header = True
    space.region_3d.view_perspective, space.region_3d.view_rotation = 'PERSP', Euler(TURNED).to_quaternion()
    space.region_3d.view_distance, space.region_3d.view_location = SHOWN, panel.matrix_world @ Vector(MIDDLE)
    yield 0.5
    return driver


def save(name: str) -> Steps:
    """Saves the 3D view as a JPEG."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    driver = window.Window()
    driver.redraw()
    yield 0.7
    whole, area = FOLDER / f"{name}.png", driver.area()
    bpy.ops.screen.screenshot(filepath=str(whole))
    yield 0.3
    seen = pictures.pixels(whole)[area.y:area.y + area.height, area.x:area.x + area.width]
    image = bpy.data.images.new(name, seen.shape[1], seen.shape[0])
    image.pixels.foreach_set(np.ascontiguousarray(seen, np.float32).ravel())
    image.filepath_raw, image.file_format = str(whole), 'PNG'
    image.save()
    bpy.data.images.remove(image)
    pictures.shrink(whole, FOLDER / f"{name}.jpg", WIDTH, QUALITY)


def take_all(_: window.Window) -> Steps:
    bpy.context.preferences.view.show_tooltips = False
    yield from take_pulled()
    yield from take_keyed()
    yield from take_drawn()
    yield from take_straightened()
    yield from take_live()


window.run(take_all)
