"""The operator Warp Lines."""
from functools import partial

import bpy

from ..interactive.drag_handles import Handle
from ..model.patch import Patch
from ..model.solution import Solution
from ..solver.live_optimizer import BuildTarget
from ..targets import warp
from ..targets.warp import Warp
from ..ui.tool_properties import WarpSettings
from ..write import warp_lattice
from .dragged_tool import DraggedTool


class REFLINES_OT_warp(DraggedTool, WarpSettings, bpy.types.Operator):
    """Move the vertices of the selected faces along the view so that their reflection lines follow the warp lattice.
An untouched lattice moves nothing"""
    bl_idname = "reflines.warp"
    bl_label = "Warp Lines"

    lattice: bpy.props.StringProperty(name="Lattice", options={'HIDDEN', 'SKIP_SAVE'},
                                      description="Name; empty takes the scene's")

    def find_scene_settings(self, scene: bpy.types.Scene) -> bpy.types.PropertyGroup:
        return scene.reflection_lines.warp

    def build_handles(self) -> tuple[Handle, ...]:
        return (Handle("amount", "Amount", per_pixel=1.0 / 3.0, low=0.0, high=1000.0, unit='PERCENT'),)

    def keeps_crossed(self) -> bool:
        """Returns false for a fit by value, which says where each line lies and leaves the crossed ones no choice."""
        return super().keeps_crossed() and self.fit != 'VALUE'

    def build_target(self, context: bpy.types.Context, _ob: bpy.types.Object, _patch: Patch) -> BuildTarget:
        moves = warp_lattice.read_lattice(warp_lattice.find_lattice(context.scene, self.lattice))
        settings = Warp(moves.scaled(self.amount / 100.0), self.fit == 'VALUE')
        return partial(warp.build_warp_target, settings=settings)

    def describe_solution(self, solution: Solution) -> tuple[str, ...]:
        return warp.describe_outside(solution.target)
