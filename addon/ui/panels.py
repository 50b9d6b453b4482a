"""The panels of the sidebar tab "Reflection": first Smooth Lines with its button, below it the result, and folded what
is set up once (stripes, in stripes_panel.py, view and light, region), and the other tools.
"""
import re
import textwrap

import bpy

from ..model.border import name_border
from . import automatic_values, rows


BIG = 1.5  # height of the one button to press, in rows
UNITS = ("km", "m", "cm", "mm", "\u00b5m", "mi", "ft", "in", "thou")
ENDED = {"converged", "already_optimal"}  # how a solve ends that found the best shape


# Spaces at which no line ends: before a unit, and on both sides of an arrow.
HELD_SPACE = re.compile(rf"(?<=\d) (?=(?:{'|'.join(UNITS)})\b)| (?=\u2192)|(?<=\u2192) ")


def draw_paragraph(layout: bpy.types.UILayout, context: bpy.types.Context, text: str, icon: str) -> None:
    """Draws a sentence over as many lines as the sidebar's width needs."""
    letters = max(20, int((context.region.width - 60) / (6.5 * context.preferences.system.ui_scale)))
    column = layout.column(align=True)
    for number, line in enumerate(textwrap.wrap(HELD_SPACE.sub("\u00a0", text), letters)):
        column.label(text=line, icon='BLANK1' if number else icon)


class ReflinesPanel:
    """The base of all panels of the tab."""
    bl_space_type = 'VIEW_3D'
    bl_region_type = 'UI'
    bl_category = "Reflection"
    bl_order = 3  # this decides before the order of registration
    bl_options = {'DEFAULT_CLOSED'}


class VIEW3D_PT_reflines_setup(ReflinesPanel, bpy.types.Panel):
    bl_label = "View and Light"

    def draw(self, context: bpy.types.Context) -> None:
        settings = context.scene.reflection_lines
        column = self.layout.column()
        row = column.row(align=True)
        row.prop(settings, "camera", text="", icon='CAMERA_DATA')
        if settings.picture_camera() is not None:
            through = context.window_manager.reflection_lines.is_looking_through(context)
            row.operator("reflines.look_through", text="", icon='HIDE_OFF', depress=through)
            row.operator("reflines.set_up", text="", icon='ADD').part = 'CAMERA'
        column.operator("reflines.set_up", icon='VIEW_CAMERA')
        column.operator("reflines.sweep_view", icon='ORIENTATION_GIMBAL')
        ob = context.view_layer.objects.active
        if ob is not None and ob.reflection_lines.has_other_view(context.scene):
            column.operator("reflines.set_up", text="View of This Panel", icon='LOOP_BACK').part = 'PANEL'
        if settings.is_perspective():
            draw_paragraph(column, context, "Perspective camera: its direction to the panel's centre is used", 'INFO')
        self.draw_unfollowed(column, context, settings.camera)
        column = self.layout.column()
        column.prop(settings, "light", text="", icon='EMPTY_SINGLE_ARROW')
        self.draw_unfollowed(column, context, settings.light)
        if not settings.present(settings.light):
            column.operator("reflines.set_up", text="Add Light Direction", icon='ADD').part = 'LIGHT'
        else:
            self.draw_light(column, settings)

    def draw_unfollowed(self, layout: bpy.types.UILayout, context: bpy.types.Context,
                        ob: bpy.types.Object | None) -> None:
        said = context.scene.reflection_lines.describe_unfollowed(ob)
        if said:
            draw_paragraph(layout, context, said, 'ERROR')

    def draw_light(self, layout: bpy.types.UILayout, settings: bpy.types.PropertyGroup) -> None:
        row = layout.row()
        row.enabled = not settings.explain_fixed_light()
        row.prop(settings, "light_dial", text="")
        column = row.column(align=True)
        column.prop(settings, "light_turn")
        column.prop(settings, "light_tilt")


