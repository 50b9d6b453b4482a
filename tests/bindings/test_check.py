"""reflines.check: what a solve leaves at its border, and what is refused."""
import numpy as np
import pytest
import reflines
from sample_panels import LINE, VIEW, panel


def region_of(V: np.ndarray, F: np.ndarray) -> np.ndarray:
    return (np.abs(V[F].mean(axis=1)[:, :2]) < (0.5, 0.4)).all(axis=1)


def solve(border: str) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    V, F = panel(jitter=0.0)
    region = region_of(V, F)
    used, own = np.unique(F[region], return_inverse=True)
    solver = reflines.ShapeOptimizer(V[used], own.reshape(-1, 3), view_direction=VIEW, line_direction=LINE,
                                     border=border)
    assert solver.solve(reflines.Target(8.0 * solver.field())).largest_move > 1e-5
    after = V.copy()
    after[used] = solver.positions
    return V, after, F, region


@pytest.mark.parametrize("border", ["clamped", "fixed"])
def test_the_border_that_was_asked_for_is_measured(border: str) -> None:
    """A fixed border lets the slope go, a clamped one the curvature."""
    before, after, F, region = solve(border)
    check = reflines.check(before, after, F, region)
    rows = {row.name: row for row in check.rows}
    assert rows["border angle"].before < 0.01 and rows["border curvature"].before < 2.0
    assert rows["border gap"].after == 0.0
    assert (rows["border angle"].after > 0.3) == (border == "fixed")
    assert rows["border curvature"].after > 20.0 and not check.all_pass
    worst = check.curvature_after.argmax()
    assert np.allclose(rows["border curvature"].place, after[check.edges[worst]].mean(axis=0))
    assert 0.0 < check.deviation_95 < check.largest_deviation <= np.linalg.norm(after - before, axis=1).max()
    assert set(check.kind) == {"border"} and len(check.edges) == len(check.passes)


def test_marks_decide_what_passes() -> None:
    before, after, F, region = solve("fixed")
    far = np.linalg.norm(after - before, axis=1).max()
    assert reflines.check(before, after, F, region, angle=90.0, curvature=1e6, deviation=far).all_pass
    assert not reflines.check(before, after, F, region, angle=90.0, curvature=1e6, deviation=0.1 * far).all_pass


