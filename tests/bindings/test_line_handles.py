"""Handles on lines: what is pulled comes, what is pinned or beyond the radius stays, and no way there is remembered."""
import meshes
import numpy as np
import pytest
import reflines
import sample_cages
import sample_panels
from sample_panels import LINE, VIEW

STEP = 2 * np.pi / 40  # of theta from line to line
RADIUS = 0.4
Array = np.ndarray


def crown(points: Array) -> Array:
    """A gently crowned panel over points (#V x 2) of 1.5 x 1.2."""
    x, y = points.T
    return np.column_stack([points, -0.12 * x**2 - 0.08 * y**2 + 0.02 * x**2 * y - 0.03 * x**4 + 0.004 * np.sin(3 * y)])


def mesh(kind: str) -> tuple[Array, Array]:
    # Stretched are four times longer triangles, on the same panel.
    points, triangles = meshes.stretched(100, 25, "regular") if "stretched" in kind else meshes.KINDS[kind](56)
    return crown(points * (1.5, 1.2)), triangles


def optimizer(kind: str = "irregular", **options: object) -> reflines.ShapeOptimizer:
    return reflines.ShapeOptimizer(*mesh(kind), view_direction=VIEW, line_direction=LINE, **options)


def middle(solver: reflines.ShapeOptimizer) -> Array:
    return 0.5 * (solver.xy.min(0) + solver.xy.max(0))


def across(solver: reflines.ShapeOptimizer, length: float) -> Array:
    """A way of this length across the lines."""
    mean = solver.field().mean(axis=0)
    return length * mean / np.linalg.norm(mean)


def pull(lines: reflines.LineHandles, start: Array, end: Array, **options: object) -> reflines.Handle:
    value = lines.read_theta(start[None])[0]
    return reflines.Handle(end[None], value=value, radius=RADIUS, centre=start[None], **options)


def moves_of_lines(solver: reflines.ShapeOptimizer, before: Array) -> Array:
    """How far the lines at the vertices have moved, as shares of their spacing."""
    change = reflines.vertex_theta(solver) - before
    return np.abs((change + np.pi) % (2 * np.pi) - np.pi) / STEP


CASES = ("regular", "4-8", "irregular", "regular stretched")


@pytest.mark.parametrize("border", ("clamped", "fixed", "free"))
@pytest.mark.parametrize("kind", CASES)
def test_a_pulled_line_passes_through_its_point_and_lines_beyond_the_radius_stay(kind: str, border: str) -> None:
    solver = optimizer(kind, border=border)
    lines, before = reflines.LineHandles(solver), reflines.vertex_theta(solver)
    start = middle(solver)
    handle = pull(lines, start, start + across(solver, 0.1))
    report = solver.solve(lines.build([handle]))
    assert report.converged
    reach, = lines.measure([handle], solver, line_step=STEP)
    after, = reflines.LineHandles(solver).read_theta((start + across(solver, 0.1))[None])
    assert abs(after - lines.read_theta(start[None])[0]) < 0.01 * STEP
    assert reach.fraction < 0.01
    beyond = np.linalg.norm(solver.xy - start, axis=1) > 1.1 * RADIUS
    assert moves_of_lines(solver, before)[beyond].max() < 0.02
    assert 0.2 < moves_of_lines(solver, before).max() < 0.4


def turn_between_neighbours(solver: reflines.ShapeOptimizer, F: Array, start: Array) -> float:
    """Root mean square of the angle (degrees) between the lines of neighbouring triangles within the radius."""
    edges = np.sort(np.stack([F[:, [1, 2]], F[:, [2, 0]], F[:, [0, 1]]], axis=1).reshape(-1, 2), axis=1)
    key = edges @ [len(solver.xy), 1]
    order = np.argsort(key)
    twin = np.flatnonzero(np.diff(key[order]) == 0)
    one, other = order[twin] // 3, order[twin + 1] // 3
    near = np.linalg.norm(solver.centers[one] - start, axis=1) < RADIUS
    a, b = solver.field()[one[near]], solver.field()[other[near]]
    sine = (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / (np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1))
    return float(np.degrees(np.sqrt(np.mean(sine**2))))


