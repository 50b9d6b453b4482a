"""A press whose border continues the curvature of the surroundings does no more harm than one with a clamped border."""
from functools import cache

import numpy as np
import pytest
import reflines
from test_curvature_border import CELLS, HALF, LINES, VIEW, Panel, flawed
from test_reachable_targets import mesh

Array = np.ndarray
CONTINUED = ["curvature", "flow"]
DIAGONALS = ["random", "jittered"]
LESS_EVEN, SEEN = 1.01, 0.05  # share and degrees, both, by which a light may end less even


def shape(kind: str, V: Array) -> Array:
    result = flawed("dent" if kind == "dent" else "ripples", V)
    x, y = V[:, 0], V[:, 1]
    if kind == "hem":  # within reach of the border at x = 0.3125
        result[:, 2] -= np.maximum(x - 0.24, 0.0)
    elif kind == "hem across":  # it runs into the border
        result[:, 2] -= np.maximum(x + 0.3 * y - 0.2, 0.0)
    elif kind == "fillet":
        result[:, 2] -= 0.018 * np.log1p(np.exp((x - 0.24) / 0.012))
    elif kind == "steep dent":
        result = flawed("dent", V) * [1, 1, 5]
    elif kind == "bulge":  # position and tangent of the region are those around, but not its curvature
        share = np.clip(1.0 - (V[:, :2] / (HALF - 1.0 / CELLS)) ** 2, 0.0, None).prod(axis=1)
        result[:, 2] = V[:, 2] + 0.003 * share**2
    return result


def is_said(report: reflines.SmoothPanelReport) -> bool:
    return any(note.kind.startswith("continuing_") for note in report.notes)


def make_panel(kind: str, diagonals: str) -> Panel:
    V, F = mesh(diagonals, CELLS)
    return Panel(shape(kind, V), F)


@cache
def press(kind: str, diagonals: str, border: str) -> tuple[Array, reflines.SmoothPanelReport]:
    panel = make_panel(kind, diagonals)
    return reflines.smooth_panel(panel.V[panel.used], panel.own, border=border, around=panel.around,
                                 view_direction=VIEW, line_direction=LINES[0])


@pytest.mark.parametrize("diagonals", DIAGONALS)
@pytest.mark.parametrize("kind", ["hem", "hem across", "fillet", "bulge"])
@pytest.mark.parametrize("border", CONTINUED)
def test_a_strong_bend_of_the_region_is_not_bent_to_the_surroundings(border: str, kind: str, diagonals: str) -> None:
    """A hem moved to the limit, ten times as far as with a clamped border; a fillet nine times."""
    panel = make_panel(kind, diagonals)
    moves = {each: np.abs(press(kind, diagonals, each)[0] - panel.V[panel.used]).max() for each in ("clamped", border)}
    print(f"{kind}, {diagonals}: {moves}")
    assert moves["clamped"] > 0.0
    assert moves[border] < 3.001 * moves["clamped"]


@pytest.mark.parametrize("diagonals", DIAGONALS)
@pytest.mark.parametrize("kind", ["ripples", "dent", "hem", "hem across", "fillet", "bulge"])
@pytest.mark.parametrize("border", CONTINUED)
def test_no_light_ends_less_even_or_it_is_clamped_to_the_bit(border: str, kind: str, diagonals: str) -> None:
    clamped, (positions, told) = press(kind, diagonals, "clamped"), press(kind, diagonals, border)
    if is_said(told):
        assert np.array_equal(positions, clamped[0])
    for late, early in zip(told.score_after, clamped[1].score_after, strict=True):
        assert late.shift <= max(LESS_EVEN * early.shift, early.shift + SEEN)
    for late, early in zip(told.unevenness_after, clamped[1].unevenness_after, strict=True):
        assert late <= max(LESS_EVEN * early, early + SEEN)


@pytest.mark.parametrize("diagonals", DIAGONALS)
@pytest.mark.parametrize("border", CONTINUED)
def test_what_is_less_even_is_clamped_and_said_and_what_is_good_is_kept(border: str, diagonals: str) -> None:
    assert is_said(press("steep dent", "jittered", border)[1])
    positions, told = press("dent", diagonals, border)
    assert not is_said(told) and not np.array_equal(positions, press("dent", diagonals, "clamped")[0])
