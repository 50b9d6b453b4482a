"""Properties of the check: the pass marks of the scene, and the table of an object's last check."""
from collections.abc import Sequence

import bpy
from bpy.props import (BoolProperty, CollectionProperty, FloatProperty, FloatVectorProperty, IntProperty,
                       StringProperty)

from ..blender import units
from ..model.check_table import TableRow

NO_MARK = -1.0


GAP = 2e-5  # metres
SHUT_LINE = 5e-4


class ReflinesMarks(bpy.types.PropertyGroup):
    """The pass marks. Lengths are stored in metres, so that they are the same in scenes of any unit."""
    gap_in_metres: FloatProperty(name="Gap in Metres", default=GAP, min=0.0, options={'HIDDEN'})
    shut_line_in_metres: FloatProperty(name="Shut Line in Metres", default=SHUT_LINE, min=0.0, options={'HIDDEN'})
    gap: FloatProperty(name="Gap", unit='LENGTH', default=GAP, min=0.0, soft_max=0.01, precision=6, options=set(),
                       get=lambda self: self.gap_in_metres / units.read_unit_length(self.id_data),
                       set=lambda self, value: self.store_length("gap", value),
                       description="Largest gap to a neighbouring sheet")
    shut_line: FloatProperty(name="Shut Line", unit='LENGTH', default=SHUT_LINE, min=0.0, soft_max=0.01, precision=4,
                             options=set(),
                             get=lambda self: self.shut_line_in_metres / units.read_unit_length(self.id_data),
                             set=lambda self, value: self.store_length("shut_line", value),
                             description="By how much the gap along a shut line may vary, and how high its step may be")
    angle: FloatProperty(name="Angle", default=0.1, min=0.0, soft_max=10.0, precision=3,
                         description="Largest angle between the normals of both sides, degrees")
    curvature: FloatProperty(name="Curvature", subtype='PERCENTAGE', default=5.0, min=0.0, soft_max=100.0, precision=1,
                             description="Largest difference of the curvatures across the border, of the larger one")

    def store_length(self, name: str, value: float) -> None:
        """Stores a length that is given in Blender units."""
        setattr(self, f"{name}_in_metres", value * units.read_unit_length(self.id_data))


class ReflinesCheckRow(bpy.types.PropertyGroup):
    """One line of the table, see model/check_table.py; its name is Blender's own property `name`."""
    unit: StringProperty(name="Unit")
    before: FloatProperty(name="Before")
    after: FloatProperty(name="After")
    mark: FloatProperty(name="Mark", default=NO_MARK)
    passes: BoolProperty(name="Passes")
    change: StringProperty(name="Change", default="unchanged", description="Against before")
    better: IntProperty(name="Better", description="Edges that are better than before")
    worse: IntProperty(name="Worse", description="Edges that are worse than before")
    shut_line: IntProperty(name="Shut Line", description="Number of the shut line; 0: the whole panel")
    beside: StringProperty(name="Beside", description="The object across the shut line")
    place: FloatVectorProperty(name="Place", size=3)
    has_place: BoolProperty(name="Has Place")

    def to_row(self) -> TableRow:
        return TableRow(self.name, self.unit, self.before, self.after, None if self.mark < 0.0 else self.mark,
                        self.passes, self.change, self.better, self.worse, self.shut_line, self.beside,
                        *(self.place if self.has_place else (None, None, None)))

    def describe(self, *, compared: bool) -> str:
        """Describes the line in the scene's units: the value, before it that before the last run, and the mark."""
        shown = (self.before, self.after) if compared else (self.after,)
        values = " \u2192 ".join(self.format_value(value) for value in shown)
        return f"{self.name[:1].upper()}{self.name[1:]}: {values}{self.describe_change()}{self.describe_mark()}"

    def describe_change(self) -> str:
        """Says how the value changed, and at how many edges; nothing where it did not."""
        counts = [f"{name} at {count}" for name, count in (("better", self.better), ("worse", self.worse)) if count]
        return f", {' and '.join(counts)} edges" if counts else "" if self.change == "unchanged" else f", {self.change}"

    def describe_mark(self) -> str:
        if self.mark < 0.0:
            return ""
        beyond = "" if self.passes else "beyond the "
        return f" ({beyond}mark {self.format_value(self.mark)}{' of change' if self.name.startswith('crease') else ''})"

    def format_value(self, value: float) -> str:
        if self.unit == "length":
            return units.format_length(value, bpy.context.scene, 3)
        return f"{value:.3g}{chr(0xb0) if self.unit == 'degrees' else ' %'}"


