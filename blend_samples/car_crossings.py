"""Dents across the shut lines of the car, which is clean elsewhere: between bonnet and wing, and between wing and door.
numpy and Blender.
"""
import bpy
import numpy as np
from mathutils import Matrix, Vector

import car_mesh
import car_sheets

DIRECTION, AIM, SCALE = (0.73, -0.46, 0.51), (0.76, -1.05, 0.62), 2.0  # of the camera, which has no perspective
# Place on a shut line, the way outwards, radius and depth, metres.
DENTS = (((0.666, -1.495, 0.805), (0.17, -0.20, 0.96), 0.055, 0.0020),
         ((0.842, -0.681, 0.500), (1.0, 0.0, -0.02), 0.055, 0.0020))
WING, WING_VERTICES = 840, 912  # faces and vertices of the body, its first ones: the cage of the wing


def dent(points: np.ndarray) -> np.ndarray:
    """Moves points (#V x 3) as the dents do."""
    moved = points.copy()
    for place, outwards, radius, depth in DENTS:
        squared = ((points - place) ** 2).sum(axis=1) / radius**2
        moved -= depth * np.exp(-squared)[:, None] * np.array(Vector(outwards).normalized())
    return moved


def read_points(ob: bpy.types.Object) -> np.ndarray:
    """The vertices of a mesh in Object Mode: #V x 3, its own space, which is the world's."""
    values = np.empty(3 * len(ob.data.vertices), np.float32)
    ob.data.vertices.foreach_get("co", values)
    return values.reshape(-1, 3).astype(float)


def read_clean_points(ob: bpy.types.Object) -> np.ndarray:
    """The vertices of a panel in Object Mode as they are without flaws."""
    sheets = dict(zip(("Bonnet", "Doors"), car_sheets.dense_sheets(), strict=True))
    return car_mesh.dense_of(sheets[ob.name], flawed=False).V if ob.name in sheets else read_points(ob)


def dent_shut_lines() -> list[bpy.types.Object]:
    """In Object Mode of the opened car: dents it, looks at it, and selects bonnet, door and wing in Edit Mode."""
    panels = [bpy.data.objects[name] for name in ("Bonnet", "Doors", "Body")]
    for ob in panels:
        ob.data.vertices.foreach_set("co", dent(read_clean_points(ob)).astype(np.float32).ravel())
        chosen = np.arange(len(ob.data.polygons)) < (WING if ob.name == "Body" else len(ob.data.polygons))
        for kind in (ob.data.vertices, ob.data.edges):
            kind.foreach_set("select", np.zeros(len(kind), bool))
        ob.data.polygons.foreach_set("select", chosen)
        ob.data.update()
        ob.select_set(True)
        bpy.context.view_layer.objects.active = ob
    camera, direction = bpy.data.objects["View"], Vector(DIRECTION).normalized()
    camera.data.type, camera.data.ortho_scale = 'ORTHO', SCALE
    turn = direction.to_track_quat('Z', 'Y').to_matrix().to_4x4()
    camera.matrix_world = Matrix.Translation(Vector(AIM) + 8.0 * direction) @ turn
    bpy.context.view_layer.update()
    bpy.ops.object.mode_set(mode='EDIT')
    return panels
