"""The panel of the inspection in the sidebar tab: the worst spots, each a line to click."""
import bpy

from .panels import ReflinesPanel, draw_paragraph

MOST_LINES = 12  # spots that are listed; Next Spot goes through all


class VIEW3D_PT_reflines_inspection(ReflinesPanel, bpy.types.Panel):
    bl_label = "Inspect"
    bl_order = 5  # after the check

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        layout.operator("reflines.inspect", icon='VIEWZOOM')
        if any(entry.is_used() for entry in context.scene.reflection_lines.light_set.entries):
            layout.operator("reflines.inspect", text="Inspect in the Set").lights = 'SET'
        ob = context.view_layer.objects.active
        if ob is not None and ob.type == 'MESH' and ob.reflection_lines.inspection.summary:
            self.draw_spots(layout, context, ob.reflection_lines.inspection)

    def draw_spots(self, layout: bpy.types.UILayout, context: bpy.types.Context,
                   inspection: bpy.types.PropertyGroup) -> None:
        draw_paragraph(layout, context, inspection.summary, 'VIEWZOOM' if len(inspection.spots) else 'CHECKMARK')
        if inspection.unseen:
            draw_paragraph(layout, context, inspection.unseen, 'INFO')
        layout.operator("reflines.export_sheet", icon='IMAGE_DATA')
        if not len(inspection.spots):
            return
        column = layout.column(align=True)
        for index, spot in enumerate(inspection.spots[:MOST_LINES]):
            text, shown = f"{index + 1}. {spot.describe_shortly()}", index == inspection.active
            button = column.operator("reflines.show_spot", text=text, depress=shown)
            button.index = index
        if len(inspection.spots) > MOST_LINES:
            column.label(text=f"and {len(inspection.spots) - MOST_LINES} more")
        layout.operator("reflines.show_spot", icon='FRAME_NEXT')
        layout.operator("reflines.export_table", icon='EXPORT').table = 'SPOTS'
