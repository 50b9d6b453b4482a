"""The last panels: the meshes that stripes were last drawn on. There they stay while light or camera is active."""
from collections.abc import Iterable

import bpy

from ..blender.app_handlers import forget_at_load
from ..read import scene_objects

_names: dict[str, tuple[str, ...]] = {}  # of the meshes, by the name of the scene


def remember_panels(scene: bpy.types.Scene, panels: Iterable[bpy.types.Object]) -> None:
    """Records the meshes as the last panels of the scene."""
    _names[scene.name] = tuple(ob.name for ob in panels)


def find_last_panels(scene: bpy.types.Scene, objects: bpy.types.bpy_prop_collection) -> list[bpy.types.Object]:
    """Returns the last panels of the scene among `objects`; where none is known, as after opening a file, the meshes on
    which a tool has run.
    """
    known = [objects[name] for name in _names.get(scene.name, ()) if name in objects]
    meshes = [ob for ob in known or objects if ob.type == 'MESH']
    return meshes if known else [ob for ob in meshes if ob.reflection_lines.report.termination]


def find_panel(context: bpy.types.Context) -> bpy.types.Object | None:
    """Returns the active mesh, else the last panel; None where there is neither."""
    ob = scene_objects.find_active_object(context)
    if ob is not None and ob.type == 'MESH':
        return ob
    return next(iter(find_last_panels(context.scene, context.view_layer.objects)), None)


register, unregister = forget_at_load(_names.clear)
