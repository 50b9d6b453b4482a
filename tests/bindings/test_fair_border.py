"""A press of Smooth with a faired border: flaws that run across the border go from the region, and the design stays."""
from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
import reflines
from test_curvature_border import CELLS, Panel
from test_reachable_targets import mesh

Array = np.ndarray
VIEW, LINE = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.3])
DIRECTIONS = {"view_direction": VIEW, "line_direction": LINE}
LENGTH = 0.1  # of the flaws


def normals(V: Array, F: Array) -> Array:
    n = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    return n / np.linalg.norm(n, axis=1, keepdims=True)


def design(diagonals: str) -> tuple[Array, Array]:
    """A crowned panel with a character line along x = 0.1, which crosses the border of the region."""
    V, F = mesh(diagonals, CELLS)
    V[:, 2] -= 0.02 * np.hypot(V[:, 0] - 0.1, 0.03)
    return V, F


def flaw(kind: str, V: Array) -> Array:
    """Heights (#V) of a flaw that runs across the border of the region at x, y = +-0.3125."""
    x, y = V[:, 0], V[:, 1]
    if kind == "noise":
        return 2e-4 * np.random.default_rng(5).standard_normal(len(V))
    if kind == "ripples":
        return 3e-4 * np.sin(2 * np.pi * x / 0.08 + 1.0) * np.cos(2 * np.pi * y / 0.08)
    return -8e-4 * np.exp(-((x + 0.3) ** 2 + (y - 0.05) ** 2) / 0.03**2)  # a dent


def press(panel: Panel, **options: object) -> tuple[Array, reflines.SmoothPanelReport]:
    """Positions of the whole panel after a press on its region, and the report."""
    settings = {"length": LENGTH, "around": panel.around, **options}
    positions, told = reflines.smooth_panel(panel.V[panel.used], panel.own, **DIRECTIONS, **settings)
    return panel.place(positions), told


def fair(panel: Panel, **options: object) -> tuple[Array, reflines.SmoothPanelReport]:
    return press(panel, fair_border=np.ones(len(panel.used), bool), **options)


def beside_border(panel: Panel) -> Array:
    """Triangles (#F) of the region that lie within one length of its border."""
    centre = np.abs(panel.V[panel.F].mean(axis=1)[:, :2]).max(axis=1)
    return panel.region & (centre > centre[panel.region].max() - LENGTH)


def error(panel: Panel, V: Array, wanted: Array, where: Array) -> float:
    """Degrees, root mean square: by how much the triangles' normals differ."""
    cosine = (normals(V, panel.F) * normals(wanted, panel.F)).sum(axis=1)[where]
    return float(np.degrees(np.sqrt(np.mean(np.arccos(np.clip(cosine, -1.0, 1.0)) ** 2))))


@pytest.mark.parametrize(("kind", "diagonals"), [
    ("noise", "random"), ("noise", "jittered"), ("ripples", "4-8"), ("ripples", "regular"), ("dent", "jittered"),
    ("dent", "4-8")])
def test_flaws_across_the_border_go_from_the_region(kind: str, diagonals: str) -> None:
    clean, F = design(diagonals)
    flawed = clean.copy()
    flawed[:, 2] += flaw(kind, clean)
    panel = Panel(flawed, F)
    where = beside_border(panel)
    before, *left = (error(panel, V, clean, where) for V in (flawed, press(panel)[0], fair(panel)[0]))
    print(f"{kind}, {diagonals}: of {before:.2f} degrees {left[0] / before:.2f} are left with a held border, "
          f"{left[1] / before:.2f} with a faired one")
    if kind == "noise":  # of the others the held border's rim is no worse: the surface is smoothed up to it
        assert left[1] < 0.75 * left[0]
    assert left[1] < 1.2 * left[0] and left[1] < 1.05 * before


@pytest.mark.parametrize("diagonals", ["random", "4-8"])
def test_a_clean_panel_keeps_its_border(diagonals: str) -> None:
    panel = Panel(*design(diagonals))
    V, told = fair(panel)
    assert error(panel, V, panel.V, panel.region) < 0.15 and np.abs(V - panel.V).max() < 0.02 * told.limit


def test_faces_beyond_the_reach_do_not_count() -> None:
    """The press takes in two lengths of the faces beside; what lies further away makes no difference to any bit."""
    clean, F = design("jittered")
    clean[:, 2] += flaw("noise", clean)
    other, length = clean.copy(), 0.06
    away = np.abs(clean[:, :2]).max(axis=1) > 15 / CELLS + 2 * length + 1.5 / CELLS
    other[away, 2] += 0.1
    assert away.any()
    panels = Panel(clean, F), Panel(other, F)
    one, two = (fair(panel, length=length)[0][panel.used] for panel in panels)
    assert np.array_equal(one, two) and not np.array_equal(one, clean[panels[0].used])


