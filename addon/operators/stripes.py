"""The operators for named set-ups of the stripes, and for the eye they are seen by."""
import bpy
from bpy.props import StringProperty


class REFLINES_OT_add_stripes(bpy.types.Operator):
    """Keep the present look of the stripes as a set-up with a name; what is changed from now on belongs to it"""
    bl_idname = "reflines.add_stripes"
    bl_label = "Add Stripes Set-up"
    bl_options = {'REGISTER', 'UNDO'}

    name: StringProperty(name="Name", description="Empty: after the mode")

    def execute(self, context: bpy.types.Context) -> set[str]:
        settings = context.scene.reflection_lines
        mode = settings.stripes.bl_rna.properties["mode"].enum_items[settings.stripes.mode].name
        settings.setups.add(self.unused(settings.setups, self.name or mode))
        return {'FINISHED'}

    def unused(self, setups: bpy.types.PropertyGroup, name: str) -> str:
        taken, number = {item.name for item in setups.entries}, 1
        while (f"{name} {number}" if number > 1 else name) in taken:
            number += 1
        return f"{name} {number}" if number > 1 else name


class REFLINES_OT_remove_stripes(bpy.types.Operator):
    """Remove the picked set-up of the stripes"""
    bl_idname = "reflines.remove_stripes"
    bl_label = "Remove Stripes Set-up"
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        cls.poll_message_set("There is no set-up to remove")
        setups = context.scene.reflection_lines.setups
        return 0 <= setups.index < len(setups.entries)

    def execute(self, context: bpy.types.Context) -> set[str]:
        context.scene.reflection_lines.setups.remove()
        return {'FINISHED'}


class REFLINES_OT_freeze_eye(bpy.types.Operator):
    """Keep this view's eye: as you orbit, the stripes stay on the panel as they are seen from here"""
    bl_idname = "reflines.freeze_eye"
    bl_label = "Freeze Eye Here"
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        cls.poll_message_set("Run this in a 3D view")
        return getattr(context.space_data, "region_3d", None) is not None

    def execute(self, context: bpy.types.Context) -> set[str]:
        stripes = context.scene.reflection_lines.stripes
        stripes.eye = 'FROZEN'
        stripes.freeze(context.space_data.region_3d)
        return {'FINISHED'}


class REFLINES_OT_toggle_stripes(bpy.types.Operator):
    """Show or hide the stripes"""
    bl_idname = "reflines.toggle_stripes"
    bl_label = "Show Stripes"

    def execute(self, context: bpy.types.Context) -> set[str]:
        stripes = context.scene.reflection_lines.stripes
        stripes.show = not stripes.show
        return {'FINISHED'}


register, unregister = bpy.utils.register_classes_factory([
    REFLINES_OT_add_stripes, REFLINES_OT_remove_stripes, REFLINES_OT_freeze_eye, REFLINES_OT_toggle_stripes])
