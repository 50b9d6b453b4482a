"""The result of an inspection: how even a panel's lines are from all around, and its worst spots."""
from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np

from .check_table import write_csv

# How the views of a walk around are named, in the order of reflines.walk_around.
VIEWS = ("the view", "its left", "its right", "above", "below")


@dataclass(frozen=True)
class Spot:
    """A place whose lines deviate, in world space."""
    place: tuple[float, float, float]
    size: float     # diameter, world units
    degrees: float  # that its lines deviate by, in the light and from the view that show it best
    height: float   # of the flaw, world units: negative of a dent
    view: str       # one of VIEWS, or the name of a light of the scene's set
    light: int      # of the walk around or of the set, from 0
    line: tuple[float, float, float]  # direction of the light that shows it best along the view camera, or in the set
    eye: tuple[float, float, float] | None = None  # direction to the viewer in the set; None: along the view camera

    def tell_where(self) -> str:
        """Tells where it is seen best."""
        return f"from {self.view}" if self.eye is None else f"in {self.view}"


@dataclass(frozen=True)
class Inspection:
    """An inspection in all lights from all views."""
    spots: tuple[Spot, ...]  # the worst first
    mean: float              # degrees, over all lights and views
    worst: str               # where lines are least even, as "from its left" or "in Its left, light"
    unseen: tuple[str, ...]  # the views or lights that see next to nothing of the panel


def format_csv(spots: Sequence[Spot]) -> str:
    """Formats the spots as comma-separated values with a header, the worst first; lengths in Blender units."""
    names = [each.name for each in fields(Spot) if each.name not in {"place", "line", "eye"}]
    rows = ({name: getattr(spot, name) for name in names}
            | dict(zip("xyz", np.asarray(spot.place).tolist(), strict=True)) | {"number": number}
            for number, spot in enumerate(spots, 1))
    return write_csv(["number", "x", "y", "z", *names], rows)
