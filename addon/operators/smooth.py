"""The operator Smooth Lines."""
from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import partial

import bpy

from ..blender import units
from ..interactive.drag_handles import Handle
from ..model.beside import Crossing
from ..model.gain import join_healed
from ..model.light_set import LightSet
from ..model.patch import Patch
from ..model.refusal import Refusal
from ..model.solution import BuildCrossed, Solution, SolveSettings
from ..model.view import View
from ..native_call import run_now
from ..read import modifiers
from ..solver import solve
from ..solver.automatic_smooth import AutomaticSmooth
from ..solver.live_optimizer import BuildTarget
from ..state import press_cache
from ..targets import smooth
from ..targets.smooth import Smooth
from ..ui import automatic_values
from ..ui.tool_properties import SmoothSettings
from .dragged_tool import DraggedTool

BESIDE_STRAIGHT = 0.01  # weight of crossed lines; see native/include/reflines/kept_target.h


class REFLINES_OT_smooth(DraggedTool, SmoothSettings, bpy.types.Operator):
    """Move the selected faces' vertices along the view so that their lines run smoothly: flaws go, design stays;
with a length all that is finer goes. In Object Mode the faces of the last run are taken"""
    bl_idname = "reflines.smooth"
    bl_label = "Smooth Lines"
    smooths = True

    def build_handles(self) -> tuple[Handle, ...]:
        return (Handle("strength", "Strength", per_pixel=1.0 / 300.0, low=0.0, high=1.0),
                Handle("length", "Length", per_pixel=1.0 / 150.0, low=1e-9, high=1e9, doubles=True, unit='LENGTH',
                       wheel=True))

    def draw(self, _context: bpy.types.Context) -> None:
        """Draws the redo panel."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        for name in ("strength", "border", "result"):
            layout.prop(self, name)
        self.draw_smooth(layout, automatic_values.draw_plain_value)
        layout.prop(self, "lights")
        automatic_values.draw_plain_value(layout, self, "limit")

    def choose_automatic(self, name: str, patch: Patch) -> float:
        """Returns the value that 0 stands for; of the length in the automatic press a multiple."""
        return super().choose_automatic(name, patch) * (self.flaw_size if name == "length" else 1.0)

    def find_scene_settings(self, scene: bpy.types.Scene) -> bpy.types.PropertyGroup:
        return scene.reflection_lines

    def read_detail_length(self, _: bpy.types.Scene) -> float:
        return self.length

    def build_target(self, _context: bpy.types.Context, _ob: bpy.types.Object, patch: Patch) -> BuildTarget:
        length = self.filter_length = solve.choose_length(patch, self.length)
        if self.follow_mouse and not self.length and self.directional:
            self.length = length  # a drag smooths by the length that it shows; the redo panel and Re-solve repeat that
        settings, chosen = Smooth(length, self.strength, self.directional), self.read_solved_set()
        if chosen is None:
            return partial(smooth.build_smooth_target, settings=settings)
        return partial(smooth.build_smooth_targets, settings=settings,
                       weights=[light.weight for light in chosen.lights])

    def read_solved_set(self) -> LightSet | None:
        """Reads the set of lights that lines are smoothed in by a length; None where there is none. Straight lines are
        asked for by one light alone.
        """
        return None if self.directional or self.is_automatic() else self.read_lights()

    def read_view(self, context: bpy.types.Context, patch: Patch) -> View:
        seen, chosen = super().read_view(context, patch), self.read_solved_set()
        return seen if chosen is None else replace(seen, families=chosen.build_families(patch))

    def keeps_crossed(self) -> bool:
        """Returns whether the crossed lines are smoothed, too: the lights of a set take their place."""
        return super().keeps_crossed() and self.read_solved_set() is None

    def choose_crossed(self) -> BuildCrossed:
        """Returns the builder of the target for the crossed lines: smoothed as well. Beside straight lines, which are
        asked for by one light alone, they count as little as those that other tools keep.
        """
        weight = BESIDE_STRAIGHT if self.directional else 1.0
        return partial(smooth.build_smooth_target, settings=Smooth(self.filter_length, self.strength, family=1,
                                                                   weight=weight))

    def read_solve_settings(self, scene: bpy.types.Scene) -> SolveSettings:
        """Reads the settings, with an automatic limit that is a fraction of the length, as in the automatic press."""
        return replace(super().read_solve_settings(scene), limit_length=self.filter_length)

    def is_automatic(self) -> bool:
        """Returns whether the automatic press takes the place of a solve."""
        return not self.length and not self.directional

    def choose_press(self) -> AutomaticSmooth | None:
        if not self.is_automatic():
            return None
        chosen = self.read_lights()
        judges = self.read_judges(bpy.context) if chosen is None else None  # those of a press judge it already
        return replace(self.choose_settings(), light_set=chosen, judges=judges)

    def choose_settings(self) -> AutomaticSmooth:
        lights = "single" if self.lights == 'SINGLE' else "crossed"
        return AutomaticSmooth(lights, self.strength, self.symmetric, self.limit or None, self.flaw_size,
                               self.fair_border, self.even_flush)

    def read_lights(self) -> LightSet | None:
        """Reads the set of lights; None where another choice is made, or none of them can be used."""
        if self.lights != 'SET':
            return None
        return self.read_set(bpy.context)

    def describe_solution(self, solution: Solution) -> tuple[str, ...]:
        return (*self.describe_flush(solution), *self.describe_set())

    def describe_flush(self, solution: Solution) -> tuple[str, ...]:
        """Returns how uneven the flush towards panels of the same press was and is, where it is to be even."""
        if not self.even_flush or not self.is_automatic():
            return ()
        if not solution.flush[0]:
            return ("Even Flush: no shut line lies between panels that move",)
        before, after = (units.format_length(each, bpy.context.scene, 2) for each in solution.flush)
        return (f"Flush uneven by {before} \u2192 {after}",)

    def describe_set(self) -> tuple[str, ...]:
        """Returns what is wrong with the set of lights, where it is asked for."""
        if self.lights != 'SET':
            return ()
        if self.directional:
            return ("Along the Lines is for the light alone: the set only judged it",)
        chosen = bpy.context.scene.reflection_lines.light_set
        if any(entry.is_used() for entry in chosen.entries):
            return chosen.describe_problems()
        return ("The set has no light that can be used: crossed lights were taken", *chosen.describe_problems())

    def choose_margin(self) -> float:
        return self.choose_settings().choose_margin() if self.is_automatic() else 0.0

    def choose_crossing(self) -> Crossing | None:
        if not self.is_automatic():
            return None
        joint = [ob for ob in self.find_subjects(bpy.context) if ob.mode == 'EDIT']
        cages = [ob.name for ob in joint if modifiers.is_cage(ob)]
        return Crossing(self.border == 'follow', frozenset(ob.name for ob in joint), frozenset(cages))

    def find_subjects(self, context: bpy.types.Context) -> list[bpy.types.Object]:
        """Returns the objects in the order of their names, so that no result depends on the order of their selection.
        """
        return sorted(super().find_subjects(context), key=lambda ob: ob.name)

    def record_solution(self, ob: bpy.types.Object, solution: Solution) -> None:
        """Records a solution. What the length 0 stands for is known after an automatic press only."""
        given = self.length and not self.directional
        super().record_solution(ob, replace(solution, automatic_length=0.0) if given else solution)

    def solve_all(self, context: bpy.types.Context, subjects: list[bpy.types.Object]) -> list[Solution]:
        """Presses all objects as one problem; those that cannot be solved are left, and named."""
        press = self.choose_press()
        if press is None:
            return super().solve_all(context, subjects)
        patches, views = zip(*self.gather_all(context, subjects), strict=True)
        outcomes = run_now(press_cache.smooth_all(patches, views, self.settle_border(), press))
        refusals = [each for each in outcomes if isinstance(each, Refusal)]
        if len(refusals) == len(outcomes):
            raise refusals[0]
        self.hear_refused(refusals)
        return [each for each in outcomes if not isinstance(each, Refusal)]

    def gather_all(self, context: bpy.types.Context, subjects: list[bpy.types.Object]) -> list[tuple[Patch, View]]:
        """Gathers the patches; of several in an automatic press those that cannot be are left, and named."""
        self.refusals = []
        if not self.is_automatic() or len(subjects) == 1:
            return super().gather_all(context, subjects)
        gathered = []
        for ob in subjects:
            try:
                gathered += super().gather_all(context, [ob])
            except Refusal as refusal:
                self.refusals.append(refusal)
        if not gathered:
            raise self.refusals[0]
        self.panels = [patch for patch, _ in gathered]
        return gathered

    def hear_refused(self, refusals: Iterable[Refusal]) -> None:
        self.refusals += refusals

    def tell_of_all(self, solutions: Sequence[Solution]) -> None:
        """Reports the objects that were left, and of several that were solved one line for all."""
        for refusal in self.refusals if self.is_automatic() else ():
            self.report({'WARNING'}, f"Left as it is: {refusal}")
        if len(solutions) > 1 and all(solution.healed is not None for solution in solutions):
            joined = join_healed([solution.healed for solution in solutions],
                                 [solution.patch.measure_area() for solution in solutions])
            largest = max(solution.report.largest_move for solution in solutions)
            moved = units.format_length(largest, bpy.context.scene, 2)
            names = ", ".join(solution.patch.name for solution in solutions)
            self.report({'INFO'}, f"{joined.describe()}, moved at most {moved} ({names})")
