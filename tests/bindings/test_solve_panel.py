"""One solve for a tool's targets: the limit, faces that would turn far, the rim, and what the report tells."""
import numpy as np
import pytest
import reflines
import sample_cages
from sample_panels import LINE, VIEW, panel, rippled

Array = np.ndarray
LENGTH = 0.3
LINES = [LINE, np.cross(VIEW, LINE)]


def build(V: Array, F: Array, **options: object) -> reflines.ShapeOptimizer:
    return reflines.ShapeOptimizer(V, F, view_direction=VIEW, line_direction=LINES, **options)


def smooth(optimizer: reflines.ShapeOptimizer) -> list[reflines.Target]:
    return [reflines.smooth(optimizer, length=LENGTH, family=family) for family in (0, 1)]


def solve(optimizer: reflines.ShapeOptimizer, targets: list[reflines.Target] | None = None, *, limit: float = 1.0,
          **options: object) -> reflines.SolvePanelReport:
    return reflines.solve_panel(optimizer, targets or smooth(optimizer), length=LENGTH, limit=limit, **options)


def make_wavy() -> tuple[Array, Array]:
    clean, F = panel()
    return rippled(clean, amplitude=2e-3, wavelength=0.15), F


def test_within_its_limit_it_is_the_free_solve_with_its_numbers() -> None:
    free, told_free = build(*make_wavy()), None
    targets = smooth(free)
    before = free.score(LENGTH), reflines.measure_residual(free, targets[0])
    told_free = free.solve(targets)
    optimizer = build(*make_wavy())
    told = solve(optimizer)
    assert np.array_equal(optimizer.positions, free.positions)
    assert (told.score_before.shift, told.residual_before) == (before[0].shift, before[1])
    assert told.score_after.turn == free.score(LENGTH).turn < 0.5 * before[0].turn
    assert np.array_equal(told.residual, free.residual(targets[0]))
    assert told.residual_after == pytest.approx(told_free.residual_rms, rel=0.5) and not told.falls_short
    assert (told.limited, told.held_faces, told.turned_faces, told.rim_bend) == (0, 0, 0, 0.0)


def test_beyond_the_limit_it_is_the_solve_within_it() -> None:
    free, optimizer, scaled = (build(*make_wavy()) for _ in range(3))
    limit = 0.4 * solve(free).solve.largest_move
    told, told_scaled = solve(optimizer, limit=limit), solve(scaled, limit=limit, most_bounded=100)
    for each, report in ((optimizer, told), (scaled, told_scaled)):
        assert np.abs(each.heights - build(*make_wavy()).heights).max() == pytest.approx(limit, rel=1e-9)
        assert report.limited > 100
    move, whole = (each.heights - build(*make_wavy()).heights for each in (scaled, free))
    assert np.allclose(move, 0.4 * whole, atol=1e-12)
    assert told.residual_after < 0.9 * told_scaled.residual_after
    share = np.tile([-1.0, 0.0], (len(move), 1))
    one_way = build(*make_wavy())
    assert solve(one_way, limit=limit, limit_range=share).limited > 100
    assert -limit <= (one_way.heights - build(*make_wavy()).heights).min() < -0.9 * limit
    assert (one_way.heights - build(*make_wavy()).heights).max() <= 0.0


def make_spike() -> tuple[reflines.ShapeOptimizer, list[reflines.Target], Array, Array]:
    """A panel with a vertex near its neighbour and above it: steep faces, which the clean panel's lines lay flat."""
    vertex, neighbour = 24 * 49 + 24, 24 * 49 + 25
    (V, F), (clean, _) = make_wavy(), panel()
    for each in (V, clean):
        each[vertex] = each[neighbour] + 0.2 * (each[vertex] - each[neighbour])
    V[vertex] += 0.009 * VIEW
    lines = build(clean, F, crease_rule="none")
    targets = [reflines.Target(lines.field(family), family=family) for family in (0, 1)]
    return build(V, F, crease_rule="none"), targets, V, F


def find_turned(V: Array, moved: Array, F: Array) -> Array:
    normals = [np.cross(P[F[:, 1]] - P[F[:, 0]], P[F[:, 2]] - P[F[:, 0]]) for P in (V, moved)]
    cosine = (normals[0] * normals[1]).sum(axis=1) / np.prod([np.linalg.norm(each, axis=1) for each in normals], axis=0)
    return cosine < np.cos(np.pi / 4)


