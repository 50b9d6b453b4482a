"""ShapeOptimizer(..., eye_directions): families of lines that are each seen by an eye of their own."""
import numpy as np
import pytest
import reflines
from sample_panels import LINE, VIEW, find_normals, grid, panel, rippled, theta_of, unit

Array = np.ndarray
EYE, ASIDE = np.array([0.5, -0.2, 0.8]), np.array([0.3, 1.0, -0.2])


def sphere(cells: int) -> tuple[Array, Array]:
    """A cap of a sphere of radius 2 above (0, 0, -2), seen along z."""
    plane, triangles = grid(cells, jitter=0.2)
    x, y = (plane - 0.5).T
    return np.stack([x, y, np.sqrt(4 - x**2 - y**2) - 2], 1), triangles


def sphere_field(centers: Array, eye: Array, line: Array) -> Array:
    """The gradient of theta on that sphere by its normals, in the plane across z."""
    step = 1e-5

    def value(points: Array) -> Array:
        return theta_of(np.column_stack([points, np.sqrt(4 - (points**2).sum(1))]), eye, line)

    return np.stack([(value(centers + step * axis) - value(centers - step * axis)) / (2 * step)
                     for axis in np.eye(2)], 1)


def looking(positions: Array, triangles: Array, eyes: object, lines: object, view: Array = VIEW,
            **options: object) -> reflines.ShapeOptimizer:
    return reflines.ShapeOptimizer(positions, triangles, view_direction=view, line_direction=np.atleast_2d(lines),
                                   eye_directions=np.atleast_2d(eyes), **options)


def test_theta_is_that_of_equation_one_for_the_eye():
    positions, triangles = panel(24)
    solver = looking(positions, triangles, [VIEW, EYE], [LINE, ASIDE])
    for family, (eye, line) in enumerate(((VIEW, LINE), (EYE, ASIDE))):
        expected = theta_of(find_normals(positions, triangles), eye, line)
        assert np.abs(np.angle(np.exp(1j * (solver.theta(family) - expected)))).max() < 1e-12


@pytest.mark.parametrize("order", [0, 1])
def test_the_field_on_a_sphere_is_that_of_its_formula(order: int):
    up, errors = np.array([0.0, 0.0, 1.0]), []
    for cells in (24, 48):
        solver = looking(*sphere(cells), [EYE, up][::1 - 2 * order], [ASIDE, LINE][::1 - 2 * order], up)
        expected = sphere_field(solver.centers @ solver.frame[:2, :2], EYE, ASIDE)
        errors.append(np.abs(solver.field(order) @ solver.frame[:2, :2] - expected).max())
    assert errors[1] < 0.65 * errors[0] < 0.65 * 0.03


def test_a_sphere_is_found_by_its_lines_from_aside():
    up = np.array([0.0, 0.0, 1.0])
    positions, triangles = sphere(40)
    bent = positions + np.outer(0.01 * np.clip(1 - (positions[:, :2] ** 2).sum(1) / 0.2, 0, None) ** 3, up)
    eyes, lines = [EYE, unit(np.array([-0.4, 0.3, 1.0]))], [ASIDE, LINE]
    solver = looking(bent, triangles, eyes, lines, up)
    centers = solver.centers @ solver.frame[:2, :2]
    report = solver.solve([reflines.Target(sphere_field(centers, eye, line) @ solver.frame[:2, :2].T, family=family)
                           for family, (eye, line) in enumerate(zip(eyes, lines, strict=True))])
    assert report.converged and report.factorizations <= 2
    assert np.abs(solver.positions - positions).max() < 0.003 * np.abs(bent - positions).max()


def test_the_energy_of_an_eye_alone_is_lowest_where_its_lines_are_the_wanted_ones():
    positions, triangles = panel(24)
    target = reflines.Target(looking(positions, triangles, EYE, ASIDE).field())
    dent = 1e-3 * np.clip(1 - (positions[:, :2] ** 2).sum(1) / 0.1, 0, None) ** 3
    solver = looking(positions + np.outer(dent, VIEW), triangles, EYE, ASIDE)
    before = solver.energy(target)
    assert solver.solve(target).converged
    assert solver.energy(target) < 1e-8 * before
    assert np.abs(solver.positions - positions).max() < 1e-6


