"""The operator View of This Panel."""
import bpy

from ..read import scene_objects


class REFLINES_OT_use_panel_view(bpy.types.Operator):
    """Take the view camera and the light that the active panel was last worked on with"""
    bl_idname = "reflines.use_panel_view"
    bl_label = "View of This Panel"
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = scene_objects.find_active_object(context)
        cls.poll_message_set("Make a panel active that was worked on with another view camera or light")
        return ob is not None and ob.reflection_lines.has_other_view(context.scene)

    def execute(self, context: bpy.types.Context) -> set[str]:
        settings, kept = context.scene.reflection_lines, scene_objects.find_active_object(context).reflection_lines
        for name in ("camera", "light"):
            if settings.present(getattr(kept, name)):
                setattr(settings, name, getattr(kept, name))
        return {'FINISHED'}


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_use_panel_view])
