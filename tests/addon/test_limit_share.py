"""Moves one way only, and limits by a vertex group, in all tools."""
import bpy
import numpy as np
import pytest

import scenes

TOOLS = {"press": ("smooth", {}), "smooth": ("smooth", {"length": 0.6}),
         "direction": ("direction", {"density": 1.2, "border": "clamped"}),
         "untwist": ("untwist", {"angle": 0.1, "border": "clamped"})}
LIMIT = 0.001


def solve(tool: str, ob: bpy.types.Object) -> np.ndarray:
    """Runs a tool; returns the moves along the view."""
    before = scenes.world(ob)
    name, settings = TOOLS[tool]
    assert getattr(bpy.ops.reflines, name)('EXEC_DEFAULT', True, limit=LIMIT, **settings) == {'FINISHED'}
    return (scenes.world(ob) - before)[:, 2]


@pytest.mark.parametrize("tool", TOOLS)
@pytest.mark.parametrize(("side", "sign"), [('OUTWARD', 1.0), ('INWARD', -1.0)])
def test_vertices_move_one_way_only(panel: bpy.types.Object, tool: str, side: str, sign: float) -> None:
    panel.reflection_lines.limit_side = side
    moves = sign * solve(tool, panel)
    assert moves.min() >= 0.0
    assert 1e-5 < moves.max() <= LIMIT * (1.0 + 1e-5)


@pytest.mark.parametrize("mode", ['EDIT', 'OBJECT'])
@pytest.mark.parametrize("tool", TOOLS)
def test_weights_are_shares_of_the_limit(panel: bpy.types.Object, tool: str, mode: str) -> None:
    assert bpy.ops.reflines.smooth('EXEC_DEFAULT', True, strength=0.0) == {'FINISHED'}  # stores the region
    scenes.object_mode()
    group = panel.vertex_groups.new(name="Freedom")
    V = scenes.positions(panel)
    weights = np.where(V[:, 0] < 0.0, 0.25, 0.0)
    for index, weight in enumerate(weights):
        group.add([index], float(weight), 'REPLACE')
    panel.reflection_lines.limit_group = "Freedom"
    if mode == 'EDIT':
        scenes.edit_inner(panel)
    moves = solve(tool, panel)
    assert not moves[weights == 0.0].any()
    assert 1e-5 < np.abs(moves).max() <= 0.25 * LIMIT * (1.0 + 1e-5)


def test_a_cage_is_pressed_one_way_and_refused_otherwise(panel: bpy.types.Object) -> None:
    panel.modifiers.new("Subdivision", 'SUBSURF').levels = 2
    panel.reflection_lines.limit_side = 'OUTWARD'
    assert solve("press", panel).min() >= 0.0
    before = scenes.fingerprint(panel)
    with pytest.raises(RuntimeError, match="choose Both Ways"):
        solve("direction", panel)
    assert scenes.fingerprint(panel) == before


def test_other_shares_make_another_result(panel: bpy.types.Object) -> None:
    panel.reflection_lines.limit_side = 'OUTWARD'
    assert solve("smooth", panel).max() > 0.0
    panel.reflection_lines.limit_side = 'INWARD'
    assert solve("smooth", panel).max() <= 0.0


@pytest.mark.parametrize(("weight", "said"), [(None, "no vertex group Freedom"), (0.0, "no vertex may move")])
def test_groups_that_are_missing_or_empty_are_told(panel: bpy.types.Object, weight: float | None, said: str) -> None:
    if weight is not None:
        panel.vertex_groups.new(name="Freedom")
    panel.reflection_lines.limit_group = "Freedom"
    before = scenes.fingerprint(panel)
    with pytest.raises(RuntimeError, match=said):
        solve("smooth", panel)
    assert scenes.fingerprint(panel) == before
