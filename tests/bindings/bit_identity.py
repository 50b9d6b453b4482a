"""Hashes of `positions` after every tool, linear solver, strategy and kind of region, on small panels and cages.

Run by test_bit_identity.py in processes of its own: `python bit_identity.py` prints a JSON object, case -> hash.
"""
import hashlib
import json
import sys
from collections.abc import Callable, Iterator
from functools import partial

import numpy as np
import reflines

VIEW = np.array([0.1, -0.4, 1.0])
LINE = np.array([0.05, 1.0, 0.1])
SOLVERS = ("cholmod", "umfpack")
Array = np.ndarray
Build = Callable[..., reflines.ShapeOptimizer]
Step = Callable[[reflines.ShapeOptimizer], object]


def ripples(x: Array, y: Array) -> Array:
    """A smooth wavy function in [-1, 1] made of products and sums alone, whose bits no mathematics library decides."""
    u, v = 3.0 * x - 1.2 * y, 2.0 * y + 0.7 * x
    return u * (1 - u * u / 9) * (1 - v * v / 16) / 2 + v * (1 - v * v / 25) / 4


def panel(cells: int, seed: int, height: float = 2e-3) -> tuple[Array, Array]:
    """A curved sheet of 2 cells^2 triangles with jittered vertices and diagonals that run either way."""
    random = np.random.default_rng(seed)
    side = np.linspace(-1.0, 1.0, cells + 1)
    x, y = (grid.ravel() for grid in np.meshgrid(side, side))
    inner = (np.abs(x) < 0.99) & (np.abs(y) < 0.99)
    x, y = (axis + inner * random.uniform(-0.5, 0.5, axis.size) / cells for axis in (x, y))
    z = 0.1 * x * y - 0.2 * x * x - 0.1 * y * y + height * (ripples(x, y) + random.uniform(-0.05, 0.05, x.size))
    a = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    b, c, d = a + 1, a + cells + 2, a + cells + 1
    other = random.random(a.size) < 0.5
    first = np.where(other[:, None], np.stack([a, b, d], 1), np.stack([a, b, c], 1))
    second = np.where(other[:, None], np.stack([b, c, d], 1), np.stack([a, c, d], 1))
    return np.stack([x, y, z], axis=1), np.concatenate([first, second]).astype(np.int32)


def two_pieces() -> tuple[Array, Array]:
    """Two panels that do not touch, one of them bent by a sharp crease."""
    V, F = panel(10, seed=3)
    W, G = panel(12, seed=4)
    W[:, 2] += np.where(W[:, 0] > 0.05, 1.5 * (W[:, 0] - 0.05), 0.0)
    return np.concatenate([V, W + [3.0, 0.0, 0.2]]), np.concatenate([F, G + len(V)]).astype(np.int32)


