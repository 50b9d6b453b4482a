"""Dabs of Fair Brush, on a mesh and on a cage: what is under the brush becomes smooth, all else keeps its bits, and the
limit holds.
"""
import sys
from dataclasses import replace

import bpy
import numpy as np
import pytest

import scenes

KINDS = ("mesh", "cage")
RADIUS = {"mesh": 0.3, "cage": 0.45}
CELLS = {"mesh": 48, "cage": 24}


def modules() -> object:
    return sys.modules["reflection_lines"]


def brushed(kind: str, *, cells: int = 0, height=scenes.rippled, mirror_x: bool = False, margin: int = 1) -> object:
    """A fresh panel under the brush."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    ob = scenes.panel(cells=cells or CELLS[kind], height=height)
    if kind == "cage":
        ob.modifiers.new("Subdivision", 'SUBSURF').levels = 2
    ob.data.use_mirror_x = mirror_x
    scenes.look_from_above(90.0 if mirror_x else 70.0)
    scenes.edit_inner(ob, cells or CELLS[kind], margin)
    return take(ob)


def take(ob: bpy.types.Object) -> object:
    addon = modules()
    patch = addon.read.gather.gather_patch(ob)
    view = addon.view.facing.read_patch_view(bpy.context.scene, patch)
    return addon.solver.brushed_cage.take_under_brush(patch, view, "clamped")


def brush(kind: str, **settings: float) -> object:
    return modules().solver.brush.Brush(**{"radius": RADIUS[kind], "strength": 1.0, "length": 0.5, "limit": 1.0,
                                           "families": 2, **settings})


def build(cage: object, **changed: object) -> object:
    """The optimizer of a whole cage as the brush has left it."""
    arguments = replace(cage.cage, V=cage.moved).build_arguments(cage.problem.is_symmetric)
    return modules().native.reflines.CageOptimizer(**{**arguments, **cage.problem.directions, **changed})


def roughness(kind: str, patch: object, family: int = 0) -> np.ndarray:
    """How strongly the lines turn from triangle to triangle near the middle, in the one light or the other."""
    optimizer = build(patch) if kind == "cage" else modules().native.reflines.ShapeOptimizer(
        patch.positions, patch.patch.F, view_direction=patch.view.view_direction,
        line_direction=patch.view.both_directions)
    near = np.linalg.norm(optimizer.centers, axis=1) < 0.5 * RADIUS[kind]
    field = optimizer.field(family)[near]
    return float(np.sqrt(np.mean(np.sum((field - field.mean(axis=0))**2, axis=1))))


def outside(kind: str, patch: object, place: tuple[float, float] = (0.0, 0.0)) -> np.ndarray:
    return np.linalg.norm(patch.xy - place, axis=1) >= RADIUS[kind]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("families", (1, 2))
def test_lines_under_the_brush_become_smoother_and_the_rest_keeps_its_bits(kind: str, families: int) -> None:
    patch = brushed(kind)
    before = [roughness(kind, patch, family) for family in (0, 1)]
    for _ in range(3):
        assert patch.dab(np.zeros(3), brush(kind, families=families))
    after = [roughness(kind, patch, family) for family in (0, 1)]
    assert after[0] < 0.65 * before[0] and after[1] < 0.65 * before[1]
    far = outside(kind, patch)
    assert (patch.move[far] == 0.0).all() and np.abs(patch.move).max() > 1e-4
    if kind == "cage":
        own = far[patch.patch.index]
        assert np.array_equal(patch.patch.to_object_space(patch.positions)[own],
                              patch.patch.round_start_positions()[own])


@pytest.mark.parametrize("kind", KINDS)
def test_dabs_add_up_and_less_strength_moves_less(kind: str) -> None:
    full, weak, still = (brushed(kind) for _ in range(3))
    full.dab(np.zeros(3), brush(kind, strength=0.4))
    once = np.abs(full.move).max()
    full.dab(np.zeros(3), brush(kind, strength=0.4))
    weak.dab(np.zeros(3), brush(kind, strength=0.1))
    still.dab(np.zeros(3), brush(kind, strength=0.0))
    assert np.abs(still.move).max() < 1e-9
    assert np.abs(weak.move).max() < 0.5 * once < once < np.abs(full.move).max()


@pytest.mark.parametrize("kind", KINDS)
def test_mirror_x_keeps_the_panel_symmetric(kind: str) -> None:
    patch = brushed(kind, mirror_x=True, height=lambda x, y: scenes.rippled(abs(x), y))
    assert patch.partner is not None
    for x in (0.5, 0.1):
        patch.dab(np.array([x, 0.1, 0.0]), brush(kind))
        assert np.array_equal(patch.move, patch.move[patch.partner]) and np.abs(patch.move).max() > 0.0
    new, own = patch.patch.to_object_space(patch.positions), patch.patch.mirror.partner
    assert np.array_equal(new[own] * np.float32([-1.0, 1.0, 1.0]) + 0.0, new + 0.0)


@pytest.mark.parametrize("kind", KINDS)
def test_a_brush_that_meets_no_free_vertex_says_so(kind: str) -> None:
    patch = brushed(kind)
    for place, radius in (((0.02, 0.03, 0.0), 0.01), ((9.0, 0.0, 0.0), 0.1), ((1.0, 1.0, 0.0), 0.1)):
        assert not patch.dab(np.array(place), brush(kind, radius=radius))
    assert (patch.move == 0.0).all()


def test_the_crossed_lines_count_where_they_are_wanted() -> None:
    single, both = brushed("mesh"), brushed("mesh")
    single.dab(np.zeros(3), brush("mesh", families=1))
    both.dab(np.zeros(3), brush("mesh", families=2))
    assert np.abs(both.move - single.move).max() > 0.05 * np.abs(both.move).max()


def test_the_seam_cannot_be_seen() -> None:
    """The slope of the move falls to nothing towards the circle."""
    patch = brushed("mesh", cells=96)
    patch.dab(np.zeros(3), brush("mesh"))
    apart = np.linalg.norm(patch.xy, axis=1)
    rim = (apart > 0.9 * RADIUS["mesh"]) & (apart < RADIUS["mesh"])
    assert np.abs(patch.move[rim]).max() < 0.06 * np.abs(patch.move).max()


def test_the_limit_holds() -> None:
    patch = brushed("mesh")
    for _ in range(4):
        patch.dab(np.zeros(3), brush("mesh", limit=5e-4))
    assert 4.9e-4 < np.abs(patch.move).max() <= 5e-4


def test_a_border_that_is_clamped_stays() -> None:
    patch = brushed("mesh")
    outermost = np.abs(patch.xy).max() - 1e-6
    patch.dab(np.array([0.8, 0.0, 0.0]), brush("mesh"))
    assert (patch.move[np.abs(patch.xy).max(axis=1) > outermost - 1.5 * 2.0 / CELLS["mesh"]] == 0.0).all()
    assert np.abs(patch.move).max() > 0.0


def test_a_window_is_the_surface_of_the_whole_cage() -> None:
    """Also beside creases, corners and the surface's own border."""
    ob = scenes.panel(cells=8)
    modifier = ob.modifiers.new("Subdivision", 'SUBSURF')
    modifier.levels = 2
    scenes.look_from_above()
    scenes.edit(ob)
    bpy.ops.mesh.select_all(action='SELECT')
    whole = take(ob).cage
    row = [9 * 4 + k for k in range(9)]
    whole = replace(whole, creases=np.column_stack([row[:-1], row[1:]]), sharpness=np.full(8, 1.5),
                    sharp_corners=np.array([20, 40]), corner_sharpness=np.array([10.0, 2.0]))
    for chosen in ([9], [27, 28, 35], [63, 62, 0], list(range(20, 50))):
        window = np.isin(np.arange(64), chosen)
        part, vertices = whole.cut_out(window)
        assert len(vertices) < 81 or len(chosen) > 20
        ours, theirs = (read_surface(cage, faces) for cage, faces in ((part, part.region), (whole, window)))
        assert ours.shape == theirs.shape and np.abs(ours - theirs).max() < 1e-12


