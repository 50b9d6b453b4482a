"""The step along shut lines that a press makes even: straight from one end to the other, and constant around a flap."""
import numpy as np
import pytest
import reflines
from test_follow_border import DIRECTIONS, REACH, Array, cut, cylinder
from test_joint_cages import cage_panel, dent, leave_off, look_at, make_cage, make_mesh
from test_joint_cages import press as press_panels
from test_joint_smoother import change, halves, press
from test_shut_lines import Mesh, check, join

DEEP = 8e-4  # of the waves


def wave(V: Array, depth: float = DEEP) -> Array:
    """Heights of waves along the cut, which fade across it and towards its ends."""
    near = np.clip(1.0 - np.abs(V[:, 0] - cut(V[:, 1])) / 0.4, 0.0, 1.0)
    return depth * near**2 * (3.0 - 2.0 * near) * np.cos(4.0 * np.pi * V[:, 1]) * np.exp(-(V[:, 1] / 0.35) ** 4)


def wavy(gap: float) -> tuple[Mesh, Mesh]:
    left, (W, G) = halves(gap)
    return left, (change(W, wave(W)), G)


def uneven(left: Mesh, right: Mesh) -> float:
    """By how much the flush that Check measures varies."""
    return float(np.ptp(check(left, right).after.flush))


def healed(results: list, meshes: tuple[Mesh, ...]) -> list[Mesh]:
    return [(V, F) for (V, _), (_, F) in zip(results, meshes, strict=True)]


@pytest.mark.parametrize("gap", [0.0, 0.008])
def test_a_flush_that_varies_by_waves_becomes_constant_and_lines_run_on(gap: float) -> None:
    meshes = wavy(gap)
    results = press(*meshes, even_flush=True)
    after = healed(results, meshes)
    assert uneven(*meshes) > 1.7 * DEEP and uneven(*after) < 0.05 * DEEP
    assert uneven(*healed(press(*meshes), meshes)) > 1.7 * DEEP
    assert all(told.flush_before == pytest.approx(DEEP, rel=0.1) and told.flush_after < 0.03 * DEEP
               for _, told in results)
    before, found = check(*meshes).after, check(*after).after
    assert before.line_offset.max() > 20.0 and found.line_offset.max() < 2.0
    for (moved, told), (start, _) in zip(results, meshes, strict=True):
        assert np.array_equal(moved[:, :2], start[:, :2])  # the gap is as wide as it was, seen along the view
        assert 0.4 * DEEP < told.largest_move < 0.6 * DEEP  # each side makes half


@pytest.mark.parametrize("heights", [lambda y: 0.0 * y, lambda y: DEEP + 0.0 * y, lambda y: DEEP * y],
                         ids=["flush", "a step", "a taper"])
def test_a_shut_line_whose_flush_is_even_is_pressed_as_without(heights: object) -> None:
    left, (W, G) = halves(0.004)
    meshes = left, (change(W, heights(W[:, 1])), G)
    for (one, told), (other, _) in zip(press(*meshes, even_flush=True), press(*meshes), strict=True):
        assert np.array_equal(one, other) and told.flush_after < 1e-5


def ring(inner: float, outer: float, cells: int, around: int) -> Mesh:
    """A ring of the cylinder about its highest point."""
    turn, r = np.meshgrid(np.linspace(0.0, 2.0 * np.pi, around, endpoint=False), np.linspace(inner, outer, cells + 1))
    i, j = (each.ravel() for each in np.meshgrid(np.arange(cells) * around, np.arange(around), indexing="ij"))
    a, b = i + j, i + (j + 1) % around
    F = np.concatenate([np.column_stack([a, a + around, b]), np.column_stack([b, a + around, b + around])])
    x, y = (r * np.cos(turn)).ravel(), (r * np.sin(turn)).ravel()
    return np.column_stack([x, y, cylinder(x, y)]), F


def test_the_step_of_a_round_flap_becomes_the_same_all_around() -> None:
    """Its mean: no corner says what it should be."""
    (V, F), body = ring(0.05, 0.246, 12, 80), ring(0.25, 0.5, 14, 90)
    flap = change(V, DEEP * (0.5 + np.cos(3.0 * np.arctan2(V[:, 1], V[:, 0]))) * (np.hypot(*V[:, :2].T) / 0.246) ** 3)
    meshes = (flap, F), body
    results = press(*meshes, even_flush=True)
    flush = check(*healed(results, meshes)).after.flush
    assert uneven(*meshes) > 1.9 * DEEP and np.ptp(flush) < 0.1 * DEEP
    assert np.mean(flush) == pytest.approx(-0.5 * DEEP, rel=0.1)
    assert all(told.flush_before > 0.9 * DEEP and told.flush_after < 0.05 * DEEP for _, told in results)


def test_the_strength_is_a_share_and_the_limit_holds() -> None:
    meshes = wavy(0.004)
    half = press(*meshes, even_flush=True, strength=0.5)
    assert uneven(*healed(half, meshes)) == pytest.approx(0.5 * uneven(*meshes), rel=0.05)
    assert all(told.flush_after == pytest.approx(0.5 * told.flush_before, rel=0.05) for _, told in half)
    for (V, told), (start, _) in zip(press(*meshes, even_flush=True, limit=1e-4), meshes, strict=True):
        assert np.abs(V - start).max() <= 1e-4 and told.flush_after < told.flush_before


def test_parts_of_one_mesh_across_a_gap() -> None:
    left, right = wavy(0.004)
    V, F = join(left, right)
    found = []
    for even in (False, True):
        positions, told = reflines.smooth_panel(V, F, **DIRECTIONS, parts_gap=0.01, even_flush=even)
        one, other = np.split(positions, [len(left[0])])
        found.append(uneven((one, left[1]), (other, right[1])))
    assert found[0] > 1.7 * DEEP and found[1] < 0.05 * DEEP
    assert told.flush_before == pytest.approx(DEEP, rel=0.1) and told.flush_after < 0.03 * DEEP


def test_a_dent_that_a_cage_has_shallower_goes_from_the_mesh_across() -> None:
    """The step between both varies by what the cage smooths: to keep it the mesh would have to keep its dent."""
    (V, F), cage = make_mesh(-1), make_cage(1, share=0.7)
    quads = reflines.Subdivision(cage[1], cage[2], vertices=len(cage[0]), level=2, boundary="preserve_corners").faces
    G = np.concatenate([quads[:, :3], quads[:, [0, 2, 3]]])
    mesh = V + dent(V), F
    for even in (False, True):
        (left, told), (moved, other) = press_panels(
            reflines.JointPanel(*mesh, **DIRECTIONS, margin=REACH, even_flush=even),
            cage_panel(cage, even_flush=even))
        after = look_at((moved, *cage[1:]))
        varies, deepest = uneven((left, F), (after, G)), max(leave_off(left), leave_off(after))
        if not even:
            assert varies > 7e-4 and deepest > 5e-4
    assert varies < 1e-4 and deepest < 1.2e-4 and max(told.healed.worst_after, other.healed.worst_after) < 0.45
    assert told.flush_before > 7e-4 and told.flush_after < 1e-4


def test_the_order_of_the_panels_does_not_matter() -> None:
    meshes = wavy(0.004)
    one, other = press(*meshes, even_flush=True), press(*meshes[::-1], even_flush=True)[::-1]
    assert all(np.array_equal(a, b) for (a, _), (b, _) in zip(one, other, strict=True))
