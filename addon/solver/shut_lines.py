"""The measure of a panel's shut lines: gap and flush towards its neighbours, and the course of lines across."""
from dataclasses import dataclass

import numpy as np

from .. import native
from ..model.beside import Neighbors
from ..model.surface import CheckedSurface
from ..model.view import View
from ..native_call import call
from .panel_check import Checked, build_checked, build_row


@dataclass(frozen=True)
class ShutLineMarks:
    """The view, the spacing and the mark that shut lines are measured by."""
    seen: View | None  # without it lines are not measured
    spacing: float     # of the lines, radians
    mark: float        # of gap and flush, world units


async def check_shut_lines(surface: CheckedSurface, name: str, neighbors: Neighbors, marks: ShutLineMarks) -> Checked:
    """Measures the shut lines of a surface, whose object has this name; raises the native module's errors."""
    seen = marks.seen
    directions = {} if seen is None else {"view_direction": seen.view_direction, "line_direction": seen.line_direction}
    found = await call(native.reflines.check_shut_lines, surface.before, surface.after, surface.F, surface.region,
                       neighbors.V, neighbors.F, label=neighbors.label, spacing=marks.spacing, uneven=marks.mark,
                       flush=marks.mark, **directions)
    rows = [build_row(row, f"{row.name} of shut line {number}", number,
                      name if line.label < 0 else neighbors.names[line.label])
            for number, line in enumerate(found.list, 1) for row in line.rows]
    return build_checked(rows, surface.after[found.edges], found.passes, np.array(found.change, dtype=str))
