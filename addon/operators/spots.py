"""The operator Next Spot, which shows the worst spots of an inspection."""
from math import radians

import bpy
from bpy.props import BoolProperty, IntProperty
from mathutils import Vector

from ..read import scene_objects
from ..view import light_angles
from ..write import select_faces

FRAMED = 5.0  # sizes of the spot that the view shows
ELSEWHERE = radians(2.0)  # from the view camera's direction


def show_spot(context: bpy.types.Context, ob: bpy.types.Object, index: int) -> str:
    """Shows a spot of the last inspection; returns the line that tells of it."""
    stored = ob.reflection_lines.inspection
    stored.active = index
    spot = stored.spots[index]
    look_at_spot(context, ob, spot)
    return f"Spot {index + 1} of {len(stored.spots)}: {spot.describe()}, seen best {spot.to_spot().tell_where()}"


def look_at_spot(context: bpy.types.Context, ob: bpy.types.Object, spot: bpy.types.PropertyGroup) -> None:
    """Frames a spot in the 3D view, turns the light to it and selects its faces."""
    settings = context.scene.reflection_lines
    if ob.mode == 'EDIT':
        ob.update_from_editmode()
    select_faces.select_faces(ob, select_faces.find_faces_near(ob, spot.find_place(), 0.5 * spot.size))
    camera = settings.picture_camera()
    if not settings.explain_fixed_light():
        axes = light_angles.read_picture_axes(camera)
        light_angles.point_light(camera, settings.light, axes.transposed() @ Vector(spot.line))
    region_3d = getattr(context.space_data, "region_3d", None)
    if region_3d is not None:
        frame_spot(region_3d, camera, spot)
        if is_seen_from_elsewhere(camera, spot):
            settings.stripes.eye = 'VIEWPORT'


def is_seen_from_elsewhere(camera: bpy.types.Object | None, spot: bpy.types.PropertyGroup) -> bool:
    """Returns whether a spot shows from another direction than the view camera's."""
    if camera is None or not any(spot.eye):
        return False
    return (camera.matrix_world.to_quaternion() @ Vector((0.0, 0.0, 1.0))).angle(spot.eye) > ELSEWHERE


def frame_spot(region_3d: bpy.types.RegionView3D, camera: bpy.types.Object | None, spot: bpy.types.PropertyGroup,
               ) -> None:
    """Looks at a spot in the direction of the view camera, for which the stripes are drawn, or from where it shows."""
    if region_3d.view_perspective == 'CAMERA':
        region_3d.view_perspective = 'ORTHO'
    if camera is not None:
        rotation = camera.matrix_world.to_quaternion()
        if is_seen_from_elsewhere(camera, spot):
            region_3d.view_perspective = 'ORTHO'
            rotation = (rotation @ Vector((0.0, 0.0, 1.0))).rotation_difference(spot.eye) @ rotation
        region_3d.view_rotation = rotation
    region_3d.view_location = spot.find_place().tolist()
    region_3d.view_distance = FRAMED * spot.size


class REFLINES_OT_show_spot(bpy.types.Operator):
    """Look at the next spot, the worst first: the view frames it, the light turns to what shows it best, and its faces
are selected"""
    bl_idname = "reflines.show_spot"
    bl_label = "Next Spot"
    bl_options = {'REGISTER', 'UNDO'}

    index: IntProperty(name="Spot", min=-1, default=-1, options={'HIDDEN', 'SKIP_SAVE'},
                       description="From 0, the worst; -1: the next one, after the last the first")
    worse: BoolProperty(options={'HIDDEN', 'SKIP_SAVE'}, description="Show the place that the last press made worse")

    @classmethod
    def description(cls, _context: bpy.types.Context, properties: bpy.types.OperatorProperties) -> str:
        """Returns the tooltip of a spot's line and of the result's button; empty for the other, which has the
        docstring.
        """
        if properties.worse:
            return ("Look at the place that the last press made worse: the view frames it, the light turns to the one "
                    "in which it is worse, and its faces are selected")
        return ("Look at this spot: the view frames it, the light turns to what shows it best, and its faces are "
                "selected") if properties.index >= 0 else ""

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = scene_objects.read_active_object(context)
        cls.poll_message_set("Make a panel active that was inspected and has spots")
        return ob is not None and ob.type == 'MESH' and (len(ob.reflection_lines.inspection.spots) > 0
                                                         or ob.reflection_lines.report.worse != "")

    def execute(self, context: bpy.types.Context) -> set[str]:
        ob = scene_objects.read_active_object(context)
        if self.worse:
            return self.show_worse(context, ob)
        stored = ob.reflection_lines.inspection
        count = len(stored.spots)
        if self.index >= count or not count:
            missing = f"there is no number {self.index + 1}" if count else "press Inspect first"
            self.report({'ERROR'}, f"{ob.name} has {count} spots: {missing}")
            return {'CANCELLED'}
        index = (stored.active + 1) % count if self.index < 0 else self.index
        self.report({'INFO'}, show_spot(context, ob, index))
        return {'FINISHED'}

    def show_worse(self, context: bpy.types.Context, ob: bpy.types.Object) -> set[str]:
        if not ob.reflection_lines.report.worse:
            self.report({'ERROR'}, f"{ob.name}: the last press made no place worse")
            return {'CANCELLED'}
        look_at_spot(context, ob, ob.reflection_lines.report.worse_spot)
        self.report({'INFO'}, f"{ob.name}: {ob.reflection_lines.report.worse}")
        return {'FINISHED'}