def test_the_triangulation_does_not_print_into_pulled_lines() -> None:
    """With the whole gradient as target neighbours turn by 1.4 times as much on a 4-8 mesh as on a regular one."""
    turns = []
    for kind in ("regular", "4-8", "irregular"):
        solver = optimizer(kind)
        lines, start = reflines.LineHandles(solver), middle(solver)
        solver.solve(lines.build([pull(lines, start, start + across(solver, 0.1))]))
        turns.append(turn_between_neighbours(solver, mesh(kind)[1], start))
    assert max(turns[1:]) < 1.1 * turns[0], turns


def test_pinned_lines_stay_beside_a_pull() -> None:
    """Of three pins within the radius, each of another kind; without them their lines move by more than a twentieth."""
    solver = optimizer()
    lines, before = reflines.LineHandles(solver), reflines.vertex_theta(solver)
    start, F = middle(solver), mesh("irregular")[1]
    handle = pull(lines, start, start + across(solver, 0.1))
    curve = start + [[0.1, -0.15], [0.2, 0.1]]
    area = np.flatnonzero(np.linalg.norm(solver.centers - start - [-0.22, 0.0], axis=1) < 0.07)
    pins = [reflines.Handle(start[None] + [0.0, -0.15]), reflines.Handle(curve), reflines.Handle(triangles=area)]
    moved = []
    for handles in ([handle], [handle, *pins]):
        solver.reset()
        solver.solve(lines.build(handles))
        area_moved = moves_of_lines(solver, before)[F[area]].max()
        moved.append([*(reach.fraction for reach in lines.measure(pins, solver, line_step=STEP)[:2]), area_moved])
    assert (np.array(moved[0]) > 0.02).all(), moved
    assert (np.array(moved[1]) < 0.02).all(), moved
    assert lines.measure([handle], solver, line_step=STEP)[0].fraction < 0.01


def test_a_line_is_laid_along_a_curve() -> None:
    solver = optimizer(border="fixed")
    lines = reflines.LineHandles(solver)
    start = middle(solver)
    curve = start + np.column_stack([0.02 + 0.03 * np.cos(np.linspace(0, 6, 20)), np.linspace(-0.2, 0.2, 20)])
    handle = reflines.Handle(curve, value=lines.read_theta(start[None])[0], radius=RADIUS)
    assert lines.measure([handle], solver, line_step=STEP)[0].fraction > 0.1
    assert solver.solve(lines.build([handle])).converged
    assert lines.measure([handle], solver, line_step=STEP)[0].fraction < 0.02


def reach_of(lines: reflines.LineHandles, start: Array, way: Array) -> float:
    """How far the region reaches from a point both ways, by bisection."""
    low, high = 0.0, 2.0
    while high - low > 1e-3:
        at = 0.5 * (low + high)
        try:
            lines.read_theta(start + np.outer([-at, at], way))
            low = at
        except reflines.InvalidInput:
            high = at
    return low


@pytest.mark.parametrize("cells", [12, 24, 48])
def test_a_curve_from_border_to_border_is_met_where_lines_can_move(cells: int) -> None:
    """A clamped border keeps the lines of the faces beside it, of a coarse panel a tenth of it: a curve that ends there
    was refused, or bulged."""
    points, triangles = sample_panels.grid(cells)
    solver = reflines.ShapeOptimizer(crown((points - 0.5) * (1.5, 1.2)), triangles, view_direction=VIEW,
                                     line_direction=LINE)
    lines, way = reflines.LineHandles(solver), across(solver, 1.0)
    along, bow = np.array([-way[1], way[0]]), np.linspace(-1.0, 1.0, 41)[:, None]
    ends = reach_of(lines, middle(solver), along) - 0.005  # within the last face
    curve = middle(solver) + bow * ends * along + 0.04 * (1.0 - bow**2) * way
    centre = curve[20] - 0.02 * way
    handle = reflines.Handle(curve, value=lines.read_theta(centre[None])[0], radius=RADIUS)
    solver.solve(lines.build([handle]))
    reach, = lines.measure([handle], solver, line_step=STEP)
    assert reach.fraction < 0.05, reach.fraction
    held = curve[:1] + np.linspace(0.0, 0.01, 5)[:, None] * along
    with pytest.raises(reflines.InvalidInput, match="on a border that holds"):
        lines.build([reflines.Handle(held, value=0.0, radius=RADIUS)])


