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
        layout.use_property_split, layout.use_property_decorate = True, False
        layout.prop(context.scene.reflection_lines, "result")
        ob = context.view_layer.objects.active
        if ob is not None and ob.reflection_lines.is_cage():
            layout.prop(context.scene.reflection_lines, "solve_for")
            layout.operator("reflines.fit", icon='MOD_SHRINKWRAP')

    def region_text(self, ob: bpy.types.Object | None) -> str:
        if ob is not None and ob.type == 'LATTICE' and ob.reflection_lines.panel is not None:
            return f"Faces of {ob.reflection_lines.panel.name}"
        if ob is None or ob.type != 'MESH':
            return "Make the panel's mesh active"
        if ob.mode == 'EDIT':
            return f"{ob.data.total_face_sel} selected faces"
        return "Faces of the last run" if ob.reflection_lines.report.termination else "Select faces in Edit Mode"


class ToolPanel(ReflinesPanel):
    """Settings of one tool, and its button."""

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.use_property_split, self.layout.use_property_decorate = True, False
        self.draw_tool(self.layout, context, context.scene.reflection_lines)

    def draw_falloff(self, layout: bpy.types.UILayout, settings: bpy.types.PropertyGroup,
                     curve: bpy.types.NodeTree | None) -> None:
        layout.prop(settings, "centre")
        if settings.centre == 'EVERYWHERE':
            return
        layout.prop(settings, "radius", text="Radius" if settings.radius else "Radius (automatic)")
        layout.prop(settings, "shape")
        if settings.shape == 'CURVE' and curve is not None and len(curve.nodes):
            layout.template_curve_mapping(curve.nodes[0], "mapping")
        layout.prop(settings, "emphasis")


class VIEW3D_PT_reflines_smooth(ToolPanel, bpy.types.Panel):
    bl_label = "Smooth"

    def draw_tool(self, layout: bpy.types.UILayout, _: bpy.types.Context, settings: bpy.types.PropertyGroup) -> None:
        layout.prop(settings, "length", text="Length" if settings.length else "Length (automatic)")
        layout.prop(settings, "strength")
        layout.prop(settings, "directional")
        layout.operator("reflines.smooth", icon='MOD_SMOOTH')


class VIEW3D_PT_reflines_direction(ToolPanel, bpy.types.Panel):
    bl_label = "Direction and Density"
    bl_options = {'DEFAULT_CLOSED'}

    def draw_tool(self, layout: bpy.types.UILayout, _: bpy.types.Context, settings: bpy.types.PropertyGroup) -> None:
        own = settings.direction
        layout.prop(own, "direction")
        if own.direction == 'ANGLE':
            layout.prop(own, "angle")
        elif own.direction == 'POINTS':
            layout.operator("reflines.pick_direction", icon='EYEDROPPER')
        layout.prop(own, "unit")
        layout.prop(own, "density", text="At the Start" if own.axis != 'NONE' else "Value")
        layout.prop(own, "axis")
        if own.axis != 'NONE':
            layout.prop(own, "density_end")
        layout.prop(own, "strength")
        self.draw_falloff(layout, own, settings.curve)
        layout.operator("reflines.direction", icon='ALIGN_JUSTIFY')


class VIEW3D_PT_reflines_untwist(ToolPanel, bpy.types.Panel):
    bl_label = "Untwist"
    bl_options = {'DEFAULT_CLOSED'}

    def draw_tool(self, layout: bpy.types.UILayout, _: bpy.types.Context, settings: bpy.types.PropertyGroup) -> None:
        layout.prop(settings.untwist, "angle")
        self.draw_falloff(layout, settings.untwist, settings.curve)
        layout.operator("reflines.untwist", icon='LOOP_BACK')


