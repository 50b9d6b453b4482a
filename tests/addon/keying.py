"""What tests of handles share: a panel, a pulled line, keys of its handle, and what Re-solve makes of them."""
import json

import bpy
import numpy as np
from mathutils import Matrix

import scenes
from reflection_lines.blender import compat

UP = {"start": (0.1, 0.0, 0.0), "end": (0.1, 0.09375, 0.0), "radius": 0.5, "pinned": [], "muted": False}
LOW = {**UP, "end": (0.1, 0.0625, 0.0)}


def fresh() -> bpy.types.Object:
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    return scenes.edited_panel(cells=32, height=scenes.crown)


def mirror_half(ob: bpy.types.Object) -> None:
    """Makes the panel one half below a Mirror modifier; its faces at the seam are selected, those at the rim not."""
    scenes.object_mode()
    ob.data.transform(Matrix.Translation((1.0, 0.0, 0.0)))
    ob.modifiers.new("Mirror", 'MIRROR')
    scenes.edit(ob)
    scenes.select_faces(ob, lambda face: face % 32 < 31 and 0 < face // 32 < 31)


def pull(*handles: dict, **settings: object) -> set[str]:
    return bpy.ops.reflines.pull_line('EXEC_DEFAULT', True, handles=json.dumps(handles), **settings)


def kept(ob: bpy.types.Object, index: int = 0) -> bpy.types.PropertyGroup:
    return ob.reflection_lines.handles.kept[index]


def key(ob: bpy.types.Object, frame: float, place: tuple, index: int = 0) -> None:
    own = kept(ob, index)
    own.place = place
    own.keyframe_insert("place", frame=frame)


def keyed(ob: bpy.types.Object, **settings: object) -> bpy.types.Object:
    """A handle that moves from UP in frame 1 to LOW in frame 11; in Object Mode."""
    assert pull(UP, **settings) == {'FINISHED'}
    scenes.object_mode()
    key(ob, 1, UP["end"])
    key(ob, 11, LOW["end"])
    return ob


def resolved(frame: float) -> np.ndarray:
    """What Re-solve makes in a frame."""
    bpy.context.scene.frame_set(int(frame), subframe=frame % 1.0)
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True) == {'FINISHED'}
    return scenes.positions(bpy.context.view_layer.objects.active)


def curves(ob: bpy.types.Object) -> dict[tuple[str, int], list[float]]:
    """The values of the keys of handles, by the path of each F-curve."""
    found = compat.find_action_curves(ob.animation_data) if ob.animation_data is not None else ()
    return {(each.data_path, each.array_index): [point.co.y for point in each.keyframe_points] for each in found}


def path(index: int, name: str = "place") -> str:
    return f"reflection_lines.handles.kept[{index}].{name}"
