"""A cage fitted to a dense mesh: one that is a cage's own limit surface gives that cage back."""
import numpy as np
import pytest
import reflines
from sample_cages import LINE, VIEW, hood, optimizer

NOISE = 0.002


def dense_surface(cage: tuple, level: int, **options: object) -> tuple[np.ndarray, np.ndarray]:
    """Vertices and triangles of the limit surface."""
    V, offsets, corners = cage
    surface = reflines.Subdivision(offsets, corners, vertices=len(V), level=level, **options)
    quads = surface.faces
    return surface.positions(V), np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def fitted(cage: tuple, dense: tuple, **options: object) -> tuple[reflines.CageOptimizer, list[np.ndarray]]:
    """The optimizer, and the positions of the cage after least squares and after the reflection lines."""
    solver = optimizer(cage, **{"border": "free", "level": 3} | options)
    other = reflines.ShapeOptimizer(*dense, view_direction=VIEW, line_direction=LINE, border="free")
    target, _, heights, weight = reflines.match_dense(solver, other)
    solver.fit(heights, weight)
    steps = [solver.cage_positions]
    assert solver.solve(target).converged
    return solver, [*steps, solver.cage_positions]


def noisy(cage: tuple, depth: float = NOISE) -> tuple:
    V, offsets, corners = cage
    rng = np.random.default_rng(11)
    return V + depth * rng.standard_normal(len(V))[:, None] * VIEW, offsets, corners


@pytest.mark.parametrize("creased", [False, True])
def test_the_limit_surface_of_a_cage_gives_that_cage_back(creased: bool) -> None:
    clean = hood(12, 10)
    row = np.arange(5 * 13, 6 * 13)
    creases = {"creases": np.stack([row[:-1], row[1:]], axis=1), "crease_sharpness": np.full(12, 3.0)}
    options = creases if creased else {}
    _, (nearest, solved) = fitted(noisy(clean), dense_surface(clean, 5, **options), **options)
    assert np.abs(noisy(clean)[0] - clean[0]).max() > 2.0 * NOISE
    assert np.abs(nearest - clean[0]).max() < 1e-3 * NOISE
    assert np.abs(solved - clean[0]).max() < 1e-3 * NOISE


def test_the_lines_decide_where_heights_are_noisy() -> None:
    """A scan whose noise no cage can follow: its lines, too rough by themselves, do not spoil the heights' fit."""
    clean = hood(12, 10)
    V, F = dense_surface(clean, 4)
    V = V + 2e-5 * np.random.default_rng(5).standard_normal(len(V))[:, None] * VIEW
    _, (nearest, solved) = fitted(noisy(clean), (V, F))
    assert np.abs(nearest - clean[0]).max() < 0.05 * NOISE
    assert np.abs(solved - clean[0]).max() < 0.2 * NOISE


def test_a_clamped_border_stays() -> None:
    clean = hood(12, 10)
    start = noisy(clean)
    solver, (_, solved) = fitted(start, dense_surface(clean, 4), border="clamped")
    held = ~solver.cage_free
    assert held.any()
    assert np.array_equal(solved[held], start[0][held])


def test_where_the_dense_mesh_is_missing_nothing_is_asked() -> None:
    clean = hood(12, 10)
    V, F = dense_surface(clean, 4)
    right = F[(V[F][:, :, 0] > -0.1).all(axis=1)]
    solver = optimizer(noisy(clean), border="free", level=2)
    other = reflines.ShapeOptimizer(V, right, view_direction=VIEW, line_direction=LINE, border="free")
    target, theta, heights, weight = reflines.match_dense(solver, other)
    x = solver.positions[:, 0]
    assert (weight[x < -0.12] == 0.0).all() and (weight[x > 0.0][1:-1] >= 0.0).all()
    center = x[solver.triangles].mean(axis=1)
    assert (target.weight[center < -0.12] == 0.0).all()
    assert (target.weight[center > 0.0] == 1.0).all()
    solver.fit(heights, weight)
    right_half = clean[0][:, 0] > 0.1
    assert np.abs(solver.cage_positions - clean[0])[right_half].max() < 0.05 * NOISE


def test_reset_takes_a_fit_back() -> None:
    clean = hood(12, 10)
    solver = optimizer(noisy(clean), border="free", level=2)
    target = reflines.smooth(solver, length=0.4)
    solver.solve(target)
    expected = solver.cage_positions
    solver.reset()
    solver.fit(solver.heights + 0.01, np.ones(len(solver.heights)))
    solver.reset()
    solver.solve(target)
    assert np.abs(solver.cage_positions - expected).max() < 1e-9


def test_heights_without_weight_are_not_read() -> None:
    solver = optimizer(noisy(hood(8, 6)), border="clamped", level=2)
    before, start = solver.cage_positions, solver.heights
    weight = np.ones(len(start))
    weight[:40] = 0.0
    heights = start + 0.01
    solver.fit(np.where(weight == 0.0, np.nan, heights), weight)
    assert np.isfinite(solver.cage_positions).all()
    assert np.abs(solver.cage_positions - before).max() > 0.005


@pytest.mark.parametrize("counted", ["none", "held"])
def test_without_a_height_that_counts_nothing_moves(counted: str) -> None:
    solver = optimizer(noisy(hood(12, 10)), border="clamped", level=2)
    before, heights = solver.cage_positions, solver.heights
    corner = np.argmin(solver.positions @ np.array([1.0, 1.0, 0.0]))
    weight = np.zeros(len(heights))
    weight[corner] = counted == "held"
    solver.fit(heights + 0.01, weight)
    assert np.array_equal(solver.cage_positions, before)
    assert solver.solve(reflines.Target(solver.field())).termination == "already_optimal"


@pytest.mark.parametrize(("heights", "weight"),
                         [(np.nan, 1.0), (np.inf, 1.0), (0.0, np.nan), (0.0, -1.0), (0.0, np.inf)])
def test_heights_and_weights_that_are_none_are_refused(heights: float, weight: float) -> None:
    solver = optimizer(noisy(hood(8, 6)), border="free", level=2)
    before = solver.cage_positions
    wanted, weights = solver.heights, np.ones(len(solver.heights))
    wanted[7], weights[7] = heights, weight
    with pytest.raises(reflines.InvalidInput, match="^1 of the .* not finite"):
        solver.fit(wanted, weights)
    assert np.array_equal(solver.cage_positions, before)


@pytest.mark.parametrize("other", [{"view_direction": (0.0, 0.01, 1.0)}, {"line_direction": (1.0, 0.3, 0.1)}])
def test_a_dense_mesh_seen_from_elsewhere_is_refused(other: dict) -> None:
    V, F = dense_surface(hood(8, 6), 3)
    dense = reflines.ShapeOptimizer(V, F, **{"view_direction": VIEW, "line_direction": LINE, "border": "free"} | other)
    with pytest.raises(reflines.InvalidInput, match="different views or line directions"):
        reflines.match_dense(optimizer(hood(8, 6), level=2), dense)


def test_a_limit_of_the_last_solve_does_not_hold_a_fit() -> None:
    cage = noisy(hood(12, 10))
    solvers = [optimizer(cage, border="free", level=2) for _ in range(2)]
    solvers[0].solve(reflines.smooth(solvers[0], length=0.4), limit=1e-4)
    heights = solvers[1].heights + 0.02
    for solver in solvers:
        solver.fit(heights, np.ones(len(heights)))
        assert np.abs(solver.heights - heights).max() < 1e-3 and not solver.at_limit.any()
    assert np.abs(solvers[0].positions - solvers[1].positions).max() < 1e-10
