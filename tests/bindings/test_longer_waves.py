"""Waves longer than flaws may be design: a press leaves them and says so; the size of flaws is a setting."""
import sys
from pathlib import Path

import numpy as np
import pytest
import reflines
from sample_panels import grid
from test_sample_lengths import measure_error

from bench.restoration import JUDGE, load_judge, load_panel

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "blend_samples"))
import panel_shapes  # noqa: E402

DOOR = {"view_direction": (1.0, -0.10, 0.22), "line_direction": (0.0, 1.0, 0.0)}
Array = np.ndarray


def make_door() -> tuple[Array, Array, Array]:
    """Wavy V, clean V and F of the sample's selection: its waves are one to two automatic lengths long."""
    V, quads, clean = panel_shapes.door()
    quads = quads[panel_shapes.door_inside(V[:, 1], V[:, 2])[quads].all(axis=1)]
    used, F = np.unique(np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]), return_inverse=True)
    straight = np.column_stack([clean, V[:, 1:]])
    return V[used], straight[used], F.reshape(-1, 3).astype(np.int32)


def test_the_doors_waves_go() -> None:
    """0.55 of them is left; 0.77 was where the whole door was judged at once."""
    V, clean, F = make_door()
    before = measure_error(V, clean, F)
    pressed, report = reflines.smooth_panel(V, F, **DOOR)
    again, larger = reflines.smooth_panel(V, F, **DOOR, flaw_size=2.0)
    assert larger.length == pytest.approx(2.0 * report.length) and larger.limit == pytest.approx(2.0 * report.limit)
    print(f"{before:.3f}, {measure_error(pressed, clean, F):.3f}, {measure_error(again, clean, F):.3f} degrees")
    assert max(measure_error(P, clean, F) for P in (pressed, again)) < 0.62 * before


@pytest.mark.parametrize("flaw_size", [1.0, 2.0])
def test_the_clean_door_is_left_and_nothing_is_told(flaw_size: float) -> None:
    _, clean, F = make_door()
    pressed, report = reflines.smooth_panel(clean, F, **DOOR, flaw_size=flaw_size)
    assert not report.longer_waves
    assert measure_error(pressed, clean, F) < 0.03


def waves_of(lengths: float, V: Array, window: Array, axes: Array) -> Array:
    """Heights (#V) of six plane waves about so many automatic lengths long, as high as 1.5 per mille of that."""
    length = lengths * np.linalg.norm(np.ptp(V, axis=0)) / 14.0
    random = np.random.default_rng(5)
    height = np.zeros(len(V))
    for angle, phase, share in random.uniform(size=(6, 3)):
        wave = length * 1.25**(2.0 * share - 1.0)
        along = V @ (np.cos(2.0 * np.pi * angle) * axes[0] + np.sin(2.0 * np.pi * angle) * axes[1])
        height += wave * np.sin(2.0 * np.pi * (along / wave + phase))
    height *= window
    return 1.5e-3 * length * height / np.sqrt((height**2).mean())


def test_waves_on_a_plain_panel_are_told() -> None:
    """Of flutes it is told, too: nothing but the artist's purpose tells these from waves."""
    plane, F = grid(48, jitter=0.2)
    x, y = 1.4 * (plane[:, 0] - 0.5), plane[:, 1] - 0.5
    crown = np.column_stack([x, y, -0.15 * x**2 - 0.1 * y**2])
    seen = {"view_direction": (0.0, 0.0, 1.0), "line_direction": (1.0, 0.2, 0.1)}
    shapes = {"plain": 0.0 * x,
              "waves": waves_of(3.0, crown, np.minimum(1.0, 8.0 * np.minimum(0.7 - abs(x), 0.5 - abs(y))), np.eye(3))}
    told = {name: reflines.smooth_panel(crown + np.outer(height, [0.0, 0.0, 1.0]), F, **seen)[1].longer_waves
            for name, height in shapes.items()}
    assert told == {"plain": False, "waves": True}


@pytest.mark.skipif(not JUDGE.is_file(), reason="the judge's panels are not here")
@pytest.mark.parametrize("name", ["drivaer_hood", "drivaer_hood_wide", "subaru_roof"])
def test_of_real_panels_only_wavy_ones_are_told(name: str) -> None:
    """Not clean ones, nor those with noise, ripples or dents; and twice the size makes nothing told of worse."""
    judge = load_judge()
    V, F, view, light = load_panel(name)
    seen = {"view_direction": view, "line_direction": light}
    diagonal = np.linalg.norm(np.ptp(V, axis=0))
    flaws = [2.0 * judge.heights(kind, V, F, view, diagonal) for kind in ("dents", "ripple", "noise")]
    for height in (np.zeros(len(V)), *flaws):
        assert not reflines.smooth_panel(V + np.outer(height, view), F, **seen)[1].longer_waves
    right = judge.unit(np.cross(view, [0.3, 0.5, 0.7]))
    inside = np.clip((judge.border_distance(V, F, diagonal) - 0.02) / 0.08, 0.0, 1.0)
    wavy = V + np.outer(waves_of(3.0, V, inside**2 * (3.0 - 2.0 * inside), [right, np.cross(view, right)]), view)
    once, report = reflines.smooth_panel(wavy, F, **seen)
    assert report.longer_waves
    larger, _ = reflines.smooth_panel(wavy, F, **seen, flaw_size=2.0)
    left = [measure_error(P, V, F) / measure_error(wavy, V, F) for P in (once, larger)]
    print(f"{name}: {left[0]:.2f}, with twice the size {left[1]:.2f}")
    assert left[1] < 1.1 * left[0]


@pytest.mark.parametrize("flaw_size", [0.0, -1.0, np.nan, np.inf])
def test_a_size_that_is_none_is_refused(flaw_size: float) -> None:
    _, clean, F = make_door()
    with pytest.raises(reflines.InvalidInput, match="flaw size"):
        reflines.smooth_panel(clean, F, **DOOR, flaw_size=flaw_size)
