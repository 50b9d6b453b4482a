"""An inspection in the background: native calls only, with progress, which Esc cancels."""
from .. import native
from ..background_work import BackgroundWork
from ..model.inspection import Inspection
from ..model.refusal import Refusal
from ..solver import live_optimizer, panel_inspection
from ..solver.panel_inspection import Inspected
from .beside_blender import Job


class InspectionJob(Job[Inspection | Refusal]):
    """The work on one inspection, and how far it is."""

    def __init__(self, wanted: Inspected) -> None:
        """Begins at once."""
        self.progress = native.reflines.Progress()
        self.work = BackgroundWork(self.run, self.progress.cancel)
        self.work.submit(wanted)

    async def run(self, wanted: Inspected) -> Inspection | Refusal:
        try:
            with live_optimizer.convert_native_errors(wanted.patch):
                return await panel_inspection.inspect_surface(wanted, self.progress)
        except (Refusal, native.Cancelled) as error:
            return Refusal(str(error))

    def advance(self) -> Inspection | Refusal | None:
        """Looks whether the native calls have ended; returns the outcome once."""
        outcome = self.work.take()
        if outcome is None and not self.work.is_alive():
            return Refusal("The inspection stopped: nothing was found")
        return outcome

    def stop(self) -> None:
        self.work.stop()

    def describe(self) -> str:
        return f"Inspecting: {self.progress.stage}, {self.progress.fraction:.0%}   Esc: cancel"
