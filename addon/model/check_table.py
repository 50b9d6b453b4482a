"""The table of a check: lines with a value before and after, how that changed, a pass mark, and whether it passes."""
import csv
import io
import json
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, fields

LINES_TOLERANCE = 0.05  # degrees that the mesh's own facets can add to how far lines are off their course


@dataclass(frozen=True)
class TableRow:
    """One line of the table."""
    name: str
    unit: str            # "length" (Blender units), "degrees", "percent"
    before: float
    after: float
    mark: float | None   # of a crease that for the change
    passes: bool
    change: str = "unchanged"  # "better", "unchanged", "worse" against before
    better: int = 0      # edges that are better
    worse: int = 0
    shut_line: int = 0   # that the line tells of, from 1; 0: of the whole panel
    beside: str = ""     # the object across that shut line
    x: float | None = None  # where it is, world units; None of what has no place
    y: float | None = None
    z: float | None = None


def describe_solve(lines: tuple[float, float], move: float, limit: float | None) -> list[TableRow]:
    """Returns the lines of the last solve: how far reflection lines were and are off their course (degrees), and its
    largest move along the view against its limit.
    """
    within = limit is None or move <= limit
    return [TableRow("lines off their course", "degrees", *lines, None, True, compare(*lines, LINES_TOLERANCE)),
            TableRow("move along the view", "length", 0.0, move, limit, within, "unchanged" if within else "worse")]


def compare(before: float, after: float, tolerance: float) -> str:
    """Says how a value changed that is the better the smaller it is."""
    if abs(after - before) <= tolerance:
        return "unchanged"
    return "worse" if after > before else "better"


def format_csv(rows: Sequence[TableRow]) -> str:
    """Formats the table as comma-separated values with a header; an empty mark where there is none."""
    return write_csv([each.name for each in fields(TableRow)],
                     ({name: "" if value is None else value for name, value in asdict(row).items()} for row in rows))


def write_csv(names: list[str], rows: Iterable[dict[str, str | int | float]]) -> str:
    """Writes rows with these names as comma-separated values with a header."""
    text = io.StringIO()
    writer = csv.DictWriter(text, names, lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def format_json(name: str, rows: Sequence[TableRow]) -> str:
    """Formats the table as JSON, with the name of the object, whether all lines pass, and whether any is worse."""
    table = {"object": name, "passes": all(row.passes for row in rows),
             "worse": any(row.change == "worse" for row in rows), "rows": [asdict(row) for row in rows]}
    return json.dumps(table, indent=2) + "\n"
