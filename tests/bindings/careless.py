"""Careless selections on real car bodies: all that is seen in a box, gaps, hems, lamps and wheel arches among it.

A box is given in shares of the mesh's bounding box, so that it holds in any unit.
"""
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import reflines
from real_meshes import triangles

Array = np.ndarray
CELLS = 400       # of the raster that tells what is seen, along the longer side
SEEN = 0.01       # of the body's length: what lies deeper below the nearest face of a cell is hidden
TURNED = np.cos(np.radians(45.0))
VISIBLE = 1e-4    # of the unevenness: nobody sees less


@dataclass(frozen=True)
class Selection:
    """What somebody selects with a box in a view."""
    name: str
    mesh: str
    view: tuple[float, float, float]
    light: tuple[float, float, float]
    low: tuple[float, float, float] = (0.0, 0.0, 0.0)
    high: tuple[float, float, float] = (1.0, 1.0, 1.0)


ABOVE, SIDE, FRONT, REAR = (0, 0, 1), (0, -1, 0), (-1, 0, 0), (1, 0, 0)
DRIVAER, BMW, SUBARU, CAR = ("drivaer_fastback_body.obj", "bmw_openmaterial_vehicle.obj", "subaru_wrx_hood_sub2.obj",
                             "opensubdiv_car.obj")
SELECTIONS = (
    Selection("bonnet", DRIVAER, ABOVE, (1, 0, 0), (0.08, 0.25, 0.4), (0.22, 0.75, 1.0)),
    Selection("roof", DRIVAER, ABOVE, (1, 0, 0), (0.48, 0.3, 0.8), (0.68, 0.7, 1.0)),
    Selection("windscreen and bonnet", DRIVAER, ABOVE, (1, 0, 0), (0.1, 0.3, 0.4), (0.4, 0.7, 1.0)),
    Selection("door and sill", DRIVAER, SIDE, (1, 0, 0), (0.42, 0.0, 0.1), (0.58, 0.5, 0.65)),
    Selection("boot", DRIVAER, ABOVE, (1, 0, 0), (0.84, 0.25, 0.4), (1.0, 0.75, 1.0)),
    Selection("bonnet and wings", DRIVAER, ABOVE, (1, 0, 0), (0.03, 0.0, 0.3), (0.28, 1.0, 1.0)),
    Selection("nose from above", DRIVAER, ABOVE, (0, 1, 0), (0.0, 0.1, 0.0), (0.1, 0.9, 1.0)),
    Selection("nose from the front", DRIVAER, FRONT, (0, 1, 0), (0.0, 0.2, 0.1), (0.15, 0.8, 0.6)),
    Selection("tail from behind", DRIVAER, REAR, (0, 1, 0), (0.9, 0.2, 0.2), (1.0, 0.8, 0.7)),
    Selection("front wheel arch", DRIVAER, SIDE, (1, 0, 0), (0.1, 0.0, 0.0), (0.3, 0.5, 0.6)),
    Selection("rear wing", DRIVAER, SIDE, (1, 0, 0), (0.7, 0.0, 0.2), (0.95, 0.5, 0.8)),
    Selection("mirror and door glass", DRIVAER, SIDE, (1, 0, 0), (0.3, 0.0, 0.55), (0.55, 0.5, 0.95)),
    Selection("left half from above", DRIVAER, ABOVE, (1, 0, 0), (0.0, 0.0, 0.0), (1.0, 0.5, 1.0)),
    Selection("a stripe across", DRIVAER, ABOVE, (0, 1, 0), (0.3, 0.0, 0.0), (0.36, 1.0, 1.0)),
    Selection("BMW bonnet", BMW, (0, 1, 0), (1, 0, 0), (0.08, 0.3, 0.2), (0.3, 1.0, 0.8)),
    Selection("BMW roof", BMW, (0, 1, 0), (1, 0, 0), (0.45, 0.7, 0.25), (0.7, 1.0, 0.75)),
    Selection("BMW side", BMW, (0, 0, 1), (1, 0, 0), (0.3, 0.2, 0.5), (0.7, 0.7, 1.0)),
    Selection("BMW tail", BMW, (0, 1, 0), (1, 0, 0), (0.85, 0.4, 0.1), (1.0, 1.0, 0.9)),
    Selection("BMW from above", BMW, (0, 1, 0), (1, 0, 0)),
    Selection("Subaru bonnet", SUBARU, ABOVE, (0, 1, 0)),
    Selection("Subaru scoop", SUBARU, ABOVE, (0, 1, 0), (0.25, 0.3, 0.0), (0.75, 0.8, 1.0)),
    Selection("car, nose", CAR, ABOVE, (1, 0, 0), (0.1, 0.0, 0.0), (0.9, 0.3, 1.0)),
    Selection("car, roof", CAR, ABOVE, (1, 0, 0), (0.1, 0.35, 0.5), (0.9, 0.75, 1.0)),
    Selection("car, tail", CAR, ABOVE, (1, 0, 0), (0.1, 0.75, 0.0), (0.9, 1.0, 1.0)),
    Selection("car from above", CAR, ABOVE, (0, 1, 0)),
)


