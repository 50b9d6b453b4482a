"""A check in the background: neighbours are read in short steps, and native calls measure; Esc cancels."""
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from .. import native
from ..background_work import BackgroundWork
from ..model.beside import Neighbors
from ..model.check_table import TableRow
from ..model.patch import Patch
from ..model.refusal import Refusal
from ..model.steps import Steps
from ..model.surface import CheckedSurface
from ..solver import live_optimizer, panel_check, shut_lines
from ..solver.panel_check import Checked, Marks
from ..solver.shut_lines import ShutLineMarks
from .beside_blender import Job

READING_TIME = 0.02  # seconds at a time, up to the end of a step


@dataclass(frozen=True)
class CheckRequest:
    """A request for one check."""
    name: str  # of the object
    patch: Patch
    surface: CheckedSurface
    own: Sequence[TableRow]
    marks: Marks
    shut_line_marks: ShutLineMarks


CheckInput = tuple[CheckRequest, Neighbors]


@dataclass(frozen=True)
class CheckOutcome:
    """The findings of a check of borders and of shut lines."""
    found: Checked
    shut: Checked
    own: Sequence[TableRow]  # the lines of the table that tell of the last run


class CheckJob(Job["CheckOutcome | Refusal"]):
    """The work on one check, and how far it is."""

    def __init__(self, reading: Steps[CheckInput]) -> None:
        """Reads the panel at once, so that what cannot be checked is refused before anything begins."""
        next(reading)
        self.stage = "what lies beside, step 1 of 3"
        self._reading: Steps[CheckInput] | None = reading
        self._work = BackgroundWork(self.run)

    def is_reading(self) -> bool:
        return self._reading is not None

    def advance(self) -> CheckOutcome | Refusal | None:
        """Reads for a short time, or looks whether the native calls have ended; returns the outcome once."""
        if self._reading is None:
            outcome = self._work.take()
            return outcome if self._work.is_alive() else Refusal("The check stopped: nothing was found")
        begun = time.monotonic()
        try:
            while time.monotonic() - begun < READING_TIME:
                next(self._reading)
        except StopIteration as end:
            self._reading = None
            self._work.submit(end.value)
        except Refusal as refusal:
            return refusal
        return None

    async def run(self, given: CheckInput) -> CheckOutcome | Refusal:
        try:
            return await measure(*given, self.begin_stage)
        except (Refusal, native.Cancelled) as error:
            return Refusal(str(error))

    def begin_stage(self, stage: str) -> None:
        self.stage = stage

    def describe(self) -> str:
        return f"Checking: {self.stage}   Esc: cancel"

    def stop(self) -> None:
        """Ends the work without an outcome; a native call that runs ends by itself."""
        if self._reading is not None:
            self._reading.close()
        self._work.stop()


async def measure(request: CheckRequest, neighbors: Neighbors,
                  begin_stage: Callable[[str], None] = lambda stage: None) -> CheckOutcome:
    """Measures borders, then shut lines; raises Refusal."""
    with live_optimizer.convert_native_errors(request.patch):
        begin_stage("borders, step 2 of 3")
        found = await panel_check.check_surface(request.surface, request.marks)
        begin_stage("shut lines, step 3 of 3")
        shut = await shut_lines.check_shut_lines(request.surface, request.name, neighbors, request.shut_line_marks)
    return CheckOutcome(found, shut, request.own)
