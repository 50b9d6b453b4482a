"""The last looks: how each 3D view looked before Look Through. They are forgotten when a file is opened."""
from dataclasses import dataclass, replace

import bpy

from ..blender.app_handlers import forget_at_load


@dataclass(frozen=True)
class Look:
    """A look of a 3D view: whether it was through a camera, and the name of its local one, empty where it had none."""
    through: bool
    local: str


_looks: dict[int, Look] = {}  # by the address of the 3D view


def remember_look(space: bpy.types.SpaceView3D, camera: bpy.types.Object) -> None:
    """Records how a 3D view looks before it looks through the view camera."""
    through = space.region_3d.view_perspective == 'CAMERA'
    local = space.camera if space.use_local_camera else None
    key = space.as_pointer()
    if local == camera and key in _looks:  # it was turned away since the last press, and still has that camera
        _looks[key] = replace(_looks[key], through=through)
    else:
        _looks[key] = Look(through, local.name if local is not None and local != camera else "")


def take_look(space: bpy.types.SpaceView3D) -> Look:
    """Returns how a 3D view looked before, and forgets it; where that is not known, through no camera."""
    return _looks.pop(space.as_pointer(), Look(through=False, local=""))


register, unregister = forget_at_load(_looks.clear)
