"""Targets of the tools: identities change no bit, and each asks for what its name says."""

import numpy as np
import pytest
import reflines
from sample_panels import LINE, VIEW, inside, panel, rms


@pytest.fixture
def solver():
    positions, triangles = panel(32)
    return reflines.ShapeOptimizer(positions, triangles, view_direction=VIEW, line_direction=LINE)


def grid_positions(low, high, columns, rows, move=lambda p: p):
    x, y = np.meshgrid(np.linspace(low[0], high[0], columns + 1), np.linspace(low[1], high[1], rows + 1), indexing="xy")
    return move(np.stack([x.ravel(), y.ravel()], 1))


def warped(solver, move, cells=64, **options):
    low, high = solver.xy.min(0) - 0.1, solver.xy.max(0) + 0.1
    return reflines.warp(solver, low=low, high=high, columns=cells, rows=cells,
                         position=grid_positions(low, high, cells, cells, move), **options)


def identities(solver):
    nobody = np.zeros(len(solver.centers))
    image = np.random.default_rng(0).random((20, 30))
    return [reflines.turn(solver, angle=0.0), reflines.turn(solver, angle=1.0, influence=nobody),
            reflines.turn(solver, density=1.0, density_end=1.0, axis=(1, 0)),
            reflines.uniform(solver, density=3.0, influence=nobody), warped(solver, lambda p: p)[0],
            reflines.pattern(solver, image=image, strength=0.0), reflines.smooth(solver, length=0.3, strength=0.0)]


def test_identities_ask_for_the_field_itself_bit_for_bit(solver):
    for target in identities(solver):
        assert np.array_equal(target.gradient, solver.field())
        report = solver.solve(target)
        assert report.termination == "already_optimal" and report.largest_move == 0.0


def test_turn_turns_every_gradient(solver):
    before, after = solver.field(), reflines.turn(solver, angle=0.3).gradient
    turned = before @ np.array([[np.cos(0.3), np.sin(0.3)], [-np.sin(0.3), np.cos(0.3)]])
    assert np.allclose(after, turned, atol=1e-14)


def test_turn_scales_every_gradient_by_a_density_along_an_axis(solver):
    axis = np.array([1.0, 0.0])
    target = reflines.turn(solver, density=1.5, density_end=0.5, axis=axis)
    position = solver.centers @ axis
    share = (position - position.min()) / np.ptp(position)
    assert np.allclose(target.gradient, solver.field() * (1.5 - share)[:, None], atol=1e-14)
    half = reflines.turn(solver, density=3.0, influence=np.full(len(position), 0.5))
    assert np.allclose(half.gradient, 2.0 * solver.field(), atol=1e-14)


def test_uniform_lines_have_the_direction_and_the_density(solver):
    direction = np.array([0.2, 1.0])
    gradient = reflines.uniform(solver, direction=direction, density=0.7, relative=False).gradient
    assert np.allclose(gradient @ direction, 0, atol=1e-13)
    assert np.allclose(np.linalg.norm(gradient, axis=1), 0.7)
    assert (gradient @ solver.field().mean(0) > 0).all()


def test_density_varies_linearly_along_an_axis(solver):
    axis = np.array([1.0, 0.0])
    gradient = reflines.uniform(solver, density=1.0, relative=False, density_end=2.0, axis=axis).gradient
    position = solver.centers @ axis
    share = (position - position.min()) / np.ptp(position)
    assert np.allclose(np.linalg.norm(gradient, axis=1), 1 + share)


def test_denser_lines_are_denser_where_the_weight_is(solver):
    centre = solver.centers.mean(0)
    influence = reflines.falloff(solver, centre=centre, radius=0.4, curve=np.array([1.0, 0.8, 0.2, 0.0]))
    target = reflines.uniform(solver, density=1.3, influence=influence, weight=1 + 99 * influence)
    near = np.linalg.norm(solver.centers - centre, axis=1) < 0.1
    before = rms((solver.field() - target.gradient)[near])
    assert solver.solve(target).converged
    assert rms((solver.field() - target.gradient)[near]) < before / 2


