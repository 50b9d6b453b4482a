"""What is in a scene, and where what is added to it goes."""
import bpy


def holds(objects: bpy.types.bpy_prop_collection, ob: bpy.types.Object) -> bool:
    """Whether it is among the objects. By name, since that is looked up; but one of the file and one linked from
    another may have the same name."""
    found = objects.get(ob.name)
    return found == ob or found is not None and any(other == ob for other in objects)


def editable_collection(context: bpy.types.Context) -> bpy.types.Collection:
    """The active collection; the scene's own where that one belongs to another file."""
    active = context.collection
    foreign = active.library is not None or active.override_library is not None
    return context.scene.collection if foreign else active
