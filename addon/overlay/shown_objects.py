"""The meshes that stripes are drawn on in a 3D view, and why none are where that is so."""
import bpy
import numpy as np

from ..model.refusal import Refusal
from ..read import scene_objects
from ..state import last_panels, solve_history
from ..view import view_and_light
from . import stripe_scene, stripes

MODES = {'OBJECT', 'EDIT', 'SCULPT', 'VERTEX_PAINT', 'WEIGHT_PAINT', 'TEXTURE_PAINT'}


def find_shown_objects(context: bpy.types.Context, settings: bpy.types.PropertyGroup) -> list[bpy.types.Object]:
    """Returns the meshes to draw stripes on: the panels visible in this view."""
    return [ob for ob in find_panels(context, settings)
            if ob.mode in MODES and ob.visible_get(viewport=context.space_data)]


def find_panels(context: bpy.types.Context, settings: bpy.types.PropertyGroup) -> list[bpy.types.Object]:
    """Returns the meshes in scope; the last panels where the active or selected objects are light, camera and the like.
    """
    meshes = find_meshes_in_scope(context, settings)
    if meshes or settings.scope in {'COLLECTION', 'VISIBLE'}:
        return meshes
    return last_panels.find_last_panels(context.scene, context.view_layer.objects)


def find_meshes_in_scope(context: bpy.types.Context, settings: bpy.types.PropertyGroup) -> list[bpy.types.Object]:
    """Returns the meshes in scope, with the warped mesh in the place of a lattice."""
    found = dict.fromkeys(follow_lattice_to_mesh(context, ob) for ob in find_objects_in_scope(context, settings))
    return [ob for ob in found if ob is not None and ob.type == 'MESH']


def follow_lattice_to_mesh(context: bpy.types.Context, ob: bpy.types.Object | None) -> bpy.types.Object | None:
    """Returns the mesh that a warp lattice belongs to, else the object itself; a lattice can outlive its mesh."""
    panel = ob.reflection_lines.panel if ob is not None and ob.type == 'LATTICE' else None
    there = panel is not None and scene_objects.contains_object(context.view_layer.objects, panel)
    return panel if there else ob


def find_objects_in_scope(context: bpy.types.Context, settings: bpy.types.PropertyGroup) -> list[bpy.types.Object]:
    """Returns the objects of the chosen scope: all visible ones, collection, selection or active object."""
    layer = context.view_layer
    if settings.scope == 'VISIBLE':
        return [ob for ob in layer.objects if ob.visible_get(viewport=context.space_data)]
    if settings.scope == 'COLLECTION':
        wanted = set() if settings.collection is None else set(settings.collection.all_objects)
        return [ob for ob in layer.objects if ob in wanted]
    if settings.scope == 'SELECTION':
        editing = [ob for ob in layer.objects if ob.mode == 'EDIT']
        return editing or [ob for ob in layer.objects if ob.select_get()]
    return [layer.objects.active]


def explain_stripes(context: bpy.types.Context) -> str:
    """Says, in a sentence, why the stripes are not drawn in this view as they are set; empty where they are."""
    settings = context.scene.reflection_lines.stripes
    if not settings.show:
        return ""
    if not context.space_data.overlay.show_overlays:
        return "Overlays are off in this view: switch them on in its header"
    panels = find_panels(context, settings)
    shown = find_shown_objects(context, settings)
    if not shown:
        return explain_no_object(settings, panels)
    return explain_light(context.scene, shown[0]) or explain_object(shown[0]) or explain_solve(settings, shown)


def explain_solve(settings: bpy.types.PropertyGroup, shown: list[bpy.types.Object]) -> str:
    """Says why a map or the shape before is not drawn; empty where it is, or none is wanted."""
    changed = [ob.name for ob in shown if solve_history.is_changed(ob)]
    if not stripe_scene.needs_solution(settings):
        return ""
    if not changed:
        return explain_verdict(shown) if settings.mode == 'VERDICT' else ""
    what = "there is no map of it" if settings.mode in stripe_scene.MAPS else "the shape before is not shown"
    return f"{changed[0]} is no longer as its solve left it: {what}. Run the tool again"


def explain_verdict(shown: list[bpy.types.Object]) -> str:
    """Says why there is no verdict to draw: only a press of Smooth Lines without a length gives one."""
    found = [(ob.name, solve_history.find_last_solve(ob.name_full)) for ob in shown]
    lacking = [name for name, solution in found if solution is None or solution.verdict is None]
    return f"{lacking[0]}: there is no verdict of its last solve: press Smooth Lines" if lacking else ""


def explain_no_object(settings: bpy.types.PropertyGroup, panels: list[bpy.types.Object]) -> str:
    """Says why no mesh is shown; `panels` are those in scope."""
    if panels:
        return f"{', '.join(ob.name for ob in panels[:3])}: hidden in this view"
    if settings.scope == 'COLLECTION':
        return "Nothing to show: pick a collection with a mesh"
    if settings.scope == 'VISIBLE':
        return "Nothing to show: no mesh is visible"
    return "Nothing to show: make the panel's mesh active"


def explain_light(scene: bpy.types.Scene, ob: bpy.types.Object) -> str:
    """Says what the directions of view and light lack for stripes on an object."""
    settings = scene.reflection_lines
    if not settings.present(settings.light):
        return settings.describe_absent(settings.light) or (
            "No light direction: press Add Light Direction in View and Light")
    if settings.picture_camera() is None:
        return settings.describe_absent(settings.camera) or (
            "No view camera: the stripes are as this view sees them. Press Set Up from This View")
    center = np.array(view_and_light.measure_extent(ob)[0])
    try:
        view = view_and_light.build_view(settings.camera, settings.light, center)
    except Refusal as refusal:
        return str(refusal)
    parallel = stripes.compute_lights(view.view_direction, view.line_direction) is None
    return "The light points along the view, where no lines are seen: turn the light" if parallel else ""


def explain_object(ob: bpy.types.Object) -> str:
    """Says why stripes on a mesh are missing or old."""
    if ob.mode != 'EDIT' and not len(ob.data.polygons):
        return f"{ob.name} has no faces"
    if ob.mode == 'SCULPT' and ob.use_dynamic_topology_sculpting:
        return "Dyntopo is on: the stripes show the mesh as it was before"
    return ""
