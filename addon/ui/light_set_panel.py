"""The panel of the set of lights, below the settings of Smooth where these choose it."""
import bpy

from .panels import ReflinesPanel, draw_paragraph

ROWS = 3
MANY = 20       # lights from which on the panel tells what they take
MEGABYTES = 2.5  # for a light, with 10,000 quads in the region


class REFLINES_UL_light_set(bpy.types.UIList):
    """The lights by their names, with a switch that mutes each."""

    def draw_item(self, _context: bpy.types.Context, layout: bpy.types.UILayout, _data: object,
                  item: bpy.types.PropertyGroup, _icon: int, _active_data: object, _active: str) -> None:
        problem = item.find_problem()
        layout.prop(item, "name", text="", emboss=False, icon='ERROR' if problem else 'LIGHT_AREA')
        layout.prop(item, "muted", text="", icon='CHECKBOX_DEHLT' if item.muted else 'CHECKBOX_HLT', emboss=False)


class VIEW3D_PT_reflines_light_set(ReflinesPanel, bpy.types.Panel):
    bl_label = "Light Set"
    bl_parent_id = "VIEW3D_PT_reflines_smooth_settings"
    bl_options = set()

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.scene.reflection_lines.lights == 'SET'

    def draw(self, context: bpy.types.Context) -> None:
        layout, chosen = self.layout, context.scene.reflection_lines.light_set
        layout.operator("reflines.light_set", text="Walk Around", icon='ORIENTATION_GIMBAL').action = 'WALK'
        row = layout.row()
        row.template_list("REFLINES_UL_light_set", "", chosen, "entries", chosen, "active", rows=ROWS)
        buttons = row.column(align=True)
        buttons.operator("reflines.light_set", text="", icon='ADD').action = 'ADD'
        buttons.operator("reflines.light_set", text="", icon='REMOVE').action = 'REMOVE'
        entry = chosen.find_active()
        if entry is None:
            draw_paragraph(layout, context, "Without a light the press takes crossed lights", 'INFO')
            return
        column = layout.column()
        column.use_property_split, column.use_property_decorate = True, False
        column.prop(entry, "weight")
        if len(chosen.entries) > MANY:
            taken = f"{MEGABYTES * len(chosen.entries):.0f} MB for 10,000 faces"
            draw_paragraph(layout, context, f"{len(chosen.entries)} lights take {taken}, and longer each", 'INFO')
        if entry.find_problem():
            draw_paragraph(layout, context, entry.find_problem(), 'ERROR')
