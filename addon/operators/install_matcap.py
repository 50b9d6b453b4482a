"""The operator Install Stripes MatCap."""
import bpy
import numpy as np

from ..model.refusal import report_refusals
from ..read import scene_objects
from ..view import view_and_light
from ..write import matcap


class REFLINES_OT_install_matcap(bpy.types.Operator):
    """Make a MatCap of the stripes as they are set and install it among yours. It knows the normal only and turns with
the view: the stripes over the mesh are the finer judge"""
    bl_idname = "reflines.install_matcap"
    bl_label = "Install Stripes MatCap"
    bl_options = {'REGISTER'}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        obstacle = view_and_light.find_obstacle(context.scene)
        cls.poll_message_set(obstacle)
        return not obstacle

    @report_refusals
    def execute(self, context: bpy.types.Context) -> set[str]:
        settings = context.scene.reflection_lines
        center = np.array(view_and_light.measure_extent(scene_objects.read_active_object(context))[0])
        seen = view_and_light.read_scene_view(context.scene, center)
        up = np.array(settings.camera.matrix_world, dtype=np.float64)[:3, 1]
        up = view_and_light.normalize(up - up @ seen.view_direction * seen.view_direction, settings.camera.name)
        matcap.install_matcap(matcap.render_matcap(seen, up, settings.stripes))
        self.report({'INFO'}, f"{matcap.NAME} is among your MatCaps")
        return {'FINISHED'}


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_install_matcap])
