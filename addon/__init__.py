"""Reflection Lines: shape optimization of car panels through their reflection lines (Tosun et al., SGP 2007).

Modules stand in the order of their dependencies; `register` walks the list forwards, `unregister` backwards.
"""
import importlib

from . import native, worker
from .targets import falloff, smooth as smooth_target, direction as direction_target, untwist as untwist_target
from .targets import mirrored, warp as warp_target, pattern as pattern_target, fit as fit_target
from .bridge import refusal, contents, units, versions, view, region, mirror, gather, modifiers, cage, keys, apply
from .bridge import surface, dense, shown_cage, environment, matcap
from .bridge import panels as bridge_panels, lattice, start, record, picture, place, curve
from . import tool_settings, stripe_settings, properties, solving, session, saved, tool
from .overlay import circle
from .drag import motion, pursuit, modal
from .live import scene as live_scene, follower, handlers
from .overlay import stripes, shader, normals, last_solve, limit, seen, draw
from .operators import add_light_direction, add_view_camera, add_warp_lattice
from .operators import direction, fit, live_warp, pattern, pick_direction, resolve, smooth, store_result, untwist
from .operators import warp
from .operators import stripes as stripes_operators, install_matcap
from . import keymaps, preferences, panels, stripes_panel, menus

bl_info = {
    "name": "Reflection Lines",
    "author": "The Reflection Lines authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Reflection",
    "description": "Optimize the shape of a panel through its reflection lines",
    "category": "Mesh",
}

MODULES = (native, worker, falloff, smooth_target, direction_target, untwist_target, mirrored, warp_target,
           pattern_target, fit_target, refusal, contents, units, versions, view, region, mirror, gather, modifiers,
           cage, keys, apply, surface, dense, shown_cage, environment, matcap, bridge_panels, lattice, start, record,
           picture, place, curve, tool_settings, stripe_settings, properties, solving, session, saved, tool, circle,
           motion, pursuit, modal, live_scene, follower, handlers, stripes, shader, normals, last_solve, limit, seen,
           draw, add_light_direction, add_view_camera, add_warp_lattice, direction, pattern, pick_direction, smooth,
           fit, resolve, store_result, untwist, warp, live_warp, stripes_operators, install_matcap, menus, keymaps,
           preferences, panels, stripes_panel)

if "REGISTERED_BEFORE" in globals():  # Blender reloads this file only; its parts must follow, in the same order.
    for module in MODULES:
        importlib.reload(module)
REGISTERED_BEFORE = True


def register() -> None:
    for module in MODULES:
        if hasattr(module, "register"):
            module.register()


def unregister() -> None:
    for module in reversed(MODULES):
        if hasattr(module, "unregister"):
            module.unregister()