class VIEW3D_PT_reflines_region(ReflinesPanel, bpy.types.Panel):
    bl_label = "Region"

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        layout.label(text=self.region_text(context.view_layer.objects.active), icon='FACESEL')
        layout.use_property_split, layout.use_property_decorate = True, False
        settings = context.scene.reflection_lines
        layout.prop(settings, "result")
        automatic_values.draw_value(layout, settings, "limit")
        layout.prop(settings, "border")
        ob = context.view_layer.objects.active
        if ob is not None and ob.type == 'MESH':
            self.draw_borders(layout, settings)
            layout.prop(ob.reflection_lines, "limit_side")
            layout.prop_search(ob.reflection_lines, "limit_group", ob, "vertex_groups")
            layout.prop(ob.reflection_lines, "creases")
        if ob is not None and ob.reflection_lines.is_cage():
            layout.operator("reflines.fit", icon='MOD_SHRINKWRAP')

    def draw_borders(self, layout: bpy.types.UILayout, settings: bpy.types.PropertyGroup) -> None:
        head = layout.row(align=True)
        head.label(text="Border of the Selected")
        head.prop(settings, "show_borders", text="", icon='HIDE_OFF' if settings.show_borders else 'HIDE_ON')
        head.operator("reflines.set_border", text="", icon='X').border = 'unset'
        grid = layout.grid_flow(row_major=True, columns=2, even_columns=True, align=True)
        for name in ("follow", "flow", "curvature", "clamped", "fixed", "free"):
            grid.operator("reflines.set_border", text=name_border(name)).border = name

    def region_text(self, ob: bpy.types.Object | None) -> str:
        if ob is not None and ob.type == 'LATTICE' and ob.reflection_lines.panel is not None:
            return f"Faces of {ob.reflection_lines.panel.name}"
        if ob is None or ob.type != 'MESH':
            return "Make the panel's mesh active"
        if ob.mode == 'EDIT':
            return f"{ob.data.total_face_sel} selected faces"
        return "Faces of the last run" if ob.reflection_lines.report.termination else "Select faces in Edit Mode"


class ToolPanel(ReflinesPanel):
    """The base of panels with the settings and the button of one tool."""

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.use_property_split, self.layout.use_property_decorate = True, False
        self.draw_tool(self.layout, context, context.scene.reflection_lines)

    def draw_buttons(self, layout: bpy.types.UILayout, name: str, icon: str) -> None:
        """Draws the button of a tool, and beside it the handle that drags the tool in the 3D view."""
        row = layout.row(align=True)
        row.operator(name, icon=icon)
        row.operator(name, text="", icon='ARROW_LEFTRIGHT').follow_mouse = True

    def draw_falloff(self, layout: bpy.types.UILayout, settings: bpy.types.PropertyGroup,
                     curve: bpy.types.NodeTree | None) -> None:
        layout.prop(settings, "centre")
        if settings.centre == 'EVERYWHERE':
            return
        automatic_values.draw_value(layout, settings, "radius")
        layout.prop(settings, "shape")
        if settings.shape == 'CURVE' and curve is not None and len(curve.nodes):
            layout.template_curve_mapping(curve.nodes[0], "mapping")


