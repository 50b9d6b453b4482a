"""What no script may do to the module: crash it, stop it for ever, fill the memory, or get a runaway result."""
import os
import resource
import time

import numpy as np
import pytest
import reflines
from sample_panels import LINE, VIEW, panel

SLOWER = float(os.environ.get("REFLINES_SLOWER", "1"))  # times that the module is slower, as under sanitizers


@pytest.fixture
def solver() -> reflines.ShapeOptimizer:
    positions, triangles = panel(24)
    return reflines.ShapeOptimizer(positions, triangles, view_direction=VIEW, line_direction=LINE)


def classes() -> list[type]:
    return [kind for kind in vars(reflines).values() if isinstance(kind, type) and not issubclass(kind, Exception)]


@pytest.mark.parametrize("kind", classes(), ids=lambda kind: kind.__name__)
def test_no_object_is_made_without_its_constructor(kind) -> None:
    with pytest.raises(TypeError):
        kind.__new__(kind)
    with pytest.raises(TypeError):
        object.__new__(kind)


@pytest.mark.parametrize(("wrong", "sentence"), [
    ({"V": np.zeros((9, 2))}, r"shape \(9, 2\) was given where rows of three numbers are needed; reshape it"),
    ({"V": np.zeros(27)}, r"shape \(27,\) was given where rows of three numbers are needed"),
    ({"V": np.zeros((9, 3), complex)}, "array of complex128 was given where rows of three numbers are needed"),
    ({"V": np.full((9, 3), None)}, "array of object was given"),
    ({"view_direction": (0, 1)}, r"shape \(2,\) was given where three numbers are needed"),
    ({"fixed": np.zeros((3, 3), bool)}, r"shape \(3, 3\) was given where truth values in a row are needed"),
    ({"marked_creases": np.array([[0, 1], [0, 10**6], [-1, 2]])}, "2 of the 3 marked creases name a vertex beyond"),
])
def test_arrays_of_another_shape_get_a_sentence(wrong: dict, sentence: str) -> None:
    V, F = panel(8)
    arguments = {"V": V, "F": F, "view_direction": VIEW, "line_direction": LINE, **wrong}
    with pytest.raises(reflines.InvalidInput, match=sentence):
        reflines.ShapeOptimizer(**arguments)


def test_arrays_of_a_press_get_a_sentence_too() -> None:
    V, F = panel(8)
    seen = {"view_direction": VIEW, "line_direction": LINE}
    with pytest.raises(reflines.InvalidInput, match=r"shape \(9, 3\) was given where rows of two numbers are needed"):
        reflines.smooth_panel(V, F, limit_range=np.zeros((9, 3)), **seen)
    with pytest.raises(reflines.InvalidInput, match=r"shape \(3,\) was given where two numbers are needed"):
        reflines.uniform(reflines.ShapeOptimizer(V, F, **seen), direction=(1, 0, 0))
    plain = reflines.ShapeOptimizer(V.tolist(), F.tolist(), **seen)  # lists, other layouts and other numbers are taken
    for other in (np.asfortranarray(V), V.astype(">f8"), np.repeat(V, 2, axis=0)[::2]):
        assert np.array_equal(reflines.ShapeOptimizer(other, F, **seen).positions, plain.positions)


def runaway(solver: reflines.ShapeOptimizer, kind: str) -> reflines.Target:
    if kind == "density":
        return reflines.uniform(solver, density=1e6)
    image = np.zeros((64, 64))
    image[30:34, 30:34] = 65504.0 if kind == "bright spot" else 3e38
    low, high = solver.xy.min(0), solver.xy.max(0)
    return reflines.pattern(solver, image=image, centre=0.5 * (low + high), width=float(high[0] - low[0]))


