"""A drag of a tool under the mouse: its values, the texts in header and status bar, and the mesh that follows.

Events are handled by operators/dragged_tool.py, solves by solve_job.py in the background.
"""
import time
from collections.abc import Collection
from contextlib import suppress
from dataclasses import replace
from typing import Protocol

import bpy
import numpy as np

from ..background_work import BackgroundWork
from ..blender import units
from ..model.gain import Gain, Healed
from ..model.light_set import LightSet
from ..model.patch import Patch
from ..model.refusal import Refusal
from ..model.solution import Solution, SolveSettings
from ..model.view import View
from ..overlay import tool_circle
from ..read import read_mesh
from ..solver import live_optimizer
from ..solver.automatic_smooth import AutomaticSmooth
from ..solver.live_optimizer import BuildTarget
from ..targets.falloff import Falloff
from ..view import shown_middles, view_and_light, view_region
from ..write import keep_region, write_mesh
from ..write.write_mesh import EditVertices
from . import drag_input
from .drag_handles import DragValues, Handle
from .solve_job import SolveJob, SolveOutcome, SolveRequest

TICK_INTERVAL = 0.01  # seconds between two checks for the work's results
REST = 0.4  # seconds without a change of values or mesh after which a gain is measured that takes long
SAYS_BUSY = 0.3  # seconds of solving after which the status bar shows the stage


class DraggedOperator(Protocol):
    """The interface of an operator to its drag, in which the mouse changes its properties."""
    bl_label: str
    smooths: bool  # whether the tool's gain is reported by how smooth the lines are

    def find_subjects(self, context: bpy.types.Context) -> list[bpy.types.Object]: ...
    def build_handles(self) -> tuple[Handle, ...]: ...
    def choose_automatic(self, name: str, patch: Patch) -> float: ...
    def gather_all(self, context: bpy.types.Context, subjects: list[bpy.types.Object]) -> list[tuple[Patch, View]]: ...
    def join_panels(self, context: bpy.types.Context,
                    gathered: list[tuple[Patch, View]]) -> list[tuple[Patch, View]]: ...
    def settle_border(self) -> str: ...
    def find_owner(self, context: bpy.types.Context, patch: Patch) -> bpy.types.Object: ...
    def read_solve_settings(self, scene: bpy.types.Scene) -> SolveSettings: ...
    def read_judges(self, context: bpy.types.Context) -> LightSet | None: ...
    def read_falloff(self, context: bpy.types.Context, ob: bpy.types.Object, patch: Patch) -> Falloff | None: ...
    def build_target(self, context: bpy.types.Context, ob: bpy.types.Object, patch: Patch) -> BuildTarget: ...
    def choose_press(self) -> AutomaticSmooth | None: ...


