"""Even Flush in Blender: the step along a shut line of two objects runs straight, and is told before and after."""
import bpy
import numpy as np
import pytest

import scenes
from test_across_gap import MATRICES, flush, half, start, start_several
from test_shut_lines import check

GAP, DEEP = 0.008, 0.002


def wavy(x: float, y: float) -> float:
    """The panel with waves along its side x = 0."""
    near = np.clip(1.0 - abs(x) / 0.8, 0.0, 1.0)
    return scenes.crown(x, y) + DEEP * near**2 * (3.0 - 2.0 * near) * np.cos(2.0 * np.pi * y) * np.exp(-(y / 0.7) ** 4)


def start_wavy(kind: str = "plain") -> tuple[bpy.types.Object, bpy.types.Object]:
    right = half("Right", 0.5 * GAP, 1.0, wavy, 17, MATRICES[kind])
    left = half("Left", -1.0, -0.5 * GAP, scenes.crown)
    start_several(left, right)
    return left, right


def measure(ob: bpy.types.Object) -> float:
    """By how much the flush that Check tells varies."""
    bpy.context.view_layer.objects.active = ob
    table = check(ob)
    return table["highest flush of shut line 1"].after - table["lowest flush of shut line 1"].after


@pytest.mark.parametrize("kind", list(MATRICES))
def test_the_flush_of_two_objects_becomes_even_and_is_told(kind: str) -> None:
    left, right = start_wavy(kind)
    before, checked = (scenes.world(left), scenes.world(right)), measure(left)
    assert scenes.smooth(border='follow', even_flush=True) == {'FINISHED'}
    after = scenes.world(left), scenes.world(right)
    assert np.ptp(flush(*before, GAP)) > 1.7 * DEEP and np.ptp(flush(*after, GAP)) < 0.1 * DEEP
    assert all(np.allclose(*each, atol=1e-6) for each in zip((V[:, :2] for V in before), (V[:, :2] for V in after),
                                                             strict=True))
    assert "Flush uneven by 1.8 mm \u2192 " in left.reflection_lines.report.notes
    assert measure(left) < 0.1 * DEEP < 1.7 * DEEP < checked


def test_switched_off_the_flush_stays() -> None:
    objects = start_wavy()
    before = scenes.world(objects[0]), scenes.world(objects[1])
    assert scenes.smooth(border='follow') == {'FINISHED'}
    after = scenes.world(objects[0]), scenes.world(objects[1])
    assert np.abs(flush(*after, GAP) - flush(*before, GAP)).max() < 0.02 * DEEP
    assert "Flush" not in objects[0].reflection_lines.report.notes


def test_without_another_panel_that_moves_it_says_so_and_does_nothing_more() -> None:
    found = []
    for even in (False, True):
        bpy.ops.wm.read_homefile(use_empty=True)
        half("Right", 0.5 * GAP, 1.0, wavy, 17)
        left = half("Left", -1.0, -0.5 * GAP, scenes.crown)
        start(left)
        assert scenes.smooth(border='follow', even_flush=even) == {'FINISHED'}
        found.append(scenes.world(left))
        assert ("no shut line lies between panels that move" in left.reflection_lines.report.notes) == even
    assert np.array_equal(*found)
