"""Creases are where the bend jumps against the surface across: coarse round shapes have none, fillets and gaps do."""
from collections.abc import Iterator

import numpy as np
import pytest
import reflines
from real_meshes import triangles
from sample_panels import optimizer, panel

Array = np.ndarray
SIDES = (12, 16, 24, 32, 48, 64)
PROFILES = {  # radius over height
    "one row": [(1.0, -1.0), (1.0, 1.0)],
    "cylinder": [(1.0, z) for z in np.linspace(-1, 1, 13)],
    "cone": [(0.65 - 0.35 * z, z) for z in np.linspace(-1, 1, 9)],
    "barrel": [(1 - 0.3 * z * z, z) for z in np.linspace(-1, 1, 9)],
    "waist": [(np.hypot(0.5, z), z) for z in np.linspace(-1, 1, 9)],
}


def split_quads(quads: Array, random: bool) -> Array:
    """#F x 3: each quad cut along its first diagonal, or along one or the other by chance."""
    second = np.random.default_rng(1).random(len(quads)) < (0.5 if random else 0.0)
    turned = np.where(second[:, None], np.roll(quads, 1, axis=1), quads)
    return np.concatenate([turned[:, :3], turned[:, [0, 2, 3]]])


def strip(rows: int, columns: int) -> Array:
    """Quads of a grid of rows x columns vertices, row by row."""
    first = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    return np.stack([first, first + columns, first + columns + 1, first + 1], 1)


def turned(profile: list[tuple[float, float]], sides: int, *, random: bool = False) -> tuple[Array, Array]:
    """The side of a solid of revolution about y that faces +z."""
    angle = np.pi * np.arange(sides // 2 + 1) / (sides // 2)
    radius, height = np.array(profile).T
    V = np.stack([np.outer(radius, -np.cos(angle)), np.outer(height, np.ones_like(angle)),
                  np.outer(radius, np.sin(angle))], -1)
    quads = strip(len(profile), len(angle))
    return V.reshape(-1, 3), split_quads(quads[:, ::-1], random)


def sphere(sides: int, *, random: bool = False) -> tuple[Array, Array]:
    polar = np.pi * np.arange(1, sides // 2) / (sides // 2)
    return turned([(np.sin(a), -np.cos(a)) for a in polar], sides, random=random)


def swept(profile: Array, *, rows: int = 20, depth: float = 4.0) -> tuple[Array, Array]:
    """A profile (#P x 2: x, z) drawn along y."""
    y = np.linspace(0, depth, rows)
    V = np.stack([np.tile(profile[:, 0], rows), np.repeat(y, len(profile)), np.tile(profile[:, 1], rows)], 1)
    return V, split_quads(strip(rows, len(profile))[:, ::-1], False)


def rounded_edge(steps: int, radius: float = 0.1) -> Array:
    """Two flats of 10 cells that meet in a fillet of 60 degrees of so many edges."""
    flat = np.linspace(-2, 0, 10, endpoint=False)
    angle = np.radians(60) * np.arange(steps) / max(steps - 1, 1)
    arc = radius * np.stack([np.sin(angle), np.cos(angle) - 1], 1)
    end = arc[-1] + np.outer(np.linspace(0, 2, 11)[1:], [np.cos(np.radians(60)), -np.sin(np.radians(60))])
    return np.concatenate([np.stack([flat, 0 * flat], 1), arc, end])


def facing(V: Array, F: Array) -> Array:
    return F[np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])[:, 2] > 0]


def round_shapes() -> Iterator[tuple[str, Array, Array]]:
    for sides in SIDES:
        for name, profile in PROFILES.items():
            for random in (False, True):
                yield f"{name} {sides} {random}", *turned(profile, sides, random=random)
        yield f"sphere {sides}", *sphere(sides)
        yield f"sphere {sides} random", *sphere(sides, random=True)
        V, F = turned(PROFILES["cylinder"], sides)
        yield f"ellipse {sides}", V * [2.0, 1.0, 1.0], F


def test_coarse_round_shapes_have_no_creases() -> None:
    held = {name: len(reflines.crease_edges(V, facing(V, F))) for name, V, F in round_shapes()}
    assert len(held) == 6 * 13 and not any(held.values()), {name: count for name, count in held.items() if count}


@pytest.mark.parametrize("sides", SIDES)
def test_a_coarse_cylinder_is_free(sides: int) -> None:
    V, F = turned(PROFILES["cylinder"], sides)
    solver = reflines.ShapeOptimizer(V, F, view_direction=(0, 0, 1), line_direction=(0, 1, 0.1), border="fixed")
    assert solver.region.creases == 0 and solver.region.free > 10


