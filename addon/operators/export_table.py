"""The operator Export Table."""
from collections.abc import Callable
from pathlib import Path

import bpy
from bpy.props import EnumProperty, StringProperty
from bpy_extras.io_utils import ExportHelper

from ..blender.tooltips import tell_by
from ..model import check_table, inspection
from ..model.refusal import Refusal, report_refusals
from ..read import scene_objects

TABLES = (
    ('CHECK', "Check", "The table of the last check: .csv for tables, .json for programs"),
    ('SPOTS', "Spots", "The spots of the last inspection, as .csv"),
)


class REFLINES_OT_export_table(ExportHelper, bpy.types.Operator):
    """Write the table of the last check to a file: .csv for tables, .json for programs"""
    bl_idname = "reflines.export_table"
    bl_label = "Export Table"

    filename_ext = ".csv"
    check_extension = None  # the artist's own ending says which
    filter_glob: StringProperty(default="*.csv;*.json", options={'HIDDEN'})
    table: EnumProperty(name="Table", items=TABLES, default='CHECK', options={'HIDDEN', 'SKIP_SAVE'})

    description = tell_by("table", {'SPOTS': "Write the spots of the last inspection to a .csv file"})

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = scene_objects.read_active_object(context)
        cls.poll_message_set("Make a panel active that was checked or inspected")
        return ob is not None and ob.type == 'MESH' and (
            len(ob.reflection_lines.check.rows) > 0 or len(ob.reflection_lines.inspection.spots) > 0)

    @report_refusals
    def execute(self, context: bpy.types.Context) -> set[str]:
        ob, path = scene_objects.read_active_object(context), Path(bpy.path.abspath(self.filepath))
        count, kinds = (format_check if self.table == 'CHECK' else format_spots)(ob)
        if not count:
            raise Refusal(f"{ob.name} has no such table: check or inspect it first")
        if path.suffix.lower() not in kinds:
            raise Refusal(f"{path.name or 'The file'} does not end in {' or '.join(kinds)}: add that")
        path.write_text(kinds[path.suffix.lower()](), encoding="utf-8")
        self.report({'INFO'}, f"{ob.name}: {count} lines written to {path.name}")
        return {'FINISHED'}


def format_check(ob: bpy.types.Object) -> tuple[int, dict[str, Callable[[], str]]]:
    """Returns how many lines the table of the last check has, and its text by the ending of the file."""
    rows = [row.to_row() for row in ob.reflection_lines.check.rows]
    return len(rows), {".csv": lambda: check_table.format_csv(rows),
                       ".json": lambda: check_table.format_json(ob.name, rows)}


def format_spots(ob: bpy.types.Object) -> tuple[int, dict[str, Callable[[], str]]]:
    """Returns how many spots the last inspection has, and their text by the ending of the file."""
    spots = [spot.to_spot() for spot in ob.reflection_lines.inspection.spots]
    return len(spots), {".csv": lambda: inspection.format_csv(spots)}
