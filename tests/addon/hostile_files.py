"""Files whose stored texts, numbers, names and pointers somebody has changed: each change is made to a solved panel,
and saved without the add-on's own hand in it.
"""
import base64
import json
import zlib
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

import bpy
import numpy as np

from hostile_scenes import HUGE, INF, NAN

Arrays = dict[str, "np.ndarray | str | list"]
KINDS = {"faces": "u1", "index": "<i4", "F": "<i4", "local": "<f4", "residual": "<f4"}  # of packed arrays
Change = Callable[[bpy.types.Object], None]


def arrays_of(text: str) -> Arrays:
    stored = json.loads(text)
    return {name: np.frombuffer(zlib.decompress(base64.b64decode(stored.pop(name))), kind).copy()
            for name, kind in KINDS.items()} | stored | {"matrix": np.array(stored["matrix"])}


def text_of(arrays: Arrays) -> str:
    packed = {name: base64.b64encode(zlib.compress(array.tobytes())).decode() if name in KINDS else array.tolist()
              for name, array in arrays.items() if isinstance(array, np.ndarray)}
    return json.dumps(arrays | packed)


def with_value(name: str, value: float, place: int = 0) -> Callable[[Arrays], None]:
    def change(arrays: Arrays) -> None:
        arrays[name].flat[place] = value
    return change


def with_array(name: str, array: "np.ndarray | str | list") -> Callable[[Arrays], None]:
    def change(arrays: Arrays) -> None:
        arrays[name] = array
    return change


RECORDS = {
    "a negative index": with_value("index", -1),
    "an index beyond the mesh": with_value("index", 10**6, -1),
    "indices out of order": with_value("index", 10**4, 3),
    "a negative corner": with_value("F", -1),
    "a corner beyond the region": with_value("F", 10**6),
    "no triangles": with_array("F", np.zeros(0, np.int32)),
    "no vertices": with_array("index", np.zeros(0, np.int32)),
    "positions that are no numbers": with_value("local", np.nan),
    "a transform that is no number": with_value("matrix", np.nan),
    "an endless transform": with_value("matrix", np.inf),
    "a flat transform": with_array("matrix", np.diag([1.0, 1.0, 0.0, 1.0])),
    "a tiny transform": with_array("matrix", np.diag([1e-300, 1e-300, 1e-300, 1.0])),
    "a transform of integers that no float holds": with_array("matrix", [[10**400] * 4] * 4),
    "a transform of texts": with_array("matrix", [["x"] * 4] * 4),
    "a ragged transform": with_array("matrix", [[1.0], [1.0, 2.0]]),
    "a residual that is no number": with_value("residual", np.nan),
    "a residual of another size": with_array("residual", np.zeros(3, np.float32)),
    "positions in a plane": with_array("local", np.zeros(2 * 225, np.float32)),
    "half a position": with_array("local", np.zeros(3 * 225 - 1, np.float32)),
    "half a number": with_array("local", np.zeros(7, np.uint8)),
    "a matrix of three dimensions": with_array("matrix", np.zeros((2, 2, 4))),
    "faces of another mesh": with_array("faces", np.zeros(7, np.uint8)),
    "indices as numbers": with_array("index", [1, 2]),
    "indices that are not packed": with_array("index", base64.b64encode(b"1234").decode()),
    "indices that end early": with_array("index", base64.b64encode(zlib.compress(bytes(900))[:-8]).decode()),
    "no indices": lambda arrays: arrays.pop("index"),
    "a very long key": with_array("key", "x" * 1000),
    "a key that is no text": with_array("key", ["x"]),
}


