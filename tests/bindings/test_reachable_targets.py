"""Wishes that no heights can meet leave no print of the mesh in the lines."""
import numpy as np
import pytest
import reflines

Array = np.ndarray
CELLS = (20, 40)
DIAGONALS = ("regular", "4-8", "random", "jittered")


def mesh(diagonals: str, cells: int) -> tuple[Array, Array]:
    """The panel z = -0.15 x^2 - 0.1 y^2 over [-0.5, 0.5]^2 and its triangles."""
    rng = np.random.default_rng(0)
    i, j = (index.ravel() for index in np.meshgrid(np.arange(cells + 1), np.arange(cells + 1)))
    x, y = i / cells - 0.5, j / cells - 0.5
    if diagonals == "jittered":
        inner = (abs(x) < 0.4999) & (abs(y) < 0.4999)
        x, y = (c + inner * rng.uniform(-0.2, 0.2, len(c)) / cells for c in (x, y))
    first = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    quads = np.stack([first, first + 1, first + cells + 2, first + cells + 1], 1)
    other = {"4-8": (first // (cells + 1) + first % (cells + 1)) % 2 == 1,
             "random": rng.random(len(first)) < 0.5}.get(diagonals, np.zeros(len(first), bool))
    quads = np.where(other[:, None], np.roll(quads, 1, axis=1), quads)
    return (np.stack([x, y, -0.15 * x**2 - 0.1 * y**2], 1),
            np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]))


def kink(solver: reflines.ShapeOptimizer, F: Array) -> float:
    """Degrees, rms: the angle between lines of triangles that share an edge, a tenth of the panel inside its border."""
    edges = np.sort(F[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    order = np.lexsort(edges.T)
    twice = np.flatnonzero((edges[order[1:]] == edges[order[:-1]]).all(1))
    one, two = order[twice] // 3, order[twice + 1] // 3
    inner = (abs(solver.centers) < 0.4).all(1)
    field = solver.field()
    turn = np.diff(np.arctan2(field[:, 1], field[:, 0])[np.stack([one, two], 1)[inner[one] & inner[two]]], axis=1)
    turn = (turn + np.pi / 2) % np.pi - np.pi / 2
    return float(np.degrees(np.sqrt((turn**2).mean())))


def image() -> Array:
    u = np.linspace(-1, 1, 60)
    return 0.5 + 0.5 * np.exp(-(u[:, None] ** 2 + u**2) / 0.2)


WISHES = {
    "density": lambda solver: reflines.uniform(solver, density=1.5),
    "direction": lambda solver: reflines.uniform(solver, direction=(0.3, 1.0)),
    "turn": lambda solver: reflines.turn(solver, angle=0.2),
    "pattern": lambda solver: reflines.pattern(solver, image=image(), strength=0.2),
}


def kinks(wish: str, diagonals: str, *, reachable_only: bool = True) -> list[tuple[float, float]]:
    """Before and after the solve, for each number of cells."""
    result = []
    for cells in CELLS:
        V, F = mesh(diagonals, cells)
        solver = reflines.ShapeOptimizer(V, F, view_direction=(0, 0, 1), line_direction=(1, 0, 0.3))
        target = WISHES[wish](solver)
        assert target.reachable_only
        target.reachable_only = reachable_only
        before = kink(solver, F)
        solver.solve(target)
        result.append((before, kink(solver, F)))
    return result


@pytest.mark.parametrize("diagonals", DIAGONALS)
def test_a_density_out_of_reach_kinks_no_line(diagonals: str) -> None:
    coarse, fine = (after for _, after in kinks("density", diagonals))
    assert coarse < 0.5 and fine < 0.7 * coarse


@pytest.mark.parametrize("wish", WISHES)
def test_irregular_meshes_show_the_lines_of_the_regular_one(wish: str) -> None:
    regular = kinks(wish, "regular")[-1][1]
    for diagonals in DIAGONALS[1:]:
        assert kinks(wish, diagonals)[-1][1] < regular + 0.5


@pytest.mark.parametrize(("diagonals", "print_of_mesh"), [("4-8", 15.0), ("random", 8.0), ("jittered", 2.0)])
def test_the_nearest_field_to_such_a_wish_is_printed_by_the_mesh(diagonals: str, print_of_mesh: float) -> None:
    """Why it is done: second-order stencils are not conservative, and refining does not help."""
    assert min(after for _, after in kinks("density", diagonals, reachable_only=False)) > print_of_mesh


def test_what_can_be_reached_is_reached() -> None:
    """The lines of another panel: nothing is out of reach, and nothing is taken away."""
    V, F = mesh("random", 24)
    options = {"view_direction": (0, 0, 1), "line_direction": (1, 0, 0.3)}
    bump = 0.01 * np.clip(1 - 6 * (V[:, :2] ** 2).sum(1), 0, None) ** 3
    wanted = reflines.ShapeOptimizer(V + bump[:, None] * [0, 0, 1], F, **options)
    solver = reflines.ShapeOptimizer(V, F, **options)
    report = solver.solve(reflines.Target(wanted.field(), reachable_only=True), gradient_tolerance=1e-10)
    assert report.converged
    assert np.abs(solver.positions - wanted.positions).max() < 1e-8 * bump.max()


def test_smoothing_and_own_targets_ask_for_the_nearest_field() -> None:
    V, F = mesh("random", 12)
    solver = reflines.ShapeOptimizer(V, F, view_direction=(0, 0, 1), line_direction=(1, 0, 0.3))
    assert not reflines.smooth(solver, length=0.3).reachable_only
    assert not reflines.Target(solver.field()).reachable_only


@pytest.mark.parametrize("diagonals", DIAGONALS)
@pytest.mark.parametrize("wish", WISHES)
def test_the_energy_of_a_wish_never_rises(wish: str, diagonals: str) -> None:
    """Solved for again and again: where nothing is left to reach, the surface stays bit for bit."""
    V, F = mesh(diagonals, 20)
    solver = reflines.ShapeOptimizer(V, F, view_direction=(0, 0, 1), line_direction=(1, 0, 0.3))
    target = WISHES[wish](solver)
    for _ in range(5):
        before = solver.positions
        report = solver.solve(target)
        assert report.energy_after <= report.energy_before
        if report.termination == "already_optimal":
            assert np.array_equal(solver.positions, before) and report.energy_after == report.energy_before
            assert report.message.startswith("Nothing to do")
