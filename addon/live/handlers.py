"""When a live warp looks at its lattice: Blender tells of every change, undo, redo and opened file.

Nothing of it runs in the background, where no timer would show what the thread has: Apply solves there.
"""
import bpy
from bpy.app.handlers import persistent

from .. import session
from .follower import Follower

TICK = 0.01  # seconds between looks at what the thread has


@persistent
def changed(scene: bpy.types.Scene, _depsgraph: object = None) -> None:
    """Depsgraph: something in the scene was edited or moved."""
    if scene.reflection_lines.live.panel is not None:
        follow(scene)


@persistent
def stepped(*_: object) -> None:
    """Undo, redo, another file: all may differ, even where the lattice does not."""
    for scene in bpy.data.scenes:
        if scene.reflection_lines.live.panel is not None:
            follow(scene, anew=True)
        else:
            end(scene)


def follow(scene: bpy.types.Scene, *, anew: bool = False) -> None:
    if bpy.app.background:
        return
    follower = session.live_warps.setdefault(scene.name, Follower())
    follower.stale |= anew
    follower.look(scene)
    if not bpy.app.timers.is_registered(tick):
        bpy.app.timers.register(tick, first_interval=TICK)


def end(scene: bpy.types.Scene) -> None:
    follower = session.live_warps.pop(scene.name, None)
    if follower is not None:
        follower.stop()


def tick() -> float | None:
    """A timer as long as a thread is at work."""
    for name in session.live_warps.keys() - bpy.data.scenes.keys():
        session.live_warps.pop(name).stop()
    more = [advance(bpy.data.scenes[name], follower) for name, follower in list(session.live_warps.items())]
    return TICK if any(more) else None


def advance(scene: bpy.types.Scene, follower: Follower) -> bool:
    if scene.reflection_lines.live.panel is None:  # a script has removed it
        end(scene)
        return False
    more = follower.tick(scene)
    if follower.told != follower.says():
        follower.told = follower.says()
        redraw()
    return more


def redraw() -> None:
    """The sidebars tell what the live warp is doing."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == 'VIEW_3D':
                area.tag_redraw()


LISTENERS = (("depsgraph_update_post", changed), ("undo_post", stepped), ("redo_post", stepped), ("load_post", stepped))


def register() -> None:
    for name, function in LISTENERS:
        getattr(bpy.app.handlers, name).append(function)


def unregister() -> None:
    for name, function in LISTENERS:
        getattr(bpy.app.handlers, name).remove(function)
    if bpy.app.timers.is_registered(tick):
        bpy.app.timers.unregister(tick)
