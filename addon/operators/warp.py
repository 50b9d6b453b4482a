"""Warp Reflection Lines."""
from functools import partial

import bpy

from .. import solving
from ..bridge import lattice
from ..bridge.gather import Panel
from ..drag.modal import DraggedTool
from ..drag.motion import Handle
from ..solving import BuildTarget
from ..targets import warp
from ..tool_settings import WarpSettings


class REFLINES_OT_warp(DraggedTool, WarpSettings, bpy.types.Operator):
    """Move the vertices of the selected faces along the view so that their reflection lines follow the warp lattice.

Add a warp lattice first and move its control points; an untouched lattice moves nothing"""
    bl_idname = "reflines.warp"
    bl_label = "Warp Reflection Lines"

    lattice: bpy.props.StringProperty(name="Lattice", options={'SKIP_SAVE'},
                                      description="Name; empty takes the scene's")

    def scene_settings(self, scene: bpy.types.Scene) -> bpy.types.PropertyGroup:
        return scene.reflection_lines.warp

    def handles(self) -> tuple[Handle, ...]:
        return (Handle("amount", "Amount", per_pixel=1.0 / 3.0, low=0.0, high=1000.0, unit='PERCENT'),)

    def build_target(self, context: bpy.types.Context, _ob: bpy.types.Object, _panel: Panel) -> BuildTarget:
        moves = lattice.read(lattice.chosen(context.scene, self.lattice))
        settings = warp.Warp(moves.scaled(self.amount / 100.0), self.cells, self.fit == 'VALUE')
        return partial(warp.target, settings=settings)

    def remarks(self, solution: solving.Solution) -> tuple[str, ...]:
        return warp.remarks(solution.target)


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_warp])
