"""What is shown and how, read from the settings: objects, eye, lights, look."""
import bpy
import numpy as np

from .. import session
from ..bridge import view
from . import stripes

MAPS = {'RESIDUAL', 'DEVIATION'}


def shown_objects(context: bpy.types.Context, settings: bpy.types.PropertyGroup) -> list[bpy.types.Object]:
    space = context.space_data
    return [ob for ob in candidates(context, settings)
            if ob is not None and ob.type == 'MESH' and ob.mode in {'OBJECT', 'EDIT'}
            and ob.visible_get(viewport=space)]


def candidates(context: bpy.types.Context, settings: bpy.types.PropertyGroup) -> list[bpy.types.Object]:
    """With a warp lattice in the place of its panel: who edits that watches this."""
    return list(dict.fromkeys(panel_of(ob) for ob in chosen(context, settings)))


def panel_of(ob: bpy.types.Object | None) -> bpy.types.Object | None:
    warps = ob is not None and ob.type == 'LATTICE' and ob.reflection_lines.panel is not None
    return ob.reflection_lines.panel if warps else ob


def chosen(context: bpy.types.Context, settings: bpy.types.PropertyGroup) -> list[bpy.types.Object]:
    layer = context.view_layer
    if settings.scope == 'COLLECTION' and settings.collection is not None:
        wanted = {ob.name for ob in settings.collection.all_objects}
        return [ob for ob in layer.objects if ob.name in wanted]
    if settings.scope == 'SELECTION':
        editing = [ob for ob in layer.objects if ob.mode == 'EDIT']
        return editing or [ob for ob in layer.objects if ob.select_get()]
    return [layer.objects.active]


def needs_solution(settings: bpy.types.PropertyGroup) -> bool:
    return settings.before or settings.mode in MAPS


def content(ob: bpy.types.Object, settings: bpy.types.PropertyGroup) -> tuple:
    """Settings that say what is uploaded; all others only say how it is painted."""
    is_map = settings.mode in MAPS
    return is_map and settings.mode, is_map and settings.map_range, settings.before, is_part_only(ob, settings)


def is_part_only(ob: bpy.types.Object, settings: bpy.types.PropertyGroup) -> bool:
    """Whether only the selected faces are shown."""
    return settings.scope == 'SELECTION' and ob.mode == 'EDIT'


def uniforms(context: bpy.types.Context, ob: bpy.types.Object) -> np.ndarray | None:
    """None where the light is missing or parallel to the view: there are no reflection lines then."""
    settings = context.scene.reflection_lines.stripes
    seen, line = session.shown_directions(context.scene, ob)
    if line is None:
        return None
    eye = eye_of(context, settings, ob, seen)
    # The lights stand where the view camera has theta = 0, whoever looks at them.
    lights = stripes.lights(eye.direction if seen is None else seen, line)
    if lights is None:
        return None
    region_3d = context.region_data
    return stripes.uniforms(model=array(ob.matrix_world), view_matrix=array(region_3d.view_matrix),
                            projection=array(region_3d.window_matrix), eye=eye, lights=lights,
                            look=look(settings, ob.mode))


def eye_of(context: bpy.types.Context, settings: bpy.types.PropertyGroup, ob: bpy.types.Object,
           seen: np.ndarray | None) -> stripes.Eye:
    if settings.eye == 'FROZEN' and any(settings.frozen_eye):
        return frozen_eye(np.array(settings.frozen_eye, dtype=np.float64), np.array(view.extent(ob)[0]))
    if settings.eye != 'CAMERA' or seen is None:
        return viewport_eye(context.region_data)
    scene = context.scene.reflection_lines
    place = np.array(scene.camera.matrix_world.translation, dtype=np.float64)
    return stripes.Eye(seen, place if settings.per_point and scene.is_perspective() else None)


def frozen_eye(value: np.ndarray, center: np.ndarray) -> stripes.Eye:
    direction = value[:3] - value[3] * center
    direction = direction / max(np.linalg.norm(direction), 1e-12)
    return stripes.Eye(direction, value[:3] if value[3] else None)


def viewport_eye(region_3d: bpy.types.RegionView3D) -> stripes.Eye:
    back = array(region_3d.view_matrix.inverted_safe())
    return stripes.Eye(back[:3, 2], back[:3, 3] if region_3d.is_perspective else None)


def look(settings: bpy.types.PropertyGroup, mode: str) -> stripes.Look:
    offset = stripes.ABOVE_CAGE if mode == 'EDIT' and not settings.cage_on_top else stripes.BELOW_CAGE
    return stripes.Look(settings.mode, settings.count, settings.width, settings.softness, tuple(settings.color),
                        tuple(settings.gap_color), settings.opacity, settings.image_rotation, offset)


def array(matrix: object) -> np.ndarray:
    return np.array(matrix, dtype=np.float64)