@pytest.mark.parametrize("steps", [1, 2, 3, 4])
def test_every_edge_of_a_fillet_is_a_crease(steps: int) -> None:
    profile = rounded_edge(steps)
    V, F = swept(profile)
    held = reflines.crease_edges(V, F)
    along = {tuple(sorted(edge)) for edge in held.tolist() if abs(edge[0] - edge[1]) == len(profile)}
    columns = {edge[0] % len(profile) for edge in along}
    assert columns == set(range(10, 10 + steps)) and len(along) == 19 * steps == len(held)


def test_a_fold_is_a_crease_where_the_surface_ends_beside_it() -> None:
    """Three faces of a cube tell nothing about roundness: their edges of 90 degrees are held."""
    V = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, -1], [1, 0, -1], [1, 1, -1]], float)
    F = split_quads(np.array([[0, 1, 2, 3], [0, 4, 5, 1], [1, 5, 6, 2]]), False)
    assert {tuple(sorted(edge)) for edge in reflines.crease_edges(V, F).tolist()} == {(0, 1), (1, 2), (1, 5)}


def sharp_edges(V: Array, F: Array) -> set[tuple[int, int]]:
    """Edges of two faces that bend by more than 30 degrees."""
    normal = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    edges = np.sort(F[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    order = np.lexsort(edges.T)
    twice = np.flatnonzero((edges[order[1:]] == edges[order[:-1]]).all(1))
    bend = (normal[order[twice] // 3] * normal[order[twice + 1] // 3]).sum(1)
    return set(map(tuple, edges[order[twice[bend < np.cos(np.radians(30))]]].tolist()))


def test_gaps_of_a_car_body_are_found() -> None:
    """Bonnet, windscreen and roof of the DrivAer, in one selection: their gaps bend by more than 30 degrees."""
    V, F = triangles("drivaer_fastback_body.obj")
    view, centre = np.array([-0.41, 0.0, 0.91]), V[F].mean(1)
    normal = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    chosen = (normal @ view > 0.2 * np.linalg.norm(normal, axis=1)) & (np.linalg.norm(normal, axis=1) > 0)
    F = F[chosen & ((centre > [0.3, -0.8, 0.4]) & (centre < [2.0, 0.8, 2.0])).all(1)]
    wanted = sharp_edges(V, F)
    found = {tuple(sorted(edge)) for edge in reflines.crease_edges(V, F).tolist()}
    assert len(wanted) > 1000 and len(wanted - found) < 0.02 * len(wanted)


def middle(V: Array) -> Array:
    """The edges of panel(24)'s middle column."""
    column = 12 + 25 * np.arange(25)
    return np.stack([column[:-1], column[1:]], 1)


@pytest.mark.parametrize("rule", ["automatic", "marked"])
def test_marked_edges_are_held_and_cut_the_lines(rule: str) -> None:
    mesh = panel(24)
    solver = optimizer(*mesh, marked_creases=middle(mesh[0])[:, ::-1], crease_rule=rule)
    assert solver.region.marked_creases == solver.region.creases == 24
    assert solver.region.pieces == 2 and not solver.free[middle(mesh[0])].any()
    assert [(note.kind, note.count) for note in solver.region.notes] == [("marked_edges", 24)]


def test_marks_that_are_no_edges_are_ignored() -> None:
    solver = optimizer(*panel(24), marked_creases=np.array([[0, 300], [5, 5]]))
    assert solver.region.creases == 0


@pytest.mark.parametrize("rule", ["marked", "none"])
def test_without_the_automatic_rule_no_bend_is_held(rule: str) -> None:
    V, F = swept(rounded_edge(1))
    marks = np.array([[0, 1]]) if rule == "none" else np.zeros((0, 2), int)
    options = {"view_direction": (0, 0, 1), "line_direction": (0, 1, 0.1), "border": "fixed"}
    assert reflines.ShapeOptimizer(V, F, **options).region.creases == 19
    solver = reflines.ShapeOptimizer(V, F, crease_rule=rule, marked_creases=marks, **options)
    assert solver.region.creases == 0 and solver.region.pieces == 1


def test_a_refusal_names_creases_where_they_hold_all_vertices() -> None:
    mesh = panel(24)
    with pytest.raises(reflines.InvalidInput, match=r"creases \(24 edges\).*hold fewer creases"):
        optimizer(mesh[0], mesh[1][(mesh[1] % 25 >= 11).all(1) & (mesh[1] % 25 <= 13).all(1)],
                  marked_creases=middle(mesh[0]))
    with pytest.raises(reflines.InvalidInput) as refused:
        optimizer(*panel(2))
    assert "crease" not in str(refused.value).lower()


def test_rules_and_marks_that_cannot_be_are_refused() -> None:
    with pytest.raises(reflines.InvalidInput, match="automatic, marked, none"):
        optimizer(*panel(8), crease_rule="sharp")
    with pytest.raises(reflines.InvalidInput, match="2 columns"):
        optimizer(*panel(8), marked_creases=np.zeros((4, 3), int))