def test_lines_can_be_laid_where_no_border_holds_and_no_feature_is() -> None:
    """A clamped border holds the faces with a corner on it or beside it, of 48 cells the outermost two; a free one
    none.
    """
    points, triangles = sample_panels.grid(48)
    V = crown((points - 0.5) * (1.5, 1.2))
    for border, rows in (("clamped", 2), ("free", 0)):
        solver = reflines.ShapeOptimizer(V, triangles, view_direction=VIEW, line_direction=LINE, border=border)
        lines = reflines.LineHandles(solver)
        cell = np.abs(points[triangles].mean(axis=1) - 0.5).max(axis=1) * 48
        inner, outer = cell < 24 - rows - 0.1, cell > 24 - rows + 0.1
        assert lines.can_follow(solver.centers[inner]).all() and not lines.can_follow(solver.centers[outer]).any()
        assert not lines.can_follow(np.array([[9.0, 0.0], [np.nan, 0.0]])).any()


def test_a_curve_that_leaves_the_region_is_laid_where_that_has_lines() -> None:
    solver = optimizer()
    lines, way = reflines.LineHandles(solver), across(solver, 1.0)
    along, start = np.array([-way[1], way[0]]), middle(solver)
    value = lines.read_theta(start[None])[0]
    curve = start + 0.02 * way + np.linspace(-0.3, 2.0, 24)[:, None] * along
    handle = reflines.Handle(curve, value=value, radius=RADIUS)
    assert solver.solve(lines.build([handle])).converged
    assert lines.measure([handle], solver, line_step=STEP)[0].fraction < 0.02
    with pytest.raises(reflines.InvalidInput, match="off the region"):
        lines.build([reflines.Handle(curve[-8:], value=value, radius=RADIUS)])


def draw_map(solver: reflines.ShapeOptimizer, low: float = -0.2, high: float = -0.1) -> Array:
    """A fall-off map that grows along the lines from 0 to 1, beside the middle."""
    way = across(solver, 1.0)
    return np.clip(((solver.xy - middle(solver)) @ [-way[1], way[0]] - low) / (high - low), 0.0, 1.0)


@pytest.mark.parametrize("kind", CASES)
def test_lines_stay_where_the_fall_off_map_is_0_and_meet_the_handle_where_it_is_1(kind: str) -> None:
    moved = []
    for mapped in (False, True):
        solver = optimizer(kind)
        before, start = reflines.vertex_theta(solver), middle(solver)
        lines = reflines.LineHandles(solver, falloff=draw_map(solver) if mapped else None)
        handle = pull(lines, start, start + across(solver, 0.1))
        assert solver.solve(lines.build([handle])).converged
        assert lines.measure([handle], solver, line_step=STEP)[0].fraction < 0.01
        moved.append(moves_of_lines(solver, before)[draw_map(solver) == 0.0].max())
    assert moved[1] < 0.02 and moved[1] < 0.2 * moved[0], moved


def test_the_less_the_map_the_less_lines_follow_and_the_handle_is_met_all_the_same() -> None:
    moved, start = [], None
    for level in (1.0, 0.75, 0.5, 0.25, 0.0):
        solver = optimizer()
        before, start = reflines.vertex_theta(solver), middle(solver)
        free = draw_map(solver)
        lines = reflines.LineHandles(solver, falloff=level + (1.0 - level) * free)
        handle = pull(lines, start, start + across(solver, 0.1))
        solver.solve(lines.build([handle]))
        assert lines.measure([handle], solver, line_step=STEP)[0].fraction < 0.01
        moved.append(moves_of_lines(solver, before)[free == 0.0].max())
    assert (np.diff(moved) < 0.0).all() and moved[1] > 0.5 * moved[0], moved
    halfway = optimizer()
    lines = reflines.LineHandles(halfway, falloff=np.full(len(halfway.xy), 0.5))
    handle = pull(lines, start, start + across(halfway, 0.1))
    halfway.solve(lines.build([handle]))
    assert lines.measure([handle], halfway, line_step=STEP)[0].fraction < 0.01