def cage(columns: int = 8, rows: int = 6) -> tuple[Array, Array, Array]:
    """Quads symmetric about x = 0, but for ripples."""
    right = np.linspace(0.0, 0.8, columns // 2 + 1)
    x, y = (g.ravel() for g in np.meshgrid(np.concatenate([-right[:0:-1], right]), np.linspace(-0.6, 0.6, rows + 1)))
    V = np.stack([x, y, -0.15 * x * x - 0.1 * y * y + 5e-3 * ripples(np.abs(x), y)], axis=1)
    corner = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    quads = np.stack([corner, corner + 1, corner + columns + 2, corner + columns + 1], axis=1)
    return V, np.arange(0, 4 * len(quads) + 1, 4, dtype=np.int32), quads.ravel().astype(np.int32)


def mesh_optimizer(mesh: tuple[Array, Array] | None = None, **options: object) -> reflines.ShapeOptimizer:
    options = {"view_direction": VIEW, "line_direction": LINE, "border": "fixed"} | options
    return reflines.ShapeOptimizer(*(mesh or panel(14, seed=1)), **options)


def mirrored_mesh(**options: object) -> reflines.ShapeOptimizer:
    """Symmetric about x = 0 but for its heights and the diagonals of its quads."""
    V, F = panel(14, seed=1)
    V[:, :2] = np.array([np.tile(np.linspace(-1.0, 1.0, 15), 15), np.repeat(np.linspace(-1.0, 1.0, 15), 15)]).T
    partner = np.arange(len(V)).reshape(15, 15)[:, ::-1].ravel()
    return mesh_optimizer((V, F), partner=partner, **options)


def cage_optimizer(**options: object) -> reflines.CageOptimizer:
    return reflines.CageOptimizer(*cage(), view_direction=VIEW, line_direction=LINE, **options)


def mirrored_cage(**options: object) -> reflines.CageOptimizer:
    partner = reflines.mirror_pairs(cage()[0], point=(0, 0, 0), normal=(1, 0, 0), tolerance=1e-6)
    return cage_optimizer(partner=partner, border="fixed", **options)


def creased_cage(**options: object) -> reflines.CageOptimizer:
    return cage_optimizer(border="free", creases=np.array([[30, 31], [31, 32]], dtype=np.int32),
                          crease_sharpness=np.array([10.0, 2.5]), corners=np.array([0], dtype=np.int32),
                          corner_sharpness=np.array([10.0]), **options)


def part_of_cage(**options: object) -> reflines.CageOptimizer:
    return cage_optimizer(region=np.arange(48) % 8 > 1, border="clamped", **options)


def nodes(optimizer: reflines.ShapeOptimizer) -> dict[str, object]:
    """A lattice of 4 x 4 cells over the region with one of its inner nodes moved."""
    low, high = optimizer.xy.min(0), optimizer.xy.max(0)
    x, y = np.meshgrid(np.linspace(low[0], high[0], 5), np.linspace(low[1], high[1], 5))
    position = np.stack([x.ravel(), y.ravel()], axis=1)
    position[12] += 0.04 * (high - low)
    return {"low": low, "high": high, "columns": 4, "rows": 4, "position": position}


def turn_softly(optimizer: reflines.ShapeOptimizer) -> reflines.Target:
    curve = np.linspace(1.0, 0.0, 9) ** 2
    influence = reflines.falloff(optimizer, centre=optimizer.xy.mean(0), radius=0.8, curve=curve)
    return reflines.turn(optimizer, angle=0.1, influence=influence)


def image() -> Array:
    x, y = np.meshgrid(np.linspace(-1, 1, 12), np.linspace(-1, 1, 9))
    return 0.5 + 0.4 * ripples(x, y)


def fit_values(optimizer: reflines.ShapeOptimizer) -> reflines.Target:
    theta = optimizer.theta() + 0.02 * ripples(*optimizer.centers.T)
    return reflines.Target(optimizer.field(), optimizer.area / optimizer.area.max(), theta=theta)


def match_panel(optimizer: reflines.ShapeOptimizer) -> reflines.Target:
    dense = mesh_optimizer(panel(20, seed=2, height=1e-3))
    return reflines.match_dense(optimizer, dense)[0]


BUILDERS: dict[str, Step] = {
    "smooth": lambda o: reflines.smooth(o, length=0.5, strength=0.7),
    "straighten": lambda o: reflines.smooth(o, length=0.6, directional=True, weight=1 + o.area),
    "uniform": lambda o: reflines.uniform(o, density=1.05, density_end=0.9, axis=(1, 0)),
    "direction": lambda o: reflines.uniform(o, direction=(0.2, 1.0), influence=np.full(len(o.area), 0.3)),
    "turn": turn_softly,
    "warp": lambda o: reflines.warp(o, **nodes(o))[0],
    "warp by value": lambda o: reflines.warp(o, by_value=True, **nodes(o))[0],
    "pattern": lambda o: reflines.pattern(o, image=image(), strength=0.05, blur=1.0, width=1.5, angle=0.3),
    "pattern by value": lambda o: reflines.pattern(o, image=image(), strength=0.03, width=1.5, by_value=True),
    "values": fit_values,
    "match": match_panel,
}


def two_families(optimizer: reflines.ShapeOptimizer) -> list[reflines.Target]:
    return [reflines.smooth(optimizer, length=0.5, family=0), reflines.uniform(optimizer, density=1.02, family=1)]


def mesh_cases() -> Iterator[tuple[str, Build, Step, dict[str, object]]]:
    for name, builder in BUILDERS.items():
        yield name, mesh_optimizer, builder, {}
    for strategy in ("linearized", "gauss_newton", "newton"):
        yield f"smooth {strategy}", mesh_optimizer, BUILDERS["smooth"], {"strategy": strategy, "max_iterations": 8}
    for border in ("free", "clamped"):
        yield f"smooth {border}", partial(mesh_optimizer, border=border), BUILDERS["smooth"], {}
        yield f"warp by value {border}", partial(mesh_optimizer, border=border), BUILDERS["warp by value"], {}
    for stencil in ("averaged", "hybrid"):
        yield f"smooth {stencil}", partial(mesh_optimizer, stencil=stencil), BUILDERS["smooth"], {}
    yield "smooth two pieces", partial(mesh_optimizer, two_pieces()), BUILDERS["smooth"], {}
    yield "warp two pieces", partial(mesh_optimizer, two_pieces()), BUILDERS["warp"], {}
    yield "mirrored mesh", mirrored_mesh, BUILDERS["smooth"], {}
    yield "mirrored mesh free", partial(mirrored_mesh, border="free"), BUILDERS["pattern by value"], {}
    # Enough triangles for loops to be shared out among threads.
    yield "many triangles", partial(mesh_optimizer, panel(130, seed=5)), BUILDERS["smooth"], {"max_iterations": 3}
    families = np.stack([LINE, [1.0, 0.1, 0.0]])
    yield "two families", partial(mesh_optimizer, line_direction=families), two_families, {}


def cage_cases() -> Iterator[tuple[str, Build, Step, dict[str, object]]]:
    for name in ("smooth", "uniform", "warp", "pattern by value", "match"):
        yield f"cage {name}", partial(cage_optimizer, border="fixed"), BUILDERS[name], {}
    yield "cage sparse", partial(cage_optimizer, border="fixed", level=3, sparse=True), BUILDERS["smooth"], {}
    for build in (mirrored_cage, creased_cage, part_of_cage):
        yield build.__name__.replace("_", " "), build, BUILDERS["smooth"], {}


def digest(optimizer: reflines.ShapeOptimizer) -> str:
    arrays = [optimizer.positions, optimizer.heights, optimizer.field()]
    if isinstance(optimizer, reflines.CageOptimizer):
        arrays.append(optimizer.cage_positions)
    return hashlib.sha256(b"".join(array.tobytes() for array in arrays)).hexdigest()[:24]


def solve_twice(optimizer: reflines.ShapeOptimizer, build_target: Step, options: dict[str, object]) -> str:
    """The second solve starts from the factor of the first, as while a handle is dragged."""
    first = optimizer.positions
    optimizer.solve(build_target(optimizer), **options)
    assert not np.array_equal(optimizer.positions, first), "the case moves nothing"
    optimizer.solve(reflines.smooth(optimizer, length=0.3), **options)
    return f"{digest(optimizer)} {optimizer.score(0.4).shift.hex()}"


def fit_cage(solver: str) -> str:
    """Heights of a dense panel, then its lines."""
    dense = mesh_optimizer(panel(20, seed=2, height=1e-3))
    optimizer = cage_optimizer(border="free", linear_solver=solver)
    target, _, heights, area = reflines.match_dense(optimizer, dense)
    optimizer.fit(heights, area)
    optimizer.solve(target)
    return digest(optimizer)


def reset_between(solver: str) -> str:
    """One optimizer, reset in between: what it was asked before leaves no trace."""
    optimizer = mesh_optimizer(border="free", linear_solver=solver)
    optimizer.solve(reflines.smooth(optimizer, length=0.5))
    optimizer.reset()
    optimizer.solve(reflines.uniform(optimizer, density=1.01))
    return digest(optimizer)


def hash_all() -> dict[str, str]:
    hashes = {}
    for solver in SOLVERS:
        for name, build, build_target, options in (*mesh_cases(), *cage_cases()):
            hashes[f"{name} / {solver}"] = solve_twice(build(linear_solver=solver), build_target, options)
        hashes[f"cage fit / {solver}"] = fit_cage(solver)
        hashes[f"after a reset / {solver}"] = reset_between(solver)
    return hashes


if __name__ == "__main__":
    json.dump(hash_all(), sys.stdout)
