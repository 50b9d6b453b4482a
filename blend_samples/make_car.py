"""Makes car.blend beside this script: ./run samples"""
import pathlib
from dataclasses import replace

import bmesh
import bpy
import numpy as np
from mathutils import Matrix, Vector

import car_details
import car_mesh
import car_shape as car
import car_sheets
import car_trim
import checkout
import studio
from car_mesh import Mesh

HERE = pathlib.Path(__file__).resolve().parent

VIEW = (2.7, -4.9, 4.7), (0.0, -0.44, 0.50)        # the camera's place, and where it looks
DOOR_VIEW = (5.6, -2.6, 1.9), (0.3, -0.1, 0.62)
LENS = 46.0        # mm
ZOOM = 18.0        # of the camera's frame in the view
BACKGROUND = (0.055, 0.06, 0.07)
SEAM_STEP = 0.03   # metres
LINE_DIRECTION = (0.0, 1.0, 0.10)
STRIPES = studio.Stripes(count=60)
PAINT = (0.36, 0.44, 0.54)
COLOURS = {"Paint": PAINT, "Glass": (0.012, 0.014, 0.018), "Black": (0.012, 0.012, 0.013), "Lamp": (0.03, 0.035, 0.04),
           "Red": (0.25, 0.01, 0.01), "Rubber": (0.012, 0.012, 0.012), "Metal": (0.35, 0.36, 0.38)}


def material(name: str) -> bpy.types.Material:
    found = bpy.data.materials.get(name)
    if found is not None:
        return found
    if name == "Paint":
        return studio.car_paint(name, COLOURS[name])
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    made.diffuse_color = (*COLOURS[name], 1.0)
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*COLOURS[name], 1.0)
    shader.inputs["Roughness"].default_value = 0.7 if name in ("Rubber", "Black") else 0.1
    shader.inputs["Metallic"].default_value = 1.0 if name == "Metal" else 0.0
    made.roughness, made.metallic = (0.8, 0.0) if name in ("Rubber", "Black") else (0.2, 0.3)
    return made


def add(name: str, parts: list[tuple[np.ndarray, np.ndarray, str]], *, levels: int = 0,
        mirrored: bool = True) -> bpy.types.Object:
    """One object of parts (V, quads, material), mirrored at the middle of the car."""
    V, quads = car_trim.join([(V, quads) for V, quads, _ in parts])
    ob = studio.add_panel(name, V, quads)
    names = list(dict.fromkeys(part[2] for part in parts))
    for one in names:
        ob.data.materials.append(material(one))
    ob.data.polygons.foreach_set("material_index", np.repeat([names.index(part[2]) for part in parts],
                                                             [len(part[1]) for part in parts]))
    if mirrored:
        mirror = ob.modifiers.new("Mirror", 'MIRROR')
        mirror.use_clip, mirror.merge_threshold = True, 1e-5
    if levels:
        smooth = ob.modifiers.new("Subdivision", 'SUBSURF')
        smooth.levels = smooth.render_levels = levels
        smooth.boundary_smooth = 'PRESERVE_CORNERS'
    return ob


def crease_corners(body: bpy.types.Object, cages: list[Mesh]) -> None:
    """Creases the vertices that are corners of panels amid one of their sides."""
    starts = np.cumsum([0] + [len(cage.V) for cage in cages])
    mesh = bmesh.new()
    mesh.from_mesh(body.data)
    mesh.verts.ensure_lookup_table()
    layer = mesh.verts.layers.crease.verify()
    for cage, start in zip(cages, starts[:-1], strict=True):
        if cage.corner >= 0:
            mesh.verts[start + cage.corner][layer] = 1.0
    mesh.to_mesh(body.data)
    mesh.free()


def part(mesh: Mesh) -> tuple[np.ndarray, np.ndarray, str]:
    return mesh.V, mesh.quads, mesh.material