class VIEW3D_PT_reflines_warp(ToolPanel, bpy.types.Panel):
    bl_label = "Warp"
    bl_options = {'DEFAULT_CLOSED'}

    def draw_tool(self, layout: bpy.types.UILayout, context: bpy.types.Context,
                  settings: bpy.types.PropertyGroup) -> None:
        own = settings.warp
        layout.prop(own, "lattice")
        layout.operator("reflines.add_warp_lattice", icon='ADD')
        for name in ("amount", "fit", "cells"):
            layout.prop(own, name)
        if settings.live.panel is not None:
            self.draw_live(layout.box(), context, settings.live)
            return
        layout.operator("reflines.start_live_warp", icon='PLAY')
        if context.mode == 'EDIT_LATTICE':
            paragraph(layout, context, "Leave the lattice's Edit Mode to warp", 'INFO')
        layout.operator("reflines.warp", icon='MOD_LATTICE')

    def draw_live(self, layout: bpy.types.UILayout, context: bpy.types.Context, live: bpy.types.PropertyGroup) -> None:
        says = context.window_manager.reflection_lines.live
        paragraph(layout, context, f"{live.panel_name()} follows the lattice", 'PLAY')
        if says:
            paragraph(layout, context, says, 'INFO')
        row = layout.row(align=True)
        row.operator("reflines.apply_live_warp", icon='CHECKMARK')
        row.operator("reflines.discard_live_warp", icon='CANCEL')


class VIEW3D_PT_reflines_pattern(ToolPanel, bpy.types.Panel):
    bl_label = "Image Pattern"
    bl_options = {'DEFAULT_CLOSED'}

    def draw_tool(self, layout: bpy.types.UILayout, _: bpy.types.Context, settings: bpy.types.PropertyGroup) -> None:
        own = settings.pattern
        layout.template_ID(own, "image", new="image.new", open="image.open")
        for name in ("fit", "strength", "blur", "keep_lines"):
            layout.prop(own, name)
        layout.prop(own, "width", text="Width" if own.width else "Width (of the region)")
        layout.prop(own, "angle")
        layout.prop(own, "offset")
        layout.operator("reflines.pattern", icon='IMAGE_DATA')


class VIEW3D_PT_reflines_result(ReflinesPanel, bpy.types.Panel):
    bl_label = "Result"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = context.view_layer.objects.active
        return ob is not None and ob.reflection_lines.report.termination != ""

    def draw(self, context: bpy.types.Context) -> None:
        ob = context.view_layer.objects.active
        report, run = ob.reflection_lines.report, ob.reflection_lines.run
        column = self.layout.column(align=True)
        icon = 'CHECKMARK' if report.termination in {"converged", "already_optimal"} else 'INFO'
        if context.window_manager.reflection_lines.is_undone(ob):
            paragraph(column, context, "The mesh is no longer as this solve left it", 'ERROR')
        column.label(text=report.termination.replace('_', ' ').capitalize(), icon=icon)
        column.label(text=f"{report.iterations} iterations, {report.seconds:.2f} s")
        column.label(text=f"Wobble {report.score_before:.3g}\u00b0 \u2192 {report.score_after:.3g}\u00b0")
        column.label(text=f"Residual {report.residual_before:.3g} \u2192 {report.residual_after:.3g}")
        column.label(text=f"Largest move {report.moved()}")
        if report.fit:
            paragraph(column, context, report.fit, 'MOD_SHRINKWRAP')
        for note in report.notes.splitlines():
            paragraph(column, context, note, 'ERROR')
        keys = ob.data.shape_keys.key_blocks if ob.type == 'MESH' and ob.data.shape_keys is not None else {}
        if run.key in keys:
            self.layout.prop(keys[run.key], "value", text="Strength", slider=True)
        if run.operator and ob.type == 'MESH' and ob.mode == 'OBJECT' and run.difference(ob.data):
            paragraph(self.layout, context, run.difference(ob.data), 'ERROR')
        self.layout.operator("reflines.resolve", icon='FILE_REFRESH')
        self.layout.operator("reflines.store_result", icon='GROUP_VERTEX')


register, unregister = bpy.utils.register_classes_factory([
    VIEW3D_PT_reflines_setup, VIEW3D_PT_reflines_region, VIEW3D_PT_reflines_smooth, VIEW3D_PT_reflines_direction,
    VIEW3D_PT_reflines_untwist, VIEW3D_PT_reflines_warp, VIEW3D_PT_reflines_pattern, VIEW3D_PT_reflines_result])
