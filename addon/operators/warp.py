"""Warp Reflection Lines."""
from functools import partial

import bpy

from .. import session
from ..bridge import lattice
from ..bridge.gather import Panel
from ..bridge.refusal import Refusal
from ..targets import warp
from ..session import BuildTarget
from ..tool import Tool
from ..tool_settings import WarpSettings


class REFLINES_OT_warp(Tool, WarpSettings, bpy.types.Operator):
    """Move the vertices of the selected faces along the view so that their reflection lines follow the warp lattice.

Add a warp lattice first and move its control points; an untouched lattice moves nothing"""
    bl_idname = "reflines.warp"
    bl_label = "Warp Reflection Lines"

    lattice: bpy.props.StringProperty(name="Lattice", options={'SKIP_SAVE'},
                                      description="Name; empty takes the scene's")

    def scene_settings(self, scene: bpy.types.Scene) -> bpy.types.PropertyGroup:
        return scene.reflection_lines.warp

    def build_target(self, context: bpy.types.Context, _ob: bpy.types.Object, _panel: Panel) -> BuildTarget:
        settings = warp.Warp(lattice.read(self.chosen(context.scene)), self.cells, self.fit == 'VALUE')
        return partial(warp.target, settings=settings)

    def chosen(self, scene: bpy.types.Scene) -> bpy.types.Object:
        named = scene.objects.get(self.lattice) if self.lattice else scene.reflection_lines.warp.lattice
        if named is None or named.type != 'LATTICE' or scene.objects.get(named.name) != named:
            raise Refusal("There is no warp lattice: "
                          "press Add Warp Lattice, or pick one in the sidebar's Reflection tab")
        return named

    def remarks(self, solution: session.Solution) -> tuple[str, ...]:
        outside = warp.outside(solution.target)
        if not outside:
            return ()
        return (f"{outside} triangles would show lines from beyond the region; they are left nearly as they are",)


register, unregister = bpy.utils.register_classes_factory([REFLINES_OT_warp])
