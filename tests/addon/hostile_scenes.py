"""Scenes that a file or a script can hold, though no artist builds them: cages that are no surfaces, numbers that are
none, sizes beyond all use. Each is made in Edit Mode with its faces selected, or in Object Mode where Blender itself
cannot edit it.
"""
from collections.abc import Callable
from functools import partial
from math import radians

import bmesh
import bpy
import numpy as np

import scenes

NAN, INF, HUGE = float("nan"), float("inf"), 3e38
Scene = Callable[[], bpy.types.Object]


def look_from_above() -> None:
    """As scenes.look_from_above, also where the add-on finds no place to look at."""
    data = bpy.data.cameras.new("View Camera")
    data.type, data.ortho_scale = 'ORTHO', 3.0
    settings = bpy.context.scene.reflection_lines
    settings.camera = bpy.data.objects.new("View Camera", data)
    settings.light = bpy.data.objects.new("Light Direction", None)
    settings.camera.location, settings.light.rotation_euler = (0.0, 0.0, 5.0), (0.0, radians(70.0), 0.0)
    for ob in (settings.camera, settings.light):
        bpy.context.collection.objects.link(ob)
    bpy.context.view_layer.update()


def ready(ob: bpy.types.Object) -> bpy.types.Object:
    """With view and light, all of it selected in Edit Mode."""
    look_from_above()
    scenes.edit(ob)
    bpy.ops.mesh.select_all(action='SELECT')
    return ob


def caged(ob: bpy.types.Object, levels: int = 2) -> bpy.types.Object:
    ob.modifiers.new("Subdivision", 'SUBSURF').levels = levels
    return ob


def book(pages: int) -> bpy.types.Object:
    """Triangles around one edge."""
    angle = np.linspace(0.0, 2.0 * np.pi, pages, endpoint=False)
    rim = [(np.cos(a), np.sin(a), 0.5) for a in angle]
    return ready(caged(scenes.linked("Book", [(0, 0, 0), (0, 0, 1), *rim], [(0, 1, 2 + k) for k in range(pages)])))


def random_cage(seed: int) -> bpy.types.Object:
    """Thirty polygons on eleven vertices: edges of many faces, bow ties, turned and doubled faces."""
    dice = np.random.default_rng(seed)
    faces = {tuple(dice.permutation(11)[:dice.integers(3, 6)].tolist()) for _ in range(30)}
    return ready(caged(scenes.linked("Tangle", dice.normal(size=(11, 3)).tolist(), sorted(faces))))


def bow_tie() -> bpy.types.Object:
    """Two fans that meet in a vertex only."""
    rim = [(np.cos(a), np.sin(a), 0.0) for a in (-0.5, 0.0, 0.5, 2.6, 3.1, 3.6)]
    return ready(scenes.linked("Bow Tie", [(0, 0, 0), *rim], [(0, 1, 2), (0, 2, 3), (0, 4, 5), (0, 5, 6)]))


def moebius() -> bpy.types.Object:
    angle = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
    rows = [((1 + s * np.cos(a / 2)) * np.cos(a), (1 + s * np.cos(a / 2)) * np.sin(a), s * np.sin(a / 2))
            for s in (-0.3, 0.3) for a in angle]
    faces = [(k, k + 1, 25 + k, 24 + k) for k in range(23)] + [(23, 24, 0, 47)]
    return ready(caged(scenes.linked("Strip", rows, faces)))


def cube() -> bpy.types.Object:
    bpy.ops.mesh.primitive_cube_add()
    return ready(caged(bpy.context.object, 3))


def fan(spokes: int) -> bpy.types.Object:
    rim = [(np.cos(a), np.sin(a), -0.1) for a in np.linspace(0.0, 2.0 * np.pi, spokes, endpoint=False)]
    return ready(scenes.linked("Fan", [(0, 0, 0), *rim], [(0, 1 + k, 1 + (k + 1) % spokes) for k in range(spokes)]))


def slivers() -> bpy.types.Object:
    """A grid sheared so far that each triangle reaches across the whole of it."""
    return moved(lambda V: np.stack([V[:, 0], 1e-4 * V[:, 1] + V[:, 0], V[:, 2]], 1), 40)


def moved(change: Callable[[np.ndarray], np.ndarray], cells: int = 16) -> bpy.types.Object:
    """The panel with its vertices (#V x 3) elsewhere."""
    ob = scenes.panel(cells=cells)
    V = scenes.positions(ob).astype(np.float64)
    with np.errstate(all="ignore"):
        ob.data.vertices.foreach_set("co", np.asarray(change(V), np.float32).ravel())
    ob.data.update()
    return ready(ob)


def one_vertex(value: float, axis: int = 2, number: int = 150) -> bpy.types.Object:
    def change(V: np.ndarray) -> np.ndarray:
        V[number, axis] = value
        return V
    return moved(change)


def doubled_vertices() -> bpy.types.Object:
    """Every face has vertices of its own."""
    ob = ready(scenes.panel())
    edit = bmesh.from_edit_mesh(ob.data)
    bmesh.ops.split_edges(edit, edges=edit.edges[:])
    bmesh.update_edit_mesh(ob.data)
    return ob


