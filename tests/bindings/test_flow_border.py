"""The border "flow": the curvature changes across the border at the rate of the surroundings, where they tell it."""
import numpy as np
import pytest
import reflines
import test_curvature_border
from test_curvature_border import HALF, LINES, VIEW, Panel, flawed, make_targets
from test_reachable_targets import mesh

Array = np.ndarray
CELLS = 96  # a dent is 5 cells wide: fits of the referee resolve it
H = 1.0 / CELLS
DEGREE, WINDOW = 4, 5.3  # of the referee's polynomials; cells across that they take in
DIRECTIONS = ((1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0))


def fit(points: Array, heights: Array) -> Array:
    """The derivatives (xxx, xxy, xyy) at the origin of the polynomial nearest to heights."""
    x, y = points.T / (WINDOW * H)
    powers = [(degree - k, k) for degree in range(DEGREE + 1) for k in range(degree + 1)]
    found = np.linalg.lstsq(np.stack([x**i * y**j for i, j in powers], axis=1), heights, rcond=None)[0]
    return np.array([6.0, 2.0, 2.0]) * found[6:9] / (WINDOW * H) ** 3


def measure_rate(V: Array, before: Array) -> float:
    """The rms along the border, but for its corners, of the difference of the second derivatives' rate across it: the
    inner side of V against the outer side of `before`, which is free of noise.
    """
    squares = []
    for n in np.array(DIRECTIONS):
        t = np.array([-n[1], n[0]])
        for along in np.arange(-HALF + 5 * H, HALF - 5 * H + 1e-9, H):
            beside = V[:, :2] - (n * (H - HALF) + along * t)  # of the last held row
            a, b = beside @ n, beside @ t
            rates = []
            for sign, surface in ((1.0, V), (-1.0, before)):
                near = (abs(b) < 2.6 * H) & (sign * a > -0.4 * H) & (sign * a < WINDOW * H)
                rates.append(fit(np.stack([a, b], 1)[near], surface[near, 2]))
            squares.append(np.sum((rates[0] - rates[1]) ** 2))
    return float(np.sqrt(np.mean(squares)))


def solve(panel: Panel, border: str, kind: str, **options: object) -> tuple[Array, reflines.ShapeOptimizer]:
    solver = panel.build(border, **options)
    before = panel.V[panel.used]
    solver.solve(make_targets(kind, solver))
    assert np.abs(solver.positions - before).max() > 1e-6
    assert np.array_equal(solver.positions[~solver.free], before[~solver.free])
    return panel.place(solver.positions), solver


@pytest.mark.parametrize("diagonals", ["regular", "random", "jittered"])
@pytest.mark.parametrize("kind", ["dent", "ripples"])
def test_the_curvatures_rate_is_that_beside_the_border(kind: str, diagonals: str) -> None:
    V, F = mesh(diagonals, CELLS)
    panel = Panel(flawed(kind, V), F)
    rates = {border: measure_rate(solve(panel, border, kind)[0], panel.V)
             for border in ("clamped", "curvature", "flow")}
    print(f"{kind}, {diagonals}: {measure_rate(panel.V, panel.V):.2f} before", rates)
    assert rates["flow"] < 0.5 * rates["curvature"]
    assert rates["flow"] < 0.8 * rates["clamped"]


@pytest.mark.parametrize("diagonals", ["regular", "random", "jittered"])
@pytest.mark.parametrize("kind", ["dent", "ripples", "density"])
def test_lines_kink_no_more_than_with_curvature_or_before(kind: str, diagonals: str) -> None:
    """The measure of a kink has the turn of a line over one edge in it, which Curvature takes from ripples."""
    V, F = mesh(diagonals, test_curvature_border.CELLS)
    panel = Panel(flawed(kind, V), F)
    kinks = {}
    for border in ("curvature", "flow"):
        result, solver = solve(panel, border, kind)
        kinks[border] = panel.kink(result, solver.changeable)
    before = panel.kink(panel.V, solver.changeable)
    print(f"{kind}, {diagonals}: {before:.3f} before", kinks)
    assert kinks["flow"] <= 1.02 * max(before, kinks["curvature"])


def fell_back(solver: reflines.ShapeOptimizer) -> int:
    return sum(note.count for note in solver.region.notes if note.kind == "flow_unknown")


@pytest.mark.parametrize(("noisy", "least", "most"), [
    ("nowhere", 0.0, 0.0), ("right", 0.4, 0.6), ("everywhere", 0.8, 1.0),
])
def test_it_falls_back_where_noise_hides_the_rate(noisy: str, least: float, most: float) -> None:
    """Noise of a few ten-thousandths of an edge, on a panel without third derivatives."""
    V, F = mesh("jittered", CELLS)
    where = {"nowhere": 0.0, "right": V[:, 0] > 0.0, "everywhere": 1.0}[noisy]
    V[:, 2] += 2e-4 * H * where * np.random.default_rng(0).standard_normal(len(V))
    share = fell_back(Panel(V, F).build("flow")) / (4 * 2 * HALF * CELLS)
    assert least <= share <= most


def beside_noise(amount: float) -> Panel:
    """A dent in a panel whose surroundings have noise, in edges."""
    V, F = mesh("jittered", test_curvature_border.CELLS)
    panel = Panel(flawed("dent", V), F)
    outside = np.setdiff1d(np.arange(len(V)), panel.used)
    panel.V[outside, 2] += amount / test_curvature_border.CELLS * np.random.default_rng(0).standard_normal(len(outside))
    return Panel(panel.V, F)


