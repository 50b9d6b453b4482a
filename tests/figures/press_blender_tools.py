"""Applies Smooth Lines and Blender's Fair Tangency, Smooth Vertices and Relax to panels, for figures/blender_tools.py.

Runs in a Blender with a window, because Fair Tangency takes the face set below the mouse and Relax is dragged:

    blender --factory-startup --enable-event-simulate --python tests/in_blender.py --
        tests/figures/press_blender_tools.py FOLDER

Reads FOLDER/NAME.npz of each panel and writes FOLDER/NAME_shapes.npz: triangles F (#F x 3) with the mask `region`,
view, light, `count` of stripes and the version of Blender; for the flawed and the clean panel its positions and those
after each tool (#V x 3), with the seconds that each took; and for each of these shapes the nearest place on the clean
panel of every vertex of the region (#R x 3) with its triangle (#R).
"""
import sys
import time
from collections.abc import Callable, Generator
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix
from mathutils.bvhtree import BVHTree

import studio
import window
from window import Steps

SAMPLES = Path(__file__).resolve().parents[2] / "blend_samples"
REPEATS = (1, 2, 3, 5, 7, 10, 14, 20, 28, 40, 56, 80, 100)
RUNS = 3
LENGTHS = 6   # in the diagonal: the length of a drag
SHAPES = "_shapes"
FACE_SETS = ".sculpt_face_set"
FACTOR = 0.5  # of Smooth Vertices in Blender's menus
RELAX_STEPS = 100   # moves of the mouse, each of which relaxes once more
FULL_STRENGTH = 100  # pixels of the drag that bring the filter's strength of 10 to 1


def read_positions(ob: bpy.types.Object) -> np.ndarray:
    ob.update_from_editmode()
    V = np.empty(3 * len(ob.data.vertices), np.float32)
    ob.data.vertices.foreach_get("co", V)
    matrix = np.array(ob.matrix_world)
    return V.reshape(-1, 3).astype(float) @ matrix[:3, :3].T + matrix[:3, 3]


def write_positions(ob: bpy.types.Object, V: np.ndarray) -> None:
    bpy.ops.object.mode_set(mode='OBJECT')
    matrix = np.linalg.inv(np.array(ob.matrix_world))
    local = V @ matrix[:3, :3].T + matrix[:3, 3]
    ob.data.vertices.foreach_set("co", np.ascontiguousarray(local, np.float32).ravel())
    ob.data.update()
    bpy.ops.object.mode_set(mode='EDIT')