@pytest.mark.parametrize("border", ["free", "fixed", "clamped"])
@pytest.mark.parametrize("kind", ["density", "bright spot", "peak"])
def test_a_runaway_result_is_a_failure_and_changes_nothing(kind, border) -> None:
    positions, triangles = panel(24)
    solver = reflines.ShapeOptimizer(positions, triangles, view_direction=VIEW, line_direction=LINE, border=border)
    before = solver.positions
    diagonal = np.linalg.norm(np.ptp(positions, axis=0))
    try:
        report = solver.solve(runaway(solver, kind))
    except (reflines.SolverFailure, reflines.InvalidInput) as error:
        assert str(error).count(". ") <= 1
        assert np.array_equal(solver.positions, before)
    else:
        moved = np.linalg.norm(solver.positions - before, axis=1).max()
        assert moved <= 10.0 * diagonal * (1.0 + 1e-12)
        assert report.largest_move <= 10.0 * diagonal


def test_density_of_a_million_is_refused(solver) -> None:
    with pytest.raises(reflines.SolverFailure, match="times its own size, so nothing was changed"):
        solver.solve(reflines.uniform(solver, density=1e6))


def peak_memory() -> int:
    """Bytes."""
    return 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def test_slivers_across_all_bins_take_little_time_and_memory(solver) -> None:
    """A lattice of one column, sheared so that each of its 32,768 triangles reaches across the whole box of all."""
    low, high, rows = solver.xy.min(0) - 0.1, solver.xy.max(0) + 0.1, 16384
    across, along = np.tile([0.0, 1.0], rows + 1), np.repeat(np.linspace(0.0, 1.0, rows + 1), 2)
    slanted = low + (high - low) * np.stack([across, across + 1e-2 * along], 1)
    before, start = peak_memory(), time.monotonic()
    reflines.warp(solver, low=low, high=high, columns=1, rows=rows, position=slanted)
    assert time.monotonic() - start < 5.0 * SLOWER
    assert peak_memory() - before < 5e8


@pytest.mark.parametrize("blur", [300.0, 1500.0])
def test_a_wide_blur_takes_no_longer_than_a_narrow_one(solver, blur) -> None:
    image = np.random.default_rng(0).random((800, 800))
    start = time.monotonic()
    reflines.pattern(solver, image=image, blur=blur)
    assert time.monotonic() - start < 2.0 * SLOWER


def test_a_wide_blur_is_gaussian(solver) -> None:
    """To 4 % of its middle: a step, compared with one a tenth as wide, which is convolved with the Gaussian itself."""
    image = np.zeros((4, 40000))
    image[:, 20000:] = 1.0
    low, high = solver.xy.min(0), solver.xy.max(0)
    options = {"image": image, "centre": 0.5 * (low + high), "width": 4.0 * float(high[0] - low[0])}
    wide = reflines.pattern(solver, blur=2000.0, **options).gradient - solver.field()
    narrow = reflines.pattern(solver, blur=200.0, **options | {"image": image[:, ::10]}).gradient - solver.field()
    assert np.abs(wide - narrow).max() < 0.04 * np.abs(narrow).max()


def fan(spokes: int) -> tuple[np.ndarray, np.ndarray]:
    angle = np.linspace(0.0, 2.0 * np.pi, spokes, endpoint=False)
    rings = [np.stack([r * np.cos(angle), r * np.sin(angle), np.full(spokes, -0.1 * r * r)], 1) for r in (1.0, 1.2)]
    i, j = np.arange(spokes), (np.arange(spokes) + 1) % spokes
    F = [np.stack([0 * i, 1 + i, 1 + j], 1), np.stack([1 + i, 1 + spokes + i, 1 + spokes + j], 1),
         np.stack([1 + i, 1 + spokes + j, 1 + j], 1)]
    return np.concatenate([np.zeros((1, 3)), *rings]), np.concatenate(F)


def test_a_fan_of_too_many_triangles_is_refused() -> None:
    with pytest.raises(reflines.InvalidInput, match="8000 triangles meet at vertex 0 of the region, more than 2000: "):
        reflines.ShapeOptimizer(*fan(8000), view_direction=[0.0, 0.0, 1.0], line_direction=LINE)
    reflines.ShapeOptimizer(*fan(2000), view_direction=[0.0, 0.0, 1.0], line_direction=LINE)