def test_vertices_without_the_mark_are_held() -> None:
    clean, F = design("jittered")
    clean[:, 2] += flaw("noise", clean)
    panel = Panel(clean, F)
    before = panel.V[panel.used]
    marked = before[:, 0] < 0.0
    solver = panel.build("clamped")
    positions = reflines.smooth_panel(before, panel.own, **DIRECTIONS, length=LENGTH, around=panel.around,
                                      fair_border=marked)[0]
    moved = (positions != before).any(axis=1)
    held = ~solver.free
    assert not moved[held & ~marked].any()
    assert moved[held & marked].mean() > 0.9 and moved[solver.free].mean() > 0.9


def test_the_surroundings_bend_with_the_border_and_keep_their_vertices() -> None:
    """The function returns the region alone; around it no vertex is its to move."""
    clean, F = design("regular")
    clean[:, 2] += flaw("noise", clean)
    panel = Panel(clean, F)
    before = [each.copy() for each in (panel.V, *panel.around)]
    V, _ = fair(panel)
    others = np.setdiff1d(np.arange(len(V)), panel.used)
    assert np.array_equal(V[others], before[0][others])
    assert all(np.array_equal(*pair) for pair in zip(before, (panel.V, *panel.around), strict=True))


def test_without_faces_beside_the_border_is_held_and_it_is_said() -> None:
    clean, F = design("regular")
    clean[:, 2] += flaw("ripples", clean)
    panel = Panel(clean, F)
    V, told = fair(panel, around=None)
    assert np.array_equal(V, press(panel)[0])
    assert told.notes[0].kind == "not_faired"


def test_mirror_images_move_alike() -> None:
    clean, F = mesh("regular", CELLS)
    clean[:, 2] += flaw("noise", clean)
    side = CELLS + 1
    image = (np.arange(side) * side)[:, None] + np.arange(side)[::-1]
    clean[:, 2] = 0.5 * (clean[:, 2] + clean[image.ravel(), 2])
    panel = Panel(clean, F)
    number = np.full(len(clean), -1)
    number[panel.used] = np.arange(len(panel.used))
    partner = number[image.ravel()[panel.used]]
    before = panel.V[panel.used]
    positions = reflines.smooth_panel(before, panel.own, view_direction=VIEW, line_direction=(0.0, 1.0, 0.0),
                                      length=LENGTH, around=panel.around, partner=partner,
                                      fair_border=np.ones(len(before), bool))[0]
    move = positions[:, 2] - before[:, 2]
    assert np.abs(move).max() > 1e-5
    assert np.array_equal(positions[:, 2], positions[partner, 2])


def test_the_report_is_of_the_region_alone() -> None:
    clean, F = design("jittered")
    clean[:, 2] += flaw("noise", clean)
    panel = Panel(clean, F)
    V, told = fair(panel)
    move = (V - panel.V)[panel.used, 2]
    assert len(told.line_deviation) == len(panel.own)
    assert told.largest_move == pytest.approx(np.abs(move).max(), rel=1e-9)
    assert told.score_after[0].shift < told.score_before[0].shift


def test_faces_beside_that_would_turn_are_refused() -> None:
    """The first vertices outside come so near that a move of the border turns their faces over."""
    clean, F = design("regular")
    border = np.flatnonzero(np.isclose(clean[:, 0], 15 / CELLS))
    outside = border + 1
    clean[outside, 0] = clean[border, 0] + 2e-4
    clean[:, 2] += flaw("noise", clean)
    clean[outside, 2] = clean[border, 2]
    panel = Panel(clean, F, (clean[F, 0] <= 15 / CELLS + 1e-6).all(axis=1) & Panel(clean, F).region)
    with pytest.raises(reflines.SolverFailure, match="Faces at the border would have turned"):
        fair(panel)


def test_a_mask_of_another_size_is_refused() -> None:
    panel = Panel(*design("regular"))
    with pytest.raises(reflines.InvalidInput, match="fair border mask has 3 entries"):
        press(panel, fair_border=np.ones(3, bool))


def noisy_panel() -> Panel:
    clean, F = design("jittered")
    clean[:, 2] += flaw("noise", clean)
    return Panel(clean, F)


@cache
def free_moves(border: Callable) -> Array:
    """The moves that a press of the noisy panel makes without a limit."""
    panel = noisy_panel()
    return (border(panel, limit=np.inf)[0] - panel.V)[panel.used, 2]


@pytest.mark.parametrize(("strength", "side"), [(0.0, (-1.0, 1.0)), (0.3, (-0.5, 0.1)), (1.0, (0.0, 1.0)),
                                                (1.0, (-0.5, 0.1))])
def test_the_vertices_that_the_limit_holds_back_are_counted(strength: float, side: tuple[float, float]) -> None:
    """Those that go beyond it where there is none, whatever share of the move is made, and it is said."""
    panel, limit = noisy_panel(), 1e-4
    share = np.tile(side, (len(panel.used), 1))
    for border in (press, fair):
        free = free_moves(border)
        _, told = border(panel, limit=limit, limit_range=share, strength=strength)
        beyond = int(((free < limit * side[0]) | (free > limit * side[1])).sum())
        assert beyond > 100 and told.limited == beyond
        assert [note.count for note in told.notes if note.kind == "limited"] == [told.limited]


