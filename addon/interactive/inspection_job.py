"""An inspection in the background: native calls only, with progress, which Esc cancels."""
from dataclasses import dataclass

from .. import native
from ..background_work import BackgroundWork
from ..model.inspection import Inspection
from ..model.patch import Patch
from ..model.refusal import Refusal
from ..solver import live_optimizer, panel_inspection
from ..solver.panel_inspection import Inspected


@dataclass(frozen=True)
class InspectionRequest:
    """A request for one inspection."""
    patch: Patch
    wanted: Inspected


@dataclass(frozen=True)
class InspectionOutcome:
    """An inspection, or why there is none."""
    inspection: Inspection | None = None
    refusal: str = ""


class InspectionJob:
    """The work on a request, and how far it is."""

    def __init__(self, request: InspectionRequest) -> None:
        """Begins at once."""
        self.progress = native.reflines.Progress()
        self.work = BackgroundWork(self.run, self.progress.cancel)
        self.work.submit(request)

    async def run(self, request: InspectionRequest) -> InspectionOutcome:
        try:
            with live_optimizer.convert_native_errors(request.patch):
                return InspectionOutcome(await panel_inspection.inspect_surface(request.wanted, self.progress))
        except Refusal as refusal:
            return InspectionOutcome(refusal=str(refusal))
        except native.Cancelled as cancelled:
            return InspectionOutcome(refusal=str(cancelled))

    def advance(self) -> InspectionOutcome | None:
        """Looks whether the native calls have ended; returns the outcome once."""
        outcome = self.work.take()
        if outcome is None and not self.work.is_alive():
            return InspectionOutcome(refusal="The inspection stopped: nothing was found")
        return outcome

    def is_reading(self) -> bool:
        return False

    def stop(self) -> None:
        self.work.stop()

    def describe(self) -> str:
        """Describes how far the work is, for the status bar."""
        return f"Inspecting: {self.progress.stage}, {self.progress.fraction:.0%}   Esc: cancel"