@pytest.mark.parametrize("name", ["strength", "width", "angle", "blur", "keep"])
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_settings_of_a_pattern_that_are_no_numbers_are_refused(solver, name, value) -> None:
    with pytest.raises(reflines.InvalidInput):
        reflines.pattern(solver, image=np.random.default_rng(0).random((8, 8)), **{name: value})


@pytest.mark.parametrize("length", [5e-324, 2e-308])
def test_a_length_too_small_to_compute_with_is_refused(length) -> None:
    """A tenth more of it is the same number, so that no circle grows from it."""
    with pytest.raises(reflines.InvalidInput, match="too small to compute with; give a longer one, or 0 for automatic"):
        reflines.smooth_panel(*panel(12), view_direction=VIEW, line_direction=LINE, length=length)


@pytest.mark.parametrize("settings", [{"length": 2.3e-308}, {"flaw_size": 5e-324}, {"parts_gap": 5e-324}])
def test_the_smallest_settings_of_a_press_come_to_an_end(settings) -> None:
    reflines.smooth_panel(*panel(12), view_direction=VIEW, line_direction=LINE, **settings)


@pytest.mark.parametrize("length", [1e8, 1e100, 1e300])
def test_a_length_far_beyond_the_panel_smooths_as_a_long_one(solver, length) -> None:
    """The fourth power of 1e100 is no number."""
    long = 1e7
    assert solver.score(length).shift == solver.score(long).shift
    told, wanted = (reflines.smooth(solver, length=each).gradient for each in (length, long))
    assert np.array_equal(told, wanted)


@pytest.mark.parametrize("width", [1e-300, 1e300])
def test_patterns_of_any_width_are_sampled(solver, width) -> None:
    image = np.random.default_rng(0).random((8, 8))
    target = reflines.pattern(solver, image=image, width=width, centre=[1e200, -1e200])
    assert np.isfinite(target.gradient).all()


@pytest.mark.parametrize("settings", [{"density": np.nan}, {"density_end": np.nan}, {"axis": [np.nan, 0.0]},
                                      {"direction": [np.inf, 1.0]}])
def test_settings_of_uniform_lines_that_are_no_numbers_are_refused(solver, settings) -> None:
    with pytest.raises(reflines.InvalidInput):
        reflines.uniform(solver, **settings)


def test_a_cage_of_two_milliards_of_vertices_is_refused() -> None:
    with pytest.raises(reflines.InvalidInput, match="2147483647 vertices, more than 8 million"):
        reflines.Subdivision([0, 4], [0, 1, 2, 3], vertices=2**31 - 1)


@pytest.mark.parametrize("place", [np.nan, np.inf, 1e300, -1e9])
def test_a_vertex_in_no_face_may_be_anywhere(place) -> None:
    """It is part of no size and no system: a solve is judged and a press is made as without it."""
    positions, triangles = panel(24)
    positions[300, 2] += 1e-3
    with_another = np.concatenate([positions, [[place, 0.0, place]]])
    results = []
    for V in (positions, with_another):
        solver = reflines.ShapeOptimizer(V, triangles, view_direction=VIEW, line_direction=LINE)
        assert solver.solve(reflines.smooth(solver, length=0.5)).converged
        with pytest.raises(reflines.SolverFailure):
            solver.solve(reflines.uniform(solver, density=1e6))
        pressed, _ = reflines.smooth_panel(V, triangles, view_direction=VIEW, line_direction=LINE, symmetric=False)
        results.append((solver.positions, pressed))
    for alone, beside in zip(*results, strict=True):
        assert np.array_equal(beside[-1], with_another[-1], equal_nan=True)
        assert np.array_equal(alone, beside[:-1])


