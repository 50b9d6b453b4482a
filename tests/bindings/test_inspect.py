"""reflines.inspect_panel: planted dents are the first spots, clean panels have none, and what hides a panel counts."""
import threading
import time
from collections.abc import Callable

import numpy as np
import pytest
import real_meshes
import reflines
import sample_panels

UP = np.array([0.0, 0.0, 1.0])
LIGHT = np.array([np.cos(0.35), 0.0, np.sin(0.35)])
VIEWS, LINES = reflines.walk_around(UP, LIGHT, (0, 1, 0))
FLOOR = 0.08      # degrees: no place of a clean panel deviates by more
HEIGHT = 1e-4     # metres, of the dents
RADIUS = 0.03
Array = np.ndarray
Panel = tuple[Array, Array]


def lift(height: Callable[[Array, Array], Array], cells: int = 100) -> Panel:
    """A panel of 1.9 m each way."""
    plane, F = sample_panels.grid(cells)
    x, y = 1.9 * (plane.T - 0.5)
    return np.stack([x, y, height(x, y)], axis=1), F


def dome(x: Array, y: Array) -> Array:
    return -0.15 * x * x - 0.1 * y * y - 0.03 * x**3


def with_character_line(x: Array, y: Array) -> Array:
    return dome(x, y) - 0.0018 * np.logaddexp(0.0, (y - 0.25 * x - 0.3) / 0.03)


def with_fillet(x: Array, y: Array) -> Array:
    return dome(x, y) - 0.014 * np.logaddexp(0.0, (x - 0.6) / 0.04)


def real_outline() -> Panel:
    """The triangles of a real bonnet, 2.5 cm long, with heights of the polynomial of degree 6 nearest to it."""
    V, F = real_meshes.triangles("drivaer_hood.obj")
    x, y, z = (V - V.mean(axis=0)).T
    terms = np.stack([x**i * y**j for i in range(7) for j in range(7 - i)], axis=1)
    return np.stack([x, y, terms @ np.linalg.lstsq(terms, z, rcond=None)[0]], axis=1), F


PANELS = {"jittered": lambda: sample_panels.panel(100), "dome": lambda: lift(dome),
          "character line": lambda: lift(with_character_line), "real outline": real_outline}


def find_border(V: Array, F: Array) -> Array:
    edges = np.sort(np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]]), axis=1)
    edges, count = np.unique(edges, axis=0, return_counts=True)
    return V[edges[count == 1].ravel()]


def plant(V: Array, F: Array, count: int, *, seed: int = 1) -> tuple[Array, list[Array], list[float]]:
    """Plants bumps and dents by turns along z, three radii from the border and six from each other; returns the
    positions, places and heights.
    """
    border, places, heights, dented = find_border(V, F), [], [], V.copy()
    for place in V[np.random.default_rng(seed).permutation(np.unique(F))]:
        near = min(np.linalg.norm(border - place, axis=1).min() / 3.0,
                   *(np.linalg.norm(place - other) / 6.0 for other in places), np.inf)
        if near < RADIUS or len(places) == count:
            continue
        places.append(place)
        heights.append(HEIGHT if len(places) % 2 else -HEIGHT)
        dented[:, 2] += heights[-1] * np.exp(-((V - place)[:, :2]**2).sum(axis=1) / RADIUS**2)
    return dented, places, heights


@pytest.mark.parametrize("name", PANELS)
def test_planted_dents_are_the_first_spots(name: str) -> None:
    """Five of 0.1 mm a panel, with their height within 30 %."""
    V, F = PANELS[name]()
    dented, places, heights = plant(V, F, 5)
    found = reflines.inspect_panel(dented, F, VIEWS, LINES)
    assert len(found.spots) >= 5
    for place, height in zip(places, heights, strict=True):
        spot = min(found.spots[:5], key=lambda each: np.linalg.norm(each.place - place))  # noqa: B023
        assert np.linalg.norm(spot.place - place) < 1.5 * RADIUS
        assert spot.height == pytest.approx(height, rel=0.3)
        assert spot.degrees == pytest.approx(found.deviation[spot.triangles].max()) and spot.degrees > 2 * FLOOR
        assert RADIUS < spot.size < 6 * RADIUS
    degrees = [spot.degrees for spot in found.spots]
    assert degrees == sorted(degrees, reverse=True)