def with_faces(panel: Panel, faces: Array, vertices: Array | None = None) -> Panel:
    """The panel with more faces beside its region, and more vertices beside it."""
    V, F = panel.around
    panel.around = V if vertices is None else np.vstack([V, vertices]), np.vstack([F, faces])
    return panel


def border_edge(panel: Panel) -> tuple[int, int]:
    """An edge of one triangle of the region."""
    edges = np.sort(panel.own[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, count = np.unique(edges, axis=0, return_counts=True)
    return tuple(edges[count == 1][5])


def spoil(kind: str, panel: Panel) -> Panel:
    own, count = len(panel.used), len(panel.used) + len(panel.around[0])
    a, b = border_edge(panel)
    away = panel.around[1][(panel.around[1] >= own).all(axis=1)]
    if kind == "zero area":
        return with_faces(panel, [[a, a, b]])
    if kind == "third face at the border":
        return with_faces(panel, [[a, b, count]], [[0.3, 0.0, 0.2]])
    if kind == "third face beside":
        return with_faces(panel, [[*away[0, :2], count]], [[0.4, 0.0, 0.2]])
    if kind == "doubled":
        return with_faces(panel, away[:3])
    if kind == "doubled and loose":
        return with_faces(panel, np.tile(count + np.arange(3), (2, 1)), panel.V[panel.own[0]] + [0.0, 0.0, 0.05])
    assert kind == "pole"
    turn = np.linspace(0.0, np.pi, 2100)
    fan = np.column_stack([np.cos(turn), np.sin(turn), np.zeros(len(turn))]) * 0.01 + [0.0, 0.0, 0.3]
    rim = count + 1 + np.arange(len(turn) - 1)
    return with_faces(panel, np.column_stack([np.full(len(rim), count), rim, rim + 1]), [[0.0, 0.0, 0.3], *fan])


@cache
def faired_noise() -> Array:
    return fair(noisy_panel())[0]


FAULTS = ["zero area", "third face at the border", "third face beside", "doubled", "doubled and loose", "pole"]


@pytest.mark.parametrize("kind", FAULTS)
def test_faces_that_cannot_be_used_are_left_out(kind: str) -> None:
    """As if they were not there, but for those that meet them at an edge."""
    panel = spoil(kind, noisy_panel())
    V, told = fair(panel)
    if "third" not in kind and kind != "doubled":
        assert np.array_equal(V, faired_noise()) and not told.notes
    border = ~panel.build("fixed").free
    held = border & (V == panel.V)[panel.used].all(axis=1)
    assert told.applied and held.sum() < 0.05 * border.sum()
    assert [note.count for note in told.notes if note.kind == "partly_faired"] == ([held.sum()] if held.any() else [])


def test_faces_that_are_near_but_not_joined_do_not_count() -> None:
    clean, F = design("jittered")
    clean[:, 2] += flaw("noise", clean)
    panel = Panel(clean, F)
    others, faces = panel.around
    panel.around = others, faces[(faces >= len(panel.used)).all(axis=1)]
    result, told = fair(panel)
    assert np.array_equal(result, press(panel)[0])
    assert [note.kind for note in told.notes] == ["not_faired"]


def test_where_a_border_is_partly_without_faces_it_is_said() -> None:
    clean, F = design("jittered")
    clean[:, 2] += flaw("noise", clean)
    panel = Panel(clean, F, clean[F].mean(axis=1)[:, 0] > 0.0)
    V, told = fair(panel)
    border = ~panel.build("fixed").free
    held = border & (V == panel.V)[panel.used].all(axis=1)
    outer = np.abs(panel.V[panel.used, :2]).max(axis=1) > 0.5 - 1e-9
    assert held[outer].all() and not held.all()
    assert (told.notes[-1].kind, told.notes[-1].count) == ("partly_faired", held.sum())


def test_the_note_on_the_limit_comes_first_and_the_refusal_too() -> None:
    """A caller that shows the first one by itself shows the right one."""
    clean, F = design("regular")
    clean[:, 2] += flaw("ripples", clean)
    _, told = fair(Panel(clean, F), around=None, limit=1e-5)
    assert [note.kind for note in told.notes[:2]] == ["limited", "not_faired"]


def test_where_no_border_vertex_is_marked_the_press_is_the_ordinary_one() -> None:
    clean, F = design("jittered")
    clean[:, 2] += flaw("noise", clean)
    panel = Panel(clean, F)
    inner = panel.build("clamped").free
    result = press(panel, border="curvature", fair_border=inner)
    ordinary = press(panel, border="curvature")
    assert np.array_equal(result[0], ordinary[0]) and result[1].notes == ordinary[1].notes
