"""Takes the picture of the manual's section on shut lines in a real window: bonnet, wing and door of the car before and
after one press on all three. Run it as

    xvfb-run -s "-screen 0 1280x900x24" blender --factory-startup --enable-event-simulate \
        --window-geometry 0 0 1280 900 -P tests/in_blender.py -- blend_samples/shut_line_picture.py FOLDER

It writes FOLDER/shut_lines.webp, which is kept with the manual.
"""
import bpy

import car_crossings
import car_pictures
import pictures
import window

STRIPES = 60                        # sparse enough to follow each line
LOW, HIGH = (60, 190), (1052, 640)  # corners of what is shown, pixels of the view from below
ZOOM = 60.0                         # of the camera's frame in the view
WIDTH, QUALITY = 900, 40            # of the picture: pixels, per cent


def take(_: window.Window) -> car_pictures.Steps:
    driver = yield from car_pictures.open_car()
    with driver.override():
        bpy.ops.object.mode_set(mode='OBJECT')
        panels = car_crossings.dent_shut_lines()
    car_pictures.show_car(driver)
    bpy.context.scene.reflection_lines.stripes.count = STRIPES
    driver.area().spaces.active.region_3d.view_camera_zoom = ZOOM
    yield from car_pictures.shoot(driver, "before")
    with driver.override():
        bpy.ops.object.mode_set(mode='EDIT')
        bpy.ops.reflines.smooth(border='follow', even_flush=True)
        bpy.ops.object.mode_set(mode='OBJECT')
    for ob in panels:
        print(f"{ob.name}: {ob.reflection_lines.report.headline()}")
    yield from car_pictures.shoot(driver, "after")
    parts = [pictures.pixels(car_pictures.FOLDER / f"{name}.png")[LOW[1]:HIGH[1], LOW[0]:HIGH[0]]
             for name in ("before", "after")]
    car_pictures.join(parts, car_pictures.FOLDER / "shut_lines.webp", WIDTH, QUALITY)


if __name__ == "__main__":
    window.run(take)