@pytest.mark.parametrize("make", [*PANELS.values(), lambda: lift(with_fillet)], ids=[*PANELS, "fillet"])
def test_clean_panels_have_no_spots(make: Callable[[], Panel]) -> None:
    found = reflines.inspect_panel(*make(), VIEWS, LINES, noise_floor=FLOOR)
    assert not found.spots and found.deviation.max() < FLOOR


def test_maps_are_the_differences_of_theta_by_normals() -> None:
    """From every view in every light; the mean of the squares over a disk, as at its middle where they vary slowly."""
    V, F = lift(dome)
    dented = V.copy()
    dented[:, 2] += 1e-3 * np.exp(-(V[:, :2]**2).sum(axis=1) / 0.06**2)
    found = reflines.inspect_panel(dented, F, VIEWS, LINES, maps=True)
    normals = [sample_panels.find_normals(P, F) for P in (dented, V)]
    centers = V[F].mean(axis=1)
    near = np.argsort(np.linalg.norm(centers[:, :2] - (0.06, 0.03), axis=1))[:20]
    for k, view in enumerate(VIEWS):
        for n, line in enumerate(LINES):
            off = np.degrees(np.subtract(*(sample_panels.theta_of(n, view, line) for n in normals)))**2
            for t in near:
                distance = np.linalg.norm((centers - centers[t])[:, :2], axis=1)
                weight = np.maximum(1.0 - (distance / (0.35 * found.length))**2, 0.0)
                expected = np.sqrt(weight @ off / weight.sum())
                assert found.maps[t, 8 * k + n] == pytest.approx(expected, rel=0.15, abs=0.02)
    assert np.allclose(found.maps.max(axis=1), found.deviation, atol=1e-5)


def test_only_the_pairs_that_are_asked_for_are_looked_at() -> None:
    V, F = lift(dome)
    dented, *_ = plant(V, F, 1)
    pairs = np.zeros((5, 8), dtype=bool)
    pairs[1, 2] = pairs[4, 6] = True
    of_all = reflines.inspect_panel(dented, F, VIEWS, LINES, maps=True)
    found = reflines.inspect_panel(dented, F, VIEWS, LINES, maps=True, pairs=pairs)
    asked = pairs.ravel()
    assert np.allclose(found.maps[:, asked], of_all.maps[:, asked], atol=1e-5) and not found.maps[:, ~asked].any()
    assert np.allclose(found.deviation, of_all.maps[:, asked].max(axis=1), atol=1e-5)
    assert found.mean == pytest.approx(of_all.degrees[pairs].mean())
    assert {(spot.view, spot.light) for spot in found.spots} <= {(1, 2), (4, 6)}
    with pytest.raises(reflines.InvalidInput, match="need a row for each of the 5 views"):
        reflines.inspect_panel(dented, F, VIEWS, LINES, pairs=pairs[:2])
    along = np.array([UP, LIGHT])  # a light along the first view, which is not asked for there
    assert reflines.inspect_panel(dented, F, VIEWS[:2], along, pairs=[[False, True], [True, True]]).mean > 0.0