def add_panels() -> bpy.types.Object:
    """The painted panels: bonnet and doors dense, all others as the cages of one body. The bonnet is returned."""
    cages = [car_mesh.cage_of(sheet) for sheet in car_sheets.cage_sheets()]
    body = add("Body", [part(cage) for cage in cages], levels=2)
    crease_corners(body, cages)
    bonnet, doors = (add(name, [part(car_mesh.dense_of(sheet))])
                     for name, sheet in zip(("Bonnet", "Doors"), car_sheets.dense_sheets(), strict=True))
    paint = bpy.data.collections.new("Paint")
    bpy.context.scene.collection.children.link(paint)
    for ob in (bonnet, doors, body):
        paint.objects.link(ob)
        bpy.context.scene.collection.objects.unlink(ob)
    return bonnet


def add_trim() -> None:
    """Windows, lamps, seams and wheels."""
    add("Details", [part(car_mesh.cage_of(sheet)) for sheet in car_details.details()], levels=1)
    add("Windows", [part(car_mesh.cage_of(car_details.windows()))], levels=2)
    sheets = car_sheets.dense_sheets() + car_sheets.cage_sheets()
    add("Seams", [(*car_trim.seam(replace(sheet, size=SEAM_STEP)), "Black") for sheet in sheets if any(sheet.gaps)])
    add("Wheels", [(*car_trim.placed(made, (x, axle, z)), name) for axle in (car.FRONT_AXLE, car.REAR_AXLE)
                   for made, name, x, z in car_trim.wheel()])


def add_camera(name: str, eye: tuple[float, float, float], aim: tuple[float, float, float]) -> bpy.types.Object:
    view = studio.add_view_camera((0.0, 0.0, 1.0), (0.0, 0.0, 0.0), 1.0)
    view.name, view.data.type, view.data.lens, view.data.clip_end = name, 'PERSP', LENS, 50.0
    turn = (Vector(aim) - Vector(eye)).to_track_quat('-Z', 'Y').to_matrix().to_4x4()
    view.matrix_world = Matrix.Translation(Vector(eye)) @ turn
    return view


def shade_by_material() -> None:
    """Every 3D viewport of the saved file shows the materials' colours before a plain background, and nothing else."""
    for screen in bpy.data.screens:
        for area in screen.areas:
            if area.type == 'VIEW_3D':
                shading = area.spaces.active.shading
                shading.type, shading.light, shading.color_type = 'SOLID', 'STUDIO', 'MATERIAL'
                shading.background_type, shading.background_color = 'VIEWPORT', BACKGROUND
                area.spaces.active.region_3d.view_camera_zoom = ZOOM
                overlay = area.spaces.active.overlay
                overlay.show_floor = overlay.show_axis_x = overlay.show_axis_y = overlay.show_cursor = False


def main() -> None:
    checkout.enable_add_on()
    studio.empty_scene()
    add_trim()
    bonnet = add_panels()
    for ob in bpy.data.objects:
        ob.select_set(ob == bonnet)
    bpy.context.view_layer.objects.active = bonnet
    studio.select_faces(bonnet, np.ones(len(bonnet.data.polygons), bool))
    add_camera("Door View", *DOOR_VIEW)
    view = add_camera("View", *VIEW)
    light = studio.add_light_direction(LINE_DIRECTION, location=(1.3, -1.3, 1.4))
    studio.set_up_add_on(view, light, STRIPES, length=0.0)
    shown = bpy.context.scene.reflection_lines.stripes
    shown.scope, shown.collection = 'COLLECTION', bpy.data.collections["Paint"]
    studio.set_up_render(1400, 800, samples=8)
    studio.look_through_camera()
    shade_by_material()
    bpy.context.view_layer.update()
    bpy.ops.object.mode_set(mode='EDIT')
    bpy.ops.wm.save_as_mainfile(filepath=str(HERE / "car.blend"), compress=True)


main()
