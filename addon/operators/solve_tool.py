"""The base of operators that solve: when they can run, gathering, applying, and reporting to the artist."""
import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from types import MappingProxyType

import bpy
import numpy as np
from bpy.props import BoolProperty

from ..blender.triangulate import triangulate_points
from ..model import meeting
from ..model.beside import Crossing
from ..model.border import AUTOMATIC, CODES, settle_border
from ..model.joined_patch import JoinedPatch, split_solution
from ..model.light_set import LightSet
from ..model.patch import Patch
from ..model.refusal import Refusal
from ..model.solution import Solution, SolveSettings
from ..model.view import View
from ..read import gather, modifiers, region_faces, scene_objects, shape_keys, shown_surface, unjoined_border
from ..read.mesh_checks import Purpose
from ..solver.join_panels import join_panels
from ..solver.live_optimizer import BuildTarget
from ..state import optimizer_cache, press_cache, solve_history
from ..ui import automatic_values
from ..ui.properties import result_property
from ..ui.tool_properties import border_property
from ..view import facing, read_light_set, view_and_light
from ..write import keep_region, write_mesh

# Settings of the scene for all tools that have none of their own.
SHARED = {"border", "result", "lights", "limit"}
FOLLOWING = {"follow", AUTOMATIC}  # borders with which panels that face each other are solved as one
LOST_START = ("The run began with the mesh as it is now: the shape before the last run is not known, since the mesh "
              "was changed, undone, renamed or duplicated after it, or another shape key is edited")


def is_ready(operator: type[bpy.types.Operator], context: bpy.types.Context, *, needs_faces: bool = True) -> bool:
    """Returns whether a tool can run on the active object; sets the message that says why not."""
    ob = scene_objects.find_active_object(context)
    if ob is None or ob.type != 'MESH' or ob.mode not in {'EDIT', 'OBJECT'}:
        return scene_objects.allow(operator, "Make the panel's mesh the active object, in Edit Mode or Object Mode")
    return scene_objects.allow(
        operator, view_and_light.find_obstacle(context.scene) or context.scene.reflection_lines.live.obstacle(ob)
        or (scene_objects.explain_missing_region(context, ob) if needs_faces else ""))


