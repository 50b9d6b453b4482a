"""The undo history of the handles within a session, which Blender's own does not see."""
from ..model.line_handle import Handles


class HandleHistory:
    """The handles that were before each change, and those that were taken back."""

    def __init__(self) -> None:
        self.before: list[Handles] = []  # what Ctrl Z brings back, the nearest last
        self.undone: list[Handles] = []  # what Ctrl Shift Z brings back, likewise

    def __len__(self) -> int:
        return len(self.before)

    def keep(self, handles: Handles) -> None:
        """Keeps the handles before a change."""
        self.before.append(handles)
        self.undone.clear()

    def drop(self) -> Handles:
        """Returns the handles kept last, and forgets that step: its change is taken back, or was none."""
        return self.before.pop()

    def step_back(self, present: Handles) -> Handles:
        """Returns the handles before the last change, of which there has to be one."""
        self.undone.append(present)
        return self.before.pop()

    def step_forward(self, present: Handles) -> Handles:
        """Returns the handles that were taken back last, of which there have to be some."""
        self.before.append(present)
        return self.undone.pop()