@dataclass(frozen=True)
class Outcome:
    """What a press with all defaults did, or the sentence with which it was refused. Lengths are those of the mesh."""
    name: str
    triangles: int
    refusal: str = ""
    move: float = 0.0
    limit: float = 0.0
    turned: int = 0             # triangles by more than 45 degrees
    before: tuple[float, ...] = ()  # unevenness of the lights, degrees
    after: tuple[float, ...] = ()
    shift: tuple[float, ...] = ()   # of the lines in the result, degrees
    healed: float = 0.0             # share of the area
    worst: tuple[float, float] = (0.0, 0.0)  # deviation of the lines before and after, degrees

    @property
    def is_harmless(self) -> bool:
        """True where nothing of it has to be explained to anybody."""
        kept = all(late <= early * (1.0 + VISIBLE) for late, early in zip(self.after, self.before, strict=True))
        return bool(self.refusal) or (self.move <= self.limit and self.turned == 0 and kept)


@lru_cache(maxsize=1)
def read_mesh(name: str) -> tuple[Array, Array]:
    return triangles(name)


def unit_normals(V: Array, F: Array) -> Array:
    normals = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)


def find_seen(V: Array, F: Array, view: Array) -> Array:
    """Finds the triangles that face the view and are not behind others, by a raster of their centres: #F, bool."""
    first = np.eye(3)[np.abs(view).argmin()]
    x = np.cross(view, first)
    axes = np.stack([x, np.cross(view, x)])
    centres = V[F].mean(axis=1)
    plane, depth = centres @ axes.T, centres @ view
    size = np.ptp(plane, axis=0).max()
    cell = ((plane - plane.min(axis=0)) / size * CELLS).astype(int)
    key = cell[:, 0] * (CELLS + 2) + cell[:, 1]
    nearest = np.full(key.max() + 1, -np.inf)
    np.maximum.at(nearest, key, depth)
    return (unit_normals(V, F) @ view > 0.0) & (depth > nearest[key] - SEEN * size)


def choose(selection: Selection, V: Array, F: Array) -> Array:
    """Returns the triangles of a selection: #F, bool."""
    low, size = V.min(axis=0), np.ptp(V, axis=0)
    share = (V[F].mean(axis=1) - low) / size
    inside = ((share >= selection.low) & (share <= selection.high)).all(axis=1)
    return inside & find_seen(V, F, np.array(selection.view, float))


def select(selection: Selection) -> tuple[Array, Array]:
    """Returns the vertices and triangles of a selection; skips the test where the mesh is not at hand."""
    V, F = read_mesh(selection.mesh)
    used, own = np.unique(F[choose(selection, V, F)], return_inverse=True)
    return V[used], own.reshape(-1, 3)


def read_around(selection: Selection) -> tuple[Array, Array]:
    """Returns the faces within four rings of a selection, as `around` of reflines.smooth_panel."""
    V, F = read_mesh(selection.mesh)
    chosen = choose(selection, V, F)
    used = np.unique(F[chosen])
    reached, found = np.zeros(len(V), bool), np.zeros(len(F), bool)
    reached[used] = True
    for _ in range(4):
        found |= reached[F].any(axis=1)
        reached[F[found]] = True
    beside = F[found & ~chosen]
    others = np.setdiff1d(beside, used)
    number = np.empty(len(V), dtype=int)
    number[used], number[others] = np.arange(len(used)), len(used) + np.arange(len(others))
    return V[others], number[beside]


def press(selection: Selection, **options: object) -> Outcome:
    """Presses Smooth on a selection, with all defaults but these options."""
    V, F = select(selection)
    try:
        positions, told = reflines.smooth_panel(V, F, view_direction=selection.view, line_direction=selection.light,
                                                **options)
    except (reflines.InvalidInput, reflines.SolverFailure) as error:
        return Outcome(selection.name, len(F), str(error))
    cosine = (unit_normals(V, F) * unit_normals(positions, F)).sum(axis=1)
    return Outcome(selection.name, len(F), "", float(np.linalg.norm(positions - V, axis=1).max()), told.limit,
                   int((cosine < TURNED).sum()), tuple(told.unevenness_before), tuple(told.unevenness_after),
                   tuple(score.shift for score in told.score_after), told.healed.area,
                   (told.healed.worst_before, told.healed.worst_after))


@lru_cache
def press_by_default(selection: Selection) -> Outcome:
    return press(selection)