def doubled_faces() -> bpy.types.Object:
    """A second, turned copy of each face, on vertices in the same places."""
    ob = ready(scenes.panel())
    bpy.ops.mesh.duplicate()
    bpy.ops.mesh.flip_normals()
    bpy.ops.mesh.select_all(action='SELECT')
    return ob


def polygon(points: np.ndarray) -> bpy.types.Object:
    return ready(scenes.linked("Polygon", np.column_stack([points, np.zeros(len(points))]).tolist(),
                               [tuple(range(len(points)))]))


def large_polygon() -> bpy.types.Object:
    a = np.linspace(0.0, 2.0 * np.pi, 3000, endpoint=False)
    return polygon(np.stack([np.cos(a), np.sin(a)], 1))


def crossed_polygon() -> bpy.types.Object:
    """A star whose sides cross."""
    a = 4.0 * np.pi / 5.0 * np.arange(5)
    return polygon(np.stack([np.cos(a), np.sin(a)], 1))


def without_faces() -> bpy.types.Object:
    return ready(caged(scenes.linked("Points", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [])))


def loose_vertices() -> bpy.types.Object:
    """A panel, and beside it vertices in no face that are nowhere."""
    ob = scenes.panel()
    count = len(ob.data.vertices)
    ob.data.vertices.add(3)
    for k, place in enumerate(((NAN, NAN, NAN), (INF, 0, 0), (HUGE, -HUGE, HUGE))):
        ob.data.vertices[count + k].co = place
    return ready(ob)


def scaled(scale: tuple[float, float, float]) -> bpy.types.Object:
    ob = ready(scenes.panel())
    ob.scale = scale
    bpy.context.view_layer.update()
    return ob


def under_a_flat_parent() -> bpy.types.Object:
    ob = ready(scenes.panel())
    parent = bpy.data.objects.new("Parent", None)
    bpy.context.collection.objects.link(parent)
    parent.scale, ob.parent = (0.0, 0.0, 0.0), parent
    bpy.context.view_layer.update()
    return ob


def seen(which: str, **transform: tuple) -> bpy.types.Object:
    """With a camera or a light that is nowhere, or of no direction."""
    ob = ready(scenes.panel())
    helper = getattr(bpy.context.scene.reflection_lines, which)
    for name, value in transform.items():
        setattr(helper, name, value)
    bpy.context.view_layer.update()
    return ob


def camera_in_the_panel() -> bpy.types.Object:
    ob = seen("camera", location=(0.0, 0.0, 0.0))
    bpy.context.scene.reflection_lines.camera.data.type = 'PERSP'
    return ob


def warped(change: Callable[[bpy.types.Object], None]) -> bpy.types.Object:
    """With a warp lattice that somebody has changed."""
    ob = ready(scenes.panel())
    bpy.ops.reflines.add_warp_lattice()
    scenes.object_mode()
    scenes.activate(ob)
    scenes.edit(ob)
    change(bpy.context.scene.reflection_lines.warp.lattice)
    bpy.context.view_layer.update()
    return ob


def set_points(value: tuple[float, float, float], lattice: bpy.types.Object) -> None:
    lattice.data.points[5].co_deform = value


def fold_points(lattice: bpy.types.Object) -> None:
    for point in lattice.data.points:
        point.co_deform.x *= -3.0


def refine_points(lattice: bpy.types.Object) -> None:
    lattice.data.points_u = lattice.data.points_v = lattice.data.points_w = 64


def flatten_points(lattice: bpy.types.Object) -> None:
    lattice.data.points_u = lattice.data.points_v = 1


def turn_lattice(lattice: bpy.types.Object) -> None:
    lattice.scale = (NAN, 1.0, INF)


