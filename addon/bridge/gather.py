"""From a Blender mesh to the arrays of one region, in world space and double precision."""
from dataclasses import dataclass
from functools import partial

import bpy
import numpy as np

from . import contents, mirror, region, versions
from .mirror import Mirror
from .refusal import Refusal


@dataclass(frozen=True)
class Panel:
    """The region of one object as the solver takes it, and the way back."""
    name: str            # of the object
    faces: np.ndarray    # #mesh faces, bool: the region
    index: np.ndarray    # #V: the mesh vertex behind each vertex of the region
    local: np.ndarray    # #V x 3, object space
    V: np.ndarray        # #V x 3, world space
    F: np.ndarray        # #F x 3, oriented so that normals point outwards in world space
    matrix: np.ndarray   # 4 x 4, object to world
    key: str             # the shape key that the result goes to; empty for the mesh itself
    mirror: Mirror | None

    @property
    def center(self) -> np.ndarray:
        """Of the bounding box: unlike the mean of the vertices it does not lean to where the mesh is dense. With the
        image that a Mirror modifier adds."""
        own = box(self.V)
        if self.mirror is None or not self.mirror.image or self.mirror.axis < 0:
            return 0.5 * sum(own)
        image = box(self.placed(self.local * self.mirror.sign))
        return 0.5 * (np.minimum(own[0], image[0]) + np.maximum(own[1], image[1]))

    @property
    def local_center(self) -> np.ndarray:
        return np.linalg.solve(self.matrix, np.append(self.center, 1.0))[:3]

    @property
    def diagonal(self) -> float:
        low, high = box(self.V)
        return float(np.linalg.norm(high - low))

    def placed(self, local: np.ndarray) -> np.ndarray:
        """#points x 3 from object space to world space."""
        return local @ self.matrix[:3, :3].T + self.matrix[:3, 3]

    def same(self, other: "Panel") -> bool:
        """Whether an optimizer of the one serves the other."""
        return (type(self) is type(other) and np.array_equal(self.V, other.V) and np.array_equal(self.F, other.F)
                and mirror.same(self.mirror, other.mirror) and np.array_equal(self.matrix, other.matrix))