class ShownShutLine:
    """One shut line as the panel tells of it."""

    def __init__(self, rows: Sequence[ReflinesCheckRow]) -> None:
        self.rows = {row.name.partition(" of ")[0]: row for row in rows}
        self.number, self.beside = rows[0].shut_line, rows[0].beside

    def find_change(self, *, compared: bool) -> str:
        """Returns how the line changed against before; without a run whether it passes."""
        if not compared:
            return "better" if all(row.passes for row in self.rows.values()) else "worse"
        changes = {row.change for row in self.rows.values()}
        return next((change for change in ("worse", "better") if change in changes), "unchanged")

    def describe(self) -> str:
        """Describes the line in the scene's units: its gap and flush, and what breaks across it."""
        gap, flush = (self.describe_span(*names) for names in (("smallest gap", "largest gap"),
                                                               ("lowest flush", "highest flush")))
        kink, lines = self.describe_value("kink"), ""
        if "line angle" in self.rows:
            lines = f", lines {self.describe_value('line angle')} and {self.describe_value('line offset')} off"
        beyond = [name for name, row in self.rows.items() if not row.passes]
        marks = f" (beyond the mark: {', '.join(beyond)})" if beyond else ""
        return f"Shut line {self.number}, {self.beside}: gap {gap}, flush {flush}, kink {kink}{lines}{marks}"

    def describe_span(self, low: str, high: str) -> str:
        return f"{self.describe_value(low)} to {self.describe_value(high)}"

    def describe_value(self, name: str) -> str:
        row = self.rows[name]
        digits = {"degrees": "{:.2f}\u00b0", "percent": "{:.1f} %"}.get(row.unit)
        return row.format_value(row.after) if digits is None else digits.format(row.after)


class ReflinesCheck(bpy.types.PropertyGroup):
    """The table of the last check."""
    rows: CollectionProperty(type=ReflinesCheckRow)
    seams: IntProperty(name="Seams", description="Edges that were judged")
    failed: IntProperty(name="Failed", description="Those of them that do not pass")
    compared: BoolProperty(name="Compared", description="Whether there is a run, before which the panel was another")

    def fill(self, rows: Sequence[TableRow], seams: int, failed: int, *, compared: bool) -> None:
        self.rows.clear()
        for row in rows:
            stored = self.rows.add()
            for name in ("name", "unit", "before", "after", "passes", "change", "better", "worse", "shut_line",
                         "beside"):
                setattr(stored, name, getattr(row, name))
            stored.has_place = row.x is not None
            stored.place = (row.x, row.y, row.z) if stored.has_place else (0.0, 0.0, 0.0)
            stored.mark = NO_MARK if row.mark is None else row.mark
        self.seams, self.failed, self.compared = seams, failed, compared

    def list_shut_lines(self) -> list[ShownShutLine]:
        count = max((row.shut_line for row in self.rows), default=0)
        return [ShownShutLine([row for row in self.rows if row.shut_line == number])
                for number in range(1, count + 1)]

    def headline(self) -> str:
        """Says in a sentence what is worse than before and what is beyond its mark; without a run what does not pass.
        """
        beyond = [row.name for row in self.rows if not row.passes]
        if not self.compared and beyond:
            return f"Does not pass: {', '.join(beyond)}"
        if not self.compared:
            return f"Passes: {len(self.rows)} lines, {self.seams} edges of borders and creases"
        worse = [row.name for row in self.rows if row.change == "worse"]
        better = [row.name for row in self.rows if row.change == "better"]
        changes = (("worse than before", worse), ("better than before", better),
                   ("beyond the mark, as before", [name for name in beyond if name not in worse]))
        said = "; ".join(f"{what}: {', '.join(names)}" for what, names in changes if names)
        return f"{said[:1].upper()}{said[1:]}" if said else "Nothing has changed by more than the marks"
