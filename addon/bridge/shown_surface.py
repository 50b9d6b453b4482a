"""Describes what keeps a result from being seen as it is: custom normals, and other objects with the same mesh."""
import bpy


def describe_custom_normals(ob: bpy.types.Object) -> tuple[str, ...]:
    """Says that custom normals go on showing the old surface."""
    if not ob.data.has_custom_normals:
        return ()
    return (f"{ob.name} has custom normals, which go on showing the old reflections in Blender's shading: reset them",)


def describe_shared_mesh(ob: bpy.types.Object) -> tuple[str, ...]:
    """Says which other objects changed, since they have the same mesh."""
    others = [other.name for other in bpy.data.objects if other.data == ob.data and other != ob
              and other.users_collection]
    if not others:
        return ()
    named = ", ".join(others[:3]) + (f" and {len(others) - 3} more" if len(others) > 3 else "")
    return (f"The mesh is shared: {named} changed, too",)