@pytest.mark.parametrize("blur", [4e-300, 1e-160, 0.02])
def test_a_blur_of_next_to_nothing_is_none(solver, blur) -> None:
    image = np.random.default_rng(0).random((8, 8))
    target = reflines.pattern(solver, image=image, blur=blur)
    assert np.array_equal(target.gradient, reflines.pattern(solver, image=image).gradient)


def test_a_place_at_its_limit_may_be_the_origin() -> None:
    """Steps of one bit from zero never arrived: the positions took for ever."""
    view, limit = np.array([0.6, 0.0, 0.8]), 0.01
    plane, F = panel(16, jitter=0.0)
    flat = plane[:, :1] * [0.8, 0.0, -0.6] + plane[:, 1:2] * [0.0, 1.0, 0.0] - limit * view
    raised = flat + 5 * limit * np.exp(-(plane[:, :2] ** 2).sum(1) / 0.02)[:, None] * view
    solvers = [reflines.ShapeOptimizer(V, F, view_direction=view, line_direction=(0, 1, 0.1)) for V in (flat, raised)]
    assert solvers[0].solve(reflines.Target(solvers[1].field()), limit=limit).limited > 0
    positions = solvers[0].positions
    assert np.abs(positions[solvers[0].at_limit != 0]).min() < 1e-9
    assert np.linalg.norm(positions - flat, axis=1).max() <= limit


@pytest.mark.parametrize(("options", "said"), [
    ({"crease_angle": np.nan}, "crease angle"), ({"crease_angle": -1.0}, "crease angle"),
    ({"proximity": np.nan}, "proximity"), ({"proximity": np.inf}, "proximity"),
])
def test_options_that_are_no_numbers_are_refused(options: dict, said: str) -> None:
    with pytest.raises(reflines.InvalidInput, match=said):
        reflines.ShapeOptimizer(*panel(8), view_direction=VIEW, line_direction=LINE, **options)


@pytest.mark.parametrize(("options", "said"), [
    ({"normal": (0, 0, 0)}, "length 0"), ({"normal": (np.nan, 0, 0)}, "not a finite"),
    ({"point": (np.inf, 0, 0)}, "not a finite"), ({"tolerance": np.nan}, "tolerance"),
    ({"tolerance": -1.0}, "tolerance"),
])
def test_mirror_planes_that_are_none_are_refused(options: dict, said: str) -> None:
    with pytest.raises(reflines.InvalidInput, match=said):
        reflines.mirror_pairs(panel(4)[0], **{"point": (0, 0, 0), "normal": (1, 0, 0), "tolerance": 1e-6, **options})


def test_the_normal_of_a_mirror_plane_may_be_of_any_length() -> None:
    V = panel(4, jitter=0.0)[0]
    pairs = [reflines.mirror_pairs(V, point=(0, 0, 0), normal=(size, 0, 0), tolerance=1e-6)
             for size in (1.0, 1e200, 1e-200)]
    assert (pairs[0] >= 0).any() and np.array_equal(pairs[0], pairs[1]) and np.array_equal(pairs[0], pairs[2])


def test_a_normal_across_the_view_has_the_light_behind_and_no_normal_has_none() -> None:
    edge_on = np.array([[1.0, 0.0, 0.0], [0.0, -2.0, 0.0], [1e200, 1e200, 0.0]])
    assert np.array_equal(reflines.theta(edge_on, (0, 0, 1.0), (0, 1, 0)), np.full(3, np.pi))
    for bad in (0.0, np.nan):
        with pytest.raises(reflines.InvalidInput, match="2 normals"):
            reflines.theta(np.vstack([edge_on, np.full((2, 3), bad)]), (0, 0, 1.0), (0, 1, 0))


def test_triangles_whose_corners_coincide_have_unit_normals() -> None:
    V, F = panel(4)
    V[:] = V[0]
    normals = reflines.NormalFit(V, F).normals(V)
    assert np.allclose(np.linalg.norm(normals, axis=1), 1.0)
