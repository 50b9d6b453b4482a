"""The table of a check: lines with a value before and after, a pass mark, and whether it passes."""
import csv
import io
import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields


@dataclass(frozen=True)
class TableRow:
    """One line of the table."""
    name: str
    unit: str            # "length" (Blender units), "degrees", "percent"
    before: float
    after: float
    mark: float | None   # of a crease that for the change
    passes: bool


def describe_solve(score: tuple[float, float], move: float, limit: float | None) -> list[TableRow]:
    """Returns the lines of the last solve: the deviation of its lines (degrees, before and after), and its largest move
    along the view against its limit.
    """
    return [TableRow("deviation of the lines", "degrees", *score, None, True),
            TableRow("move along the view", "length", 0.0, move, limit, limit is None or move <= limit)]


def format_csv(rows: Sequence[TableRow]) -> str:
    """Formats the table as comma-separated values with a header; an empty mark where there is none."""
    text = io.StringIO()
    writer = csv.DictWriter(text, [each.name for each in fields(TableRow)], lineterminator="\n")
    writer.writeheader()
    writer.writerows({name: "" if value is None else value for name, value in asdict(row).items()} for row in rows)
    return text.getvalue()


def format_json(name: str, rows: Sequence[TableRow]) -> str:
    """Formats the table as JSON, with the name of the object and whether all lines pass."""
    table = {"object": name, "passes": all(row.passes for row in rows), "rows": [asdict(row) for row in rows]}
    return json.dumps(table, indent=2) + "\n"
