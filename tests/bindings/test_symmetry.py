"""Mirror images of a mesh's vertices keep equal moves to the last bit: `partner`, for solves and for the press."""
from collections.abc import Callable

import numpy as np
import pytest
import reflines

Array = np.ndarray
VIEW = np.array([0.0, 0.3, 1.0])
LIGHTS = [(0.0, 1.0, 0.2), (1.0, 0.0, 0.0)]  # in the mirror plane, and across it
CELLS = 24


def symmetric(cells: int = CELLS, *, mirrored_cut: bool = True, lopsided: float = 0.0) -> tuple[Array, Array, Array]:
    """A rippled panel about x = 0, its triangles, and its vertices' mirror images; both halves are cut alike where the
    cut is mirrored. `lopsided` raises the right half by a ripple of its own."""
    right = np.linspace(0.0, 0.75, cells // 2 + 1)
    x, y = (g.ravel() for g in np.meshgrid(np.concatenate([-right[:0:-1], right]), np.linspace(-0.6, 0.6, cells + 1)))
    fade = (1.0 - (x / 0.75) ** 2) ** 2 * (1.0 - (y / 0.6) ** 2) ** 2
    z = -0.12 * x * x - 0.08 * y * y + 2e-3 * fade * np.cos(18 * np.abs(x)) * np.cos(15 * y + 0.5)
    z += lopsided * fade * np.where(x > 0.1, np.sin(20 * x), 0.0)
    a = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    b, c, d = a + 1, a + cells + 2, a + cells + 1
    left = (a % (cells + 1) < cells // 2) & mirrored_cut
    first = np.where(left[:, None], np.stack([a, b, d], 1), np.stack([a, b, c], 1))
    second = np.where(left[:, None], np.stack([b, c, d], 1), np.stack([a, c, d], 1))
    rows = np.arange((cells + 1) ** 2).reshape(cells + 1, cells + 1)
    return np.stack([x, y, z], axis=1), np.concatenate([first, second]), rows[:, ::-1].ravel()


def optimizer(V: Array, F: Array, **options: object) -> reflines.ShapeOptimizer:
    return reflines.ShapeOptimizer(V, F, **{"view_direction": VIEW, "line_direction": LIGHTS[0]} | options)


def mirrored(V: Array, partner: Array) -> Array:
    return V[partner] * [-1.0, 1.0, 1.0]


def doors() -> tuple[Array, Array, Array]:
    """Two panels that do not touch, one the image of the other."""
    V, F, _ = symmetric(16, lopsided=1e-3)
    own = V + [1.5, 0.0, 0.0]
    both = np.concatenate([own, own * [-1.0, 1.0, 1.0]])
    partner = (np.arange(len(both)) + len(V)) % len(both)
    return both, np.concatenate([F, F[:, ::-1] + len(V)]), partner


@pytest.mark.parametrize("light", LIGHTS)
@pytest.mark.parametrize("border", ["free", "fixed", "clamped"])
def test_a_symmetric_problem_has_the_same_solution(light: Array, border: str) -> None:
    V, F, partner = symmetric()
    half = optimizer(V, F, border=border, line_direction=light, partner=partner)
    whole = optimizer(V, F, border=border, line_direction=light)
    reports = [o.solve(reflines.smooth(o, length=0.4), gradient_tolerance=1e-11) for o in (half, whole)]
    free = np.flatnonzero(half.free)
    assert reports[0].unknowns == np.count_nonzero(partner[free] >= free)
    assert reports[1].unknowns == len(free)
    move = np.linalg.norm(whole.positions - V, axis=1).max()
    assert move > 1e-3
    assert np.abs(half.positions - whole.positions).max() < 1e-6 * move


@pytest.mark.parametrize("light", LIGHTS)
def test_what_is_cut_unevenly_stays_symmetric_to_the_last_bit(light: Array) -> None:
    """By itself the solver leaves halves apart whose quads are cut along one diagonal."""
    V, F, partner = symmetric(mirrored_cut=False)
    apart = {}
    for given in (None, partner):
        solver = optimizer(V, F, line_direction=light, partner=given)
        for target in (reflines.smooth(solver, length=0.4), reflines.uniform(solver, density=1.1)):
            assert solver.solve(target).largest_move > 1e-3
        apart[given is None] = np.abs(mirrored(solver.positions, partner) - solver.positions).max()
    assert apart[True] > 1e-7
    assert apart[False] == 0.0


def test_what_is_symmetric_but_for_its_heights_moves_alike() -> None:
    V, F, partner = symmetric(lopsided=1e-4)
    solver = optimizer(V, F, partner=partner)
    report = solver.solve(reflines.smooth(solver, length=0.4))
    assert report.converged
    way = solver.positions - V
    assert np.abs(way).max() > 1e-4
    assert np.abs(mirrored(way, partner) - way).max() < 1e-15  # moves are equal, and added to other heights


def test_many_unknowns_are_approached_from_afar() -> None:
    """The coarse problem moves mirror images in the mean of both places."""
    V, F, partner = symmetric(96)
    clean, _, _ = symmetric(96)
    clean[:, 2] = -0.12 * V[:, 0] ** 2 - 0.08 * V[:, 1] ** 2
    wanted = reflines.Target(optimizer(clean, F).field())
    reports = []
    for given in (None, partner):
        solver = optimizer(V, F, partner=given)
        reports.append(solver.solve(wanted))
        assert np.abs(solver.positions[:, 2] - clean[:, 2]).max() < 0.05 * np.abs(V - clean).max()
    assert reports[1].iterations <= reports[0].iterations + 3
    assert reports[1].factorizations <= reports[0].factorizations


def test_halves_that_do_not_touch_are_solved_together() -> None:
    V, F, partner = doors()
    own = len(V) // 2
    alone = optimizer(V[:own], F[:len(F) // 2])
    both = optimizer(V, F, partner=partner)
    assert both.region.pieces == 2
    for solver in (alone, both):
        assert solver.solve(reflines.smooth(solver, length=0.3), gradient_tolerance=1e-11).converged
    move = np.abs(alone.positions - V[:own]).max()
    assert move > 5e-4
    assert np.abs(both.positions[:own] - alone.positions).max() < 1e-6 * move
    assert np.array_equal(mirrored(both.positions, partner), both.positions)


def test_what_holds_one_vertex_holds_its_image() -> None:
    V, F, partner = symmetric()
    held = np.zeros(len(V), dtype=bool)
    held[np.flatnonzero((V[:, 0] > 0.2) & (np.abs(V[:, 1]) < 0.05))] = True
    codes = np.where(V[:, 0] > 0, 1, 0)
    marked = np.array([[a, a + CELLS + 1] for a in np.flatnonzero(np.abs(V[:, 0] - 0.5) < 1e-9)[:-1]])
    solver = optimizer(V, F, partner=partner, fixed=held, border=codes, marked_creases=marked)
    assert np.array_equal(solver.free, solver.free[partner])
    assert not solver.free[held].any() and not solver.free[partner[held]].any()
    assert not solver.free[np.abs(np.abs(V[:, 0]) - 0.75) < 1e-9].any()
    assert not solver.free[partner[marked]].any()
    solver.solve(reflines.smooth(solver, length=0.4))
    assert np.array_equal(mirrored(solver.positions, partner), solver.positions)
    assert np.array_equal(solver.positions[~solver.free], V[~solver.free])


@pytest.mark.parametrize("view", [VIEW, np.array([0.0, 0.0, 1.0])])
def test_the_limits_of_both_images_hold_to_the_last_bit(view: Array) -> None:
    V, F, partner = symmetric(mirrored_cut=False)
    solver = optimizer(V, F, view_direction=view, partner=partner)
    target = reflines.smooth(solver, length=0.4)
    largest = solver.solve(target).largest_move
    solver.reset()
    share = np.where(V[:, :1] > 0.1, 0.2, 0.6) * [-1.0, 1.0]
    share[np.flatnonzero(V[:, 0] < -0.4), 1] = 0.0
    ends = largest * share
    report = solver.solve(target, limit=ends)
    assert report.converged and report.limited > 0
    along = view / np.linalg.norm(view)
    move = (solver.positions - V) @ along
    tight = np.column_stack([np.maximum(ends[:, 0], ends[partner, 0]), np.minimum(ends[:, 1], ends[partner, 1])])
    assert (move >= tight[:, 0]).all() and (move <= tight[:, 1]).all()
    assert np.array_equal(solver.at_limit, solver.at_limit[partner])
    assert (move[solver.at_limit > 0] >= (1 - 1e-12) * tight[solver.at_limit > 0, 1]).all()
    assert np.array_equal(mirrored(solver.positions, partner), solver.positions)


def test_scaled_and_reset_moves_are_symmetric() -> None:
    V, F, partner = symmetric(mirrored_cut=False)
    solver = optimizer(V, F, partner=partner)
    solver.solve(reflines.smooth(solver, length=0.4))
    whole = solver.heights
    solver.scale_move(0.3)
    assert np.array_equal(mirrored(solver.positions, partner), solver.positions)
    start = optimizer(V, F).heights
    assert np.allclose(solver.heights - start, 0.3 * (whole - start), rtol=0, atol=1e-15)
    solver.reset()
    assert np.array_equal(solver.positions, V)


@pytest.mark.parametrize("mesh", [lambda: symmetric(32, mirrored_cut=False), doors])
def test_the_press_keeps_every_bit_symmetric(mesh: Callable[[], tuple[Array, Array, Array]]) -> None:
    V, F, partner = mesh()
    noise = np.random.default_rng(1).uniform(-1e-4, 1e-4, len(V))
    V[:, 2] += np.minimum(noise, noise[partner])
    press = {"view_direction": VIEW, "line_direction": LIGHTS[0], "partner": partner, "length": 0.2}
    for more in ({}, {"limit": 1e-4, "limit_range": np.where(V[:, :1] > 0, 1.0, 0.5) * [-1.0, 1.0]}):
        positions, told = reflines.smooth_panel(V, F, **press, **more)
        assert told.applied and told.largest_move > 1e-5
        assert np.array_equal(mirrored(positions, partner), positions)
    assert np.abs(positions - V).max() <= 0.5e-4


def test_an_image_in_no_face_holds_in_the_press() -> None:
    V, F, partner = symmetric(16)
    F = F[~(F == 40).any(axis=1)]
    F = F[~(V[F, 0] > 0.5).all(axis=1)]
    positions, _ = reflines.smooth_panel(V, F, view_direction=VIEW, line_direction=LIGHTS[0], partner=partner,
                                         length=0.2)
    assert np.array_equal((positions != V).any(axis=1), (positions != V).any(axis=1)[partner])
    assert (positions != V).any()


@pytest.mark.parametrize(("change", "said"), [
    ({3: 10**6}, "partner of vertex 3 is 1000000"), ({3: -7}, "vertex 3 is -7"),
    ({3: 5}, "vertex 3 is 5, which is none of the 625 vertices or has another")])
@pytest.mark.parametrize("call", [optimizer, lambda V, F, partner: reflines.smooth_panel(
    V, F, view_direction=VIEW, line_direction=LIGHTS[0], partner=partner)])
def test_partners_that_are_none_are_refused(call: Callable[..., object], change: dict[int, int], said: str) -> None:
    V, F, partner = symmetric()
    for vertex, other in change.items():
        partner[vertex] = other
    with pytest.raises(reflines.InvalidInput, match=said):
        call(V, F, partner=partner)
    with pytest.raises(reflines.InvalidInput, match="has 624 entries for 625 vertices; give one for each"):
        call(V, F, partner=partner[:-1])
    with pytest.raises(reflines.InvalidInput, match="array of float64"):
        call(V, F, partner=0.5 * partner)