def test_a_map_of_1_changes_no_bit_and_handles_at_rest_change_none_under_any() -> None:
    solver = optimizer()
    start, ones = middle(solver), np.ones(len(solver.xy))
    handle = pull(reflines.LineHandles(solver), start, start + across(solver, 0.1))
    for plain, mapped in zip(reflines.handles(solver, [handle]), reflines.handles(solver, [handle], falloff=ones),
                             strict=True):
        assert np.array_equal(plain.gradient, mapped.gradient) and np.array_equal(plain.theta, mapped.theta)
        assert np.array_equal(plain.weight, mapped.weight)
    lines, before = reflines.LineHandles(solver, falloff=draw_map(solver)), solver.positions.tobytes()
    gradient, value, met = lines.build([pull(lines, start, start)])
    assert np.array_equal(gradient.gradient, solver.field()) and np.array_equal(value.theta, solver.theta())
    assert solver.solve([gradient, value, met]).termination == "already_optimal"
    assert solver.positions.tobytes() == before


def test_bad_fall_off_maps_are_refused_with_the_count() -> None:
    solver = optimizer()
    good = np.ones(len(solver.xy))
    number, count = np.arange(len(good)), len(good)
    for wrong, words in ((good[:-1], f"has {count - 1} values"),
                         (np.where(number < 3, 1.5, good), f"^3 of the {count} values"),
                         (np.where(number < 2, np.nan, good), "^2 of the"), (-good, f"^{count} of the")):
        with pytest.raises(reflines.InvalidInput, match=words):
            reflines.LineHandles(solver, falloff=wrong)
    lines, start = reflines.LineHandles(solver, falloff=draw_map(solver)), middle(solver)
    held = start - 0.3 * across(solver, 1.0)[::-1] * [-1.0, 1.0]
    with pytest.raises(reflines.InvalidInput, match="where the fall-off map is 0"):
        lines.build([reflines.Handle(held[None], value=0.1, radius=RADIUS)])


def test_several_handles_are_all_met() -> None:
    solver = optimizer()
    lines = reflines.LineHandles(solver)
    starts = middle(solver) + np.array([[-0.3, -0.1], [0.25, 0.1], [0.05, 0.2]])
    way = across(solver, 0.1)
    handles = [pull(lines, start, start + sign * way) for start, sign in zip(starts, (1, 1, -1), strict=True)]
    assert not lines.find_conflicts(handles)
    assert solver.solve(lines.build(handles)).converged
    assert max(reach.fraction for reach in lines.measure(handles, solver, line_step=STEP)) < 0.01


def test_the_same_on_a_cage() -> None:
    """Its few unknowns cannot hold all lines beyond the radius: those stay to a tenth of the pull."""
    solver = sample_cages.optimizer(sample_cages.hood(), level=2)
    lines, before = reflines.LineHandles(solver), reflines.vertex_theta(solver)
    start = middle(solver)
    handle = pull(lines, start, start + across(solver, 0.1))
    assert solver.solve(lines.build([handle])).converged
    pulled = abs(lines.read_theta((start + across(solver, 0.1))[None]) - lines.read_theta(start[None]))[0] / STEP
    assert lines.measure([handle], solver, line_step=STEP)[0].fraction < 0.01 < pulled
    beyond = np.linalg.norm(solver.xy - start, axis=1) > 1.1 * RADIUS
    assert moves_of_lines(solver, before)[beyond].max() < max(0.02, 0.1 * pulled)
    assert np.abs(solver.cage_positions - sample_cages.hood()[0]).max() > 1e-4