def test_falloff_follows_its_curve(solver):
    centre = solver.centers[7]
    values = reflines.falloff(solver, centre=centre, radius=0.4, curve=np.array([3.0, 1.0]))
    distance = np.linalg.norm(solver.centers - centre, axis=1)
    assert np.allclose(values, 3 - 2 * np.minimum(distance / 0.4, 1))


def bump(p, amount=0.03):
    weight = np.exp(-((p - p.mean(0)) ** 2).sum(1) / 0.05)
    return p + amount * weight[:, None] * np.array([1.0, 0.5])


def inverse_bump(p, centre, amount=0.03):
    """The exact inverse of `bump` by fixed-point iteration: the referee of the sampled inverse."""
    source = p.copy()
    for _ in range(200):
        weight = np.exp(-((source - centre) ** 2).sum(1) / 0.05)
        source = p - amount * weight[:, None] * np.array([1.0, 0.5])
    return source


def bowl(cells):
    """An analytic surface with its normals as a function of the plane."""
    plane, triangles = panel(cells)
    x, y = plane[:, 0], plane[:, 1]

    def normals(p):
        return np.stack([0.6 * p[:, 0] - 0.3 * p[:, 0] ** 2, 0.4 * p[:, 1], np.ones(len(p))], 1)

    return np.column_stack([x, y, -0.3 * x**2 - 0.2 * y**2 + 0.1 * x**3]), triangles, normals


def central_differences(function, points, h=1e-5):
    steps = h * np.eye(2)
    return np.stack([(function(points + step) - function(points - step)) / (2 * h) for step in steps], 1)


def warp_error(cells):
    """Of the wanted change of the field against the exact one, relative, away from the border."""
    positions, triangles, normals = bowl(cells)
    view, line = np.array([0.0, 0, 1]), np.array([0.1, 1, 0.2])
    solver = reflines.ShapeOptimizer(positions, triangles, view_direction=view, line_direction=line)
    target, _ = warped(solver, bump, cells=256)
    to_world = solver.frame[:2, :2]
    centre = (solver.xy.min(0) + solver.xy.max(0)) / 2

    def exact(p):
        return (reflines.theta(normals(inverse_bump(p, centre) @ to_world), view, line)
                - reflines.theta(normals(p @ to_world), view, line))

    inner = (np.abs(positions[triangles].mean(1)[:, :2]) < [0.6, 0.45]).all(1)
    wanted = central_differences(exact, solver.centers)[inner]
    return rms((target.gradient - solver.field())[inner] - wanted) / rms(wanted)


def test_warp_agrees_with_the_exact_inverse_on_analytic_lines():
    """theta_warp(x) is theta of the normal at w^-1(x); the P1 gradient on an irregular mesh is of first order."""
    coarse, fine = warp_error(24), warp_error(48)
    assert coarse < 0.15 and fine < coarse / 1.7


def test_folded_lattice_is_refused_in_words(solver):
    with pytest.raises(reflines.InvalidInput, match="folds over"):
        warped(solver, lambda p: np.column_stack([np.abs(p[:, 0]), p[:, 1]]))


def test_warp_by_value_reaches_the_same_lines(solver):
    target, _ = warped(solver, lambda p: bump(p, 0.01), by_value=True)
    before = solver.residual(target)[np.linalg.norm(solver.centers - solver.centers.mean(0), axis=1) < 0.3].max()
    solver.solve(target)
    after = solver.residual(target)[np.linalg.norm(solver.centers - solver.centers.mean(0), axis=1) < 0.3].max()
    assert after < before / 2


def test_pattern_is_the_gradient_of_the_blurred_image(solver):
    rows, columns, width = 128, 128, 3.2
    x = (np.arange(columns) + 0.5) / columns * width - width / 2
    y = (np.arange(rows) + 0.5) / columns * width - rows / columns * width / 2
    image = 0.5 + 0.3 * np.sin(3 * x)[None, :] * np.cos(2 * y)[:, None]
    target = reflines.pattern(solver, image=image, strength=2.0, keep=0.0, width=width)
    cx, cy = solver.centers.T
    wanted = 2 * 0.3 * np.stack([3 * np.cos(3 * cx) * np.cos(2 * cy), -2 * np.sin(3 * cx) * np.sin(2 * cy)], 1)
    assert rms(target.gradient - wanted) < 0.05 * rms(wanted)  # P1 gradients of a wave of 2 on 32 irregular cells


