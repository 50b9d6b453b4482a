"""The panel of the check in the sidebar tab."""
import bpy

from .panels import ReflinesPanel, draw_paragraph

ICONS = {"better": 'CHECKMARK', "unchanged": 'DOT', "worse": 'CANCEL'}

class VIEW3D_PT_reflines_check(ReflinesPanel, bpy.types.Panel):
    bl_label = "Check"
    bl_order = 4  # after the result

    def draw(self, context: bpy.types.Context) -> None:
        layout, marks = self.layout, context.scene.reflection_lines.marks
        layout.use_property_split, layout.use_property_decorate = True, False
        column = layout.column(align=True)
        for name in ("gap", "angle", "curvature", "shut_line"):
            column.prop(marks, name)
        layout.operator("reflines.check", icon='CHECKMARK')
        ob = context.view_layer.objects.active
        if ob is not None and ob.type == 'MESH' and len(ob.reflection_lines.check.rows):
            self.draw_table(layout, context, ob.reflection_lines.check)

    def draw_table(self, layout: bpy.types.UILayout, context: bpy.types.Context,
                   check: bpy.types.PropertyGroup) -> None:
        draw_paragraph(layout, context, check.headline(), 'INFO')
        for row in check.rows:
            if row.shut_line:
                continue
            change = row.change if check.compared else "better" if row.passes else "worse"
            self.draw_line(layout, context, row.describe(compared=check.compared), change)
        for shut_line in check.list_shut_lines():
            self.draw_line(layout, context, shut_line.describe(), shut_line.find_change(compared=check.compared))
        layout.operator("reflines.export_table", icon='EXPORT')

    def draw_line(self, layout: bpy.types.UILayout, context: bpy.types.Context, text: str, change: str) -> None:
        line = layout.column(align=True)
        line.alert = change == "worse"
        draw_paragraph(line, context, text, ICONS.get(change, 'DOT'))
