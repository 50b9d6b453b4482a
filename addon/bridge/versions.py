"""All that differs between Blender 3.4, 4.3 and 5.2 in what this add-on uses."""
import bpy


def shape_is_locked(key: bpy.types.ShapeKey) -> bool:
    """Shape keys can be locked from Blender 4.2 on."""
    return getattr(key, "lock_shape", False)
