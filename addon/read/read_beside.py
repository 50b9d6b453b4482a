"""Reads the surfaces beside a region that its border can follow: what is visible near it, of all objects."""
import time
from collections.abc import Iterator
from itertools import islice

import bpy
import numpy as np

from .. import native
from ..model import triangulation
from ..model.beside import Beside, Crossing, Neighbors, join_soups, label_soups
from ..model.mesh_snapshot import MeshSnapshot
from ..model.patch import Patch, compute_bounds
from ..model.steps import Steps, finish
from ..model.surroundings import find_readable
from . import modifiers, read_mesh, region_faces

WIDER = 1.05  # than the two lengths that a press takes in
NEIGHBOR_MARGIN = 0.25  # of the diagonal: what lies across a gap, and enough of it to tell how it runs on
STEP = 0.03  # seconds of reading between two looks at the window
SOLID = {'SOLID', 'TEXTURED'}  # objects drawn as bounds or wires are cutters and aids

NOTHING = np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64)  # no vertices, no triangles

Box = tuple[np.ndarray, np.ndarray]  # lowest and highest corner
Soup = tuple[np.ndarray, np.ndarray]  # vertices in world space and triangles


def read_beside(ob: bpy.types.Object, snapshot: MeshSnapshot, patch: Patch, crossing: Crossing) -> Beside:
    """Reads what lies beside the region of a mesh: its own visible faces, and those of other objects as their modifiers
    leave them. Nothing of it is changed.
    """
    nothing = measure_beside(patch)
    low, high = compute_bounds(patch.V)
    margin = nothing.gap + nothing.margin
    box = low - margin, high + margin
    others = [finish(cutting) for _, _, cutting in read_others(ob, box, crossing)]
    return nothing.add_soups([cut_own(snapshot, box), *others])


def cut_own(snapshot: MeshSnapshot, box: Box) -> Soup:
    """Cuts what of the mesh lies beside its region and has a vertex in a box."""
    V, mesh = snapshot.world, snapshot.mesh
    near = find_near(mesh.corners, mesh.sizes, V, find_inside(V, box), snapshot.visible & ~snapshot.region)
    return build_soup(snapshot.cut_faces(near, V), V, turned=snapshot.is_turned) if near.any() else NOTHING


def measure_beside(patch: Patch) -> Beside:
    """Measures how wide a gap beside a region is crossed and how far beyond it is read, without reading what is there.
    """
    gap = native.reflines.AUTOMATIC_GAP * patch.diagonal
    margin = WIDER * native.reflines.FAIR_MARGIN * native.reflines.AUTOMATIC_LENGTH * patch.diagonal
    return Beside(*join_soups([]), gap, margin)


def read_neighbors(ob: bpy.types.Object, V: np.ndarray) -> Steps[Neighbors]:
    """Reads what other objects have near the vertices V (#V x 3, world space) of an object's surface, in steps of some
    objects each, between which Blender may redraw, but the scene must not change.
    """
    low, high = compute_bounds(V)
    margin = NEIGHBOR_MARGIN * float(np.linalg.norm(high - low))
    box, soups, first = (low - margin, high + margin), {}, 0
    while first >= 0:
        # Blender's list of objects is valid until the step ends only; the further steps hold arrays.
        begun, first = begin_reading(ob, box, first)
        yield
        for name, cutting in begun:
            soup = yield from cutting
            soups[name] = join_soups([soups[name], soup]) if name in soups else soup  # instances have one name
    return label_soups(soups)


def begin_reading(ob: bpy.types.Object, box: Box, first: int) -> tuple[list[tuple[str, Steps[Soup]]], int]:
    """Begins to read what other objects have within a box, from that with the number `first` on, until that has taken
    long. Returns their names and further steps, and the number to go on with, -1 at the end.
    """
    end, begun = time.monotonic() + STEP, []
    for number, name, cutting in read_others(ob, box, Crossing(everywhere=True), first):
        begun.append((name, cutting))
        if time.monotonic() > end:
            return begun, number + 1
    return begun, -1


def read_others(ob: bpy.types.Object, box: Box, crossing: Crossing,
                first: int = 0) -> Iterator[tuple[int, str, Steps[Soup]]]:
    """Reads what other visible objects, and instances, have within a box, from the number `first` on: their numbers,
    names, and further steps, which take arrays alone.
    """
    instances = bpy.context.evaluated_depsgraph_get().object_instances
    for number, instance in enumerate(islice(instances, first, None), first):
        other, matrix = instance.object, np.array(instance.matrix_world, dtype=np.float64)
        original = other.original
        own = original == ob and not instance.is_instance
        if own or other.type != 'MESH' or other.display_type not in SOLID or not is_near(other, matrix, box):
            continue
        if not instance.is_instance and not original.visible_get():
            continue
        yield number, other.name, read_near(original if original.mode == 'EDIT' else other, matrix, box, crossing)