class Drag:
    """One drag, from the press of the button to its end."""

    def __init__(self, tool: DraggedOperator, context: bpy.types.Context, *, final: bool = False) -> None:
        """Begins with the solve that is kept where that is asked for at once: a press of the tool."""
        scene = context.scene
        self.tool, self.area, self.is_press = tool, context.area, final
        solved = tool.join_panels(context, tool.gather_all(context, tool.find_subjects(context)))
        self.solved, views = [patch for patch, _ in solved], [seen for _, seen in solved]
        self.patches = [panel for patch in self.solved for panel in patch.panels]
        subjects = [bpy.data.objects[patch.name] for patch in self.patches]
        self.counts = [read_mesh.count_elements(ob) for ob in subjects]
        self.before = [self.read_shown(ob, patch) for ob, patch in zip(subjects, self.patches, strict=True)]
        self.shown = self.before
        self.vertices = [EditVertices(patch.index) for patch in self.patches]
        self.values = self.read_values(scene)
        self.frame = live_optimizer.compute_image_frame(self.patches[0], views[0])
        self.update_request(context, final=final)  # refuses before anything is started
        self.job = SolveJob(self.solved, views, tool.settle_border())
        shown_middles.show_from({panel.name: patch.center for patch in self.solved if len(patch.panels) > 1
                                 for panel in patch.panels})
        self.circle = tool_circle.add_circle(lambda: self.circle_points)
        self.work = BackgroundWork(self.job.run, self.job.cancel)
        self.work.submit(self.request)
        self.keeping, self.busy_since, self.problem, self.texts = final, time.monotonic(), "", ("", "")
        self.moved = False  # whether values changed since the last request
        self.changed_at = 0.0  # when values or mesh changed last, in the seconds of time.monotonic
        self.largest_move = 0.0  # of the shown positions from the start, world units
        self.gain: Gain | Healed | None = None  # of the shown positions, where it was measured
        self.unmeasured = False  # whether the gain of the shown positions is still to be measured
        self.timer = context.window_manager.event_timer_add(TICK_INTERVAL, window=context.window)
        _running.append(self)

    def read_values(self, scene: bpy.types.Scene) -> DragValues:
        handles = self.tool.build_handles()
        starts = [getattr(self.tool, handle.name) or self.tool.choose_automatic(handle.name, self.patches[0])
                  for handle in handles]
        return drag_input.read_values(handles, starts, scene)

    def read_shown(self, _ob: bpy.types.Object, patch: Patch) -> np.ndarray:
        """Returns the positions that the mesh has before the drag: #V x 3 float32, object space."""
        return patch.round_start_positions()

    def begin_at(self, context: bpy.types.Context, x: int, y: int) -> None:
        """Takes the mouse's place (pixels of the window) as that of the present values. Where it is not over the view,
        on a button of the sidebar say, it is put there, so that the way from the button changes nothing.
        """
        self.move_mouse(x, y, precise=False)
        if self.values.last is None:
            context.window.cursor_warp(*view_region.find_view_middle(self.area))

    def move_mouse(self, x: int, y: int, *, precise: bool) -> None:
        """Moves the held value with the mouse, from the first place over the view on."""
        if self.values.last is not None or view_region.find_view_at(self.area, x, y) is not None:
            self.values.move(x, precise=precise)

    def keep_values(self, settings: bpy.types.PropertyGroup) -> None:
        """Writes the values that were moved or typed into the scene's settings of the tool."""
        for index, handle in enumerate(self.values.handles):
            if self.values.is_touched(index):
                setattr(settings, handle.name, self.values.value(index))

    def find_objects(self) -> list[bpy.types.Object]:
        """Returns the dragged objects; refuses where somebody else has changed one of them."""
        return [self.find_object(which) for which in range(len(self.patches))]

    def find_object(self, which: int) -> bpy.types.Object:
        """Returns one of the dragged objects; refuses where somebody else has changed it."""
        patch = self.patches[which]
        ob = bpy.data.objects.get(patch.name)
        same = ob is not None and ob.type == 'MESH' and read_mesh.count_elements(ob) == self.counts[which]
        if not same or not read_mesh.has_positions(ob, patch, self.shown[which]):
            raise Refusal(f"{patch.name} was changed while it was dragged: it is left as it is now")
        return ob

    def update_request(self, context: bpy.types.Context, *, final: bool = False) -> None:
        """Sets the tool's properties from the drag's values, and builds the request for them."""
        for index, handle in enumerate(self.values.handles):
            if self.values.is_touched(index):
                setattr(self.tool, handle.name, self.values.value(index))
        # The settings are read after each target, since a panel's size sets its length.
        self.find_objects()
        owners = [self.tool.find_owner(context, patch) for patch in self.solved]
        wanted = [(self.tool.build_target(context, ob, patch), self.tool.read_solve_settings(context.scene))
                  for ob, patch in zip(owners, self.solved, strict=True)]
        builds, settings = zip(*wanted, strict=True)
        if final:
            judges = self.tool.read_judges(context)
            settings = tuple(replace(each, judges=judges) for each in settings)
        self.request = SolveRequest(builds, settings, final, press=self.tool.choose_press())
        falloff = self.tool.read_falloff(context, owners[0], self.solved[0])
        self.circle_points = (tool_circle.sample_circle(falloff.centre, falloff.radius, self.frame)
                              if falloff is not None else None)

    def submit_request(self, context: bpy.types.Context, *, final: bool = False) -> None:
        """Submits the request of the present values; a refusal of these is shown in the header. Refuses where no values
        could help, since somebody else has changed a mesh, or removed the view camera or the light.
        """
        self.moved = False
        self.find_objects()
        view_and_light.refuse_obstacle(context.scene)
        try:
            self.update_request(context, final=final)
        except Refusal as refusal:
            self.problem = str(refusal)
            return
        self.keeping = final
        if self.work.is_idle():
            self.busy_since = time.monotonic()
        self.work.submit(self.request)

    def note_move(self) -> None:
        """Notes that values have changed, which the next tick solves for."""
        self.moved, self.changed_at = True, time.monotonic()

    def is_to_measure(self) -> bool:
        """Returns whether what is shown is to be measured now: the panel would not follow meanwhile."""
        return self.unmeasured and self.work.is_idle() and time.monotonic() - self.changed_at >= REST

    def submit_measurement(self) -> None:
        """Submits the request for the gain of what is shown."""
        self.work.submit(replace(self.request, measure=True))

    def take_gain(self, outcome: SolveOutcome) -> None:
        self.gain = outcome.gain
        self.unmeasured = bool(outcome.positions) and outcome.gain is None

    def show_positions(self, positions: tuple[np.ndarray, ...]) -> None:
        self.largest_move = max(float(np.linalg.norm(wanted - patch.V, axis=1).max())
                                for patch, wanted in zip(self.patches, positions, strict=True))
        new = [patch.to_object_space(wanted) for patch, wanted in zip(self.patches, positions, strict=True)]
        self.write_positions(new)
        self.changed_at = time.monotonic()

    def write_positions(self, new: list[np.ndarray]) -> None:
        every = zip(self.find_objects(), self.patches, new, self.shown, self.vertices, strict=True)
        for ob, patch, to, now, vertices in every:
            write_mesh.write_positions(ob, patch, to, now, vertices)
        self.shown = new

    def write_solutions(self, solutions: tuple[Solution, ...]) -> None:
        """Replaces what the drag showed in the mesh by the result in a shape key, where one is wanted."""
        if not any(patch.key for patch in self.patches):
            return
        self.restore()
        for ob, solution in zip(self.find_objects(), solutions, strict=True):
            keep_region.keep_region(ob, solution.patch)
        for ob, solution in zip(self.find_objects(), solutions, strict=True):
            write_mesh.write_solution(ob, solution.patch, solution.positions)
        self.shown = [solution.patch.to_object_space(solution.positions) for solution in solutions]

    def leave_out(self, names: Collection[str]) -> None:
        """Leaves patches alone that cannot be solved; nothing of them has been shown."""
        kept = [which for which, patch in enumerate(self.patches) if patch.name not in names]
        for each in ("patches", "counts", "before", "shown", "vertices"):
            setattr(self, each, [getattr(self, each)[which] for which in kept])

    def restore(self) -> None:
        self.write_positions(self.before)

    def update_texts(self, context: bpy.types.Context) -> None:
        if self.is_press:
            self.show_texts(context, self.tool.bl_label, "")
            return
        values = drag_input.describe_values(self.values, context.scene)
        header = f"{self.problem or self.describe_gain(context)}   {values}   ({self.tool.bl_label})"
        self.show_texts(context, header, drag_input.describe_keys(self.values))

    def show_texts(self, context: bpy.types.Context, header: str, keys: str) -> None:
        """Shows the header, and in the status bar the keys, or the stage of what takes long."""
        working = not self.work.is_idle() and time.monotonic() - self.busy_since > SAYS_BUSY
        status = f"{self.job.describe_stage()}   Esc: cancel" if working or self.keeping else keys
        if self.texts != (header, status):  # setting a text redraws its bar
            self.texts = header, status
            self.area.header_text_set(header)
            context.workspace.status_text_set(status)

    def describe_gain(self, context: bpy.types.Context) -> str:
        """Says what the drag has gained so far; the move alone while the gain is not measured."""
        moved = f"oved at most {units.format_length(self.largest_move, context.scene, precision=2)}"
        if self.gain is None:
            return f"M{moved}"
        return f"{self.gain.describe_shortly(smoothed=self.tool.smooths)}, m{moved}"

    def end(self, context: bpy.types.Context) -> None:
        """Restores header, status bar and timer; the work ends after its native call."""
        _running.remove(self)
        context.window_manager.event_timer_remove(self.timer)
        if self.work.is_idle():
            self.job.return_optimizers()
        self.work.stop()
        shown_middles.show_from({})
        tool_circle.remove_circle(self.circle)
        self.area.header_text_set(None)
        context.workspace.status_text_set(None)

    def abort(self, context: bpy.types.Context) -> None:
        """Restores the meshes and ends the drag, when it cannot go on, and when Blender exits, opens another file or
        disables the add-on.
        """
        every = zip(self.patches, self.before, self.shown, self.vertices, strict=True)
        for which, (patch, before, shown, vertices) in enumerate(every):
            with suppress(Refusal):  # this one is gone, or was changed by something else
                write_mesh.write_positions(self.find_object(which), patch, before, shown, vertices)
        self.end(context)


_running: list[Drag] = []  # more than one only where a script started a tool over another: that hears the mouse first


def is_running() -> bool:
    """Returns whether a tool is dragged."""
    return bool(_running)


def has_work() -> bool:
    """Returns whether a running drag has something left to submit, solve or show."""
    return any(drag.moved or drag.keeping or drag.unmeasured or not drag.work.is_idle()
               or drag.work.has_outcome() for drag in _running)


def unregister() -> None:
    for drag in reversed(_running[:]):  # Blender drops the operators without calling them
        drag.abort(bpy.context)
