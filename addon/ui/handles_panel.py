"""The panel of the handles that are kept with an object: their values, which can be keyed, and their bake."""
import bpy

from ..model.line_handle import Handles
from ..model.refusal import Refusal
from .panels import ReflinesPanel, draw_paragraph

ROWS = 3


class REFLINES_UL_handles(bpy.types.UIList):
    """The kept handles by their names, with a switch that mutes each."""

    def draw_item(self, _context: bpy.types.Context, layout: bpy.types.UILayout, _data: object,
                  item: bpy.types.PropertyGroup, _icon: int, _active_data: object, _active: str) -> None:
        layout.label(text=item.name, icon='PINNED' if item.name.startswith("Pin") else 'EMPTY_DATA')
        layout.prop(item, "muted", text="", icon='CHECKBOX_DEHLT' if item.muted else 'CHECKBOX_HLT', emboss=False)


class VIEW3D_PT_reflines_handles(ReflinesPanel, bpy.types.Panel):
    bl_label = "Handles"
    bl_parent_id = "VIEW3D_PT_reflines_pull"
    bl_options = set()

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = context.view_layer.objects.active
        return ob is not None and ob.type == 'MESH' and bool(ob.reflection_lines.handles.text)

    def draw(self, context: bpy.types.Context) -> None:
        ob = context.view_layer.objects.active
        layout, kept = self.layout, ob.reflection_lines.handles
        try:
            handles = kept.read(ob.data)
        except Refusal as refusal:
            draw_paragraph(layout, context, str(refusal), 'ERROR')
            layout.operator("reflines.delete_handles", icon='X')
            return
        if kept.kept:
            self.draw_values(layout, kept, handles)
            layout.operator("reflines.bake_handles", icon='KEYTYPE_KEYFRAME_VEC')
        elif handles:
            draw_paragraph(layout, context, "Handles of an older file: Re-solve lets them be keyed", 'INFO')
        layout.operator("reflines.delete_handles", icon='X')

    def draw_values(self, layout: bpy.types.UILayout, kept: bpy.types.PropertyGroup, handles: Handles) -> None:
        """Draws the list, and the values of its active handle with the dots that key them."""
        index = min(kept.active, len(handles) - 1)
        row = layout.row()
        row.template_list("REFLINES_UL_handles", "", kept, "kept", kept, "active", rows=ROWS)
        row.operator("reflines.delete_handles", text="", icon='REMOVE').index = index
        column = layout.column()
        column.use_property_split, column.use_property_decorate = True, True
        if not handles[index].is_pin:
            column.prop(kept.kept[index], "place")
            column.prop(kept.kept[index], "radius")
        column.prop(kept.kept[index], "muted")
