"""Objects of the scene: those that operators work on, and the collection that new ones go to."""
import bpy

from ..model.refusal import Refusal


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


def find_active_object(context: bpy.types.Context) -> bpy.types.Object | None:
    """Returns the active object; for a warp lattice in Object Mode the mesh that it warps.

    In Edit Mode a lattice stands for itself: undo would take back the lattice only, and not the mesh.
    """
    ob = context.view_layer.objects.active
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
    editing = {ob.data: ob for ob in context.view_layer.objects if ob.mode == 'EDIT' and ob.type == 'MESH'}
    selected = [ob for ob in editing.values() if ob.data.total_face_sel > 0]
    if not selected:
        loose = sum(ob.data.total_vert_sel for ob in editing.values())
        also = f" (the {loose} selected vertices span no face)" if loose else ""
        raise Refusal(f"No faces are selected{also}: select the faces of the panel")
    return selected
