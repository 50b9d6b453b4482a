"""The measure of a panel's shut lines: gap and flush towards its neighbours, and the course of lines across."""
import numpy as np

from .. import native
from ..model.beside import Neighbors
from ..model.checked_surface import CheckedSurface
from ..model.view import View
from .panel_check import Checked, build_checked, build_row


def check_shut_lines(surface: CheckedSurface, name: str, neighbors: Neighbors, seen: View | None, spacing: float,
                     mark: float) -> Checked:
    """Measures the shut lines of a surface, whose object has this name; raises the native module's errors. Without a
    view lines are not measured. `spacing` is that of the lines in radians, `mark` that of gap and flush in world units.
    """
    directions = {} if seen is None else {"view_direction": seen.view_direction, "line_direction": seen.line_direction}
    found = native.reflines.check_shut_lines(surface.before, surface.after, surface.F, surface.region, neighbors.V,
                                             neighbors.F, label=neighbors.label, spacing=spacing, uneven=mark,
                                             flush=mark, **directions)
    rows = [build_row(row, f"{row.name} of shut line {number}", number,
                      name if line.label < 0 else neighbors.names[line.label])
            for number, line in enumerate(found.list, 1) for row in line.rows]
    return build_checked(rows, surface.after[found.edges], found.passes, np.array(found.change, dtype=str))