def read_surface(cage: object, faces: np.ndarray) -> np.ndarray:
    """The corners of the refined faces on some of the cage's: #refined x 4 x 3."""
    refined = modules().native.reflines.Subdivision(**cage.build_topology_arguments(), vertices=len(cage.V))
    return refined.positions(cage.V)[refined.faces[faces[refined.face_parent]]]


@pytest.mark.parametrize("cells", [18, 36])
def test_a_dab_is_the_solve_of_the_whole_cage_with_the_rest_held(cells: int) -> None:
    """What the window leaves out would have changed nothing, so that no seam can be seen."""
    cage = brushed("cage", cells=cells)
    point = np.array([0.15, -0.1, 0.0])
    place = cage.frame[:2] @ point
    whole = build(cage, fixed=outside("cage", cage, place))
    target = modules().solver.brush.build_dab_target(whole, place, brush("cage"), 0)
    whole.solve([target], gradient_tolerance=1e-6)
    wanted = (whole.cage_positions - cage.cage.V) @ cage.frame[2]
    assert cage.dab(point, brush("cage", families=1))
    assert np.abs(cage.move - wanted).max() < 0.01 * np.abs(wanted).max()


def test_the_limit_of_a_cage_holds_and_the_rest_is_solved_on() -> None:
    free, held = brushed("cage"), brushed("cage")
    free.dab(np.zeros(3), brush("cage"))
    limit = 0.5 * np.abs(free.move).max()
    for _ in range(3):
        assert held.dab(np.zeros(3), brush("cage", limit=limit))
        assert np.abs(held.move).max() <= limit
    assert (np.abs(held.move) == limit).any()
    clipped = brushed("cage")
    clipped.move = np.clip(free.move, -limit, limit)
    rough = [roughness("cage", each) for each in (held, clipped)]
    assert rough[0] < 0.95 * rough[1], rough


