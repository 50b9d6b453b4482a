"""Where what is added to a scene goes."""
import bpy


def editable_collection(context: bpy.types.Context) -> bpy.types.Collection:
    """The active collection; the scene's own where that one belongs to another file."""
    active = context.collection
    foreign = active.library is not None or active.override_library is not None
    return context.scene.collection if foreign else active
