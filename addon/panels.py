"""The sidebar tab "Reflection", top to bottom as the work goes: view and light, region and border, tool, result."""
import textwrap

import bpy


def paragraph(layout: bpy.types.UILayout, context: bpy.types.Context, text: str, icon: str) -> None:
    """A sentence over as many lines as the sidebar's width asks for."""
    letters = max(20, int((context.region.width - 60) / (6.5 * context.preferences.system.ui_scale)))
    column = layout.column(align=True)
    for number, line in enumerate(textwrap.wrap(text, letters)):
        column.label(text=line, icon='BLANK1' if number else icon)


class ReflinesPanel:
    """What all panels of the tab share."""
    bl_space_type = 'VIEW_3D'
    bl_region_type = 'UI'
    bl_category = "Reflection"


class VIEW3D_PT_reflines_setup(ReflinesPanel, bpy.types.Panel):
    bl_label = "View and Light"

    def draw(self, context: bpy.types.Context) -> None:
        settings = context.scene.reflection_lines
        layout = self.layout
        self.draw_problem(layout, context)
        column = layout.column()
        column.prop(settings, "camera", text="", icon='CAMERA_DATA')
        if not settings.present(settings.camera):
            column.operator("reflines.add_view_camera", icon='ADD')
        elif settings.is_perspective():
            paragraph(column, context, "Perspective camera: its direction to the panel's centre is used", 'INFO')
        column = layout.column()
        column.prop(settings, "light", text="", icon='EMPTY_SINGLE_ARROW')
        if not settings.present(settings.light):
            column.operator("reflines.add_light_direction", icon='ADD')

    def draw_problem(self, layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
        session = context.window_manager.reflection_lines
        if session.problem:
            box = layout.box()
            box.alert = True
            paragraph(box, context, session.problem, 'ERROR')
            paragraph(box, context, session.remedy, 'BLANK1')


class VIEW3D_PT_reflines_region(ReflinesPanel, bpy.types.Panel):
    bl_label = "Region and Border"

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        layout.label(text=self.region_text(context.view_layer.objects.active), icon='FACESEL')
        layout.row().prop(context.scene.reflection_lines, "border", expand=True)

    def region_text(self, ob: bpy.types.Object | None) -> str:
        if ob is None or ob.type != 'MESH':
            return "Make the panel's mesh active"
        if ob.mode == 'EDIT':
            return f"{ob.data.total_face_sel} selected faces"
        return "Faces of the last run" if ob.reflection_lines.report.termination else "Select faces in Edit Mode"


class VIEW3D_PT_reflines_smooth(ReflinesPanel, bpy.types.Panel):
    bl_label = "Smooth"

    def draw(self, context: bpy.types.Context) -> None:
        settings = context.scene.reflection_lines
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        layout.prop(settings, "length", text="Length" if settings.length else "Length (automatic)")
        layout.prop(settings, "strength")
        layout.operator("reflines.smooth", icon='MOD_SMOOTH')


class VIEW3D_PT_reflines_result(ReflinesPanel, bpy.types.Panel):
    bl_label = "Result"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = context.view_layer.objects.active
        return ob is not None and ob.reflection_lines.report.termination != ""

    def draw(self, context: bpy.types.Context) -> None:
        report = context.view_layer.objects.active.reflection_lines.report
        column = self.layout.column(align=True)
        icon = 'CHECKMARK' if report.termination in {"converged", "already_optimal"} else 'INFO'
        column.label(text=report.termination.replace('_', ' ').capitalize(), icon=icon)
        column.label(text=f"{report.iterations} iterations, {report.seconds:.2f} s")
        column.label(text=f"Wobble {report.score_before:.3g}\u00b0 \u2192 {report.score_after:.3g}\u00b0")
        move = bpy.utils.units.to_string(context.scene.unit_settings.system, 'LENGTH', report.largest_move, precision=5)
        column.label(text=f"Largest move {move}")
        for note in report.notes.splitlines():
            paragraph(column, context, note, 'ERROR')


class VIEW3D_PT_reflines_stripes(ReflinesPanel, bpy.types.Panel):
    bl_label = "Stripes"

    def draw_header(self, context: bpy.types.Context) -> None:
        self.layout.prop(context.scene.reflection_lines.stripes, "show", text="")

    def draw(self, context: bpy.types.Context) -> None:
        stripes = context.scene.reflection_lines.stripes
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        layout.active = stripes.show
        for name in ("eye", "cage_on_top", "count", "width", "softness", "color", "gap_color", "opacity"):
            layout.prop(stripes, name)


register, unregister = bpy.utils.register_classes_factory([
    VIEW3D_PT_reflines_setup, VIEW3D_PT_reflines_region, VIEW3D_PT_reflines_smooth, VIEW3D_PT_reflines_result,
    VIEW3D_PT_reflines_stripes])
