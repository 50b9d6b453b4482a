"""The border "curvature": lines run on into the surroundings without a kink, position and tangent stay to the bit."""
import numpy as np
import pytest
import reflines
from test_reachable_targets import mesh

Array = np.ndarray
VIEW, LINES = np.array([0.0, 0.0, 1.0]), np.array([[1.0, 0.0, 0.3], [0.0, 1.0, 0.0]])
CELLS = 48
HALF = 15 / CELLS


class Panel:
    """A panel of which the inner part, or what is given (#F, bool), is the region."""

    def __init__(self, V: Array, F: Array, region: Array | None = None) -> None:
        self.V, self.F = V, F
        self.region = (np.abs(V[F].mean(axis=1)[:, :2]) < HALF).all(axis=1) if region is None else region
        self.used, own = np.unique(F[self.region], return_inverse=True)
        self.own = own.reshape(-1, 3)
        others = np.setdiff1d(np.arange(len(V)), self.used)
        number = np.empty(len(V), dtype=int)
        number[self.used], number[others] = np.arange(len(self.used)), len(self.used) + np.arange(len(others))
        self.around = V[others], number[F[~self.region]]

    def build(self, border: str, **options: object) -> reflines.ShapeOptimizer:
        return reflines.ShapeOptimizer(self.V[self.used], self.own, view_direction=VIEW, line_direction=LINES,
                                       border=border, around=self.around, **options)

    def place(self, positions: Array) -> Array:
        result = self.V.copy()
        result[self.used] = positions
        return result

    def kink(self, V: Array, changeable: Array) -> float:
        """Degrees, rms: the angle between the drawn lines of triangles that share an edge, one held and one free."""
        whole = reflines.ShapeOptimizer(V, self.F, view_direction=VIEW, line_direction=LINES, border="free",
                                        crease_rule="none")
        free = np.zeros(len(self.F), bool)
        free[self.region] = changeable
        edges = np.sort(self.F[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        order = np.lexsort(edges.T)
        twice = np.flatnonzero((edges[order[1:]] == edges[order[:-1]]).all(1))
        one, two = order[twice] // 3, order[twice + 1] // 3
        field = whole.field()
        turn = np.diff(np.arctan2(field[:, 1], field[:, 0])[np.stack([one, two], 1)[free[one] != free[two]]], axis=1)
        turn = (turn + np.pi / 2) % np.pi - np.pi / 2
        return float(np.degrees(np.sqrt((turn**2).mean())))


def flawed(kind: str, V: Array) -> Array:
    result = V.copy()
    x, y = V[:, 0], V[:, 1]
    if kind == "dent":  # whose rim the border crosses
        result[:, 2] += 0.003 * np.exp(-((x - 0.2) ** 2 + y**2) / 0.006)
    elif kind == "ripples":
        result[:, 2] += 0.0002 * np.sin(2 * np.pi * x / 0.25) * np.sin(2 * np.pi * y / 0.25)
    return result


def make_targets(kind: str, solver: reflines.ShapeOptimizer) -> list[reflines.Target]:
    if kind == "density":
        return [reflines.uniform(solver, density=1.5)]
    return [reflines.smooth(solver, length=0.4, family=family) for family in (0, 1)]


@pytest.mark.parametrize("diagonals", ["regular", "random", "jittered"])
@pytest.mark.parametrize("kind", ["dent", "ripples", "density"])
def test_the_border_kinks_lines_at_most_twice_as_much_as_before(kind: str, diagonals: str) -> None:
    V, F = mesh(diagonals, CELLS)
    panel = Panel(flawed(kind, V), F)
    kinks = {}
    for border in ("clamped", "curvature"):
        solver = panel.build(border)
        before = panel.V[panel.used]
        solver.solve(make_targets(kind, solver))
        assert np.abs(solver.positions - before).max() > 1e-6
        assert np.array_equal(solver.positions[~solver.free], before[~solver.free])
        kinks[border] = panel.kink(panel.place(solver.positions), solver.changeable)
    before = panel.kink(panel.V, solver.changeable)
    print(f"{kind}, {diagonals}: {before:.3f} before, {kinks['clamped']:.3f} clamped, {kinks['curvature']:.3f}")
    assert kinks["curvature"] <= (1.1 if kind == "density" else 2.0) * before


def test_a_wish_that_would_kink_does_not() -> None:
    """Without the removal of what heights cannot reach, a clamped border shows all of it."""
    panel = Panel(*mesh("random", CELLS))
    clamped, curvature = panel.build("clamped"), panel.build("curvature")
    for solver in (clamped, curvature):
        solver.solve(reflines.Target(1.5 * solver.field()))
    before, *after = (panel.kink(panel.place(V), clamped.changeable)
                      for V in (panel.V[panel.used], clamped.positions, curvature.positions))
    assert after[0] > 20.0 * before
    assert after[1] < 0.3 * after[0]


def test_the_same_vertices_are_held_as_by_clamped() -> None:
    panel = Panel(*mesh("jittered", 20))
    assert np.array_equal(panel.build("curvature").free, panel.build("clamped").free)
    codes = np.full(len(panel.used), 3)
    assert np.array_equal(panel.build(codes).free, panel.build("clamped").free)


def test_the_curvature_is_that_of_the_surroundings_alone() -> None:
    """Where position and tangent of the region are those around, but not its curvature, its lines bend towards them
    although nothing else is wanted of them."""
    V, F = mesh("regular", CELLS)
    panel = Panel(V, F)
    share = np.clip(1.0 - (V[:, :2] / (HALF - 1.0 / CELLS)) ** 2, 0.0, None).prod(axis=1)
    panel.V[:, 2] += 0.003 * share**2
    solver = panel.build("curvature")
    before = panel.kink(panel.V, solver.changeable)
    solver.solve(reflines.Target(solver.field()))
    after = panel.kink(panel.place(solver.positions), solver.changeable)
    print(f"{before:.2f} before, {after:.2f} after")
    assert after < 0.5 * before


@pytest.mark.parametrize(("around", "said"), [
    ((np.zeros((1, 3)), [[0, 1, 10**6]]), "name a vertex beyond"),
    ((np.full((1, 3), np.nan), [[0, 1, 2]]), "1 vertices around the region"),
    ((np.zeros((1, 3)), [[0, 1]]), "array of 3 columns"),
])
def test_surroundings_that_cannot_be_used_are_refused(around: tuple, said: str) -> None:
    panel = Panel(*mesh("regular", 12))
    panel.around = around
    with pytest.raises(reflines.InvalidInput, match=said):
        panel.build("curvature")


def test_without_surroundings_it_is_clamped_and_said() -> None:
    panel = Panel(*mesh("regular", 12))
    panel.around = None
    solver = panel.build("curvature")
    assert [note.kind for note in solver.region.notes] == ["curvature_unknown"]
    clamped = panel.build("clamped")
    for each in (solver, clamped):
        each.solve(reflines.turn(each, angle=0.1))
    assert np.array_equal(solver.positions, clamped.positions)