@pytest.mark.parametrize("make", (optimizer, lambda: sample_cages.optimizer(sample_cages.hood())))
def test_handles_at_rest_change_no_bit(make) -> None:
    solver = make()
    lines = reflines.LineHandles(solver)
    start = middle(solver)
    handles = [pull(lines, start, start), reflines.Handle(start[None] + 0.1)]
    gradient, value, met = lines.build(handles)
    assert np.array_equal(gradient.gradient, solver.field()) and np.array_equal(value.theta, solver.theta())
    before = [np.array(getattr(solver, name, 0.0)) for name in ("positions", "cage_positions")]
    report = solver.solve([gradient, value, met])
    assert report.termination == "already_optimal"
    kept = solver.cage_positions if hasattr(solver, "cage_positions") else solver.positions
    assert kept.tobytes() == before[hasattr(solver, "cage_positions")].tobytes()


def test_a_closed_path_leaves_nothing() -> None:
    """Targets are those of the start's lines, whatever the heights are now."""
    solver = optimizer()
    lines, before = reflines.LineHandles(solver), solver.heights.copy()
    start = middle(solver)
    away = []
    for turn in np.linspace(0.0, 2.0 * np.pi, 13):
        end = start + across(solver, 0.1) * np.sin(turn) + [0.1 * (1.0 - np.cos(turn)), 0.0]
        solver.solve(lines.build([pull(lines, start, end)]))
        away.append(np.abs(solver.heights - before).max())
    assert away[0] == 0.0 and max(away) > 1e-3
    assert away[-1] < 1e-6


def test_a_moved_handle_is_built_as_by_new_handles() -> None:
    """The factorization that is kept is that of the part, not of the point."""
    solver = optimizer()
    lines, start = reflines.LineHandles(solver), middle(solver)
    lines.build([pull(lines, start, start + across(solver, 0.1))])
    moved = pull(lines, start, start - across(solver, 0.1))
    kept, fresh = lines.build([moved])[0], reflines.handles(solver, [moved])[0]
    assert np.array_equal(kept.gradient, fresh.gradient)
    other = reflines.Handle(start[None] - across(solver, 0.1), value=0.1, radius=0.3)
    kept, fresh = lines.build([other])[0], reflines.handles(solver, [other])[0]
    assert np.array_equal(kept.gradient, fresh.gradient)


def test_values_that_jump_by_a_full_turn_are_right() -> None:
    """A panel that leans so far that the lines at theta = pi, where atan2 jumps to -pi, run along its middle."""
    points, triangles = meshes.regular(40)
    x, y = points.T
    V = np.column_stack([points, -1.0 * y - 0.3 * x**2 - 0.05 * y**2])
    solver = reflines.ShapeOptimizer(V, triangles, view_direction=(0, 0, 1), line_direction=(0, 1, 1))
    lines, start, end = reflines.LineHandles(solver), np.array([-0.03, 0.0]), np.array([0.04, 0.0])
    values = lines.read_theta(np.array([start, end]))
    assert abs(values[0] - values[1]) > 6.0
    handles = [reflines.Handle(end[None], value=values[0] + turn, radius=0.3, centre=start[None])
               for turn in (0.0, 2.0 * np.pi)]
    targets = [lines.build([handle]) for handle in handles]
    assert np.allclose(targets[0][0].gradient, targets[1][0].gradient, atol=1e-9)
    assert np.abs(targets[0][0].gradient - solver.field()).max() < 2.0
    assert solver.solve(targets[0]).converged
    assert lines.measure(handles, solver, line_step=STEP)[0].fraction < 0.01


def test_what_is_reached_is_told_along_the_surface() -> None:
    """On a cylinder that is seen at an angle: theta grows evenly along its arc."""
    points, triangles = meshes.regular(60)
    V = np.column_stack([points, np.sqrt(4.0 - (points[:, 0] + 1.0)**2)])
    solver = reflines.ShapeOptimizer(V, triangles, view_direction=(0, 0, 1), line_direction=(0, 1, 0.0))
    lines = reflines.LineHandles(solver)
    places = np.array([[0.0, 0.0], [0.1, 0.0]])
    value = lines.read_theta(places[:1])[0]
    reach, = lines.measure([reflines.Handle(places[1:], value=value, radius=0.2)], solver, line_step=STEP)
    arc = 2.0 * abs(np.diff(np.arcsin((places @ solver.frame[:2, 0] + 1.0) / 2.0))[0])
    assert abs(reach.distance / arc - 1.0) < 0.05
    assert abs(reach.fraction - abs(reach.theta) / STEP) < 1e-12


