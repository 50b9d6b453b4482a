"""What drags of cages need: few samples that speak for the surface, and solves that begin where the last ended."""
import numpy as np
import pytest
import reflines
from sample_cages import LINE, VIEW, dented, hood, optimizer


def triangulated(cage: tuple) -> tuple:
    V, _, corners = cage
    quads = corners.reshape(-1, 4)
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    return V, np.arange(0, triangles.size + 1, 3), triangles.ravel()


@pytest.mark.parametrize("scheme", ["catmull_clark", "loop"])
@pytest.mark.parametrize("tool", [lambda start: reflines.smooth(start, length=0.3),
                                  lambda start: reflines.uniform(start, density=1.1)])
def test_a_few_triangles_speak_for_all(tool, scheme: str) -> None:
    cage = dented(hood(20, 18), VIEW, LINE)
    cage = triangulated(cage) if scheme == "loop" else cage
    whole, sparse = (optimizer(cage, level=3, scheme=scheme, sparse=some) for some in (False, True))
    target = tool(whole)
    moves = []
    for solver in (whole, sparse):
        assert solver.solve(target).converged
        moves.append(solver.cage_positions - cage[0])
    assert not np.array_equal(*moves)
    assert np.abs(moves[0] - moves[1]).max() < 0.015 * np.abs(moves[0]).max()


def test_coarse_surfaces_have_none_to_leave_out() -> None:
    cage = dented(hood(), VIEW, LINE)
    results = []
    for sparse in (False, True):
        solver = optimizer(cage, level=2, sparse=sparse)
        solver.solve(reflines.smooth(solver, length=0.4))
        results.append(solver.cage_positions)
    assert np.array_equal(*results)


@pytest.mark.parametrize("level", [2, 3, 4])
def test_a_solve_that_begins_at_the_minimum_makes_no_factor(level: int) -> None:
    """Rounding of the heights hides what is left of the gradient, the more the finer the surface is."""
    solver = optimizer(dented(hood(), VIEW, LINE), level=level)
    target = reflines.smooth(solver, length=0.4)
    reports = [solver.solve(target) for _ in range(3)]
    assert all(report.converged for report in reports)
    assert [report.factorizations for report in reports] == [1, 0, 0]
    assert reports[-1].termination == "already_optimal"
