"""Dabs of Fair Brush: what is under the brush becomes smooth, all else keeps its bits, and the limit holds."""
import sys

import bpy
import numpy as np
import pytest

import scenes

RADIUS = 0.3
CELLS = 48


def modules() -> object:
    return sys.modules["reflection_lines"]


def brushed(*, cells: int = CELLS, height=scenes.rippled, mirror_x: bool = False) -> object:
    """A patch under the brush, of a fresh panel."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    ob = scenes.panel(cells=cells, height=height)
    ob.data.use_mirror_x = mirror_x
    scenes.look_from_above(90.0 if mirror_x else 70.0)
    scenes.edit_inner(ob, cells)
    addon = modules()
    patch = addon.read.gather.gather_patch(ob)
    view = addon.view.facing.read_patch_view(bpy.context.scene, patch)
    return modules().solver.brush.BrushedPatch(patch, view, "clamped")


def brush(**settings: float) -> object:
    return modules().solver.brush.Brush(**{"radius": RADIUS, "strength": 1.0, "length": 0.5, "limit": 1.0,
                                           "families": 2, **settings})


def roughness(patch: object, family: int = 0) -> np.ndarray:
    """How strongly the lines turn from vertex to vertex near the middle, in the one light or the other."""
    view, native = patch.view, modules().native.reflines
    optimizer = native.ShapeOptimizer(patch.positions, patch.patch.F, view_direction=view.view_direction,
                                      line_direction=view.both_directions)
    near = np.linalg.norm(optimizer.centers, axis=1) < 0.5 * RADIUS
    field = optimizer.field(family)[near]
    return float(np.sqrt(np.mean(np.sum((field - field.mean(axis=0))**2, axis=1))))


@pytest.mark.parametrize("families", (1, 2))
def test_lines_under_the_brush_become_smoother_and_the_rest_keeps_its_bits(families: int) -> None:
    patch = brushed()
    before = [roughness(patch, family) for family in (0, 1)]
    for _ in range(3):
        assert patch.dab(np.zeros(3), brush(families=families))
    after = [roughness(patch, family) for family in (0, 1)]
    assert after[0] < 0.65 * before[0] and after[1] < 0.65 * before[1]
    far = np.linalg.norm(patch.xy, axis=1) >= RADIUS
    assert (patch.move[far] == 0.0).all() and np.abs(patch.move).max() > 1e-4


def test_the_crossed_lines_count_where_they_are_wanted() -> None:
    single, both = brushed(), brushed()
    single.dab(np.zeros(3), brush(families=1))
    both.dab(np.zeros(3), brush(families=2))
    assert np.abs(both.move - single.move).max() > 0.05 * np.abs(both.move).max()


def test_the_seam_cannot_be_seen() -> None:
    """The slope of the move falls to nothing towards the circle."""
    patch = brushed(cells=96)
    patch.dab(np.zeros(3), brush())
    apart = np.linalg.norm(patch.xy, axis=1)
    rim = (apart > 0.9 * RADIUS) & (apart < RADIUS)
    assert np.abs(patch.move[rim]).max() < 0.06 * np.abs(patch.move).max()


def test_dabs_add_up_and_less_strength_moves_less() -> None:
    full, weak = brushed(), brushed()
    full.dab(np.zeros(3), brush(strength=0.4))
    once = np.abs(full.move).max()
    full.dab(np.zeros(3), brush(strength=0.4))
    weak.dab(np.zeros(3), brush(strength=0.1))
    assert np.abs(weak.move).max() < 0.5 * once < once < np.abs(full.move).max()


def test_a_dab_of_strength_0_moves_nothing() -> None:
    patch = brushed()
    patch.dab(np.zeros(3), brush(strength=0.0))
    assert np.abs(patch.move).max() < 1e-9


def test_the_limit_holds() -> None:
    patch = brushed()
    for _ in range(4):
        patch.dab(np.zeros(3), brush(limit=5e-4))
    assert 4.9e-4 < np.abs(patch.move).max() <= 5e-4


def test_mirror_x_keeps_the_panel_symmetric() -> None:
    patch = brushed(mirror_x=True, height=lambda x, y: scenes.rippled(abs(x), y))
    assert patch.partner is not None
    for x in (0.5, 0.1):
        patch.dab(np.array([x, 0.1, 0.0]), brush())
        assert np.array_equal(patch.move, patch.move[patch.partner]) and np.abs(patch.move).max() > 0.0
    new = patch.patch.to_object_space(patch.positions)
    assert np.array_equal(new[patch.partner] * np.float32([-1.0, 1.0, 1.0]) + 0.0, new + 0.0)


def test_a_border_that_is_clamped_stays() -> None:
    patch = brushed()
    outermost = np.abs(patch.xy).max() - 1e-6
    patch.dab(np.array([0.8, 0.0, 0.0]), brush())
    assert (patch.move[np.abs(patch.xy).max(axis=1) > outermost - 1.5 * 2.0 / CELLS] == 0.0).all()
    assert np.abs(patch.move).max() > 0.0


def test_a_brush_that_meets_no_free_vertex_says_so() -> None:
    patch = brushed()
    assert not patch.dab(np.zeros(3), brush(radius=0.01)) and not patch.dab(np.array([9.0, 0.0, 0.0]), brush())
    assert (patch.move == 0.0).all()


def test_without_a_mouse_it_says_what_to_do() -> None:
    brushed()
    with pytest.raises(RuntimeError, match="paints with the mouse"):
        bpy.ops.reflines.fair_brush('EXEC_DEFAULT')