def read_triangles(ob: bpy.types.Object) -> tuple[np.ndarray, np.ndarray]:
    """Returns the triangles (#F x 3) and which of them are of selected faces."""
    mesh = ob.data
    mesh.calc_loop_triangles()
    F, face = np.empty(3 * len(mesh.loop_triangles), np.int32), np.empty(len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("vertices", F)
    mesh.loop_triangles.foreach_get("polygon_index", face)
    chosen = np.empty(len(mesh.polygons), bool)
    mesh.polygons.foreach_get("select", chosen)
    return F.reshape(-1, 3), chosen[face]


def build_panel(data: np.lib.npyio.NpzFile) -> bpy.types.Object:
    """Makes a panel, its camera and its light of arrays, with its region selected in Edit Mode."""
    studio.empty_scene()
    V = data["flawed"]
    faces = np.split(data["corners"], data["offsets"][1:-1])
    ob = studio.add_panel("Panel", V, np.array([face.tolist() for face in faces], object))
    studio.select_faces(ob, data["region"])
    centre, size = V.mean(axis=0), np.linalg.norm(np.ptp(V, axis=0))
    settings = bpy.context.scene.reflection_lines
    settings.camera = studio.add_view_camera(tuple(data["view"]), tuple(centre), size)
    settings.light = studio.add_light_direction(tuple(data["light"]), tuple(centre))
    settings.stripes.count = int(data["count"])
    bpy.context.view_layer.objects.active = ob
    bpy.context.view_layer.update()
    bpy.ops.object.mode_set(mode='EDIT')
    return ob


def open_panel(path: Path, shape: str) -> bpy.types.Object:
    """Returns the panel in the named shape, in Edit Mode, as if nothing had been done to it before."""
    data = np.load(path)
    if "corners" in data:
        bpy.ops.wm.read_homefile(use_empty=True, load_ui=False)  # drops what the add-on keeps of the press before
    else:
        bpy.ops.wm.open_mainfile(filepath=str(SAMPLES / f"{path.stem}.blend"), load_ui=False)
    with window.Window().override():
        ob = build_panel(data) if "corners" in data else bpy.context.view_layer.objects.active
        if shape == "clean":
            write_positions(ob, data["clean"])
    return ob


def smooth_lines(length: float) -> None:
    """Presses Smooth Lines with its defaults but for the length, whatever the sample is saved with; 0 is automatic."""
    bpy.ops.reflines.smooth('EXEC_DEFAULT', length=length, directional=False)


def measure_diagonal(ob: bpy.types.Object) -> float:
    """Returns the diagonal of the region's bounding box."""
    F, inside = read_triangles(ob)
    return float(np.linalg.norm(np.ptp(read_positions(ob)[np.unique(F[inside])], axis=0)))


def write_face_sets(mesh: bpy.types.Mesh) -> None:
    """Makes a face set of the selected faces: Blender 3.4's own operator leaves some out where there are more faces
    than vertices.
    """
    chosen = np.empty(len(mesh.polygons), bool)
    mesh.polygons.foreach_get("select", chosen)
    sets = mesh.attributes.get(FACE_SETS) or mesh.attributes.new(FACE_SETS, 'INT', 'FACE')
    sets.data.foreach_set("value", 1 + chosen.astype(np.int32))


def aim_at_region(driver: window.Window, ob: bpy.types.Object) -> Steps:
    """Turns the 3D view as the camera looks and moves the mouse over a face in the middle of the region."""
    F, inside = read_triangles(ob)
    centres = read_positions(ob)[F[inside]].mean(axis=1)
    middle = centres[np.linalg.norm(centres - centres.mean(axis=0), axis=1).argmin()]
    seen = driver.region_3d()
    seen.view_perspective = 'ORTHO'
    seen.view_rotation = Matrix(bpy.context.scene.reflection_lines.camera.matrix_world).to_quaternion()
    seen.view_location, seen.view_distance = middle, float(np.linalg.norm(np.ptp(centres, axis=0)))
    driver.redraw()
    yield 0.5
    driver.move(driver.region().width // 2, driver.region().height // 2)
    yield 0.3


def fair_tangency(driver: window.Window, ob: bpy.types.Object) -> Generator[float, None, float]:
    """Fairs a face set of the region as Sculpt Mode does, by the one below the mouse; returns the seconds."""
    with driver.override():
        bpy.ops.object.mode_set(mode='OBJECT')
        write_face_sets(ob.data)
        bpy.ops.object.mode_set(mode='SCULPT')
    yield from aim_at_region(driver, ob)
    with driver.override():
        start = time.perf_counter()
        if bpy.ops.sculpt.face_set_edit('INVOKE_DEFAULT', mode='FAIR_TANGENCY') != {'FINISHED'}:
            raise RuntimeError("the mouse is over no face set")
        seconds = time.perf_counter() - start
        bpy.ops.object.mode_set(mode='EDIT')
    return seconds


def write_mask(ob: bpy.types.Object) -> None:
    """Masks all vertices but those within the region, as a mask from its face set does."""
    F, inside = read_triangles(ob)
    mask = np.ones(len(ob.data.vertices), np.float32)
    mask[F[inside]] = 0.0
    mask[F[~inside]] = 1.0
    bpy.ops.object.mode_set(mode='SCULPT')
    bpy.ops.paint.mask_flood_fill(mode='VALUE', value=1.0)
    bpy.ops.object.mode_set(mode='OBJECT')
    ob.data.vertex_paint_masks[0].data.foreach_set("value", mask)


def relax(driver: window.Window, ob: bpy.types.Object) -> Steps:
    """Drags Sculpt Mode's tool Mesh Filter with its type Relax, at its full strength."""
    with driver.override():
        bpy.ops.object.mode_set(mode='OBJECT')
        write_mask(ob)
        bpy.ops.object.mode_set(mode='SCULPT')
        bpy.ops.wm.tool_set_by_id(name="builtin.mesh_filter")
        chosen = bpy.context.workspace.tools.from_space_view3d_mode('SCULPT').operator_properties("sculpt.mesh_filter")
        chosen.type, chosen.strength = 'RELAX', 10.0
    yield from aim_at_region(driver, ob)
    x, y = driver.region().width // 2, driver.region().height // 2
    driver.event('LEFTMOUSE', 'PRESS')
    for step in range(RELAX_STEPS):
        driver.move(x + FULL_STRENGTH + step % 2, y)
        yield 0.01
    driver.event('LEFTMOUSE', 'RELEASE')
    yield 0.2
    with driver.override():
        bpy.ops.object.mode_set(mode='EDIT')


def measure(driver: window.Window, act: Callable[[], object]) -> float:
    """Returns the seconds of an operator in the 3D view."""
    with driver.override():
        start = time.perf_counter()
        act()
        return time.perf_counter() - start


def apply_all(path: Path, shape: str, found: dict[str, np.ndarray]) -> Steps:
    """Adds positions and times of all tools on one shape of a panel to `found`."""
    ob = open_panel(path, shape)
    yield 0.2
    found[shape] = read_positions(ob)
    times: dict[str, list[float]] = {}
    for _ in range(RUNS if shape == "flawed" else 1):
        for tool in ("smooth", "length", "fair", *(f"vertices_{repeat}" for repeat in REPEATS)):
            ob = open_panel(path, shape)
            yield 0.2
            seconds = yield from apply_tool(window.Window(), ob, tool)
            times.setdefault(tool, []).append(seconds)
            found[f"{shape}_{tool}"] = read_positions(ob)
    ob = open_panel(path, shape)
    yield 0.2
    yield from relax(window.Window(), ob)
    found[f"{shape}_relax"] = read_positions(ob)
    found.update({f"{shape}_{tool}_seconds": np.array(seconds) for tool, seconds in times.items()})


def apply_tool(driver: window.Window, ob: bpy.types.Object, tool: str) -> Generator[float, None, float]:
    if tool == "fair":
        return (yield from fair_tangency(driver, ob))
    if tool == "smooth":
        return measure(driver, lambda: smooth_lines(0.0))
    if tool == "length":
        length = measure_diagonal(ob) / LENGTHS
        return measure(driver, lambda: smooth_lines(length))
    repeat = int(tool.removeprefix("vertices_"))
    return measure(driver, lambda: bpy.ops.mesh.vertices_smooth(factor=FACTOR, repeat=repeat))


def add_nearest_places(found: dict[str, np.ndarray]) -> None:
    """Adds for every shape where on the clean panel each vertex of the region comes to lie nearest."""
    tree = BVHTree.FromPolygons(found["clean"].tolist(), found["F"].tolist())
    vertices = np.unique(found["F"][found["region"]])
    for name in [name for name, values in found.items() if values.shape == found["clean"].shape]:
        hits = [tree.find_nearest(point) for point in found[name][vertices]]
        found[f"{name}_place"] = np.array([hit[0] for hit in hits])
        found[f"{name}_triangle"] = np.array([hit[2] for hit in hits], np.int32)


def press_panel(path: Path) -> Steps:
    """Applies all tools to one panel and writes its shapes."""
    ob = open_panel(path, "flawed")
    F, region = read_triangles(ob)
    patch = sys.modules["reflection_lines.read.gather"].gather_patch(ob)
    view = sys.modules["reflection_lines.view.facing"].read_patch_view(bpy.context.scene, patch)
    found = {"F": F, "region": region, "view": view.view_direction, "light": view.line_direction,
             "count": np.array(bpy.context.scene.reflection_lines.stripes.count),
             "blender": np.array(bpy.app.version_string)}
    for shape in ("flawed", "clean"):
        yield from apply_all(path, shape, found)
    add_nearest_places(found)
    np.savez(path.with_name(f"{path.stem}{SHAPES}.npz"), **found)
    print(f"{path.stem}: {len(F)} triangles, {region.sum()} in the region", flush=True)


def press_all(_: window.Window) -> Steps:
    for path in sorted(Path(sys.argv[1]).resolve().glob("*.npz")):
        if not path.stem.endswith(SHAPES):
            yield from press_panel(path)


window.start(window.all_steps((press_all,)))
