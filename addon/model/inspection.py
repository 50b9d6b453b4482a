"""The result of an inspection: how even a panel's lines are from all around, and its worst spots."""
import csv
import io
from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields

import numpy as np

# How the views of a walk around are told, in the order of reflines.walk_around.
VIEWS = ("the view", "its left", "its right", "above", "below")


@dataclass(frozen=True)
class Spot:
    """A place whose lines deviate, in world space."""
    place: tuple[float, float, float]
    size: float     # diameter, world units
    degrees: float  # that its lines deviate by, in the light and from the view that show it best
    height: float   # of the flaw, world units: negative of a dent
    view: str       # one of VIEWS
    light: int      # of the walk around, from 0
    line: tuple[float, float, float]  # direction of the light that shows it best in the view


@dataclass(frozen=True)
class Inspection:
    """An inspection in all lights from all views."""
    spots: tuple[Spot, ...]  # the worst first
    mean: float              # degrees, over all lights and views
    worst_view: str          # one of VIEWS
    worst_light: int         # from 0
    unseen: tuple[str, ...]  # the views that see next to nothing of the panel


def format_csv(spots: Sequence[Spot]) -> str:
    """Formats the spots as comma-separated values with a header, the worst first; lengths in Blender units."""
    text = io.StringIO()
    names = [each.name for each in fields(Spot) if each.name not in {"place", "line"}]
    writer = csv.DictWriter(text, ["number", "x", "y", "z", *names], lineterminator="\n")
    writer.writeheader()
    for number, spot in enumerate(spots, 1):
        row = {name: value for name, value in asdict(spot).items() if name in names}
        writer.writerow(row | dict(zip("xyz", np.asarray(spot.place).tolist(), strict=True)) | {"number": number})
    return text.getvalue()
