"""The panel of the stripes' look in the sidebar tab."""
import bpy

from . import rows, stripe_presets
from .panels import ReflinesPanel, draw_paragraph

BANDS = {'REFLECTION', 'HIGHLIGHT', 'ISOPHOTE'}
MAPS = {'RESIDUAL', 'DEVIATION', 'VERDICT'}


class VIEW3D_PT_reflines_stripes(ReflinesPanel, bpy.types.Panel):
    bl_label = "Stripes"
    bl_order = 2

    def draw_header_preset(self, _context: bpy.types.Context) -> None:
        stripe_presets.VIEW3D_PT_reflines_stripe_presets.draw_panel_header(self.layout)

    def draw_header(self, context: bpy.types.Context) -> None:
        self.layout.prop(context.scene.reflection_lines.stripes, "show", text="")

    def draw(self, context: bpy.types.Context) -> None:
        settings = context.scene.reflection_lines
        stripes = settings.stripes
        layout = self.layout
        why = context.window_manager.reflection_lines.explain_stripes(context)
        if why:
            draw_paragraph(layout, context, why, 'INFO')
        layout.active = stripes.show
        layout.use_property_split, layout.use_property_decorate = True, False
        layout.prop(stripes, "look")
        rows.draw_choice(layout, stripes, "mode")
        layout.prop(stripes, "scope")
        if stripes.scope == 'COLLECTION':
            layout.prop(stripes, "collection")
        if stripes.mode in MAPS:
            self.draw_map(layout, context.view_layer.objects.active)
        else:
            layout.prop(stripes, "eye")
        if stripes.mode == 'IMAGE':
            self.draw_image(layout, stripes)

    def draw_map(self, layout: bpy.types.UILayout, ob: bpy.types.Object | None) -> None:
        if ob is None or not ob.reflection_lines.report.termination:
            draw_paragraph(layout, bpy.context, "Run a tool: the map shows what its solve did", 'INFO')

    def draw_image(self, layout: bpy.types.UILayout, stripes: bpy.types.PropertyGroup) -> None:
        column = layout.column()
        column.use_property_split = False
        column.template_ID(stripes, "image", open="image.open")
        if stripes.image is None:
            draw_paragraph(column, bpy.context, "Open an equirectangular image, as World environments use", 'INFO')
        layout.prop(stripes, "image_rotation")


class VIEW3D_PT_reflines_look(ReflinesPanel, bpy.types.Panel):
    bl_label = "Adjust Look"
    bl_parent_id = "VIEW3D_PT_reflines_stripes"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.scene.reflection_lines.stripes.mode in BANDS

    def draw(self, context: bpy.types.Context) -> None:
        settings, layout = context.scene.reflection_lines, self.layout
        layout.active = settings.stripes.show
        layout.use_property_split, layout.use_property_decorate = True, False
        for name in ("count", "width", "color", "gap_color"):
            layout.prop(settings.stripes, name)
