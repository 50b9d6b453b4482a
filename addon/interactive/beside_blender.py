"""The modal part of operators whose work is done in short steps beside Blender. Esc ends it."""
from dataclasses import dataclass
from typing import Generic, TypeVar

import bpy
import numpy as np
from bpy.props import StringProperty
from bpy_extras.io_utils import ExportHelper
from mathutils import Matrix

from ..model.refusal import Refusal, report_refusals
from ..model.steps import Steps, finish
from ..read import read_mesh, scene_objects
from ..state import last_checks
from . import running_operators

TICK_INTERVAL = 0.02  # seconds between two steps

Outcome = TypeVar("Outcome")


class Job(Generic[Outcome]):
    """Work that is done in steps."""

    def advance(self) -> Outcome | None:
        """Does a step; returns the outcome once. Raises Refusal and OSError."""
        raise NotImplementedError

    def is_reading(self) -> bool:
        """Returns whether Blender's data is still being read, which must not change meanwhile."""
        return False

    def describe(self) -> str:
        """Describes what is being done, for the status bar."""
        raise NotImplementedError

    def stop(self) -> None:
        """Ends the work without an outcome."""
        raise NotImplementedError


class BesideBlender(running_operators.RunningOperator, Generic[Outcome]):
    """The modal part of an operator with a job."""
    job: Job[Outcome]

    def take_outcome(self, outcome: Outcome) -> set[str]:
        raise NotImplementedError

    def describe_end(self) -> str:
        """Says what Esc has left."""
        raise NotImplementedError

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type == 'ESC' and event.value == 'PRESS':
            self.take_back(context)
            self.report({'INFO'}, self.describe_end())
            return {'CANCELLED'}
        if event.type != 'TIMER':
            return {'RUNNING_MODAL'} if self.job.is_reading() else {'PASS_THROUGH'}
        try:
            outcome = self.job.advance()
        except (Refusal, OSError) as error:
            self.take_back(context)
            self.report({'ERROR'}, str(error))
            return {'CANCELLED'}
        if outcome is None:
            context.workspace.status_text_set(self.job.describe())
            return {'RUNNING_MODAL'}
        result = {'CANCELLED'}
        try:
            result = self.take_outcome(outcome)
        finally:
            if result != {'RUNNING_MODAL'}:
                running_operators.end(self, context)
        return result

    def take_back(self, context: bpy.types.Context) -> None:
        """Ends the work without a result."""
        self.job.stop()
        running_operators.end(self, context)


@dataclass(frozen=True)
class PanelShape:
    """A panel as it was when an operator began."""
    name: str
    shape: np.ndarray  # #vertices x 3 float32
    matrix: Matrix


def read_shape(ob: bpy.types.Object) -> PanelShape:
    return PanelShape(ob.name, read_mesh.read_shown_coordinates(ob), ob.matrix_world.copy())


class PanelWork(BesideBlender[Outcome]):
    """An operator that looks at panels one after the other: what it finds is refused where the panel was changed
    meanwhile. An outcome may be a refusal.
    """
    verb: str  # what is done with a panel: "check"

    def find_panels(self, context: bpy.types.Context) -> list[bpy.types.Object]:
        """Returns the panels, which is the active one."""
        return [scene_objects.read_active_object(context)]

    def look_at(self, context: bpy.types.Context, ob: bpy.types.Object) -> Outcome:
        """Looks at a panel at once; refuses what cannot be looked at."""
        raise NotImplementedError

    def build_job(self, context: bpy.types.Context, ob: bpy.types.Object) -> Job[Outcome]:
        """Reads the panel, and begins; refuses what cannot be looked at."""
        raise NotImplementedError

    def store(self, ob: bpy.types.Object, outcome: Outcome) -> None:
        raise NotImplementedError

    def execute(self, context: bpy.types.Context) -> set[str]:
        results = [self.look_at_once(context, ob) for ob in self.find_panels(context)]
        return {'FINISHED'} if {'FINISHED'} in results else {'CANCELLED'}

    @report_refusals
    def look_at_once(self, context: bpy.types.Context, ob: bpy.types.Object) -> set[str]:
        self.panel = read_shape(ob)
        self.store(ob, self.look_at(context, ob))
        return {'FINISHED'}

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        """Works beside Blender, which goes on meanwhile."""
        if context.area is None or context.area.type != 'VIEW_3D':
            return self.execute(context)
        self.left = [read_shape(ob) for ob in self.find_panels(context)]
        result = self.begin_next(context)
        return running_operators.begin(self, context, TICK_INTERVAL) if result == {'RUNNING_MODAL'} else result

    def begin_next(self, context: bpy.types.Context) -> set[str]:
        """Begins with the next panel that can be looked at; ends where none is left."""
        result = {'CANCELLED'}
        while self.left and result == {'CANCELLED'}:
            self.panel = self.left.pop(0)
            result = self.begin_job(context)
        return result

    @report_refusals
    def begin_job(self, context: bpy.types.Context) -> set[str]:
        self.job = self.build_job(context, self.find_unchanged())
        return {'RUNNING_MODAL'}

    def find_unchanged(self) -> bpy.types.Object:
        """Returns the object at work; refuses where it was changed since the operator began."""
        ob, panel = bpy.data.objects.get(self.panel.name), self.panel
        if ob is None or ob.matrix_world != panel.matrix or not last_checks.has_shape(ob, panel.shape):
            raise Refusal(f"{panel.name} was changed while it was {self.verb}ed: {self.verb} it again")
        return ob

    def take_outcome(self, outcome: Outcome | Refusal) -> set[str]:
        result = self.take_panel(bpy.context, outcome)
        following = self.begin_next(bpy.context)
        return following if following == {'RUNNING_MODAL'} else result

    @report_refusals
    def take_panel(self, context: bpy.types.Context, outcome: Outcome | Refusal) -> set[str]:
        if isinstance(outcome, Refusal):
            raise outcome
        self.store(self.find_unchanged(), outcome)
        for area in context.window.screen.areas:
            area.tag_redraw()
        return {'FINISHED'}


class FileWork(Job["FileWork"]):
    """Work on a file; its first step, which reads, is done at once."""
    steps: Steps[None]

    def write(self, context: bpy.types.Context) -> Steps[None]:
        """Reads the panel as it is in the first step, and writes; raises Refusal and OSError."""
        raise NotImplementedError

    def describe_written(self) -> str:
        """Describes what was written, after the end or Esc."""
        raise NotImplementedError

    def advance(self) -> "FileWork | None":
        try:
            return next(self.steps)
        except StopIteration:
            return self

    def stop(self) -> None:
        """Ends the work; files that are written stay."""
        self.steps.close()


class FileExport(BesideBlender[FileWork], ExportHelper):
    """An operator that writes pictures once their name is chosen; at once where there is no window."""
    filename_ext = ".png"
    filter_glob: StringProperty(default="*.png", options={'HIDDEN'})

    def write_file(self, context: bpy.types.Context, work: FileWork) -> set[str]:
        """Begins to write; raises Refusal and OSError."""
        self.job, work.steps = work, work.write(context)
        if bpy.app.background:
            finish(work.steps)
            return self.take_outcome(work)
        next(work.steps)
        return running_operators.begin(self, context, TICK_INTERVAL)

    def take_outcome(self, outcome: FileWork) -> set[str]:
        self.report({'INFO'}, outcome.describe_written())
        return {'FINISHED'}

    def describe_end(self) -> str:
        return self.job.describe_written()
