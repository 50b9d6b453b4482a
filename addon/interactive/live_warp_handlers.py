"""Handlers that keep live warps up to date: Blender calls them after every change, undo, redo and opened file.

None of them works in background Blender, where no timer would take the results; Apply solves there by itself.
"""
import bpy
from bpy.app.handlers import persistent

from ..blender.app_handlers import add_app_handlers, remove_app_handlers
from ..view import view_region
from .live_warp import LiveWarp

TICK_INTERVAL = 0.01  # seconds between two checks for results

_live_warps: dict[str, LiveWarp] = {}  # by the name of the scene


def has_work() -> bool:
    """Returns whether any live warp has something left to submit, to solve or to show."""
    return any(live.has_work() for live in _live_warps.values())


def find_live_warp(scene: bpy.types.Scene) -> LiveWarp | None:
    """Returns the scene's live warp, None where there is none."""
    return _live_warps.get(scene.name)


@persistent
def note_change(scene: bpy.types.Scene, _depsgraph: bpy.types.Depsgraph | None = None) -> None:
    """Checks the lattice after a change of the scene (depsgraph_update_post), and ends with a panel that was removed:
    another of its name would be taken for it.
    """
    if scene.reflection_lines.live.panel is not None:
        follow_lattice(scene)
    else:
        end_live_warp(scene)


@persistent
def note_step(*_: object) -> None:
    """Checks every scene after undo, redo and opening a file, when all may differ though the lattice does not."""
    for scene in bpy.data.scenes:
        if scene.reflection_lines.live.panel is not None:
            follow_lattice(scene, anew=True)
        else:
            end_live_warp(scene)


def follow_lattice(scene: bpy.types.Scene, *, anew: bool = False) -> None:
    """Lets the scene's live warp check its lattice, making one where the scene has none yet."""
    if bpy.app.background:
        return
    live = _live_warps.setdefault(scene.name, LiveWarp())
    live.stale |= anew
    live.check_lattice(scene)
    if not bpy.app.timers.is_registered(tick):
        bpy.app.timers.register(tick, first_interval=TICK_INTERVAL)


def end_live_warp(scene: bpy.types.Scene) -> None:
    """Ends the scene's live warp, if it has one."""
    live = _live_warps.pop(scene.name, None)
    if live is not None:
        live.stop()


def tick() -> float | None:
    """Takes the results; a timer that runs as long as one is at work."""
    for name in _live_warps.keys() - bpy.data.scenes.keys():
        _live_warps.pop(name).stop()
    more = [advance_live_warp(bpy.data.scenes[name], live) for name, live in list(_live_warps.items())]
    return TICK_INTERVAL if any(more) else None


def advance_live_warp(scene: bpy.types.Scene, live: LiveWarp) -> bool:
    if scene.reflection_lines.live.panel is None:  # a script has removed it
        end_live_warp(scene)
        return False
    more = live.advance(scene)
    if live.shown_text != live.describe_state():
        live.shown_text = live.describe_state()
        view_region.redraw_views(bpy.context)  # whose sidebars show the state
    return more


@persistent
def end_all_live_warps(*_: object) -> None:
    """Ends all live warps, before another file is opened and when the add-on is disabled."""
    while _live_warps:
        _live_warps.popitem()[1].stop()


LISTENERS = (("depsgraph_update_post", note_change), ("undo_post", note_step), ("redo_post", note_step),
             ("load_post", note_step))


def register() -> None:
    add_app_handlers(LISTENERS)
    # Before the optimizer cache is cleared: a live warp that ends gives its optimizer back to it.
    bpy.app.handlers.load_pre.insert(0, end_all_live_warps)


def unregister() -> None:
    bpy.app.handlers.load_pre.remove(end_all_live_warps)
    remove_app_handlers(LISTENERS)
    if bpy.app.timers.is_registered(tick):
        bpy.app.timers.unregister(tick)
    end_all_live_warps()
