"""Takes README's first picture in a real window: the car before and after one press on its bonnet. Run it as

    xvfb-run -s "-screen 0 1280x900x24" blender --factory-startup --enable-event-simulate \
        --window-geometry 0 0 1280 900 -P tests/in_blender.py -- blend_samples/car_pictures.py FOLDER

It writes FOLDER/car.jpg, which is kept beside this script.
"""
import pathlib
import sys
from collections.abc import Generator

import bpy
import numpy as np

import pictures
import window
from window import Steps

HERE = pathlib.Path(__file__).resolve().parent
FOLDER = pathlib.Path(sys.argv[1]).resolve()
ZOOM = 26.0                          # of the camera's frame in the view
LOW, HIGH = (215, 120), (847, 668)   # corners of what is shown, pixels of the view from below
WIDTH, QUALITY = 1280, 70            # of the picture: pixels, per cent
OVERLAYS = ("show_floor", "show_axis_x", "show_axis_y", "show_cursor", "show_edges", "show_faces", "show_extras",
            "show_text", "show_outline_selected", "show_object_origins", "show_relationship_lines")


def take(_: window.Window) -> Steps:
    driver = yield from open_car()
    yield from shoot(driver, "before")
    press_smooth(driver)
    print(f"car: {bpy.context.view_layer.objects.active.reflection_lines.report.headline()}")
    yield from shoot(driver, "after")
    shots = [pictures.pixels(FOLDER / f"{name}.png") for name in ("before", "after")]
    join([shot[LOW[1]:HIGH[1], LOW[0]:HIGH[0]] for shot in shots], FOLDER / "car.jpg", WIDTH, QUALITY)


def open_car() -> Generator[float, None, window.Window]:
    """Opens the car, with nothing but that and its stripes in view; returns the window of the file."""
    bpy.ops.wm.open_mainfile(filepath=str(HERE / "car.blend"), load_ui=False)
    yield 1.0
    driver = window.Window()
    show_car(driver)
    return driver


def press_smooth(driver: window.Window) -> None:
    with driver.override():
        bpy.ops.object.mode_set(mode='EDIT')
        bpy.ops.reflines.smooth()
        bpy.ops.object.mode_set(mode='OBJECT')


def show_car(driver: window.Window) -> None:
    """Leaves nothing but the car and its stripes in view."""
    with driver.override():
        bpy.ops.object.mode_set(mode='OBJECT')  # where no selection tints the stripes
    for ob in bpy.data.objects:
        ob.hide_set(ob.type == 'EMPTY')
    space = driver.area().spaces.active
    space.show_region_ui = space.show_region_toolbar = space.show_region_header = space.show_gizmo = False
    space.show_region_tool_header = space.show_region_hud = False
    bpy.context.scene.reflection_lines.camera.data.show_passepartout = False
    for name in OVERLAYS:
        setattr(space.overlay, name, False)
    space.shading.type, space.shading.light, space.shading.color_type = 'SOLID', 'STUDIO', 'MATERIAL'
    space.shading.background_type, space.shading.background_color = 'VIEWPORT', (0.055, 0.06, 0.07)
    space.region_3d.view_perspective = 'CAMERA'
    space.region_3d.view_camera_zoom = ZOOM


def shoot(driver: window.Window, name: str) -> Steps:
    FOLDER.mkdir(parents=True, exist_ok=True)
    driver.redraw()
    yield 1.0
    with driver.override():
        bpy.ops.screen.screenshot_area(filepath=str(FOLDER / f"{name}.png"))
    yield 0.2


def join(parts: list[np.ndarray], path: pathlib.Path, width: int, quality: int) -> None:
    """Puts two pictures side by side."""
    gutter = np.ones((len(parts[0]), pictures.GUTTER, 4), np.float32)
    joined = np.concatenate([parts[0], gutter, parts[1]], axis=1)
    image = bpy.data.images.new(path.stem, joined.shape[1], joined.shape[0])
    image.pixels.foreach_set(np.ascontiguousarray(joined, np.float32).ravel())
    image.filepath_raw, image.file_format = str(path.with_suffix(".png")), 'PNG'
    image.save()
    pictures.shrink(path.with_suffix(".png"), path, width, quality)


if __name__ == "__main__":
    window.run(take)
