"""The baseline of a live warp as the scene stores it: the mesh and its start, the lattice, view and light.

All of it is saved with the file and undone with it, and the shape of the mesh follows from it alone.
"""
from dataclasses import dataclass

import bpy
import numpy as np

from ..model.border import settle_border
from ..model.patch import Patch
from ..model.refusal import Refusal
from ..model.solution import SolveSettings
from ..model.view import View
from ..read import gather
from ..targets import crossed
from ..targets.warp import Warp
from ..view import facing, read_light_set, view_and_light
from ..write import live_warp_start, warp_lattice


class BaselineChanged(Refusal):
    """Refuses to go on with a live warp whose mesh or lattice was changed by something else; the mesh stays as it is.
    """


@dataclass(frozen=True)
class Baseline:
    """The data from which the optimizer of a live warp is built; `signs` are cheap to read and differ where it may have
    changed.
    """
    patch: Patch
    view: View
    border: str
    signs: tuple


def find_subject(scene: bpy.types.Scene) -> bpy.types.Object:
    """Returns the warped mesh object; refuses while it is in Edit Mode."""
    ob = scene.reflection_lines.live.panel
    if not scene.reflection_lines.present(ob):
        raise BaselineChanged(f"The panel {ob.name} is no longer in the scene: bring it back by undo, or discard the "
                              "live warp")
    if ob.type != 'MESH':
        raise BaselineChanged(f"The live warp of {ob.name} cannot go on, since that is no mesh: discard it")
    if ob.mode == 'EDIT':
        raise Refusal(f"The live warp waits while {ob.name} is in Edit Mode")
    return ob


def refuse_changed(ob: bpy.types.Object) -> None:
    """Refuses a mesh that was changed since the live warp wrote it."""
    refuse_other_mesh(ob)
    if not live_warp_start.is_unchanged(ob):
        raise BaselineChanged(f"{ob.name} was changed by something else than its live warp, which cannot go on: "
                      "apply leaves it as it is now, discard takes it back to where it began")


def refuse_other_mesh(ob: bpy.types.Object) -> None:
    """Refuses a mesh for which the stored start no longer holds."""
    if live_warp_start.read_start(ob) is None:
        raise BaselineChanged(f"{ob.name} has lost where the live warp began (the attribute "
                              f"{live_warp_start.ATTRIBUTE}): apply or discard, both leave it as it is now")
    vertices, faces = live_warp_start.count_growth(ob)
    if vertices or faces:
        raise BaselineChanged(f"{ob.name} has other vertices ({vertices:+}) and faces ({faces:+}) than when the live "
                              "warp began, which cannot go on: apply or discard, both leave it as it is now")


def read_warp(scene: bpy.types.Scene) -> Warp:
    """Reads the wanted warp: the lattice as it is now, and the settings."""
    own, live = scene.reflection_lines.warp, scene.reflection_lines.live
    if not scene.reflection_lines.present(own.lattice):
        raise BaselineChanged(f"The warp lattice of {live.panel_name()} is no longer in the scene: bring it back by "
                              "undo; apply leaves the panel as it is now, discard takes it back to where it began")
    return Warp(warp_lattice.read_lattice(own.lattice).scaled(own.amount / 100.0), own.fit == 'VALUE')


def read_signs(scene: bpy.types.Scene, ob: bpy.types.Object, center: np.ndarray) -> tuple:
    """Reads the cheap signs of a baseline: size, transform, border, view and light; refuses where no tool can run."""
    seen, settings = view_and_light.read_scene_view(scene, center), scene.reflection_lines
    return (ob.name, len(ob.data.vertices), len(ob.data.polygons), tuple(map(tuple, ob.matrix_world)),
            settings.border, settings.lights, settings.limit,
            *(tuple(getattr(seen, name)) for name in ("view_direction", "line_direction")))


def read_baseline(scene: bpy.types.Scene, ob: bpy.types.Object) -> Baseline:
    """Reads the baseline: the patch at the start of the live warp, with view and border."""
    settings = scene.reflection_lines
    patch = gather.gather_patch(ob, settings.live.result, live_warp_start.read_whole_start(ob))
    now = read_signs(scene, ob, patch.center)
    return Baseline(patch, facing.read_patch_view(scene, patch), settle_border(settings.border, joined=False), now)


def read_solve_settings(scene: bpy.types.Scene, *, final: bool) -> SolveSettings:
    """Reads the settings of the solve from the scene, whose set of lights judges the shape at rest."""
    settings = scene.reflection_lines
    keeps_crossed = settings.lights != 'SINGLE' and settings.warp.fit != 'VALUE'
    return SolveSettings(settle_border(settings.border, joined=False), settings.length, settings.limit,
                         build_crossed=crossed.build_kept_target if keeps_crossed else None,
                         judges=read_light_set.read_light_set(settings, [find_subject(scene)]) if final else None)


def read_operator_settings(scene: bpy.types.Scene) -> dict[str, str | float]:
    """Returns the settings with which the operator Warp makes the same shape."""
    settings, own = scene.reflection_lines, scene.reflection_lines.warp
    return {"amount": own.amount, "fit": own.fit, "border": settle_border(settings.border, joined=False),
            "lights": settings.lights, "limit": settings.limit,
            "result": settings.live.result}