def test_what_hides_the_panel_takes_its_weight() -> None:
    """A plate over its left half, seen from above and from its left."""
    V, F = lift(dome, 40)
    plate = np.array([[-2.0, -2.0, 0.5], [0.0, -2.0, 0.5], [0.0, 2.0, 0.5], [-2.0, 2.0, 0.5]])
    views = np.array([UP, [0.6, 0.0, 0.8], [0.0, 0.0, -1.0]])
    free = reflines.inspect_panel(V, F, views[:2], LINES)
    hidden = reflines.inspect_panel(V, F, views, LINES, blockers=(plate, np.array([[0, 1, 2], [0, 2, 3]])))
    assert free.seen == pytest.approx([1.0, 1.0], abs=0.02)
    shifted = 0.5 * 0.6 / 0.8  # of the plate's shadow, to the left: at height 0
    assert hidden.seen[0] == pytest.approx(0.5, abs=0.02)
    assert hidden.seen[1] == pytest.approx(0.5 + shifted / 1.9, abs=0.05)
    assert hidden.seen[2] == 0.0 and not hidden.degrees[2].any()


def test_a_fold_hides_what_lies_behind_it() -> None:
    """From the side a ridge hides the valley behind it, which faces the viewer."""
    V, F = lift(lambda x, y: 0.15 * np.cos(7.0 * x) + 0.0 * y)
    low = np.array([[1.0, 0.0, 0.35]])
    view = np.concatenate([UP[None], low / np.linalg.norm(low)])
    found = reflines.inspect_panel(V, F, view, np.array([[0.0, 1.0, 0.0]]))
    slopes = -0.15 * 7.0 * np.sin(7.0 * V[F].mean(axis=1)[:, 0])
    facing = (view[1, 2] - view[1, 0] * slopes) / np.hypot(1.0, slopes) > 0.35
    assert found.seen[1] < 0.75 * facing.mean()


def test_a_walk_around_sees_every_light() -> None:
    for tilt in (0.02, 0.3, 0.8, 1.5):
        views, lines = reflines.walk_around((0, 0, 2), (np.sin(tilt), 0, np.cos(tilt)), (0, 3, 1))
        assert views.shape == (5, 3) and lines.shape == (8, 3)
        assert np.allclose(views[0], UP) and np.allclose(lines[0], (np.sin(tilt), 0, np.cos(tilt)))
        assert views[1, 0] < 0 < views[2, 0] and views[4, 1] < 0 < views[3, 1]
        assert np.abs(views @ lines.T).max() <= np.cos(0.49 * tilt)
        reflines.inspect_panel(*sample_panels.panel(8), views, lines)


def test_it_can_be_cancelled() -> None:
    V, F = lift(dome, 150)
    progress = reflines.Progress()
    timer = threading.Timer(0.2, progress.cancel)
    timer.start()
    start = time.monotonic()
    with pytest.raises(reflines.Cancelled):
        reflines.inspect_panel(V, F, VIEWS, LINES, progress=progress)
    assert time.monotonic() - start < 2.0


@pytest.mark.parametrize(("change", "said"), [
    ({"views": np.zeros((0, 3))}, "no view direction"),
    ({"lines": np.zeros((1, 3))}, "light 0 has no length"),
    ({"lines": np.array([[1.0, 0, 0], [0, 0, -3.0]])}, "Light 1 is parallel to view 0"),
    ({"noise_floor": float("nan")}, "noise floor"),
    ({"length": 0.0}, "length"),
    ({"flaw_size": float("inf")}, "flaw size"),
    ({"most_spots": -1}, "number of spots"),
    ({"blockers": (np.full((3, 3), np.nan), np.array([[0, 1, 2]]))}, "no finite number"),
    ({"blockers": (np.zeros((3, 3)), np.array([[0, 1, 3]]))}, "3"),
    ({"F": np.zeros((0, 3), int)}, "no face"),
])
def test_unusable_input_gets_one_sentence(change: dict, said: str) -> None:
    V, F = sample_panels.panel(8)
    arguments = {"V": V, "F": F, "views": VIEWS, "lines": LINES} | change
    with pytest.raises(reflines.InvalidInput, match=said) as error:
        reflines.inspect_panel(**arguments)
    assert "\n" not in str(error.value)