def box(V: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Its lowest and highest corner; along rows numpy takes ten times longer."""
    columns = np.ascontiguousarray(V.T)
    return columns.min(axis=1), columns.max(axis=1)


def active(context: bpy.types.Context) -> bpy.types.Object | None:
    """The active object; for a warp lattice the panel that it warps.

    A lattice in Edit Mode stands for none: undo would give back the lattice only, and not the panel.
    """
    ob = context.view_layer.objects.active
    if ob is None or ob.type != 'LATTICE' or ob.mode != 'OBJECT':
        return ob
    panel = ob.reflection_lines.panel  # a deleted object can still be pointed at
    return panel if panel is not None and contents.holds(context.view_layer.objects, panel) else ob


def subjects(context: bpy.types.Context) -> list[bpy.types.Object]:
    """The objects an operator works on: all meshes in Edit Mode that have selected faces, else the active mesh."""
    chosen = active(context)
    if chosen is None or chosen.mode != 'EDIT':
        return [chosen]
    editing = {ob.data: ob for ob in context.view_layer.objects if ob.mode == 'EDIT' and ob.type == 'MESH'}
    selected = [ob for ob in editing.values() if ob.data.total_face_sel > 0]
    if not selected:
        loose = sum(ob.data.total_vert_sel for ob in editing.values())
        also = f" (the {loose} selected vertices span no face)" if loose else ""
        raise Refusal(f"No faces are selected{also}: select the faces of the panel")
    return selected


def gather(ob: bpy.types.Object, local: np.ndarray | None = None, key: str = "", *, or_all: bool = False) -> Panel:
    """`local`: #vertices x 3 positions, object space, to take for those that the mesh has. `or_all`: all that is
    visible where no region is stored."""
    refuse_unusable(ob, key)
    mesh = ob.data
    if ob.mode == 'EDIT':
        ob.update_from_editmode()
    faces = region.selected(mesh) if ob.mode == 'EDIT' else region.stored(mesh)
    if or_all and ob.mode != 'EDIT' and not region.is_stored(mesh):
        faces = region.visible(mesh)
    if not faces.any():
        raise Refusal(f"{ob.name} has no stored region: "
                      "select the faces of the panel in Edit Mode and run the tool there once")
    local = coordinates(ob, key) if local is None else local
    around, sizes = face_corners(mesh, faces)
    refuse_broken(ob.name, around, local)
    chosen = short_triangles(around, sizes, local) if sizes.max() <= 4 else long_triangles(mesh, faces)
    index, F = renumbered(chosen, len(local))
    matrix = np.array(ob.matrix_world, dtype=np.float64)
    if np.linalg.det(matrix[:3, :3]) < 0.0:
        F = F[:, ::-1]  # a mirroring transform turns triangles over, but not what Blender calls their front
    local = local[index]
    V = local @ matrix[:3, :3].T + matrix[:3, 3]
    return Panel(ob.name, faces, index, local, V, np.ascontiguousarray(F), matrix, key, mirror.of(ob, local))


def refuse_unusable(ob: bpy.types.Object, key: str) -> None:
    mesh, keys = ob.data, ob.data.shape_keys
    if ob.library is not None or mesh.library is not None:
        raise Refusal(f"{ob.name} is linked from another file and cannot be changed here: make it local")
    if mesh.override_library is not None:
        raise Refusal(f"The mesh of {ob.name} is linked from another file and overridden here, which keeps no moved "
                      "vertices: make it local")
    if ob.mode != 'EDIT' and keys is not None and not key:
        raise Refusal(f"{ob.name} has shape keys: enter Edit Mode on the key that is to be changed, "
                      "or choose the result Shape Key")
    if key and keys is not None and not keys.use_relative:
        raise Refusal(f"{ob.name} has absolute shape keys, which cannot be mixed: choose the result Mesh in Edit Mode")
    refuse_mixed(ob, key)
    others = mesh.users - mesh.use_fake_user - 1
    if ob.mode != 'EDIT' and others > 0:
        raise Refusal(f"{ob.name} shares its mesh with {others} other objects: "
                      "make it single-user, or work in Edit Mode")
    written = keys and (keys.key_blocks.get(key) or (None if key else ob.active_shape_key))
    if written and versions.shape_is_locked(written):
        raise Refusal(f"The shape key {written.name} of {ob.name} is locked: unlock it, or choose another")
    scale = np.array(ob.matrix_world, dtype=np.float64)[:3, :3]
    if not np.isfinite(scale).all() or np.linalg.matrix_rank(scale) < 3:
        raise Refusal(f"{ob.name} is scaled to nothing in one direction: give it a scale other than zero")


def refuse_mixed(ob: bpy.types.Object, key: str) -> None:
    """A key holds whole shapes: the region of one put into another tears the panel at the region's border."""
    edited = ob.active_shape_key if ob.mode == 'EDIT' else None
    if key and edited is not None and edited.name != key and key in ob.data.shape_keys.key_blocks:
        raise Refusal(f"{ob.name} is edited in the shape key {edited.name}, but the result would go into {key}, which "
                      f"is there already: edit {key} to go on with it, or rename it to begin another")


def refuse_broken(name: str, vertices: np.ndarray, local: np.ndarray) -> None:
    """Coordinates that are no numbers must not reach Blender's triangulation of n-gons."""
    if np.isfinite(local).all():
        return
    broken = np.unique(vertices[~np.isfinite(local[vertices]).all(axis=1)])
    if len(broken):
        raise Refusal(f"{name} has {len(broken)} vertices in the region whose coordinates are no numbers, "
                      f"the first is {broken[0]}: delete or move them")


def mean_normal(ob: bpy.types.Object) -> np.ndarray:
    """World direction of the selected faces, else of the stored region, else of all; +Z for a closed body."""
    if ob.mode == 'EDIT':
        ob.update_from_editmode()
    mesh = ob.data
    faces = region.selected(mesh) if ob.mode == 'EDIT' else region.stored(mesh)
    areas, directions = np.empty(len(mesh.polygons)), np.empty(3 * len(mesh.polygons))
    mesh.polygons.foreach_get("area", areas)
    mesh.polygons.foreach_get("normal", directions)
    chosen = faces if faces.any() else np.ones(len(faces), dtype=bool)
    total = areas[chosen] @ directions.reshape(-1, 3)[chosen]
    matrix = np.array(ob.matrix_world, dtype=np.float64)[:3, :3]
    if np.linalg.norm(total) < 1e-3 * areas[chosen].sum() or np.linalg.matrix_rank(matrix) < 3 or not len(areas):
        return np.array([0.0, 0.0, 1.0])
    normal = np.linalg.solve(matrix.T, total)
    return normal / np.linalg.norm(normal)


def corners(mesh: bpy.types.Mesh) -> tuple[np.ndarray, np.ndarray]:
    """The vertices of all faces, corner by corner, and the number of corners of each face."""
    return integers(mesh.loops, "vertex_index", 1), integers(mesh.polygons, "loop_total", 1)


def integers(collection: bpy.types.bpy_prop_collection, name: str, each: int) -> np.ndarray:
    """`each` numbers >= 0 of every element. Blender stores them unsigned; read as signed they take ten times longer."""
    values = np.empty(each * len(collection), dtype=np.uint32)
    collection.foreach_get(name, values)
    return values.view(np.int32)


def face_corners(mesh: bpy.types.Mesh, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """As `corners`, of the chosen faces only."""
    vertices, sizes = corners(mesh)
    return vertices[np.repeat(faces, sizes)], sizes[faces]


def coordinates(ob: bpy.types.Object, key: str = "") -> np.ndarray:
    """#vertices x 3, object space, of the shape that `points` says."""
    shape = points(ob, key)
    values = np.empty(3 * len(shape), dtype=np.float32)  # as stored: read as doubles it takes ten times longer
    shape.foreach_get("co", values)
    return values.reshape(-1, 3).astype(np.float64)


def points(ob: bpy.types.Object, key: str = "") -> bpy.types.bpy_prop_collection:
    """In Edit Mode the mesh keeps the basis; what is edited is the active shape key. In Object Mode the shape key with
    this name, where there is one."""
    keys = ob.data.shape_keys
    if keys is None:
        return ob.data.vertices
    own = keys.key_blocks.get(key) if key and ob.mode != 'EDIT' else None
    return (own or ob.active_shape_key).data


def triangles(mesh: bpy.types.Mesh) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (#triangles x 3) and face (#triangles) of Blender's own triangulation."""
    mesh.calc_loop_triangles()
    cut = mesh.loop_triangles
    return integers(cut, "vertices", 3).reshape(-1, 3), integers(cut, "polygon_index", 1)


def short_triangles(around: np.ndarray, sizes: np.ndarray, local: np.ndarray) -> np.ndarray:
    """#triangles x 3 of triangles and quads, as Blender cuts them, but four times faster than read from it."""
    if (sizes == 4).all():
        return cut_quads(around.reshape(-1, 4), local).reshape(-1, 3)
    start, first = np.cumsum(sizes) - sizes, np.cumsum(sizes - 2) - (sizes - 2)
    F = np.empty((int((sizes - 2).sum()), 3), dtype=np.int32)
    three, four = sizes == 3, sizes == 4
    F[first[three]] = around[start[three][:, None] + [0, 1, 2]]
    halves = cut_quads(around[start[four][:, None] + [0, 1, 2, 3]], local)
    F[first[four]], F[first[four] + 1] = halves[:, 0], halves[:, 1]
    return F


def cut_quads(quads: np.ndarray, local: np.ndarray) -> np.ndarray:
    """#quads x 2 x 3: from the first corner, or from the second where the first cut would fold the quad over."""
    folds = first_cut_folds(quads, local)
    halves = np.empty((len(quads), 2, 3), dtype=np.int32)
    halves[:, 0], halves[:, 1, 0], halves[:, 1, 1:] = quads[:, :3], quads[:, 0], quads[:, 2:]
    halves[folds, 0, 2], halves[folds, 1, 0] = quads[folds, 3], quads[folds, 1]
    return halves


def first_cut_folds(quads: np.ndarray, local: np.ndarray) -> np.ndarray:
    """#quads, bool: both other corners lie on one side of the diagonal from the first corner to the third.

    The sign of (a x d) . (b x d), written as (a . b) (d . d) - (a . d) (b . d).
    """
    origin = local.take(quads[:, 0], axis=0)
    a, d, b = (local.take(quads[:, k], axis=0) - origin for k in (1, 2, 3))
    dot = partial(np.einsum, 'ij,ij->i')
    return dot(a, b) * dot(d, d) > dot(a, d) * dot(b, d)


def long_triangles(mesh: bpy.types.Mesh, faces: np.ndarray) -> np.ndarray:
    """#triangles x 3 of any faces, as Blender cuts them."""
    vertices, polygons = triangles(mesh)
    return vertices[faces[polygons]]


def renumbered(chosen: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """The vertices in use, and the triangles by their places among those."""
    used = np.zeros(count, dtype=bool)
    used[chosen] = True
    compact = np.cumsum(used, dtype=np.int32) - 1
    return np.flatnonzero(used), compact[chosen]
