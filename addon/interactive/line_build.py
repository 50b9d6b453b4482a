"""The targets of handles for one object, with what that holds of its lines: a fall-off map."""
from functools import partial

import bpy
import numpy as np

from ..model import line_handle
from ..model.joined_patch import gather_values
from ..model.line_handle import Handles
from ..model.patch import Patch
from ..model.same import are_same
from ..model.view import View
from ..read import group_weights
from ..solver.panel_problem import PanelProblem, pose_problem
from ..solver.read_solved import spread_weights
from ..targets.line_handles import HandleBuild, HandleTargets, SpreadFalloff
from ..view import facing


class LineBuild:
    """Builds targets of handles again and again, while the fall-off of the object stays."""

    def __init__(self, scene: bpy.types.Scene) -> None:
        self.builder = HandleTargets(2.0 * np.pi / scene.reflection_lines.stripes.count)
        self.is_begun = False
        self.problem: PanelProblem | None = None  # the last one

    def pose(self, patch: Patch, seen: View) -> PanelProblem:
        """Poses the problem of a patch, or takes the last one where it is the same."""
        if self.problem is None or self.problem.patch is not patch or not are_same(self.problem.view, seen):
            self.problem = pose_problem(patch, seen)
        return self.problem

    def build(self, scene: bpy.types.Scene, ob: bpy.types.Object, patch: Patch, handles: Handles) -> HandleBuild:
        problem = self.pose(patch, facing.read_patch_view(scene, patch))
        images, handles = (handles if sign is None else line_handle.mirror_handles(handles, sign)
                           for sign in (problem.sign, problem.image_sign))
        if not self.is_begun:
            self.builder.spread_falloff, self.is_begun = read_spread_falloff(ob, problem), True
        owner = next(panel for panel in patch.panels if panel.name == ob.name)
        return HandleBuild(self.builder, handles, images, owner.matrix)


def read_spread_falloff(ob: bpy.types.Object, problem: PanelProblem) -> SpreadFalloff | None:
    """Reads the fall-off map of the object's handles, to be spread over an optimizer's vertices; None without one."""
    name = ob.reflection_lines.follow_group
    if not name:
        return None
    weights = {ob.name: group_weights.read_group_weights(ob, name, "the handles")}
    return partial(spread_weights, problem, weights=gather_values(problem.patch, weights, 1.0))
