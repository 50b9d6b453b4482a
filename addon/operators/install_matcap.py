"""Install Stripes MatCap."""
import bpy
import numpy as np

from .. import session
from ..bridge import matcap, view
from ..bridge.refusal import Refusal


class REFLINES_OT_install_matcap(bpy.types.Operator):
    """Make a MatCap of the stripes as they are set, install it among yours, and shade this view with it.

A MatCap knows the normal only and turns with the view: the stripes over the mesh are the finer judge"""
    bl_idname = "reflines.install_matcap"
    bl_label = "Install Stripes MatCap"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        missing = context.scene.reflection_lines.missing()
        cls.poll_message_set(missing)
        return not missing

    def execute(self, context: bpy.types.Context) -> set[str]:
        settings = context.scene.reflection_lines
        center = np.array(view.extent(context.view_layer.objects.active)[0])
        try:
            seen = session.view_of(context.scene, center)
            up = np.array(settings.camera.matrix_world, dtype=np.float64)[:3, 1]
            up = view.unit(up - up @ seen.view_direction * seen.view_direction, settings.camera.name)
            matcap.install(matcap.picture(seen, up, settings.stripes))
        except Refusal as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        self.shade(getattr(context.space_data, "shading", None))
        self.report({'INFO'}, f"{matcap.NAME} is among your MatCaps")
        return {'FINISHED'}

    def shade(self, shading: bpy.types.View3DShading | None) -> None:
        if shading is not None:
            shading.type, shading.light = 'SOLID', 'MATCAP'
            shading.studio_light = matcap.NAME


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_install_matcap])