def pictured(size: tuple[int, int], spot: float | None = None) -> bpy.types.Object:
    """With an image of any shape; `spot` is the value of one pixel."""
    ob = ready(scenes.panel())
    image = bpy.data.images.new("Hostile", *size, float_buffer=spot is not None)
    if spot is not None:
        pixels = np.zeros(4 * size[0] * size[1], np.float32)
        pixels[4 * (len(pixels) // 8):][:3] = spot
        image.pixels.foreach_set(pixels)
    settings = bpy.context.scene.reflection_lines
    settings.pattern.image = settings.stripes.image = image
    return ob


def lost_picture() -> bpy.types.Object:
    ob = pictured((4, 4))
    image = bpy.context.scene.reflection_lines.pattern.image
    image.source, image.filepath = 'FILE', "//nowhere.png"
    return ob


def creased(value: float) -> bpy.types.Object:
    """A cage whose creases are no numbers that Blender's own fields can take."""
    ob = caged(scenes.panel(cells=5))
    if bpy.app.version < (4, 0, 0):
        ob.data.edges.foreach_set("crease", np.full(len(ob.data.edges), value, np.float32))
    else:
        ob.data.attributes.new("crease_edge", 'FLOAT', 'EDGE').data.foreach_set(
            "value", np.full(len(ob.data.edges), value, np.float32))
    return ready(ob)


def mirrored(every: bool) -> bpy.types.Object:
    """A cage whose Mirror modifier has all axes, or a mirror object that is nowhere."""
    ob = scenes.panel(cells=8)
    mirror = ob.modifiers.new("Mirror", 'MIRROR')
    mirror.use_axis = (True, every, every)
    if not every:
        mirror.mirror_object = bpy.data.objects.new("Nowhere", None)
        bpy.context.collection.objects.link(mirror.mirror_object)
        mirror.mirror_object.location.x = NAN
    return ready(caged(ob))


def keyed(value: float) -> bpy.types.Object:
    """In a shape key with a vertex that is nowhere."""
    ob = scenes.panel()
    ob.shape_key_add(name="Basis")
    key = ob.shape_key_add(name="Key")
    key.data[150].co.z, key.value = value, 1.0
    ob.active_shape_key_index = 1
    return ready(ob)


SCENES: dict[str, Scene] = {
    **{f"an edge of {pages} faces": partial(book, pages) for pages in (3, 20, 300)},
    **{f"random faces {seed}": partial(random_cage, seed) for seed in range(4)},
    "two fans at a vertex": bow_tie,
    "a strip of one side": moebius,
    "a closed cage": cube,
    "a fan of 300": partial(fan, 300),
    "a fan of 8000": partial(fan, 8000),
    "slivers": slivers,
    "doubled vertices": doubled_vertices,
    "doubled faces": doubled_faces,
    "a polygon of 3000 corners": large_polygon,
    "a polygon that crosses itself": crossed_polygon,
    "no faces": without_faces,
    "loose vertices nowhere": loose_vertices,
    "all at one point": partial(moved, lambda V: 0.0 * V),
    "all on one line": partial(moved, lambda V: V * (1.0, 0.0, 0.0)),
    "a tiny panel": partial(moved, lambda V: 1e-30 * V),
    "a panel as large as numbers": partial(moved, lambda V: 1e38 * V),
    "a large panel": partial(moved, lambda V: 1e15 * V),
    "far from the origin": partial(moved, lambda V: V + 1e7),
    "a vertex that is no number": partial(one_vertex, NAN),
    "an endless vertex": partial(one_vertex, INF, 0),
    "a vertex at the end of numbers": partial(one_vertex, HUGE),
    "a vertex at the end of numbers, aside": partial(one_vertex, -HUGE, 1),
    "a far vertex": partial(one_vertex, 1e12),
    "a corner that is no number": partial(one_vertex, NAN, 2, 0),
    "no scale": partial(scaled, (0.0, 0.0, 0.0)),
    "no scale in one direction": partial(scaled, (1.0, 0.0, 1.0)),
    "a scale that is no number": partial(scaled, (NAN, 1.0, 1.0)),
    "an endless scale": partial(scaled, (INF, 1.0, 1.0)),
    "a tiny scale": partial(scaled, (1e-20, 1e-20, 1e-20)),
    "a huge scale": partial(scaled, (1e30, 1e30, 1e30)),
    "a huge turned scale": partial(scaled, (-1e20, 1e20, 1.0)),
    "a parent without scale": under_a_flat_parent,
    "a camera that is nowhere": partial(seen, "camera", rotation_euler=(NAN, 0.0, 0.0)),
    "a camera without scale": partial(seen, "camera", scale=(0.0, 0.0, 0.0)),
    "a camera in the panel": camera_in_the_panel,
    "a light that is nowhere": partial(seen, "light", rotation_euler=(0.0, NAN, 0.0)),
    "a light without scale": partial(seen, "light", scale=(0.0, 0.0, 0.0)),
    "an endless light": partial(seen, "light", scale=(INF, INF, INF)),
    "a lattice point that is no number": partial(warped, partial(set_points, (NAN, 0.0, 0.0))),
    "a lattice point far away": partial(warped, partial(set_points, (1e30, -1e30, 0.0))),
    "a folded lattice": partial(warped, fold_points),
    "a lattice of most points": partial(warped, refine_points),
    "a lattice of one point": partial(warped, flatten_points),
    "a lattice without numbers": partial(warped, turn_lattice),
    "a bright spot": partial(pictured, (64, 64), 65504.0),
    "a brighter spot": partial(pictured, (64, 64), HUGE),
    "a spot that is no number": partial(pictured, (64, 64), NAN),
    "an endless spot": partial(pictured, (64, 64), -INF),
    "a wide picture": partial(pictured, (65536, 16)),
    "a high picture": partial(pictured, (1, 65536)),
    "a picture of one pixel": partial(pictured, (1, 1)),
    "a lost picture": lost_picture,
    "creases that are no numbers": partial(creased, NAN),
    "huge creases": partial(creased, HUGE),
    "negative creases": partial(creased, -5.0),
    "all mirrors": partial(mirrored, True),
    "a mirror nowhere": partial(mirrored, False),
    "a shape key that is no number": partial(keyed, NAN),
    "a shape key at the end of numbers": partial(keyed, HUGE),
}