def bomb(name: str, size: int) -> str:
    """A record with an array of zeros of so many bytes, which pack into a thousandth."""
    packing = zlib.compressobj()
    packed = b"".join([*(packing.compress(bytes(2**20)) for _ in range(size // 2**20)), packing.flush()])
    return json.dumps({name: base64.b64encode(packed).decode()})


TEXTS = ("x", "=" * 1000, "A" * 10**7, "[" * 100000, "[]", "5", "{}", "null", "\u00e9", json.dumps({"faces": {}}))
RUNS = {
    "no tool": ("nonsense", "{}"),
    "another operator": ("REFLINES_OT_resolve", "{}"),
    "an operator of Blender": ("WM_OT_quit_blender", "{}"),
    "no identifier": ("REFLINES_OT_", "{}"),
    "settings that are no JSON": ("REFLINES_OT_smooth", "{"),
    "settings that are a list": ("REFLINES_OT_smooth", "[1, 2]"),
    "settings nested deeply": ("REFLINES_OT_smooth", "[" * 100000),
    "a setting that there is not": ("REFLINES_OT_smooth", json.dumps({"nonsense": 1})),
    "a setting of another type": ("REFLINES_OT_smooth", json.dumps({"border": 5})),
    "a choice that there is not": ("REFLINES_OT_smooth", json.dumps({"border": "nonsense"})),
}
# These may finish: Blender brings the values into their range.
ODD_RUNS = {
    "a length that is no number": ("REFLINES_OT_smooth", '{"length": NaN}'),
    "an endless limit": ("REFLINES_OT_smooth", '{"limit": Infinity}'),
    "a huge density": ("REFLINES_OT_direction", '{"density": 1e300}'),
    "a raster of most cells": ("REFLINES_OT_warp", '{"cells": 1000000}'),
    "handles of another origin": ("REFLINES_OT_pull_line", '{"handles": "[1]"}'),
    "a setting of the operator itself": ("REFLINES_OT_smooth", '{"anew": false}'),
}
UP = {"start": [0.1, 0.0, 0.0], "end": [0.1, 0.1, 0.0], "radius": 0.5, "pinned": [], "muted": False}
HANDLES = {
    "no list": "{}", "no end": "[", "no handle": "[1]", "an empty handle": "[{}]", "nested deeply": "[" * 100000,
    "a point that is no number": json.dumps([{**UP, "end": [0.0, NAN, 0.0]}]),
    "a point far away": json.dumps([{**UP, "end": [1e14, 1e14, 0.0]}]),
    "no radius": json.dumps([{**UP, "radius": 0.0}]), "a negative radius": json.dumps([{**UP, "radius": -1e14}]),
    "too many": json.dumps([UP] * 101), "as many as there can be": json.dumps([UP] * 100),
    "a pin at one point": json.dumps([{**UP, "pinned": [UP["start"]]}]),
    "a curve at one point": json.dumps([{**UP, "curve": [UP["start"]] * 64}]),
}
FIXED = {"number": 1, "start": [0.1, 0.0, 0.0], "pinned": [], "bends": []}
VALUES = {"place": [0.1, 0.1, 0.0], "radius": 0.5, "muted": 0}
KEPT = {
    "a place that is no number": [{**VALUES, "place": [NAN, 0.0, 0.0]}],
    "a radius without end": [{**VALUES, "radius": INF}],
    "a place of two numbers": [{**VALUES, "place": [0.1, 0.1]}], "a place that is text": [{**VALUES, "place": "here"}],
    "more values than handles": [VALUES, VALUES], "numbers": [1.0, 2.0], "a number": 5, "an empty group": [{}],
}


def change_record(change: Callable[[Arrays], None], ob: bpy.types.Object) -> None:
    arrays = arrays_of(ob.reflection_lines.last)
    change(arrays)
    ob.reflection_lines.last = text_of(arrays)


def set_record(text: str, ob: bpy.types.Object) -> None:
    ob.reflection_lines.last = text


def set_bomb(name: str, ob: bpy.types.Object) -> None:
    ob.reflection_lines.last = bomb(name, 200 * 2**20)


def set_run(run: tuple[str, str], ob: bpy.types.Object) -> None:
    ob.reflection_lines.run.operator, ob.reflection_lines.run.settings = run


def set_handles(text: str, ob: bpy.types.Object) -> None:
    stored = ob.reflection_lines.handles
    stored.text, stored.vertices, stored.faces = text, len(ob.data.vertices), len(ob.data.polygons)
    set_run(("REFLINES_OT_pull_line", "{}"), ob)


def set_values(values: object, ob: bpy.types.Object) -> None:
    """Handles of this version, with values that it never stores."""
    set_handles(json.dumps([FIXED]), ob)
    put_object("handles.kept", values, ob)


def key_handles(frames: tuple[float, ...], ob: bpy.types.Object) -> None:
    """A handle whose place is keyed, in a file whose last solve was another tool's or none."""
    set_values([VALUES], ob)
    for frame in frames:
        ob.reflection_lines.handles.kept[0].keyframe_insert("place", frame=frame)


def set_attribute(name: str, kind: str, domain: str, value: float | None, ob: bpy.types.Object) -> None:
    """Stores an attribute under one of the add-on's names, of another type or with values that it never has."""
    old = ob.data.attributes.get(name)
    if old is not None:
        ob.data.attributes.remove(old)
    new = ob.data.attributes.new(name, kind, domain)
    for element in new.data if value is not None else ():
        element.value = value


def put(block: bpy.types.ID, path: str, value: object) -> None:
    """Stores a value past the property's own checks, as a changed file has it."""
    get = getattr(block, "bl_system_properties_get", None)
    group, names = get(do_create=True) if get else block, path.split(".")
    for name in names[:-1]:
        if name not in group:
            group[name] = {}
        group = group[name]
    if names[-1] in group:
        del group[names[-1]]  # from Blender 5 on a value cannot take the place of one of another type
    group[names[-1]] = value


def put_scene(path: str, value: object, _: bpy.types.Object) -> None:
    put(bpy.context.scene, f"reflection_lines.{path}", value)


def put_object(path: str, value: object, ob: bpy.types.Object) -> None:
    put(ob, f"reflection_lines.{path}", value)


def put_report(value: float, names: Sequence[str], ob: bpy.types.Object) -> None:
    """Puts a number in the place of these of the report."""
    for name in names:
        put_object(f"report.{name}", value, ob)


def put_all(value: object, ob: bpy.types.Object) -> None:
    for block in (bpy.context.scene, ob):
        put(block, "reflection_lines", value)


def point(holder: str, name: str, kind: str, ob: bpy.types.Object) -> None:
    """Points a setting at an object of another kind."""
    scene = bpy.context.scene.reflection_lines
    owners = {"scene": scene, "warp": scene.warp, "live": scene.live, "object": ob.reflection_lines}
    if kind == "TEXT":
        other = bpy.data.objects.new("Text", bpy.data.curves.new("Text", 'FONT'))
        bpy.context.collection.objects.link(other)
    else:
        other = {"MESH": ob, "CAMERA": scene.camera, "EMPTY": scene.light}[kind]
    setattr(owners[holder], name, other)


def begin_live_warp(change: Callable[[bpy.types.Object], None], ob: bpy.types.Object) -> None:
    """A live warp that is stored in the file, and whose start somebody has changed."""
    bpy.ops.reflines.add_warp_lattice()
    assert bpy.ops.reflines.live_warp() == {'FINISHED'}
    change(ob)


def remove_start(ob: bpy.types.Object) -> None:
    ob.data.attributes.remove(ob.data.attributes["reflines_live_start"])


def remove_lattice(_: bpy.types.Object) -> None:
    bpy.data.objects.remove(bpy.context.scene.reflection_lines.warp.lattice)


def set_mesh_property(name: str, value: object, ob: bpy.types.Object) -> None:
    ob.data[name] = value


def take_curve(ob: bpy.types.Object) -> None:
    """A fall-off curve that is of another kind of nodes."""
    settings = bpy.context.scene.reflection_lines
    settings.direction.shape = 'CURVE'
    settings.curve = bpy.data.node_groups.new("Other", 'GeometryNodeTree')


def add_check_row(ob: bpy.types.Object) -> None:
    row = ob.reflection_lines.check.rows.add()
    row.name, row.unit, row.before, row.after, row.mark = "x" * 1000, "parsecs", NAN, INF, NAN


def save_past_the_addon(path: str | Path) -> None:
    """Saves the file as it is: the add-on's handler would write its own records."""
    handlers = bpy.app.handlers.save_pre
    own = list(handlers)
    handlers.clear()
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    handlers.extend(own)


CHOICES = ("border", "result", "lights", "stripes.mode", "stripes.eye", "stripes.scope",
           "direction.centre", "direction.shape", "direction.direction", "direction.axis",
           "warp.fit", "pattern.fit")
NUMBERS = ("length", "limit", "strength", "stripes.image_rotation", "direction.density",
           "direction.radius", "direction.angle", "warp.amount", "pattern.width", "pattern.blur", "pull.radius",
           "marks.gap", "marks.curvature")
COUNTS = {"stripes.count": -5, "brush.size": -7}
REPORT = ("length", "score_before", "score_after", "cage_move", "residual_before", "residual_after",
          "automatic_limit", "automatic_length", "seconds")
FILES: dict[str, Change] = {
    **{f"record: {name}": partial(change_record, change) for name, change in RECORDS.items()},
    **{f"record of text {number}": partial(set_record, text) for number, text in enumerate(TEXTS)},
    "record that unpacks to 200 MiB": partial(set_bomb, "faces"),
    **{f"run: {name}": partial(set_run, run) for name, run in (RUNS | ODD_RUNS).items()},
    **{f"handles: {name}": partial(set_handles, text) for name, text in HANDLES.items()},
    **{f"kept handles: {name}": partial(set_values, values) for name, values in KEPT.items()},
    **{f"handles keyed at {frames}": partial(key_handles, frames) for frames in ((1.0, 11.0), (0.0, 1e6))},
    **{f"attribute {name} of {kind} by {domain}, {value}":
       partial(set_attribute, f"reflines_{name}", kind, domain, value) for name, kind, domain, value in (
           ("border", 'INT', 'POINT', 99), ("border", 'INT', 'POINT', -5), ("border", 'FLOAT', 'POINT', 2.0),
           ("border", 'INT', 'FACE', 1), ("region", 'INT', 'FACE', -7), ("region", 'FLOAT', 'FACE', NAN),
           ("region", 'INT', 'POINT', 1), ("pinned", 'INT', 'FACE', 2**31 - 1),
           ("pinned", 'FLOAT_COLOR', 'POINT', None), ("live_start", 'INT', 'POINT', 1))},
    **{f"choice {path}": partial(put_scene, path, 99) for path in CHOICES},
    **{f"no number in {path}": partial(put_scene, path, NAN) for path in NUMBERS},
    **{f"endless {path}": partial(put_scene, path, INF) for path in NUMBERS},
    **{f"count {path}": partial(put_scene, path, value) for path, value in COUNTS.items()},
    "report with NaN in every number": partial(put_report, NAN, ("largest_move", *REPORT)),
    "report with a number below all in every one": partial(put_report, -HUGE, REPORT),
    "report with a number below all for the move": partial(put_report, -HUGE, ("largest_move",)),
    "text for a length": partial(put_scene, "length", "text"),
    "a list for a choice": partial(put_scene, "border", [1.0, 2.0]),
    "a number for the stripes": partial(put_scene, "stripes", 5),
    "a number for all settings": partial(put_all, 5),
    "a choice of the object": partial(put_object, "limit_side", 99),
    "creases of no kind": partial(put_object, "creases", -1),
    "a limit by no group": partial(put_object, "limit_group", "Nobody"),
    "a centre that is no point": partial(put_object, "center", [NAN, INF, 0.0]),
    "a termination of no kind": partial(put_object, "report.termination", "nonsense"),
    "a remedy that is none": partial(put_object, "report.remedy", "nonsense"),
    "an eye that is nowhere": partial(put_scene, "stripes.frozen_eye", [NAN, 0.0, INF, 1.0]),
    "a check that is none": add_check_row,
    "a curve of another kind": take_curve,
    **{f"{holder}.{name} is a {kind.lower()}": partial(point, holder, name, kind) for holder, name, kind in (
        ("scene", "camera", 'MESH'), ("scene", "camera", 'EMPTY'), ("scene", "light", 'MESH'),
        ("scene", "light", 'CAMERA'), ("warp", "lattice", 'MESH'), ("warp", "lattice", 'EMPTY'),
        ("live", "panel", 'CAMERA'), ("live", "panel", 'TEXT'), ("live", "panel", 'MESH'), ("object", "panel", 'EMPTY'),
        ("object", "camera", 'MESH'), ("object", "light", 'MESH'))},
    **{f"live warp with {name}": partial(begin_live_warp, change) for name, change in (
        ("no start", remove_start), ("no lattice", remove_lattice),
        ("a size that is text", partial(set_mesh_property, "reflines_live_size", "text")),
        ("a key that is a number", partial(set_mesh_property, "reflines_live_key", 5)),
        ("a key that there is not", partial(set_mesh_property, "reflines_live_key", "Nobody")),
        ("keys that it never made", partial(set_mesh_property, "reflines_live_made", "Basis\nNobody")),
        ("a mark that is a list", partial(set_mesh_property, "reflines_live_left", [1, 2])))},
}
