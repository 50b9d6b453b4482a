"""Objects of the scene: those that operators work on, and the collection that new ones go to."""
import bpy

from ..model.refusal import Refusal
from . import region_faces


def contains_object(objects: bpy.types.bpy_prop_collection, ob: bpy.types.Object) -> bool:
    """Returns whether the object is in the collection.

    It is looked up by name first; an object of this file and one linked from another may have the same name.
    """
    found = objects.get(ob.name)
    return found == ob or found is not None and any(other == ob for other in objects)


def find_editable_collection(context: bpy.types.Context) -> bpy.types.Collection:
    """Returns the active collection; the scene's own where the active one belongs to another file."""
    active = context.collection
    foreign = active.library is not None or active.override_library is not None
    return context.scene.collection if foreign else active


def read_active_object(context: bpy.types.Context) -> bpy.types.Object | None:
    """Returns the active object: of an override of the context where a script has given one, else of the view layer,
    which alone is known where there is no window.
    """
    return getattr(context, "active_object", None) or context.view_layer.objects.active


def allow(operator: type[bpy.types.Operator], obstacle: str) -> bool:
    """Returns whether nothing keeps an operator from running; sets the message that says what does."""
    operator.poll_message_set(obstacle)
    return not obstacle


def has_panel(operator: type[bpy.types.Operator], context: bpy.types.Context) -> bool:
    """Returns whether the active object is a mesh to look at; sets the message that says why not."""
    ob = read_active_object(context)
    operator.poll_message_set("Make a panel's mesh active, in Edit Mode or Object Mode")
    return ob is not None and ob.type == 'MESH' and ob.mode in {'EDIT', 'OBJECT'}


def find_active_object(context: bpy.types.Context) -> bpy.types.Object | None:
    """Returns the active object; for a warp lattice in Object Mode the mesh that it warps.

    In Edit Mode a lattice stands for itself: undo would take back the lattice only, and not the mesh.
    """
    ob = read_active_object(context)
    if ob is None or ob.type != 'LATTICE' or ob.mode != 'OBJECT':
        return ob
    panel = ob.reflection_lines.panel  # a deleted object can still be pointed at
    return panel if panel is not None and contains_object(context.view_layer.objects, panel) else ob


def find_subjects(context: bpy.types.Context) -> list[bpy.types.Object]:
    """Returns the objects that an operator works on: all meshes in Edit Mode with selected faces, else the active mesh.
    """
    chosen = find_active_object(context)
    if chosen is None or chosen.mode != 'EDIT':
        return [chosen]
    editing = list_edited_meshes(context)
    selected = [ob for ob in editing if ob.data.total_face_sel > 0]
    if not selected:
        raise Refusal(describe_empty_selection(editing))
    return selected


def find_partners(context: bpy.types.Context, ob: bpy.types.Object) -> list[bpy.types.Object]:
    """Returns the objects that were solved as one with this one in its last run; refuses where that was not the last
    run of one of them, too, or that is in another mode: moved alone a rim would leave the other.
    """
    own = ob.reflection_lines.run
    others = [name for name in own.list_joined() if name != ob.name]
    found = [context.view_layer.objects.get(name) for name in others]
    for name, other in zip(others, found, strict=True):
        if other is None or other.mode != ob.mode or not is_same_run(other.reflection_lines.run, own):
            raise Refusal(f"{ob.name} was moved as one with {name}, which has changed since or is in another mode: "
                          "select the faces of both in Edit Mode and run the tool there")
    return found


def is_same_run(one: bpy.types.PropertyGroup, other: bpy.types.PropertyGroup) -> bool:
    return all(getattr(one, name) == getattr(other, name) for name in ("operator", "settings", "joined"))


def list_edited_meshes(context: bpy.types.Context) -> list[bpy.types.Object]:
    """Returns the objects in Edit Mode, one for each mesh."""
    return list({ob.data: ob for ob in context.view_layer.objects if ob.mode == 'EDIT' and ob.type == 'MESH'}.values())


def has_selected_vertices(context: bpy.types.Context) -> bool:
    """Returns whether the active mesh is in Edit Mode and one of the edited meshes has selected vertices."""
    ob = read_active_object(context)
    return ob is not None and ob.type == 'MESH' and ob.mode == 'EDIT' and (
        ob.data.total_vert_sel > 0 or any(each.data.total_vert_sel > 0 for each in list_edited_meshes(context)))


def describe_empty_selection(editing: list[bpy.types.Object]) -> str:
    """Says that none of the edited meshes has a selected face."""
    loose = sum(ob.data.total_vert_sel for ob in editing)
    also = f" (the {loose} selected vertices span no face)" if loose else ""
    return f"No faces are selected{also}: select the faces of the panel"


def describe_unselected(ob: bpy.types.Object) -> str:
    """Says that an edited mesh has no selected face, and which of the others in Edit Mode have some."""
    others = [each.name for each in list_edited_meshes(bpy.context) if each.data.total_face_sel > 0]
    if not others:
        return describe_empty_selection([ob])
    return f"{ob.name} is active and has no selected faces: select some, or make {others[0]} active"


def explain_missing_region(context: bpy.types.Context, ob: bpy.types.Object) -> str:
    """Says why there are no faces that a tool could work on; empty where there are."""
    if ob.mode != 'EDIT':
        return "" if region_faces.has_stored_region(ob.data) else region_faces.describe_missing_region(ob)
    if ob.data.total_face_sel > 0:
        return ""
    editing = list_edited_meshes(context)
    return "" if any(each.data.total_face_sel > 0 for each in editing) else describe_empty_selection(editing)