def beside(positions: Array, triangles: Array) -> Array:
    return positions[triangles].mean(1)[:, 0]


def test_what_another_surface_hides_from_the_eye_keeps_its_lines():
    """A wall beyond x = 0.8 hides the right end of the panel from an eye at 45 degrees, and nothing from above."""
    positions, triangles = panel(32)
    wall = np.array([[0.8, -2.0, -1.0], [0.8, 2.0, -1.0], [0.8, 2.0, 0.4], [0.8, -2.0, 0.4]])
    blockers = wall, np.array([[0, 1, 2], [0, 2, 3]])
    up, at = np.array([0.0, 0.0, 1.0]), positions[:, :2]
    dents = sum(np.clip(1 - ((at - place) ** 2).sum(1) / 0.02, 0, None) ** 3 for place in ((-0.2, 0), (0.58, 0)))
    bad = positions + np.outer(1e-3 * dents, up)
    eyes = [[1.0, 0.0, 1.0], up]
    solver = looking(bad, triangles, eyes, [ASIDE, ASIDE], up, blockers=blockers)
    x = beside(bad, triangles)
    sight = solver.sight(0)
    assert (sight[x > 0.5] == 0).all() and (sight[x < 0.3] == 1).all() and (solver.sight(1) == 1).all()
    solver.solve(reflines.Target(looking(positions, triangles, eyes, [ASIDE, ASIDE], up).field(0)))
    left, moved = (np.abs(solver.positions - other)[:, 2] for other in (positions, bad))
    assert left[at[:, 0] < 0.2].max() < 1e-5 and moved[at[:, 0] > 0.5].max() < 1e-5


def test_an_eye_behind_the_panel_has_no_weight_and_is_named():
    positions, triangles = panel(16)
    solver = looking(positions, triangles, [VIEW, -VIEW], [LINE, LINE])
    assert (solver.sight(1) == 0).all()
    assert [note.count for note in solver.region.notes if note.kind == "unseen"] == [1]
    start = solver.positions
    solver.solve(reflines.Target(solver.field(1) + 1.0, family=1))
    assert np.array_equal(solver.positions, start)


def test_the_eyes_that_look_along_the_view_change_nothing():
    positions, triangles = rippled(panel(24)[0], amplitude=3e-4, wavelength=0.1), panel(24)[1]
    results = []
    for eyes in (None, np.array([VIEW, VIEW])):
        solver = reflines.ShapeOptimizer(positions, triangles, view_direction=VIEW, line_direction=[LINE, ASIDE],
                                         eye_directions=eyes)
        solver.solve([reflines.smooth(solver, length=0.3, family=family) for family in range(2)])
        results.append(solver.positions)
    assert np.abs(results[0] - results[1]).max() < 1e-9


@pytest.mark.parametrize(("eyes", "lines", "sentence"), [
    ([VIEW, ASIDE], [LINE, ASIDE], "Light lines 1 are parallel to eye direction 1"),
    ([VIEW], [LINE, ASIDE], "There are 1 eye directions for 2 line directions"),
    ([VIEW, [0, 0, 0]], [LINE, ASIDE], "Eye direction 1 has no length"),
    ([VIEW, [np.nan, 0, 1]], [LINE, ASIDE], "Eye direction 1 has no length"),
    ([-VIEW, -VIEW], [LINE, ASIDE], "No eye direction sees the region"),
])
def test_bad_eyes_get_a_sentence(eyes: object, lines: object, sentence: str):
    with pytest.raises(reflines.InvalidInput, match=sentence):
        looking(*panel(8), eyes, lines)


def test_lines_along_the_view_are_no_reason_to_refuse_an_eye_that_sees_them():
    solver = looking(*panel(16), [EYE, EYE], [VIEW, LINE])
    assert np.isfinite(solver.field(0)).all() and solver.region.free > 0