def test_both_halves_below_a_mirror_modifier_move_alike() -> None:
    """Painted on the image the mesh's own half moves, and the seam stays closed and smooth."""
    grid = np.linspace(0.0, 1.0, 9)
    vertices = [(x, y, scenes.rippled(x, 2 * y - 1)) for y in grid for x in grid]
    moves = []
    for x in (0.3, -0.3):
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        ob = scenes.linked("Half", vertices, scenes.quads(9, 9))
        ob.modifiers.new("Mirror", 'MIRROR')
        ob.modifiers.new("Subdivision", 'SUBSURF').levels = 2
        scenes.look_from_above(90.0)
        scenes.edit(ob)
        bpy.ops.mesh.select_all(action='SELECT')
        cage = take(ob)
        assert len(cage.surface[0]) and cage.dab(np.array([x, 0.5, 0.0]), brush("cage"))
        moves.append((cage.positions - cage.patch.V)[:, 2])
    assert np.abs(moves[0]).max() > 1e-4 and np.abs(moves[0] - moves[1]).max() < 0.03 * np.abs(moves[0]).max()


def test_a_border_of_a_cage_that_is_clamped_stays() -> None:
    cage = brushed("cage", margin=3)
    held = ~build(cage).cage_free
    for x in (0.7, 0.0):
        cage.dab(np.array([x, 0.0, 0.0]), brush("cage"))
    assert (cage.move[held] == 0.0).all() and np.abs(cage.move).max() > 0.0
    assert (np.abs(cage.xy[:, 0]) < 0.75)[cage.move != 0.0].all()


def test_without_a_mouse_it_says_what_to_do() -> None:
    brushed("mesh")
    with pytest.raises(RuntimeError, match="paints with the mouse"):
        bpy.ops.reflines.fair_brush('EXEC_DEFAULT')
