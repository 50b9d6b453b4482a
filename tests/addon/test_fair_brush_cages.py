"""Dabs of Fair Brush on a cage: its surface becomes smooth under the brush, vertices outside keep their bits."""
import sys
from dataclasses import replace

import bpy
import numpy as np
import pytest

import scenes

RADIUS = 0.45
CELLS = 24


def modules() -> object:
    return sys.modules["reflection_lines"]


def brushed(*, cells: int = CELLS, height=scenes.rippled, mirror_x: bool = False, margin: int = 1) -> object:
    """The cage of a fresh panel under the brush."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    ob = scenes.panel(cells=cells, height=height)
    ob.modifiers.new("Subdivision", 'SUBSURF').levels = 2
    ob.data.use_mirror_x = mirror_x
    scenes.look_from_above(90.0 if mirror_x else 70.0)
    scenes.edit_inner(ob, cells, margin)
    return take(ob)


def take(ob: bpy.types.Object, border: str = "clamped") -> object:
    addon = modules()
    patch = addon.read.gather.gather_patch(ob)
    view = addon.view.facing.read_patch_view(bpy.context.scene, patch)
    return modules().solver.brushed_cage.take_under_brush(patch, view, border)


def brush(**settings: float) -> object:
    return modules().solver.brush.Brush(**{"radius": RADIUS, "strength": 1.0, "length": 0.5, "limit": 1.0,
                                           "families": 2, **settings})


def build(cage: object, **changed: object) -> object:
    """The optimizer of a whole cage as the brush has left it."""
    arguments = replace(cage.cage, V=cage.moved).build_arguments(cage.problem.is_symmetric)
    return modules().native.reflines.CageOptimizer(**{**arguments, **cage.problem.directions, **changed})


def roughness(cage: object, family: int) -> float:
    """How strongly the lines of the surface turn from triangle to triangle near the middle."""
    surface = build(cage)
    near = np.linalg.norm(surface.centers, axis=1) < 0.5 * RADIUS
    field = surface.field(family)[near]
    return float(np.sqrt(np.mean(np.sum((field - field.mean(axis=0))**2, axis=1))))


def outside(cage: object, place: tuple[float, float] = (0.0, 0.0)) -> np.ndarray:
    return np.linalg.norm(cage.xy - place, axis=1) >= RADIUS


@pytest.mark.parametrize("families", (1, 2))
def test_lines_under_the_brush_become_smoother_and_vertices_outside_keep_their_bits(families: int) -> None:
    cage = brushed()
    before = [roughness(cage, family) for family in (0, 1)]
    for _ in range(3):
        assert cage.dab(np.zeros(3), brush(families=families))
    after = [roughness(cage, family) for family in (0, 1)]
    assert after[0] < 0.65 * before[0] and after[1] < 0.65 * before[1]
    assert (cage.move[outside(cage)] == 0.0).all() and np.abs(cage.move).max() > 1e-4
    assert np.array_equal(cage.patch.to_object_space(cage.positions)[outside(cage)[cage.patch.index]],
                          cage.patch.round_start_positions()[outside(cage)[cage.patch.index]])


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


@pytest.mark.parametrize(("cells", "bound"), [(18, 0.01), (36, 0.01)])
def test_a_dab_is_the_solve_of_the_whole_cage_with_the_rest_held(cells: int, bound: float) -> None:
    """What the window leaves out would have changed nothing, so that no seam can be seen."""
    cage = brushed(cells=cells)
    point = np.array([0.15, -0.1, 0.0])
    place = cage.frame[:2] @ point
    whole = build(cage, fixed=outside(cage, place))
    target = modules().solver.brush.build_dab_target(whole, place, brush(), 0)
    whole.solve([target], gradient_tolerance=1e-6)
    wanted = (whole.cage_positions - cage.cage.V) @ cage.frame[2]
    assert cage.dab(point, brush(families=1))
    assert np.abs(cage.move - wanted).max() < bound * np.abs(wanted).max()


def test_dabs_add_up_and_less_strength_moves_less() -> None:
    full, weak = brushed(), brushed()
    full.dab(np.zeros(3), brush(strength=0.4))
    once = np.abs(full.move).max()
    full.dab(np.zeros(3), brush(strength=0.4))
    weak.dab(np.zeros(3), brush(strength=0.1))
    assert np.abs(weak.move).max() < 0.5 * once < once < np.abs(full.move).max()
    still = brushed()
    still.dab(np.zeros(3), brush(strength=0.0))
    assert np.abs(still.move).max() < 1e-9


def test_the_limit_holds_and_the_rest_is_solved_on() -> None:
    free, held = brushed(), brushed()
    free.dab(np.zeros(3), brush())
    limit = 0.5 * np.abs(free.move).max()
    for _ in range(3):
        assert held.dab(np.zeros(3), brush(limit=limit))
        assert np.abs(held.move).max() <= limit
    assert (np.abs(held.move) == limit).any()
    clipped = brushed()
    clipped.move = np.clip(free.move, -limit, limit)
    assert roughness(held, 0) < 0.95 * roughness(clipped, 0), (roughness(held, 0), roughness(clipped, 0))


def test_mirror_x_keeps_the_cage_symmetric() -> None:
    cage = brushed(mirror_x=True, height=lambda x, y: scenes.rippled(abs(x), y))
    assert cage.partner is not None
    for x in (0.5, 0.1):
        cage.dab(np.array([x, 0.1, 0.0]), brush())
        assert np.array_equal(cage.move, cage.move[cage.partner]) and np.abs(cage.move).max() > 0.0
    new, own = cage.patch.to_object_space(cage.positions), cage.patch.mirror.partner
    assert np.array_equal(new[own] * np.float32([-1.0, 1.0, 1.0]) + 0.0, new + 0.0)


def test_both_halves_below_a_mirror_modifier_move_alike() -> None:
    """Painted on the image the mesh's own half moves, and the seam stays closed and smooth."""
    grid = np.linspace(0.0, 1.0, 9)
    vertices = [(x, y, scenes.rippled(x, 2 * y - 1)) for y in grid for x in grid]
    faces = [(i, i + 1, i + 10, i + 9) for j in range(8) for i in range(9 * j, 9 * j + 8)]
    moves = []
    for x in (0.3, -0.3):
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        ob = scenes.linked("Half", vertices, faces)
        ob.modifiers.new("Mirror", 'MIRROR')
        ob.modifiers.new("Subdivision", 'SUBSURF').levels = 2
        scenes.look_from_above(90.0)
        scenes.edit(ob)
        bpy.ops.mesh.select_all(action='SELECT')
        cage = take(ob)
        assert len(cage.surface[0]) and cage.dab(np.array([x, 0.5, 0.0]), brush())
        moves.append((cage.positions - cage.patch.V)[:, 2])
    assert np.abs(moves[0]).max() > 1e-4 and np.abs(moves[0] - moves[1]).max() < 0.03 * np.abs(moves[0]).max()


def test_a_border_that_is_clamped_stays() -> None:
    cage = brushed(margin=3)
    held = ~build(cage).cage_free
    for x in (0.7, 0.0):
        cage.dab(np.array([x, 0.0, 0.0]), brush())
    assert (cage.move[held] == 0.0).all() and np.abs(cage.move).max() > 0.0
    assert (np.abs(cage.xy[:, 0]) < 0.75)[cage.move != 0.0].all()


def test_a_brush_that_meets_no_free_vertex_says_so() -> None:
    cage = brushed()
    for place in ((9.0, 0.0, 0.0), (1.0, 1.0, 0.0)):
        assert not cage.dab(np.array(place), brush(radius=0.1))
    assert not cage.dab(np.array([0.02, 0.03, 0.0]), brush(radius=0.01))
    assert (cage.move == 0.0).all()