def test_faces_that_would_turn_far_are_held_as_if_they_were_fixed() -> None:
    free, targets, V, F = make_spike()
    assert solve(free, targets, limit=np.inf).turned_faces == 2  # without a limit nothing is held
    turned = find_turned(V, free.positions, F)
    optimizer, *_ = make_spike()
    told = solve(optimizer, targets)
    assert turned.sum() == 2 and (told.held_faces, told.turned_faces, told.limited) == (2, 0, 0)
    held = np.isin(np.arange(len(V)), F[turned])
    fixed = build(V, F, crease_rule="none", fixed=held)
    fixed.solve(targets)
    assert np.array_equal(optimizer.positions[held], V[held])
    assert np.abs(optimizer.heights - fixed.heights).max() < 1e-6 < 1e-3 < np.abs(free.heights - fixed.heights).max()


def test_many_faces_that_turn_are_what_was_asked_for() -> None:
    optimizer = build(*panel(24), border="free")
    wanted = reflines.Target(np.tile([4.0, 0.0], (len(optimizer.area), 1)))
    told = solve(optimizer, [wanted], limit=1e3)
    assert told.turned_faces > 0.02 * len(optimizer.area) and told.held_faces == 0


def test_a_rim_that_bends_is_told() -> None:
    """The inner part of a panel with a free border, turned by half its lines' change; told as numpy has it."""
    V, F = panel(24)
    inner = (np.abs(V[:, :2]) < [0.5, 0.4]).all(axis=1)[F].all(axis=1)
    used, own = np.unique(F[inner], return_inverse=True)
    number = np.full(len(V), -1)
    number[used] = np.arange(len(used))
    others = np.setdiff1d(F[~inner], used)
    number[others] = len(used) + np.arange(len(others))
    optimizer = build(V[used], own.reshape(-1, 3), border="free")
    told = solve(optimizer, [reflines.Target(np.tile([1.0, 0.0], (inner.sum(), 1)))],
                 around=(V[others], number[F[~inner]]))
    after = V.copy()
    after[used] = optimizer.positions
    assert told.rim_bend == pytest.approx(measure_bend(V, after, F, inner), rel=1e-6) and told.rim_bend > 0.1


def measure_bend(before: Array, after: Array, F: Array, inner: Array) -> float:
    edges = {}
    for side in (True, False):
        for t in np.flatnonzero(inner == side):
            for i in range(3):
                edges.setdefault(tuple(sorted((F[t, i], F[t, (i + 1) % 3]))), {})[side] = t
    pairs = np.array([(each[True], each[False]) for each in edges.values() if len(each) == 2])
    angles = []
    for P in (before, after):
        normal = np.cross(P[F[:, 1]] - P[F[:, 0]], P[F[:, 2]] - P[F[:, 0]])
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        one, other = normal[pairs[:, 0]], normal[pairs[:, 1]]
        angles.append(np.arctan2(np.linalg.norm(np.cross(one, other), axis=1), (one * other).sum(axis=1)))
    return float((angles[1] - angles[0]).max())


def test_a_target_that_the_border_keeps_out_of_reach_is_told() -> None:
    optimizer = build(*panel(24))
    dense = reflines.Target(np.tile([3.0, 0.0], (len(optimizer.area), 1)))
    assert solve(optimizer, [dense]).falls_short


def test_a_cancelled_solve_changes_nothing() -> None:
    optimizer, progress = build(*make_wavy()), reflines.Progress()
    targets, before = smooth(optimizer), optimizer.positions
    progress.cancel()
    told = solve(optimizer, targets, progress=progress)
    assert told.solve.termination == "cancelled" and np.array_equal(optimizer.positions, before)


def test_the_surface_of_a_cage_stays_within_the_limit_however_many_unknowns_it_has() -> None:
    moves = []
    for most in (0, 10):
        optimizer = sample_cages.optimizer(sample_cages.hood())
        start = optimizer.heights
        wanted = reflines.Target(1.2 * optimizer.field())
        told = solve(optimizer, [wanted], limit=1e-3, most_bounded=most)
        moves.append(np.abs(optimizer.heights - start).max())
        assert told.limited > 0
    assert moves == pytest.approx([1e-3, 1e-3], rel=1e-6)


@pytest.mark.parametrize("limit", [np.nan, -1.0])
def test_a_limit_that_is_none_is_refused(limit: float) -> None:
    with pytest.raises(reflines.InvalidInput, match="limit"):
        solve(build(*panel(12)), limit=limit)
