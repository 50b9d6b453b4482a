"""The measures by which `./run figures blender_tools` compares Smooth Lines with Blender's own tools."""
import meshes
import numpy as np
import pytest

pytest.importorskip("matplotlib", reason="figures are drawn where the project is built, not where it is used")

from figures import compare_shapes, stripe_sheet  # noqa: E402  (they import it)

CELLS = 24
VIEW, LIGHT = np.array([0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0])


def build_shapes(bend: float = 0.0) -> compare_shapes.Shapes:
    """A sheet over [-1, 1]^2, bent across the light; the region are the triangles right of x = 0."""
    points, F = meshes.regular(CELLS)
    x, y = 2.0 * points.T
    V = np.column_stack([x, y, -0.5 * bend * x**2])
    return {"F": F, "region": x[F].mean(axis=1) > 0.0, "view": VIEW, "light": LIGHT, "count": np.array(20),
            "clean": V, "flawed": V}


def turn(V: np.ndarray, degrees: float) -> np.ndarray:
    """Turns points about the y axis, where x > 0."""
    angle = np.radians(degrees)
    turned = V @ np.array([[np.cos(angle), 0, -np.sin(angle)], [0, 1, 0], [np.sin(angle), 0, np.cos(angle)]])
    return np.where(V[:, :1] > 0.0, turned, V)


def add_shape(shapes: compare_shapes.Shapes, V: np.ndarray) -> compare_shapes.Shapes:
    """Adds a shape whose vertices lie nearest to their own places on the clean sheet."""
    F, vertices = shapes["F"], np.unique(shapes["F"][shapes["region"]])
    triangle = np.array([np.flatnonzero((vertex == F).any(axis=1))[0] for vertex in vertices])
    return shapes | {"flawed_tool": V, "flawed_tool_place": shapes["clean"][vertices], "flawed_tool_triangle": triangle}


def test_lines_turn_twice_as_far_as_the_surface_in_the_light_that_it_turns_about_and_not_in_the_other() -> None:
    plane = build_shapes()
    tilted = add_shape(plane, turn(plane["clean"] + [1e-3, 0, 0], 1.0))
    tilted["region"] = tilted["clean"][tilted["F"]][:, :, 0].min(axis=1) > 0.1
    tilted = add_shape(tilted, tilted["flawed_tool"])
    given, crossed = compare_shapes.measure_line_error(tilted, "flawed_tool")
    assert given == pytest.approx(2.0, rel=1e-6) and crossed < 1e-6


def test_the_clean_panel_is_off_itself_by_nothing() -> None:
    shapes = build_shapes(bend=0.3)
    assert max(compare_shapes.measure_line_error(add_shape(shapes, shapes["clean"]), "flawed_tool")) < 1e-6


def test_weights_give_the_place_back() -> None:
    rng = np.random.default_rng(1)
    corners, weights = rng.standard_normal((50, 3, 3)), rng.dirichlet(np.ones(3), 50)
    places = (corners * weights[:, :, None]).sum(axis=1)
    assert compare_shapes.weigh_corners(places, corners) == pytest.approx(weights)


def test_a_fold_along_the_border_is_its_kink_and_a_sheet_that_rises_moves_its_border() -> None:
    shapes = build_shapes()
    folded = shapes | {"flawed_tool": turn(shapes["clean"], 2.0)}
    border = compare_shapes.measure_border(compare_shapes.compare(folded, "flawed", "flawed_tool"))
    assert border["border_kink"] == pytest.approx(2.0, rel=0.02) and border["border_moved"] < 1e-9
    raised = shapes | {"flawed_tool": shapes["clean"] + [0, 0, 0.01]}
    assert compare_shapes.measure_border(compare_shapes.compare(raised, "flawed", "flawed_tool")) == pytest.approx(
        {"border_kink": 0.0, "border_moved": 0.01}, abs=1e-6)


def test_a_tool_that_moves_other_vertices_is_refused() -> None:
    shapes = build_shapes()
    compare_shapes.refuse_moves_outside(shapes | {"flawed_tool": turn(shapes["clean"], 2.0)}, "flawed_tool")
    with pytest.raises(ValueError, match="outside"):
        compare_shapes.refuse_moves_outside(shapes | {"flawed_tool": shapes["clean"] + [0, 0, 0.01]}, "flawed_tool")


@pytest.mark.parametrize(("wobble", "repeats"), [(1.0, 5), (0.5, 10), (0.01, 10)])
def test_repeats_are_the_fewest_that_reach_the_wobble_or_all(wobble: float, repeats: int,
                                                             monkeypatch: pytest.MonkeyPatch) -> None:
    shapes = {f"flawed_vertices_{name}": np.zeros(0) for name in ("10", "1", "5", "5_place")}
    monkeypatch.setattr(compare_shapes, "score", lambda _, name: dict.fromkeys(
        ("wobble", "wobble_crossed"), {"1": 1.5, "5": 1.0, "10": 0.2}[name.rpartition("_")[2]]))
    assert compare_shapes.choose_repeats(shapes, wobble) == repeats


def test_a_picture_shows_theta_and_hides_what_lies_behind() -> None:
    """Theta of a sheet bent across the light is twice the angle of its normal: known at every pixel."""
    shapes = build_shapes(bend=0.5)
    picture = stripe_sheet.draw_stripes(shapes, "clean")
    middle, columns = picture[len(picture) // 2], np.arange(picture.shape[1]) + 0.5
    at = stripe_sheet.project(shapes, "clean")[0][:, 0]
    slope, start = np.polyfit(at, shapes["clean"][:, 0], 1)
    theta = 2.0 * np.arctan(0.5 * (slope * columns + start))
    expected = 0.5 + 0.5 * np.tanh(stripe_sheet.SHARPNESS * np.cos(20 * theta))
    inside = (columns > 15) & (columns < at.max() - 5)
    assert np.abs(middle - expected)[inside].mean() < 0.03
    behind = turn(shapes["clean"], 20.0) - [0.0, 0.0, 2.0]
    both = shapes | {"F": np.concatenate([shapes["F"], shapes["F"] + len(behind)]),
                     "region": np.concatenate([shapes["region"], np.zeros(len(shapes["F"]), bool)]),
                     "clean": np.concatenate([shapes["clean"], behind])}
    assert (stripe_sheet.draw_stripes(both, "clean")[:, 20:-20] == picture[:, 20:-20]).all()
