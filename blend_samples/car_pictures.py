"""Takes README's first picture in a real window: the car before and after one press on its bonnet. Run it as

    xvfb-run -s "-screen 0 1280x900x24" blender --factory-startup --enable-event-simulate \
        --window-geometry 0 0 1280 900 -P tests/in_blender.py -- blend_samples/car_pictures.py FOLDER
"""
import pathlib
import sys
from collections.abc import Generator

import bpy

import window

HERE = pathlib.Path(__file__).resolve().parent
FOLDER = pathlib.Path(sys.argv[1]).resolve()
ZOOM = 26.0   # of the camera's frame in the view
OVERLAYS = ("show_floor", "show_axis_x", "show_axis_y", "show_cursor", "show_edges", "show_faces", "show_extras",
            "show_text", "show_outline_selected", "show_object_origins", "show_relationship_lines")

Steps = Generator[float, None, None]


def take(_: window.Window) -> Steps:
    bpy.ops.wm.open_mainfile(filepath=str(HERE / "car.blend"), load_ui=False)
    yield 1.0
    driver = window.Window()   # that of the file
    show_car(driver)
    yield from shoot(driver, "before")
    with driver.override():
        bpy.ops.object.mode_set(mode='EDIT')
        bpy.ops.reflines.smooth()
        bpy.ops.object.mode_set(mode='OBJECT')
    print(f"car: {bpy.context.view_layer.objects.active.reflection_lines.report.headline()}")
    yield from shoot(driver, "after")


def show_car(driver: window.Window) -> None:
    """Leaves nothing but the car and its stripes in view."""
    with driver.override():
        bpy.ops.object.mode_set(mode='OBJECT')  # where no selection tints the stripes
    for ob in bpy.data.objects:
        ob.hide_set(ob.type == 'EMPTY')
    space = driver.area().spaces.active
    space.show_region_ui = space.show_region_toolbar = space.show_region_header = space.show_gizmo = False
    space.show_region_tool_header = False
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


window.run(take)
