"""What tools leave alone: fillets across a panel, lines from beyond a crease, and what a fixed border forbids."""
from collections.abc import Callable

import numpy as np
import pytest
import reflines
from sample_panels import panel
from test_builders import bump, warped

EDGE = 0.28125  # x of the fillet or the fold, a line of the grid


def optimizer(shape: Callable[[np.ndarray], np.ndarray], **options: object) -> reflines.ShapeOptimizer:
    positions, triangles = panel(64, jitter=0.0 if shape is fold else 0.2)
    positions[:, 2] += shape(positions[:, 0])
    return reflines.ShapeOptimizer(positions, triangles, view_direction=(0, 0, 1), line_direction=(0.1, 1.0, 0.1),
                                   **options)


def flat(x: np.ndarray) -> np.ndarray:
    return 0.0 * x


def fillet(x: np.ndarray) -> np.ndarray:
    return -0.8 * 0.03 * np.logaddexp(0.0, (x - EDGE) / 0.03)


def fold(x: np.ndarray) -> np.ndarray:
    return -0.8 * np.maximum(x - EDGE, 0.0)


def x_of(solver: reflines.ShapeOptimizer) -> np.ndarray:
    return solver.centers @ solver.frame[:2, 0]


TOOLS = {
    "uniform": lambda solver: reflines.uniform(solver, direction=(0.3, 1.0)),
    "turn": lambda solver: reflines.turn(solver, angle=0.3),
    "pattern": lambda solver: reflines.pattern(solver, image=np.eye(40), blur=8.0, strength=0.3, keep=0.5, width=2.0),
    "warp": lambda solver: warped(solver, lambda p: bump(p, 0.1))[0],
}


@pytest.mark.parametrize("build", TOOLS.values(), ids=TOOLS)
def test_every_tool_keeps_the_lines_of_a_fillet_bit_for_bit(build) -> None:
    solver = optimizer(fillet)
    x, target, field = x_of(solver), build(solver), solver.field()
    core, away = abs(x - EDGE) < 0.01, x < 0.1
    assert core.sum() > 100 and np.array_equal(target.gradient[core], field[core])
    assert (target.gradient[away] != field[away]).any()
    assert [note.kind for note in solver.region.notes] == ["features"]


def test_the_count_of_kept_faces_is_told_once_whatever_lengths_were_tried() -> None:
    solver = optimizer(fillet)
    for length in (0.1, 0.5, 5.0, 0.2):
        reflines.smooth(solver, length=length)
    assert [note.kind for note in solver.region.notes] == ["features"]


def test_a_warp_carries_no_lines_across_a_crease() -> None:
    """theta jumps by 1.3 there: drawn into the panel, the jump would ask for 60 radians a unit of length."""
    solver = optimizer(fold)
    target, outside = warped(solver, lambda p: bump(p, 0.2))
    counted = target.weight == 1.0
    assert 0 < outside == (~counted).sum() < len(counted) / 10
    assert np.linalg.norm(target.gradient - solver.field(), axis=1)[counted].max() < 2.0
    assert (target.gradient[counted] != solver.field()[counted]).any()


def test_values_that_a_fixed_border_forbids_do_not_fold_the_surface() -> None:
    """A border that stays keeps the mean slope, so theta cannot rise everywhere; nothing may be bent to hide that."""
    solver = optimizer(flat, border="fixed")
    wanted = solver.theta() + 0.2
    report = solver.solve(reflines.Target(solver.field(), theta=wanted))
    assert report.converged
    assert solver.score(0.3).shift < 0.05  # degrees: a fold makes tens of them


def test_a_pattern_by_value_moves_each_line_to_its_place() -> None:
    solver = optimizer(flat, border="free")
    ramp = np.broadcast_to(np.linspace(0.0, 1.0, 60), (60, 60))
    before = solver.theta()
    target = reflines.pattern(solver, image=ramp, strength=0.2, width=2.0, by_value=True)
    assert np.abs(target.theta - before - 0.2 * (x_of(solver) + 1.0) / 2.0).max() < 0.05 * 0.2
    solver.solve(target)
    assert np.abs(solver.theta() - target.theta).max() < 0.05 * np.abs(before - target.theta).max()


def test_the_residual_is_that_of_triangles_that_can_change() -> None:
    solver = optimizer(flat)
    changeable = solver.changeable
    target = reflines.Target(np.where(changeable[:, None], 0.9 * solver.field(), 100.0), changeable.astype(float))
    report = solver.solve(target)
    square, area = solver.residual(target) ** 2, solver.area * changeable
    assert 0 < (~changeable).sum() < len(changeable) / 5
    assert report.residual_rms == pytest.approx(np.sqrt(area @ square / area.sum()), rel=1e-9)
    assert report.residual_rms < np.sqrt(solver.area @ square / solver.area.sum()) / 50


def test_the_report_measures_what_the_target_gives_no_weight_and_other_targets_than_the_last() -> None:
    """The energy knows the squares of triangles with weight only, of the target and the heights it was evaluated at."""
    solver = optimizer(flat)
    weight = (np.arange(len(solver.area)) % 3).astype(float)
    rms = []
    for scale in (0.9, 0.8, 0.8):
        target = reflines.Target(scale * solver.field(), weight=weight)
        report = solver.solve(target)
        area = solver.area * solver.changeable
        assert report.residual_rms == pytest.approx(np.sqrt(area @ solver.residual(target) ** 2 / area.sum()), rel=1e-9)
        rms.append(report.residual_rms)
    assert rms[0] > 0