class SolveTool:
    """A tool adds its settings, names the property group that holds the scene's, and builds a target from them."""
    bl_options = {'REGISTER', 'UNDO'}

    # Whether the buttons are grey where there are no faces to work on. A press in the view would go unheard then.
    needs_faces = True
    panels: Sequence[Patch] = ()  # of the run
    joint: Mapping[str, JoinedPatch] = MappingProxyType({})  # by the names of those of them that are solved as one
    known_set: tuple[LightSet | None, ...] = ()  # once it was read

    border: border_property()
    result: result_property(options={'SKIP_SAVE'})
    anew: BoolProperty(options={'HIDDEN', 'SKIP_SAVE'}, description="Begin with the shape before the last run")
    edited: BoolProperty(options={'HIDDEN', 'SKIP_SAVE'}, description="Also in Object Mode change what Edit Mode does: "
                         "a mesh that other objects share, and the active shape key")

    def find_scene_settings(self, scene: bpy.types.Scene) -> bpy.types.PropertyGroup:
        """Returns the scene's settings, which stand for those not given."""
        raise NotImplementedError

    def build_target(self, context: bpy.types.Context, ob: bpy.types.Object, patch: Patch) -> BuildTarget:
        """Returns the builder of the tool's target."""
        raise NotImplementedError

    def describe_solution(self, _solution: Solution) -> tuple[str, ...]:
        """Returns sentences about a finished solve beside the solver's own."""
        return ()

    def read_detail_length(self, scene: bpy.types.Scene) -> float:
        """Returns the length below which detail counts as a deviation; 0 is a fraction of the patch's diagonal."""
        return scene.reflection_lines.length

    def read_solve_settings(self, scene: bpy.types.Scene) -> SolveSettings:
        """Reads what the solve needs beside the target, once that is built."""
        return SolveSettings(self.settle_border(), self.read_detail_length(scene))

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return is_ready(cls, context, needs_faces=cls.needs_faces)

    def draw(self, _context: bpy.types.Context) -> None:
        """Draws the redo panel: the settings that act on the active object."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        for about in self.properties.bl_rna.properties:
            name = about.identifier
            if name != "rna_type" and not about.is_hidden and self.has_use(name):
                automatic_values.draw_plain_value(layout, self, name)

    def has_use(self, _name: str) -> bool:
        """Returns whether a setting acts beside the others as they are."""
        return True

    def execute(self, context: bpy.types.Context) -> set[str]:
        self.known_set = ()
        context.view_layer.update()  # scripts may have set transforms that are not evaluated yet
        self.copy_settings(context.scene)
        subjects = []
        try:
            subjects = self.find_subjects(context)
            solutions = self.solve_all(context, subjects)
            for solution in solutions:  # before any is written: what lies too far away to be stored is refused
                solution.patch.to_object_space(solution.positions)
        except Refusal as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        finally:
            optimizer_cache.drop_surplus({ob.name for ob in subjects})
            press_cache.keep_only({ob.name for ob in subjects})
        for solution in solutions:  # before writing: a result in a shape key ends Edit Mode for all objects
            keep_region.keep_region(bpy.data.objects[solution.patch.name], solution.patch)
        for solution in solutions:
            ob = bpy.data.objects[solution.patch.name]
            write_mesh.write_solution(ob, solution.patch, solution.positions, edited=self.edited)
            self.record_solution(ob, solution)
        self.tell_of_all(solutions)
        return {'FINISHED'}

    def solve_all(self, context: bpy.types.Context, subjects: list[bpy.types.Object]) -> list[Solution]:
        """Solves the objects before any is written; refuses all of them where one cannot be solved."""
        gathered = self.gather_all(context, subjects)
        solutions = []
        for patch, _ in self.join_panels(context, gathered):
            solution = self.solve_patch(context, self.find_owner(context, patch), patch)
            solutions += split_solution(solution, self.read_solve_settings(context.scene).limit)
        return solutions

    def join_panels(self, context: bpy.types.Context, gathered: list[tuple[Patch, View]]) -> list[tuple[Patch, View]]:
        """Returns what is solved: panels that face each other, where the border follows its neighbours, as one patch,
        which is seen as its middle is.
        """
        self.joint = {}
        if not self.joins_panels():
            return gathered
        patches = join_panels([patch for patch, _ in gathered], partial(view_and_light.read_scene_view, context.scene),
                              settle_border(self.border, joined=True), triangulate_points)
        self.joint = {each.name: patch for patch in patches if len(patch.panels) > 1 for each in patch.panels}
        alone = {patch.name: seen for patch, seen in gathered}
        return [(patch, alone[patch.name] if len(patch.panels) == 1 else self.read_view(context, patch))
                for patch in patches]

    def joins_panels(self) -> bool:
        """Returns whether panels that face each other are solved as one."""
        follows = self.border in FOLLOWING or any((each.border == CODES["follow"]).any() for each in self.panels)
        return follows and len(self.panels) > 1 and not self.is_automatic()

    def settle_border(self) -> str:
        """Returns the border that the solver takes, once it is known which panels are solved as one."""
        return settle_border(self.border, joined=bool(self.joint))

    def find_owner(self, context: bpy.types.Context, patch: Patch) -> bpy.types.Object:
        """Returns the object whose settings hold for a patch: of several the active one."""
        names = [each.name for each in patch.panels]
        active = scene_objects.find_active_object(context).name
        return bpy.data.objects[active if active in names else names[0]]

    def gather_all(self, context: bpy.types.Context, subjects: list[bpy.types.Object]) -> list[tuple[Patch, View]]:
        """Gathers the patches of the objects, each with its view."""
        self.panels = [self.gather_patch(ob) for ob in subjects]
        return [(patch, self.read_view(context, patch)) for patch in self.panels]

    def find_meeting(self, patch: Patch) -> list[Patch]:
        """Returns a patch and those of this run that meet it across gaps: tools that work on all of a region take them
        as one.
        """
        return meeting.find_meeting(patch, self.panels)

    def read_view(self, context: bpy.types.Context, patch: Patch) -> View:
        """Reads the view and the light that a patch is solved for."""
        return facing.read_patch_view(context.scene, patch)

    def tell_of_all(self, solutions: Sequence[Solution]) -> None:
        """Reports what concerns all objects of a run together, after what concerns each."""

    def find_subjects(self, context: bpy.types.Context) -> list[bpy.types.Object]:
        """Returns the objects to work on; of a run that is repeated those that were solved as one, too."""
        found = scene_objects.find_subjects(context)
        return [*found, *scene_objects.find_partners(context, found[0])] if self.anew and len(found) == 1 else found

    def copy_settings(self, scene: bpy.types.Scene) -> None:
        """Copies the scene's settings into the properties that were not given."""
        own = self.find_scene_settings(scene)
        for name, _ in self.properties.bl_rna.properties.items():
            shared = name in SHARED and name not in own.bl_rna.properties
            holder = scene.reflection_lines if shared else own
            taken = holder.bl_rna.properties.get(name)
            if taken is None or taken.type == 'POINTER' or self.properties.is_property_set(name):
                continue
            value = getattr(holder, name)
            if value != "" or taken.type != 'ENUM':  # a changed file may hold a choice that there is not
                setattr(self, name, value)

    def solve_patch(self, context: bpy.types.Context, ob: bpy.types.Object, patch: Patch) -> Solution:
        build = self.build_target(context, ob, patch)
        settings = replace(self.read_solve_settings(context.scene), judges=self.read_judges(context))
        return optimizer_cache.solve_with_cache(patch, self.read_view(context, patch), settings, build)

    def read_judges(self, context: bpy.types.Context) -> LightSet | None:
        """Returns the scene's set of lights, which judges what the tool makes; None where there is none."""
        return self.read_set(context)

    def read_set(self, context: bpy.types.Context) -> LightSet | None:
        """Returns the scene's set of lights, read once in a run or drag: what may hide a panel is all of its mesh."""
        if not self.known_set:
            found = read_light_set.read_light_set(context.scene.reflection_lines, self.find_subjects(context))
            self.known_set = (found,)
        return self.known_set[0]

    def gather_patch(self, ob: bpy.types.Object) -> Patch:
        return gather.gather_patch(ob, self.result, self.begin_run(ob), margin=self.choose_margin(),
                                   purpose=self.choose_purpose(), crossing=self.choose_crossing())

    def choose_purpose(self) -> Purpose:
        return Purpose.WRITE_EDITED if self.edited else Purpose.WRITE

    def choose_margin(self) -> float:
        """Returns how far the faces beside the region are read, in its diagonals; 0: some rings of them."""
        return 0.0

    def choose_crossing(self) -> Crossing | None:
        """Returns what the border follows across gaps; None where the tool does not."""
        return None

    def begin_run(self, ob: bpy.types.Object) -> np.ndarray | None:
        """Returns the shape to begin with: #vertices x 3, None for the mesh as it is.

        Records for the report whether the shape before the last run was lost, and whether the stored region was taken.
        """
        found = solve_history.read_original_shape(ob, self.result) if self.anew else None
        self.lost_start = self.anew and found is None
        self.region_stored = ob.mode != 'EDIT' and region_faces.has_stored_region(ob.data)
        return found

    def record_solution(self, ob: bpy.types.Object, solution: Solution) -> None:
        """Records a solution beside its positions: region, history, report, and the run for Re-solve."""
        keep_region.keep_region(ob, solution.patch)
        solve_history.remember_solve(solution.to_last_solve())
        stored = ob.reflection_lines
        stored.center = (solution.patch.to_local(self.joint[ob.name].center) if ob.name in self.joint else
                         solution.patch.local_center)
        stored.keep_view(bpy.context.scene)
        stored.run.fill(self, ob.data, solution.patch.key)
        stored.run.joined = json.dumps(sorted(self.joint)) if ob.name in self.joint else ""
        lost = (LOST_START,) if self.lost_start else ()
        shown = (*self.record_surroundings(ob, solution.patch),
                 *shape_keys.describe_hidden_key(ob, solution.patch.key), *shown_surface.describe_custom_normals(ob),
                 *shown_surface.describe_shared_mesh(ob),
                 *modifiers.describe_unsolved_modifiers(ob))
        stored.report.fill(solution, (*solution.notes, *self.describe_solution(solution), *shown, *lost))
        for note in stored.report.notes.splitlines():
            self.report({'WARNING'}, f"{ob.name}: {note}")
        faces = f", {solution.patch.faces.sum()} faces kept as the region; in Edit Mode the selected ones are taken"
        kept = " ".join(stored.report.kept.splitlines())
        if kept:
            self.report({'INFO'}, f"{ob.name}: Kept: {kept}")
        # The status bar shows the last report, and cuts off its end.
        self.report({'INFO'}, f"{stored.report.headline()} ({ob.name}{faces if self.region_stored else ''})")

    def is_automatic(self) -> bool:
        """Returns whether the automatic press takes the place of a solve, which that of Smooth alone can."""
        return False

    def record_surroundings(self, ob: bpy.types.Object, patch: Patch) -> tuple[str, ...]:
        """Records for the buttons of the result what is wrong with the mesh itself; returns the sentences about it."""
        scene, report = bpy.context.scene, ob.reflection_lines.report
        # The automatic press smooths parts of a region that touch as one.
        unjoined = unjoined_border.find_unjoined(scene, ob, patch, within=not self.is_automatic())
        turn = shown_surface.measure_rounding(patch)
        report.merge_distance, report.rounding = unjoined.distance if unjoined.own else 0.0, turn
        # Then the lines do not break there.
        follows = self.border == "follow" and self.is_automatic() or patch.name in self.joint
        breaks = () if follows else unjoined.describe()
        return (*shown_surface.describe_rounding(scene, patch, turn), *breaks, *self.describe_apart(patch))

    def describe_apart(self, patch: Patch) -> tuple[str, ...]:
        """Says where panels that meet are solved one by one what the border does between them."""
        beside = [each.name for each in self.find_meeting(patch)[1:]]
        if self.border == "follow" and not self.is_automatic() and patch.name not in self.joint:
            return ("The border Neighbours follows panels in Edit Mode that face each other and, in Smooth Lines with "
                    "the automatic length, all that lies beside: here it was Tangent",)
        if self.border == "free" and beside:
            return (f"The border Free moves each panel by itself: gap and step towards {', '.join(beside)} change, "
                    "Neighbours moves them as one",)
        return ()