def test_handles_that_force_lines_to_cross_are_named() -> None:
    solver = optimizer()
    lines, start = reflines.LineHandles(solver), middle(solver)
    left = pull(lines, start, start + across(solver, 0.2), name="Left")
    right = pull(lines, start + across(solver, 0.1), start + across(solver, 0.05), name="Right")
    conflict, = lines.find_conflicts([left, right])
    assert "Left" in conflict and "Right" in conflict and "cross" in conflict
    near = pull(lines, start + across(solver, 0.1), start + across(solver, 0.25), name="Near")
    assert not lines.find_conflicts([left, near])


def bad_handles(lines: reflines.LineHandles, start: Array) -> list[tuple[list[reflines.Handle], str]]:
    good = pull(lines, start, start)
    point = start[None]
    return [([], "no handle that pulls"), ([reflines.Handle(point)], "no handle that pulls"),
            ([reflines.Handle(value=0.1, radius=RADIUS)], "has no point"), ([good, reflines.Handle()], "has no point"),
            ([reflines.Handle(point, value=np.nan, radius=RADIUS)], "not a finite"),
            ([reflines.Handle(point * np.inf, value=0.1, radius=RADIUS)], "not a finite"),
            ([reflines.Handle(point, value=0.1)], "no radius"),
            ([reflines.Handle(point, value=0.1, radius=-1.0)], "no radius"),
            ([reflines.Handle(point, value=0.1, radius=0.01)], "covers"),
            ([reflines.Handle(point + 9.0, value=0.1, radius=RADIUS)], "off the region"),
            ([good, reflines.Handle(point + 9.0)], "Handle 2 lies off the region"),
            ([reflines.Handle(point + 0.4, value=0.1, radius=0.2, centre=point)], "outside its radius"),
            ([good, reflines.Handle(triangles=np.array([-1]))], "names a triangle"),
            ([good, reflines.Handle(triangles=np.array([10**6]))], "names a triangle"),
            ([reflines.Handle(point, value=0.1, radius=RADIUS, triangles=np.array([10**6]))], "names a triangle"),
            ([reflines.Handle([[0, 0], [1e200, 0]], value=0.1, radius=RADIUS)], "too far away")]


def test_bad_handles_are_refused_in_a_sentence() -> None:
    solver = optimizer()
    lines, start = reflines.LineHandles(solver), middle(solver)
    for handles, words in bad_handles(lines, start):
        with pytest.raises(reflines.InvalidInput, match=words) as refusal:
            lines.build(handles)
        assert str(refusal.value).endswith(".")
    other = reflines.ShapeOptimizer(*mesh("4-8"), view_direction=VIEW, line_direction=LINE)
    with pytest.raises(reflines.InvalidInput, match="another region"):
        lines.measure([], sample_cages.optimizer(sample_cages.hood()), line_step=STEP)
    with pytest.raises(reflines.InvalidInput, match="positive"):
        lines.measure([], solver, line_step=0.0)
    assert reflines.LineHandles(other).read_theta(np.zeros((0, 2))).shape == (0,)


@pytest.mark.parametrize("triangles", [np.array([2**32 + 3]), np.array([1.5])])
def test_numbers_of_triangles_that_are_none_are_refused(triangles: Array) -> None:
    with pytest.raises(reflines.InvalidInput, match="32 bits|whole numbers"):
        reflines.Handle(triangles=triangles)


def test_a_pin_where_nothing_can_be_seen_weighs_nothing() -> None:
    V, F = sample_panels.panel(16)
    V[:, 2] -= 6 * np.maximum(V[:, 0] - 0.4, 0.0)
    solver = reflines.ShapeOptimizer(V, F, view_direction=VIEW, line_direction=LINE)
    lines, start = reflines.LineHandles(solver), middle(solver)
    pin = reflines.Handle(triangles=np.flatnonzero(~solver.active)[:3])
    assert solver.solve(lines.build([pull(lines, start, start + across(solver, 0.02)), pin])).converged
