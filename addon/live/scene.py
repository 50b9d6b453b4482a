"""What a live warp wants, as the scene says it: the panel, where it began, the lattice, view and light.

All of it is saved with the file and undone with it, and the panel's shape follows from it and nothing else.
"""
from dataclasses import dataclass
from functools import partial

import bpy

from .. import session
from ..bridge import lattice, panels, start
from ..bridge.gather import Panel
from ..bridge.refusal import Refusal
from ..bridge.view import View
from ..solving import BuildTarget, Settings
from ..targets import warp
from ..targets.warp import Warp


class Changed(Refusal):
    """Somebody else changed what the live warp stands on: it does not go on, and the panel stays as it is now."""


@dataclass(frozen=True)
class Ground:
    """What an optimizer is built from; `signs` are cheap to read and differ where it may have changed."""
    panel: Panel
    view: View
    border: str
    signs: tuple

    def serves(self, other: "Ground") -> bool:
        """Whether an optimizer of the one serves the other."""
        return self.signs == other.signs and self.panel.same(other.panel)


def subject(scene: bpy.types.Scene) -> bpy.types.Object:
    """The panel, in Object Mode."""
    ob = scene.reflection_lines.live.panel
    if not scene.reflection_lines.present(ob):
        raise Changed(f"The panel {ob.name} is no longer in the scene: bring it back by undo, or discard the live warp")
    if ob.mode == 'EDIT':
        raise Refusal(f"The live warp waits while {ob.name} is in Edit Mode")
    return ob


def refuse_changed(ob: bpy.types.Object) -> None:
    refuse_another(ob)
    if not start.is_left(ob):
        raise Changed(f"{ob.name} was changed by something else than its live warp, which cannot go on: "
                      "apply leaves it as it is now, discard takes it back to where it began")


def refuse_another(ob: bpy.types.Object) -> None:
    """Where the start says nothing about the mesh as it is now."""
    if start.kept(ob) is None:
        raise Changed(f"{ob.name} has lost where the live warp began (the attribute {start.ATTRIBUTE}): "
                      "apply or discard, both leave it as it is now")
    vertices, faces = start.has_grown(ob)
    if vertices or faces:
        raise Changed(f"{ob.name} has other vertices ({vertices:+}) and faces ({faces:+}) than when the live warp "
                      "began, which cannot go on: apply or discard, both leave it as it is now")


def wanted(scene: bpy.types.Scene) -> Warp:
    own, live = scene.reflection_lines.warp, scene.reflection_lines.live
    if not scene.reflection_lines.present(own.lattice):
        raise Changed(f"The warp lattice of {live.panel_name()} is no longer in the scene: bring it back by undo; "
                      "apply leaves the panel as it is now, discard takes it back to where it began")
    return Warp(lattice.read(own.lattice).scaled(own.amount / 100.0), own.cells, own.fit == 'VALUE')


def signs(scene: bpy.types.Scene, ob: bpy.types.Object, center: object) -> tuple:
    obstacle = session.obstacle(scene)
    if obstacle:
        raise Refusal(obstacle)
    seen, settings = session.view_of(scene, center), scene.reflection_lines
    return (ob.name, tuple(map(tuple, ob.matrix_world)), settings.border,
            *(tuple(getattr(seen, name)) for name in ("view_direction", "line_direction")))


def ground(scene: bpy.types.Scene, ob: bpy.types.Object) -> Ground:
    settings = scene.reflection_lines
    panel = panels.gathered(ob, settings.live.solve_for, settings.live.result, start.everywhere(ob))
    now = signs(scene, ob, panel.center)
    return Ground(panel, session.view_of(scene, panel.center), settings.border, now)


def build(wish: Warp) -> BuildTarget:
    return partial(warp.target, settings=wish)


def solve_settings(scene: bpy.types.Scene) -> Settings:
    return Settings(scene.reflection_lines.border, scene.reflection_lines.length)


def operator_settings(scene: bpy.types.Scene) -> dict[str, object]:
    """Those of Warp that make the same shape."""
    settings, own = scene.reflection_lines, scene.reflection_lines.warp
    return {"amount": own.amount, "cells": own.cells, "fit": own.fit, "border": settings.border,
            "solve_for": settings.live.solve_for, "result": settings.live.result}