def test_blur_takes_the_sharpness_away(solver):
    image = np.zeros((64, 64))
    image[:, 32:] = 1.0
    sharp = reflines.pattern(solver, image=image, keep=0.0, width=2.0).gradient
    soft = reflines.pattern(solver, image=image, keep=0.0, width=2.0, blur=6.0).gradient
    assert np.abs(soft).max() < np.abs(sharp).max() / 3


def test_reachable_pattern_is_reached(solver):
    positions, triangles = panel(32)
    lifted = positions + (2e-3 * inside(positions, margin=0.4, rim=0.1) * np.sin(6 * positions[:, 0]))[:, None] * VIEW
    other = reflines.ShapeOptimizer(lifted, triangles, view_direction=VIEW, line_direction=LINE)
    assert solver.solve(reflines.Target(other.field())).converged
    assert np.abs(solver.heights - other.heights).max() < 1e-5


def warp_of(solver, nodes, low=(0, 0), **sizes):
    return reflines.warp(solver, low=low, high=(1, 1), position=np.zeros((nodes, 2)), **sizes)


@pytest.mark.parametrize("call, words", [
    (lambda s: reflines.uniform(s, density=-1.0), "density"),
    (lambda s: reflines.uniform(s, influence=np.full(len(s.centers), 2.0)), "influence"),
    (lambda s: reflines.uniform(s, influence=np.ones(3)), "influence"),
    (lambda s: reflines.turn(s, angle=float("nan")), "angle"),
    (lambda s: reflines.turn(s, density=-1.0), "density"),
    (lambda s: reflines.falloff(s, centre=(0, 0), radius=0.0, curve=np.ones(2)), "radius"),
    (lambda s: reflines.pattern(s, image=np.zeros((0, 0))), "image"),
    (lambda s: reflines.pattern(s, image=np.ones((2, 2)), width=0.0), "width"),
    (lambda s: reflines.pattern(s, image=np.ones((2, 2)), blur=1e9), "blur"),
    (lambda s: reflines.smooth(s, length=0.1, family=3), "family 3"),
    (lambda s: warp_of(s, columns=2, rows=2, nodes=8), "there are 8 for 2 columns"),
    (lambda s: warp_of(s, columns=-3, rows=-3, nodes=4), "for -3 columns"),
    (lambda s: warp_of(s, columns=50000, rows=50000, nodes=4), "50000 columns"),  # 120 GB of triangles
    (lambda s: warp_of(s, columns=65535, rows=65535, nodes=0), "65535 columns"),  # 2^32 nodes
    (lambda s: warp_of(s, columns=2**31 - 1, rows=1, nodes=0), "2147483647 columns"),
    (lambda s: warp_of(s, columns=1, rows=1, nodes=4, low=(float("nan"), 0)), "rectangle"),
])
def test_bad_settings_get_a_sentence(solver, call, words):
    with pytest.raises(reflines.InvalidInput, match=words):
        call(solver)


def test_the_blur_is_a_gaussian_with_the_border_continued(solver):
    image = np.random.default_rng(5).random((40, 56))
    offsets = np.arange(-20, 21)
    kernel = np.exp(-0.5 * (offsets / 5.0) ** 2)
    kernel /= kernel.sum()
    rows = np.clip(np.arange(40)[:, None] + offsets, 0, 39)
    columns = np.clip(np.arange(56)[:, None] + offsets, 0, 55)
    soft = kernel @ (kernel @ image[rows]).T[columns]
    ours = reflines.pattern(solver, image=image, blur=5.0, width=1.2, by_value=True)
    expected = reflines.pattern(solver, image=soft.T, width=1.2, by_value=True)
    assert np.abs(ours.theta - expected.theta).max() < 1e-14