def is_near(other: bpy.types.Object, matrix: np.ndarray, box: Box) -> bool:
    """Returns whether the bounding box of an object touches a box in world space; False where it has no extent that a
    surface could have, or its transform none that keeps one.
    """
    corners = np.array([corner[:] for corner in other.bound_box]) @ matrix[:3, :3].T + matrix[:3, 3]
    if not np.isfinite(corners).all() or np.linalg.matrix_rank(matrix[:3, :3]) < 3:
        return False
    low, high = compute_bounds(corners)
    return bool((low <= box[1]).all() and (high >= box[0]).all())


def read_near(other: bpy.types.Object, matrix: np.ndarray, box: Box, crossing: Crossing) -> Steps[Soup]:
    """Reads the faces of an evaluated object, or of one in Edit Mode, that have a vertex in a box; of one that is
    solved, too, those beside its region.
    """
    if other.mode == 'EDIT':
        other.update_from_editmode()
        if other.name not in crossing.joint - crossing.cages and modifiers.find_shaping_modifiers(other):
            evaluated = other.evaluated_get(bpy.context.evaluated_depsgraph_get())
            found = cut_object(other, evaluated.to_mesh(), matrix, box, crossing)
            evaluated.to_mesh_clear()
            return found
    return cut_object(other, other.data, matrix, box, crossing)


def cut_object(other: bpy.types.Object, mesh: bpy.types.Mesh, matrix: np.ndarray, box: Box,
               crossing: Crossing) -> Steps[Soup]:
    """Cuts what of an object's mesh is near a box, and not part of what is solved, of which the first step is done; a
    subdivided face is as selected as the one that it was cut from.
    """
    local = read_mesh.read_values(mesh.vertices, "co", np.float32, 3)
    V = local.astype(np.float64) @ matrix[:3, :3].T + matrix[:3, 3]
    joint = other.mode == 'EDIT' and other.name in crossing.joint
    faces = ~region_faces.read_selected_faces(mesh) if joint else np.ones(len(mesh.polygons), dtype=bool)
    cutting = cut_near(mesh, V, faces, box, turned=np.linalg.det(matrix[:3, :3]) < 0.0)
    next(cutting)
    return cutting


def cut_near(mesh: bpy.types.Mesh, V: np.ndarray, faces: np.ndarray, box: Box, *, turned: bool) -> Steps[Soup]:
    """Cuts those of the faces (#faces, bool) into triangles that are visible and have a vertex in a box, with the
    vertices V (#vertices x 3) in world space; `turned` tells of a mirroring transform, which turns triangles over. The
    mesh is read in the first of at least two steps; that does all for n-gons, whose triangles Blender cuts.
    """
    inside = find_inside(V, box)
    if len(mesh.polygons) == 0 or not inside.any():
        yield
        return NOTHING
    corners, sizes = read_mesh.read_corners(mesh)
    visible = region_faces.read_visible_faces(mesh)
    by_blender = sizes.max() > 4
    if not by_blender:
        yield
    near = find_near(corners, sizes, V, inside, faces & visible)
    soup = NOTHING
    if near.any():
        if not by_blender:
            yield
        around, sizes = corners[np.repeat(near, sizes)], sizes[near]
        if sizes.max() > 4:
            triangles, owners = read_mesh.read_triangles(mesh)
            F = triangles[near[owners]]
        else:
            F = triangulation.triangulate_short_faces(around, sizes, V)
        soup = build_soup(F, V, turned=turned)
    if by_blender:
        yield
    return soup


def build_soup(F: np.ndarray, V: np.ndarray, *, turned: bool) -> Soup:
    """Takes the triangles with those of the vertices V that they use, the right way out."""
    index, F = triangulation.renumber_vertices(F, len(V))
    return V[index], F[:, ::-1] if turned else F


def find_inside(V: np.ndarray, box: Box) -> np.ndarray:
    """Finds the vertices (#V, bool) in a box."""
    with np.errstate(invalid="ignore"):
        return (np.abs(V - 0.5 * (box[0] + box[1])) <= 0.5 * (box[1] - box[0])).all(axis=1)


def find_near(corners: np.ndarray, sizes: np.ndarray, V: np.ndarray, inside: np.ndarray,
              faces: np.ndarray) -> np.ndarray:
    """Finds those of the faces (#faces, bool) that have a vertex inside, and can be read."""
    near = faces & np.logical_or.reduceat(inside[corners], np.cumsum(sizes) - sizes)
    return near if np.isfinite(V).all() else near & find_readable(corners, sizes, V)
