"""Reflection Lines: shape optimization of car panels through their reflection lines (Tosun et al., SGP 2007)."""
import importlib
from types import ModuleType

import bpy

bl_info = {
    "name": "Reflection Lines",
    "author": "The Reflection Lines authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Reflection",
    "description": "Remove dents and waves from car panels by their reflections",
    "category": "Mesh",
}

# Every module once, each after those that it imports: they are imported, reloaded and registered in this order, and
# unregistered backwards.
NAMES = (
    "library_copy", "native", "native_call",
    "model.same", "model.border", "model.beside", "model.check_table", "model.gain",
    "model.inspection", "model.looks", "model.surface",
    "model.creases", "model.line_curve", "model.mirror", "model.refusal", "model.triangulation", "model.orientation",
    "model.mesh_snapshot", "model.surroundings",
    "model.line_handle", "model.kept_handles", "model.line_run",
    "model.line_surface", "model.patch", "model.meeting", "model.region_patch", "model.cage",
    "model.view", "model.light_set", "model.solution", "model.joined_patch", "model.joined_cage",
    "model.steps", "model.canvas", "model.panel_picture", "model.film", "model.sheet",
    "targets.falloff", "targets.crossed", "targets.direction", "targets.fit", "targets.mirror_target",
    "targets.pattern", "targets.smooth", "targets.warp", "targets.line_handles",
    "blender.app_handlers", "blender.compat", "blender.tooltips", "blender.triangulate",
    "blender.units",
    "animation.baked_keys", "animation.handle_keys",
    "read.mesh_checks", "read.read_mesh", "read.border_segments", "read.modifiers", "read.read_edit_cage",
    "read.region_faces", "read.viewport_surface", "read.dense_mesh", "read.falloff_curve", "read.read_beside",
    "read.group_weights", "read.read_mirror", "read.scene_objects", "read.read_snapshot", "read.read_cage",
    "read.shape_keys", "read.gather", "read.image_pixels",
    "read.read_checked", "read.read_edges", "read.read_falloff", "read.shown_surface",
    "read.text_outlines",
    "read.unjoined_border", "read.viewport_cage",
    "view.shown_middles", "view.view_and_light", "view.facing", "view.light_angles", "view.light_arrow",
    "view.view_region",
    "view.places_beside", "view.read_light_set", "view.screen_surface", "view.view_camera",
    "write.keep_region", "write.result_key", "write.set_borders",
    "write.write_mesh", "write.live_warp_start", "write.png", "write.select_faces",
    "write.solve_record", "write.warp_lattice",
    "solver.panel_problem", "solver.build_native", "solver.read_solved", "solver.live_optimizer",
    "solver.rim_moves", "solver.gap_strip", "solver.joint_mirror", "solver.join_cages", "solver.join_panels",
    "solver.common_lines", "solver.limited_solve", "solver.remarks", "solver.native_notes",
    "solver.solve", "solver.automatic_smooth", "solver.joint_smooth", "solver.brush", "solver.brushed_cage",
    "solver.panel_check", "solver.shut_lines",
    "solver.panel_inspection",
    "ui.rows", "ui.automatic_values", "ui.tool_properties", "ui.stripe_properties",
    "ui.handle_properties", "ui.check_properties", "ui.inspection_properties", "ui.light_set_properties",
    "ui.properties",
    "state.compared", "state.last_checks", "state.last_looks",
    "state.last_panels", "state.optimizer_cache", "state.press_cache", "state.solve_history", "state.persistence",
    "background_work", "interactive.running_operators", "interactive.beside_blender", "interactive.check_job",
    "interactive.inspection_job", "interactive.drag_handles", "interactive.solve_job", "interactive.read_picture",
    "overlay.handle_marks", "overlay.tool_circle",
    "interactive.brush_stroke", "interactive.drag_input", "interactive.sweep", "interactive.drag",
    "interactive.line_build", "interactive.handle_history", "interactive.handle_tracing", "interactive.drawn_lines",
    "interactive.handle_texts",
    "interactive.line_drag", "interactive.handle_bake",
    "interactive.live_baseline", "interactive.live_warp", "interactive.live_warp_handlers",
    "overlay.stripes", "overlay.stripe_scene", "overlay.shown_objects", "ui.session_properties",
    "overlay.fitted_normals", "overlay.limit_surface", "overlay.shader", "overlay.solve_maps",
    "overlay.draw_cage", "overlay.legend",
    "overlay.draw", "overlay.surface_lines", "overlay.draw_borders", "overlay.draw_check",
    "operators.set_up", "operators.check",
    "operators.look_through", "operators.save_stripes_preset", "operators.solve_tool",
    "operators.add_warp_lattice", "operators.bake_handles",
    "operators.dragged_tool", "operators.direction", "operators.fair_brush",
    "operators.export_film", "operators.export_sheet", "operators.export_table", "operators.fit",
    "operators.inspect_panel", "operators.light_set", "operators.live_warp",
    "operators.pattern",
    "operators.pull_line",
    "operators.resolve", "operators.set_border", "operators.smooth", "operators.spots",
    "operators.sweep_light", "operators.sweep_view", "operators.warp",
    "ui.divider_gizmo", "ui.gizmos", "ui.handle_gizmos", "ui.keymaps", "ui.manual_links", "ui.menus", "ui.panels",
    "ui.handles_panel", "ui.check_panel", "ui.inspection_panel", "ui.light_set_panel",
    "ui.preferences", "ui.toolbar",
    "ui.stripe_presets", "ui.stripes_panel",
)
MODULES = [importlib.import_module(f"{__name__}.{name}") for name in NAMES]

if "REGISTERED_BEFORE" in globals():  # Blender reloads this file only; its parts must follow, in the same order.
    for module in MODULES:
        for name in [name for name in vars(module) if not name.startswith("__")]:  # a reload keeps what is gone
            delattr(module, name)
        importlib.reload(module)
REGISTERED_BEFORE = True
running_operators = importlib.import_module(f"{__name__}.interactive.running_operators")


def list_classes(module: ModuleType) -> list[type]:
    """Returns the classes of a module that Blender knows: operators, panels and the like, in their order."""
    return [kind for kind in vars(module).values() if isinstance(kind, type) and kind.__module__ == module.__name__
            and issubclass(kind, bpy.types.bpy_struct)]


def register() -> None:
    for module in MODULES:
        for kind in list_classes(module):
            bpy.utils.register_class(kind)
        if hasattr(module, "register"):
            module.register()


def unregister() -> None:
    for module in reversed(MODULES):
        if hasattr(module, "unregister"):
            module.unregister()
        for kind in reversed(list_classes(module)):
            running_operators.take_back(kind)
            bpy.utils.unregister_class(kind)