class VIEW3D_PT_reflines_smooth(ToolPanel, bpy.types.Panel):
    bl_label = "Smooth Lines"
    bl_order = 0
    bl_options = set()

    def draw_tool(self, layout: bpy.types.UILayout, context: bpy.types.Context,
                  settings: bpy.types.PropertyGroup) -> None:
        self.draw_problem(layout, context)
        is_set_up = not settings.missing()
        if not is_set_up:
            self.draw_first_steps(layout, context)
        row = layout.row(align=True)
        row.scale_y = BIG
        if not is_set_up:
            row.operator("reflines.set_up", icon='VIEW_CAMERA')
            return
        row.operator("reflines.smooth", icon='MOD_SMOOTH')
        row.operator("reflines.smooth", text="", icon='ARROW_LEFTRIGHT').follow_mouse = True
        layout.prop(settings, "strength")
        self.draw_hands(layout)

    def draw_first_steps(self, layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
        """Draws what an artist does before the first press, as far as it is not done."""
        ob = context.view_layer.objects.active
        if ob is None or ob.type != 'MESH' or ob.mode != 'EDIT' or not ob.data.total_face_sel:
            draw_paragraph(layout, context, "Select the panel's faces in Edit Mode", 'FACESEL')
        draw_paragraph(layout, context, "Turn the view until they face you", 'ORIENTATION_VIEW')

    def draw_hands(self, layout: bpy.types.UILayout) -> None:
        """Draws what is done by hand where the press has left something."""
        hands = layout.column(align=True)
        rows.draw_hands(hands)
        hands.operator("reflines.sweep_light", icon='LIGHT_SUN')

    def draw_problem(self, layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
        session = context.window_manager.reflection_lines
        if session.problem:
            box = layout.box()
            box.alert = True
            draw_paragraph(box, context, session.problem, 'ERROR')
            draw_paragraph(box, context, session.remedy, 'BLANK1')


class VIEW3D_PT_reflines_smooth_settings(ToolPanel, bpy.types.Panel):
    bl_label = "Settings"
    bl_parent_id = "VIEW3D_PT_reflines_smooth"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return not context.scene.reflection_lines.missing()

    def draw_tool(self, layout: bpy.types.UILayout, _: bpy.types.Context, settings: bpy.types.PropertyGroup) -> None:
        settings.draw_smooth(layout, automatic_values.draw_value)
        layout.prop(settings, "lights")


class VIEW3D_PT_reflines_pull(ToolPanel, bpy.types.Panel):
    bl_label = "Pull Line"

    def draw_tool(self, layout: bpy.types.UILayout, context: bpy.types.Context,
                  settings: bpy.types.PropertyGroup) -> None:
        own = settings.pull
        automatic_values.draw_value(layout, own, "radius")
        ob = context.view_layer.objects.active
        if ob is not None and ob.type == 'MESH':
            layout.prop_search(ob.reflection_lines, "follow_group", ob, "vertex_groups")


class VIEW3D_PT_reflines_brush(ToolPanel, bpy.types.Panel):
    bl_label = "Fair Brush"

    def draw_tool(self, layout: bpy.types.UILayout, _: bpy.types.Context, settings: bpy.types.PropertyGroup) -> None:
        own = settings.brush
        layout.prop(own, "size")
        layout.prop(own, "strength")
        automatic_values.draw_value(layout, settings, "length")


class VIEW3D_PT_reflines_design(ReflinesPanel, bpy.types.Panel):
    """The tools that give lines another course than a smoother one of their own, each in a panel within."""
    bl_label = "Design Lines"

    def draw(self, _context: bpy.types.Context) -> None:
        """Draws nothing beside the panels within."""


class VIEW3D_PT_reflines_direction(ToolPanel, bpy.types.Panel):
    bl_label = "Direction and Density"
    bl_parent_id = "VIEW3D_PT_reflines_design"

    def draw_tool(self, layout: bpy.types.UILayout, _: bpy.types.Context, settings: bpy.types.PropertyGroup) -> None:
        own = settings.direction
        layout.prop(own, "direction")
        if own.direction in {'PRESENT', 'ANGLE'}:
            layout.prop(own, "angle")
        layout.prop(own, "density", text="Density" if own.axis == 'NONE' else "At the Start")
        layout.prop(own, "axis")
        if own.axis != 'NONE':
            layout.prop(own, "density_end")
        if own.direction != 'PRESENT':
            layout.prop(own, "strength")
        self.draw_falloff(layout, own, settings.curve)
        self.draw_buttons(layout, "reflines.direction", 'ALIGN_JUSTIFY')


class VIEW3D_PT_reflines_warp(ToolPanel, bpy.types.Panel):
    bl_label = "Warp Lines"
    bl_parent_id = "VIEW3D_PT_reflines_design"

    def draw_tool(self, layout: bpy.types.UILayout, context: bpy.types.Context,
                  settings: bpy.types.PropertyGroup) -> None:
        own = settings.warp
        layout.prop(own, "lattice")
        layout.operator("reflines.add_warp_lattice", icon='ADD')
        rows.draw_choice(layout, own, "fit")
        layout.prop(own, "amount")
        if settings.live.panel is not None:
            self.draw_live(layout.box(), context, settings.live)
            return
        layout.operator("reflines.live_warp", icon='PLAY')
        if context.mode == 'EDIT_LATTICE':
            draw_paragraph(layout, context, "Leave the lattice's Edit Mode to warp", 'INFO')
        self.draw_buttons(layout, "reflines.warp", 'MOD_LATTICE')

    def draw_live(self, layout: bpy.types.UILayout, context: bpy.types.Context, live: bpy.types.PropertyGroup) -> None:
        says = context.window_manager.reflection_lines.live
        draw_paragraph(layout, context, f"{live.panel_name()} follows the lattice", 'PLAY')
        if says:
            draw_paragraph(layout, context, says, 'INFO')
        row = layout.row(align=True)
        row.operator("reflines.live_warp", text="Apply", icon='CHECKMARK').action = 'APPLY'
        row.operator("reflines.live_warp", text="Discard", icon='CANCEL').action = 'DISCARD'


class VIEW3D_PT_reflines_pattern(ToolPanel, bpy.types.Panel):
    bl_label = "Image Pattern"
    bl_parent_id = "VIEW3D_PT_reflines_design"

    def draw_tool(self, layout: bpy.types.UILayout, _: bpy.types.Context, settings: bpy.types.PropertyGroup) -> None:
        own = settings.pattern
        layout.template_ID(own, "image", new="image.new", open="image.open")
        rows.draw_choice(layout, own, "fit")
        for name in ("strength", "blur"):
            layout.prop(own, name)
        automatic_values.draw_value(layout, own, "width")
        layout.prop(own, "angle")
        layout.prop(own, "offset")
        self.draw_buttons(layout, "reflines.pattern", 'IMAGE_DATA')


class VIEW3D_PT_reflines_result(ReflinesPanel, bpy.types.Panel):
    bl_label = "Result"
    bl_order = 1
    bl_options = set()

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = context.view_layer.objects.active
        return ob is not None and ob.reflection_lines.report.termination != ""

    def draw(self, context: bpy.types.Context) -> None:
        ob = context.view_layer.objects.active
        report, run = ob.reflection_lines.report, ob.reflection_lines.run
        column = self.layout.column(align=True)
        good = report.termination in ENDED and not report.remedy
        if context.window_manager.reflection_lines.is_undone(ob):
            draw_paragraph(column, context, "Undone: the mesh is no longer as the last solve left it", 'LOOP_BACK')
            self.layout.operator("reflines.resolve", icon='FILE_REFRESH')
            return
        draw_paragraph(column, context, report.headline(), 'CHECKMARK' if good else 'INFO')
        self.layout.prop(context.scene.reflection_lines.stripes, "before", toggle=True, icon='MOD_MIRROR')
        if ob.type == 'MESH':
            self.draw_mesh_remedies(ob, report)  # above the notes, which would push them out of a low window
        column = self.layout.column(align=True)
        for note in report.notes.splitlines():
            draw_paragraph(column, context, note, 'INFO' if good else 'ERROR')
        keys = ob.data.shape_keys.key_blocks if ob.type == 'MESH' and ob.data.shape_keys is not None else {}
        if run.key in keys:
            self.layout.prop(keys[run.key], "value", text="Strength", slider=True)
        if run.operator and ob.type == 'MESH' and ob.mode == 'OBJECT' and run.difference(ob.data):
            draw_paragraph(self.layout, context, run.difference(ob.data), 'ERROR')
        if report.remedy and run.operator:
            remedy = self.layout.operator("reflines.resolve", text=f"Solve with Border {name_border(report.remedy)}")
            remedy.border = report.remedy
        limit = 2.0 * (report.automatic_limit or run.read_length("limit"))
        if report.limited and limit and bpy.ops.reflines.resolve.poll():
            shown = run.format_length(limit)
            self.layout.operator("reflines.resolve", text=f"Solve with Limit {shown}").limit = limit
        if report.worse:
            self.layout.operator("reflines.show_spot", text="Show Worse Place", icon='VIEWZOOM').worse = True
        if report.longer_waves and run.operator:
            self.layout.operator("reflines.resolve", text="Take Longer Waves Too").flaw_size = 2.0
        self.layout.operator("reflines.resolve", icon='FILE_REFRESH')

    def draw_mesh_remedies(self, ob: bpy.types.Object, report: bpy.types.PropertyGroup) -> None:
        """Draws the buttons of Blender for what is wrong with the mesh itself."""
        if ob.data.has_custom_normals:
            self.layout.operator("mesh.customdata_custom_splitnormals_clear", text="Reset Custom Normals")
        if ob.data.users - ob.data.use_fake_user > 1:
            single = self.layout.operator("object.make_single_user", text="Make Single User")
            single.type, single.object, single.obdata = 'SELECTED_OBJECTS', False, True
        if report.merge_distance and ob.mode == 'EDIT':
            merge = self.layout.operator("mesh.remove_doubles", text="Merge by Distance")
            merge.threshold, merge.use_unselected = report.merge_distance, True
        if report.rounding and ob.mode == 'OBJECT':
            self.layout.operator("object.origin_set", text="Origin to Geometry").type = 'ORIGIN_GEOMETRY'


class ResultPart(ReflinesPanel):
    """The base of folded panels within the result."""
    bl_parent_id = "VIEW3D_PT_reflines_result"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return VIEW3D_PT_reflines_result.poll.__func__(cls, context)


class VIEW3D_PT_reflines_kept(ResultPart, bpy.types.Panel):
    """The list of what in the region was left as it is: fillets, edges, the hidden side."""
    bl_label = "Kept"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not super().poll(context):
            return False
        report = context.view_layer.objects.active.reflection_lines.report
        return report.kept != "" or report.healed

    def draw(self, context: bpy.types.Context) -> None:
        report = context.view_layer.objects.active.reflection_lines.report
        column = self.layout.column(align=True)
        for sentence in report.kept.splitlines():
            draw_paragraph(column, context, sentence, 'DOT')
        if report.healed:
            row = self.layout.row(align=True)
            for mode, name in (('REFLECTION', "Stripes"), ('VERDICT', "By Place")):
                row.prop_enum(context.scene.reflection_lines.stripes, "mode", mode, text=name)


class VIEW3D_PT_reflines_numbers(ResultPart, bpy.types.Panel):
    bl_label = "Numbers"

    def draw(self, context: bpy.types.Context) -> None:
        report = context.view_layer.objects.active.reflection_lines.report
        column = self.layout.column(align=True)
        column.label(text=f"Line deviation {report.score_before:.2g}\u00b0 \u2192 {report.score_after:.2g}\u00b0")
        column.label(text=f"Turn {report.turn_before:.2g}\u00b0 \u2192 {report.turn_after:.2g}\u00b0")
        column.label(text=f"at length {report.measured_length()}")
        if report.termination not in ENDED:
            draw_paragraph(column, context, "The solver stopped before the best shape", 'INFO')
