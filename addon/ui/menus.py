"""The tools in Blender's menus, in its context menus, and in two pie menus: one presses them, the other drags them."""
import bpy

from . import rows

# (operator, icon), in the order of the work.
DESIGN = (("reflines.direction", 'ALIGN_JUSTIFY'), ("reflines.warp", 'MOD_LATTICE'), ("reflines.pattern", 'IMAGE_DATA'))
TOOLS = (("reflines.smooth", 'MOD_SMOOTH'), ("reflines.pull_line", 'VIEW_PAN'), ("reflines.fair_brush", 'BRUSH_DATA'),
         *DESIGN, ("reflines.fit", 'MOD_SHRINKWRAP'))
SETUP = (
    ("reflines.set_up", 'VIEW_CAMERA'), ("reflines.look_through", 'HIDE_OFF'),
    ("reflines.sweep_light", 'LIGHT_SUN'), ("reflines.sweep_view", 'ORIENTATION_GIMBAL'),
    ("reflines.add_warp_lattice", 'LATTICE_DATA'), ("reflines.live_warp", 'PLAY'),
)
BEFORE = "scene.reflection_lines.stripes.before"
DRAG_PIE = "VIEW3D_MT_reflines_drag_pie"


class VIEW3D_MT_reflines(bpy.types.Menu):
    bl_label = "Reflection Lines"

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        for name, icon in TOOLS:
            layout.operator(name, icon=icon)
        layout.menu("VIEW3D_MT_reflines_drag", icon='ARROW_LEFTRIGHT')
        layout.separator()
        for name, icon in SETUP:
            layout.operator(name, icon=icon)
        layout.operator("reflines.light_set", text="Light Set: Walk Around", icon='LIGHT')
        layout.operator_menu_enum("reflines.set_border", "border")
        layout.separator()
        stripes = context.scene.reflection_lines.stripes
        layout.prop(stripes, "show")
        layout.prop(stripes, "before")
        layout.prop_menu_enum(stripes, "mode")
        layout.operator("reflines.resolve", icon='FILE_REFRESH')
        layout.operator("reflines.bake_handles", icon='KEYTYPE_KEYFRAME_VEC')
        layout.operator("reflines.delete_handles", icon='X')
        layout.operator("reflines.check", icon='CHECKMARK')
        layout.operator("reflines.inspect", icon='VIEWZOOM')
        layout.operator("reflines.show_spot", icon='FRAME_NEXT')
        layout.menu("VIEW3D_MT_reflines_export", icon='EXPORT')


class VIEW3D_MT_reflines_export(bpy.types.Menu):
    bl_label = "Export"

    def draw(self, _context: bpy.types.Context) -> None:
        """Draws an entry for each file that can be written."""
        layout = self.layout
        layout.operator("reflines.export_table", text="Export Table of Check")
        layout.operator("reflines.export_table", text="Export Table of Spots").table = 'SPOTS'
        layout.operator("reflines.export_sheet")
        layout.operator("reflines.export_film")


def draw_drags(layout: bpy.types.UILayout) -> None:
    """Draws an entry for each tool that starts its drag, and those that are always dragged."""
    layout.operator("reflines.smooth", text="Drag Smooth Lines", icon='MOD_SMOOTH').follow_mouse = True
    rows.draw_hands(layout)
    for name, icon in DESIGN:
        label = getattr(bpy.ops.reflines, name.partition(".")[2]).get_rna_type().name
        layout.operator(name, text=f"Drag {label}", icon=icon).follow_mouse = True


class VIEW3D_MT_reflines_drag(bpy.types.Menu):
    bl_label = "Drag a Tool"

    def draw(self, _context: bpy.types.Context) -> None:
        draw_drags(self.layout)


class VIEW3D_MT_reflines_drag_pie(bpy.types.Menu):
    bl_label = "Drag a Tool"

    def draw(self, _context: bpy.types.Context) -> None:
        draw_drags(self.layout.menu_pie())


class VIEW3D_MT_reflines_pie(bpy.types.Menu):
    bl_label = "Reflection Lines"

    def draw(self, context: bpy.types.Context) -> None:
        """Fills the slots in Blender's order: west, east, south, north, then the corners."""
        pie = self.layout.menu_pie()
        stripes = context.scene.reflection_lines.stripes
        pie.operator("reflines.smooth", icon='MOD_SMOOTH')
        pie.operator("reflines.pull_line", icon='VIEW_PAN')
        pie.prop(stripes, "show", icon='SHADING_RENDERED')
        pie.operator("wm.context_toggle", text="Compare with Before", icon='MOD_MIRROR').data_path = BEFORE
        pie.operator("reflines.fair_brush", icon='BRUSH_DATA')
        pie.operator("reflines.pull_line", text="Draw Highlight", icon='GREASEPENCIL').draws = True
        pie.operator("reflines.sweep_light", icon='LIGHT_SUN')
        pie.operator("wm.call_menu_pie", text="Drag a Tool", icon='ARROW_LEFTRIGHT').name = DRAG_PIE


def draw_entry(self: bpy.types.Menu, _context: bpy.types.Context) -> None:
    self.layout.separator()
    self.layout.menu("VIEW3D_MT_reflines", icon='SHADING_RENDERED')


PLACES = ("VIEW3D_MT_edit_mesh", "VIEW3D_MT_edit_mesh_context_menu", "VIEW3D_MT_object",
          "VIEW3D_MT_object_context_menu")


def register() -> None:
    for place in PLACES:
        getattr(bpy.types, place).append(draw_entry)


def unregister() -> None:
    for place in PLACES:
        getattr(bpy.types, place).remove(draw_entry)
