"""Moves one way only, and limits by a vertex group, in all tools."""
import bpy
import numpy as np
import pytest

import scenes
from reflection_lines import native

TOOLS = {"press": ("smooth", {}), "smooth": ("smooth", {"length": 0.6}),
         "direction": ("direction", {"density": 1.2, "border": "clamped"}),
         "turn": ("direction", {"angle": 0.1, "border": "clamped"})}
LIMIT = 0.001
ROUNDING = 5e-7  # of single precision, in which Blender keeps and subdivides positions of up to 1


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


def subdivided(ob: bpy.types.Object) -> np.ndarray:
    """Returns the z coordinates of the modifier's surface, in world space."""
    evaluated = ob.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return scenes.world(evaluated)[:, 2]


def solve_cage(tool: str, ob: bpy.types.Object) -> np.ndarray:
    """Runs a tool; returns the moves along the view of the surface that the modifier makes."""
    scenes.object_mode()
    before = subdivided(ob)
    scenes.edit_inner(ob)
    solve(tool, ob)
    scenes.object_mode()
    return subdivided(ob) - before


@pytest.fixture
def cage(panel: bpy.types.Object) -> bpy.types.Object:
    panel.modifiers.new("Subdivision", 'SUBSURF').levels = 2
    return panel


@pytest.mark.parametrize("tool", TOOLS)
@pytest.mark.parametrize(("side", "sign"), [('OUTWARD', 1.0), ('INWARD', -1.0)])
def test_the_surface_of_a_cage_moves_one_way_only(cage: bpy.types.Object, tool: str, side: str, sign: float) -> None:
    cage.reflection_lines.limit_side = side
    moves = sign * solve_cage(tool, cage)
    assert moves.min() >= -ROUNDING
    assert 1e-5 < moves.max() <= LIMIT + ROUNDING


def test_large_cages_are_refused_one_way(cage: bpy.types.Object, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(native.reflines, "MOST_BOUNDED_CAGE", 100)
    cage.reflection_lines.limit_side = 'OUTWARD'
    scenes.edit_inner(cage)
    before = scenes.fingerprint(cage)
    with pytest.raises(RuntimeError, match="up to 100 vertices of a cage.*choose Both Ways"):
        solve("direction", cage)
    assert scenes.fingerprint(cage) == before


@pytest.mark.parametrize("tool", TOOLS)
def test_weights_of_a_cage_hold_its_surface(cage: bpy.types.Object, tool: str) -> None:
    scenes.object_mode()
    group = cage.vertex_groups.new(name="Freedom")
    before = scenes.positions(cage)
    side = before[:, 0]
    for index, x in enumerate(side):
        group.add([index], 0.25 if x < 0.0 else 0.0, 'REPLACE')
    cage.reflection_lines.limit_group = "Freedom"
    moves = solve_cage(tool, cage)
    assert 1e-5 < np.abs(moves).max() <= 0.25 * LIMIT + ROUNDING
    far = side > 0.5  # where all weights that the surface depends on are 0
    assert np.array_equal(scenes.positions(cage)[far], before[far])


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
    with scenes.refused(panel, said):
        solve("smooth", panel)