@pytest.mark.parametrize("amount", [0.01, 0.1])
@pytest.mark.parametrize("border", ["curvature", "flow"])
def test_where_noise_hides_the_curvature_it_is_clamped_to_the_bit(border: str, amount: float) -> None:
    panel = beside_noise(amount)
    moved, solver = solve(panel, border, "dent")
    assert "curvature_unknown" in [note.kind for note in solver.region.notes]
    assert np.array_equal(moved, solve(panel, "clamped", "dent")[0])


@pytest.mark.parametrize("slope", [0.2, 1.0, 3.0])
@pytest.mark.parametrize("border", ["curvature", "flow"])
@pytest.mark.parametrize("rule", ["automatic", "none"])
def test_where_the_border_is_a_crease_it_is_clamped_to_the_bit(border: str, slope: float, rule: str) -> None:
    """Behind the border the panel bends down like a flange; a press of Smooth holds no creases."""
    V, F = mesh("jittered", test_curvature_border.CELLS)
    V[:, 2] -= slope * np.maximum(np.abs(V[:, :2]).max(axis=1) - HALF, 0.0)
    panel = Panel(flawed("dent", V), F)
    results = [solve(panel, each, "dent", crease_rule=rule)[0] for each in ("clamped", border)]
    assert np.array_equal(*results)


def test_a_panel_whose_rate_is_told_says_nothing() -> None:
    solver = Panel(*mesh("random", CELLS)).build("flow")
    assert not solver.region.notes


def take_rings(panel: Panel, rings: int, cells: int) -> None:
    """Leaves so many rings of faces around the region of a regular panel."""
    V, F = panel.around
    corners = np.concatenate([panel.V[panel.used], V])[F]
    near = np.abs(corners[:, :, :2]).max(axis=(1, 2)) < HALF + (rings + 0.5) / cells
    panel.around = V, F[near]


def test_where_it_falls_back_it_is_curvature_to_the_bit() -> None:
    """Vertices on three straight rows leave the third derivative across them open."""
    cells = 48
    panel = Panel(flawed("ripples", mesh("regular", cells)[0]), mesh("regular", cells)[1])
    take_rings(panel, 2, cells)
    beside_corners = np.abs(panel.V[panel.used][:, :2]).min(axis=1) > HALF - 6.5 / cells
    results = []
    for border in ("clamped", "curvature", "flow"):
        codes = np.where(beside_corners, code("clamped"), code(border))
        result, solver = solve(panel, codes, "ripples")
        results.append((result, fell_back(solver)))
    assert [count for _, count in results] == [0, 0, 4 * (2 * 8 + 1)]
    assert np.array_equal(results[1][0], results[2][0])
    assert not np.array_equal(results[0][0], results[1][0])


def code(border: str) -> int:
    return ("free", "fixed", "clamped", "curvature", "flow").index(border)


def test_segments_of_flow_and_curvature_meet() -> None:
    """Codes for each vertex: only the side of Flow differs from Curvature."""
    V, F = mesh("regular", CELLS)
    panel = Panel(flawed("ripples", V), F)
    left = panel.V[panel.used, 0] < -HALF + 2.5 * H
    codes = np.where(left, code("flow"), code("curvature"))
    curvature, both = solve(panel, "curvature", "ripples")[0], solve(panel, codes, "ripples")[0]
    change, x = np.abs(both - curvature)[:, 2], panel.V[:, 0]
    assert change[x < -HALF + 8 * H].max() > 10.0 * change[x > HALF - 8 * H].max()


def test_a_flat_panel_stays_flat() -> None:
    """Second and third derivatives vanish: none of them is a scale for the other."""
    V, F = mesh("jittered", 24)
    panel = Panel(V * [1.0, 1.0, 0.0], F)
    solver = panel.build("flow")
    solver.solve(reflines.Target(solver.field()))
    assert np.array_equal(solver.positions, panel.V[panel.used])


@pytest.mark.parametrize("bend", [10.0, 100.0])
def test_surroundings_that_turn_away_move_a_panel_little(bend: float) -> None:
    """Behind the border they bend down ever more: their third derivatives continue only as far as their range."""
    V, F = mesh("random", test_curvature_border.CELLS)
    V[:, 2] -= bend * np.maximum(V[:, 0] - HALF, 0.0) ** 3
    panel = Panel(V, F)
    move = np.abs(solve(panel, "flow", "dent")[0] - panel.V).max()
    print(f"moved by {move:.4f}")
    assert move < 0.02 * HALF


def test_codes_beyond_are_refused() -> None:
    panel = Panel(*mesh("regular", 12))
    with pytest.raises(reflines.InvalidInput, match="5 \\(follow\\); one is 6"):
        panel.build(np.full(len(panel.used), 6))


def test_the_press_takes_it_too() -> None:
    """A dent that the press takes for one: half its length wide, at the border."""
    V, F = mesh("random", CELLS)
    V[:, 2] += 0.0006 * np.exp(-((V[:, 0] - HALF + 0.05) ** 2 + V[:, 1] ** 2) / 0.0012)
    panel = Panel(V, F)
    results, held = {}, ~panel.build("clamped").free
    for border in ("curvature", "flow"):
        results[border], report = reflines.smooth_panel(panel.V[panel.used], panel.own, border=border,
                                                        around=panel.around, view_direction=VIEW,
                                                        line_direction=LINES[0])
        assert report.largest_move > 1e-4
        assert np.array_equal(results[border][held], panel.V[panel.used][held])
    assert np.abs(results["curvature"] - results["flow"]).max() > 1e-4