def folded(angles: tuple[float, float]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A plane of two bands that meet the middle one, the region, at edges bent by these angles (degrees)."""
    V, F = panel(24, jitter=0.0)
    x = V[:, 0]
    V[:, 2] = sum(np.tan(np.radians(angle)) * np.maximum(0.0, side * x - 0.5)
                  for angle, side in zip(angles, (-1.0, 1.0), strict=True))
    return V, F, (np.abs(V[F].mean(axis=1)[:, 0]) < 0.5)


@pytest.mark.parametrize(("before", "after", "change"), [
    ((8.0, 8.0), (7.5, 7.5), "unchanged"), ((8.0, 8.0), (2.0, 2.0), "better"), ((8.0, 8.0), (9.5, 9.5), "worse"),
    ((0.8, 0.8), (1.2, 1.2), "worse"),   # no longer within the mark
    ((1.2, 1.2), (0.8, 0.8), "better"),  # within it now
    ((8.0, 2.0), (8.0, 4.0), "worse"),   # hidden behind the largest value, which is as before
    ((8.0, 2.0), (5.0, 2.0), "better"),
])
def test_a_border_is_judged_against_before(before: tuple, after: tuple, change: str) -> None:
    """By a mark of one degree. What was beyond the mark before and is so now is no news."""
    (V, F, region), (W, _, _) = folded(before), folded(after)
    check = reflines.check(V, W, F, region, angle=1.0, curvature=1e6)
    row = next(row for row in check.rows if row.name == "border angle")
    assert (row.before, row.after) == pytest.approx((max(before), max(after)), abs=0.05)
    assert row.change == change and row.passes == (max(after) <= 1.0)
    sides = [np.sign(V[ends, 0].mean()) for ends in check.edges]
    grown = {-1.0: after[0] - before[0], 1.0: after[1] - before[1]}
    for side, kind, told in zip(sides, check.kind, check.change, strict=True):
        assert told == ("unchanged" if kind == "open" or abs(grown[side]) < 0.1 else change)
    assert (row.better, row.worse) == tuple(check.change.count(name) for name in ("better", "worse"))
    if row.worse:
        assert grown[np.sign(row.place[0])] > 0.1


def test_a_line_is_worse_where_more_edges_are_worse_than_better() -> None:
    (V, F, region), (W, _, _) = folded((8.0, 2.0)), folded((5.0, 4.0))
    kept = (W[:, 1] < 0.0) & (W[:, 0] < 0.0)  # half of the left border, where nothing becomes better
    W[kept, 2] = V[kept, 2]
    row = next(row for row in reflines.check(V, W, F, region, angle=1.0, curvature=1e6).rows
               if row.name == "border angle")
    assert row.worse > row.better > 0 and row.change == "worse"


NOWHERE = panel(8)[0]
NOWHERE[80, 1] = np.nan  # a corner, of triangles beside the region


@pytest.mark.parametrize(("change", "said"), [
    ({"after": np.zeros((3, 3))}, "vertices before and 3 after"),
    ({"region": np.ones(3, bool)}, "mask has 3 entries"),
    ({"region": None}, "no face"),
    ({"gap": -1.0}, "mark for the gap"),
    ({"angle": float("nan")}, "mark for the angle"), ({"angle": -1.0}, "mark for the angle"),
    ({"curvature": float("nan")}, "mark for the curvature"),     ({"after": NOWHERE}, "not a finite number"),
    ({"deviation": -0.1}, "mark for the deviation"),
    ({"deviation": float("inf")}, "mark for the deviation"),
    ({"crease_angle": float("nan")}, "crease angle"),
    ({"crease_rule": "some"}, "'some'"),
    ({"marked_creases": [[0, 10**6]]}, "1 of the 1 marked creases name a vertex beyond"),
    ({"marked_creases": [[0, 1], [-5, 2]]}, "1 of the 2 marked creases name a vertex beyond"),
])
def test_unusable_input_gets_one_sentence(change: dict, said: str) -> None:
    V, F = panel(8)
    arguments = {"before": V, "after": V, "F": F, "region": region_of(V, F)} | change
    if arguments["region"] is None:
        arguments["region"] = np.zeros(len(F), bool)
    with pytest.raises(reflines.InvalidInput, match=said):
        reflines.check(**arguments)


@pytest.mark.parametrize("first", [True, False])
def test_what_is_fixed_to_the_region_from_beside_is_no_border(first: bool) -> None:
    """The pairs of an edge of three triangles depended on which came first."""
    V, F = panel(16)
    region = region_of(V, F)
    edge = F[np.flatnonzero(region)[region.sum() // 2], :2]
    fin = np.array([[*edge, len(V)]])
    W = np.vstack([V, V[edge[:1]] + [0.0, 0.0, 0.2]])
    faces, mask = (np.vstack([fin, F]), np.r_[False, region]) if first else (np.vstack([F, fin]), np.r_[region, False])
    plain, finned = reflines.check(V, V, F, region), reflines.check(W, W, faces, mask)
    assert [(row.name, row.after) for row in finned.rows] == [(row.name, row.after) for row in plain.rows]


@pytest.mark.parametrize("first", [True, False])
def test_an_edge_with_several_triangles_beside_it_cannot_be_judged(first: bool) -> None:
    V, F = panel(16)
    region = region_of(V, F)
    plain = reflines.check(V, V, F, region)
    edge = plain.edges[[kind == "border" for kind in plain.kind].index(True)]
    fin = np.array([[*edge, len(V)]])
    W = np.vstack([V, V[edge[:1]] + [0.0, 0.0, 0.2]])
    faces, mask = (np.vstack([fin, F]), np.r_[False, region]) if first else (np.vstack([F, fin]), np.r_[region, False])
    finned = reflines.check(W, W, faces, mask)
    assert [kind for kind, ends in zip(finned.kind, finned.edges, strict=True) if set(ends) == set(edge)] == ["open"]
    assert list(finned.kind).count("border") == list(plain.kind).count("border") - 1
