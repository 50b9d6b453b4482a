"""The check of a panel against pass marks."""
from dataclasses import asdict, dataclass

import numpy as np

from .. import native
from ..model.check_table import TableRow
from ..model.surface import CheckedSurface
from ..native_call import call


@dataclass(frozen=True)
class Marks:
    """The pass marks, by the names of the arguments of reflines.check."""
    gap: float               # world units
    angle: float             # degrees
    curvature: float         # percent
    deviation: float | None  # world units


@dataclass(frozen=True)
class Checked:
    """The result of a check, in world space."""
    rows: list[TableRow]
    segments: np.ndarray  # #E x 2 x 3: the edges that were judged
    passes: np.ndarray    # #E, bool
    change: np.ndarray    # #E: "better", "unchanged", "worse" against before
    worst: np.ndarray     # #W x 3: the worst place of each line of the table that is worse or does not pass
    worse: np.ndarray     # #W, bool: whether that line is worse

    def join(self, other: "Checked") -> "Checked":
        arrays = {name: np.concatenate([getattr(self, name), getattr(other, name)])
                  for name in ("segments", "passes", "change", "worst", "worse")}
        return Checked([*self.rows, *other.rows], **arrays)


async def check_surface(surface: CheckedSurface, marks: Marks) -> Checked:
    """Measures gap, angle, curvature and deviation; raises the native module's errors."""
    found = await call(native.reflines.check, surface.before, surface.after, surface.F, surface.region,
                       **surface.creases, **asdict(marks))
    rows = [build_row(row) for row in found.rows]
    judged = np.array([kind != "open" for kind in found.kind], dtype=bool)
    return build_checked(rows, surface.after[found.edges[judged]], found.passes[judged],
                         np.array(found.change)[judged])


def build_row(row: "native.CheckRow", name: str = "", shut_line: int = 0, beside: str = "") -> TableRow:
    """Builds the line of the table of a native one, with another name where one is given."""
    return TableRow(name or row.name, row.unit, row.before, row.after, row.mark, row.passes, row.change, row.better,
                    row.worse, shut_line, beside, *row.place.tolist())


def build_checked(rows: list[TableRow], segments: np.ndarray, passes: np.ndarray, change: np.ndarray) -> Checked:
    """Builds the result of a check, with the worst places of its lines."""
    shown = [row for row in rows if row.change == "worse" or not row.passes]
    return Checked(rows, segments, passes, change, np.array([(row.x, row.y, row.z) for row in shown]).reshape(-1, 3),
                   np.array([row.change == "worse" for row in shown], dtype=bool))
