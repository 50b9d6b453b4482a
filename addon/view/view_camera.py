"""Aims a view camera at a panel: chooses the points to frame and the axes of the picture."""
import bpy
import numpy as np
from mathutils import Matrix, Vector

from ..model.refusal import Refusal
from ..read import read_mesh, region_faces
from . import view_and_light

MARGIN = 1.1    # size of the picture relative to the framed points
FURTHEST = 1e15  # coordinate: what is made of larger ones is not finite in float32
DISTANCE = 2.0  # from the camera to the middle of the framed points, relative to their size


def choose_frame(context: bpy.types.Context, ob: bpy.types.Object, direction: tuple[float, float, float]) -> Matrix:
    """Chooses the axes of the picture, columns right, up, towards the viewer: of the given direction where it is not
    zero, else of the 3D view, in background of the panel's mean normal.
    """
    if any(direction):
        return view_and_light.build_frame(Vector(direction))
    return (view_and_light.read_viewport_frame(context)
            or view_and_light.build_frame(Vector(compute_mean_normal(ob))))


def compute_mean_normal(ob: bpy.types.Object) -> np.ndarray:
    """Returns the mean normal, in world space, of the selected faces, else of the stored region, else of all faces; +Z
    for a closed body, and where it is no direction.
    """
    if ob.mode == 'EDIT':
        ob.update_from_editmode()
    mesh = ob.data
    faces = region_faces.read_selected_faces(mesh) if ob.mode == 'EDIT' else region_faces.read_stored_region(mesh)
    areas, directions = (read_mesh.read_values(mesh.polygons, name, float, each)
                         for name, each in (("area", 1), ("normal", 3)))
    chosen = faces if faces.any() else np.ones(len(faces), dtype=bool)
    total = areas[chosen] @ directions[chosen]
    matrix = np.array(ob.matrix_world, dtype=np.float64)[:3, :3]
    known = len(areas) and np.isfinite(total).all() and np.isfinite(matrix).all()
    if not known or np.linalg.norm(total) < 1e-3 * areas[chosen].sum() or np.linalg.matrix_rank(matrix) < 3:
        return np.array([0.0, 0.0, 1.0])
    normal = np.linalg.solve(matrix.T, total)
    return normal / np.linalg.norm(normal)


def read_framed_points(ob: bpy.types.Object) -> np.ndarray:
    """Reads the points to frame, in world space: the selected vertices in Edit Mode, else the corners of the object's
    bounding box: #P x 3. Those that are nowhere are left out; refuses where no other is left.
    """
    points = np.array(ob.bound_box, dtype=np.float64)
    if ob.mode == 'EDIT':
        ob.update_from_editmode()
        selected = read_mesh.read_values(ob.data.vertices, "select", bool)
        points = read_mesh.read_values(ob.data.vertices, "co", float, 3)[selected] if selected.any() else points
    matrix = np.array(ob.matrix_world, dtype=np.float64)
    with np.errstate(invalid="ignore", over="ignore"):
        points = points @ matrix[:3, :3].T + matrix[:3, 3]
    points = points[(np.abs(points) < FURTHEST).all(axis=1)]
    if not len(points):
        raise Refusal(f"{ob.name} has no place to look at: its coordinates or its transform are no finite numbers")
    return points


def aim_camera(context: bpy.types.Context, camera: bpy.types.Object, frame: Matrix, points: np.ndarray) -> None:
    """Turns and moves a camera so that its picture has these axes and shows all points with MARGIN around them."""
    axes = np.array(frame, dtype=np.float64)
    low, high = (points @ axes).min(axis=0), (points @ axes).max(axis=0)
    middle, size = axes @ (0.5 * (low + high)), float(np.linalg.norm(high - low)) or 1.0
    camera.matrix_world = Matrix.Translation(Vector(middle + DISTANCE * size * axes[:, 2])) @ frame.to_4x4()
    context.view_layer.update()
    place, scale = camera.camera_fit_coords(context.evaluated_depsgraph_get(), points.ravel().tolist())
    if camera.data.type == 'ORTHO':
        camera.data.ortho_scale = MARGIN * scale
    else:
        away = (place - Vector(middle)).length
        camera.matrix_world = Matrix.Translation(place + (MARGIN - 1.0) * away * frame.col[2]) @ frame.to_4x4()
    far = (camera.matrix_world.translation - Vector(middle)).length + size
    camera.data.clip_start, camera.data.clip_end = min(camera.data.clip_start, 0.01 * size), 2.0 * far


def add_camera(collection: bpy.types.Collection) -> bpy.types.Object:
    """Adds an orthographic camera."""
    data = bpy.data.cameras.new("View Camera")
    data.type = 'ORTHO'
    camera = bpy.data.objects.new("View Camera", data)
    collection.objects.link(camera)
    return camera


def is_looking_through(space: bpy.types.Space, camera: bpy.types.Object) -> bool:
    """Returns whether the 3D view looks through the camera."""
    return space.region_3d.view_perspective == 'CAMERA' and space.camera == camera
