"""Cages beside each other as one, with a bridge of triangles over the gap between their surfaces."""
import numpy as np
import pytest
import reflines

GAP, CELLS, LEVEL = 0.02, 6, 2
DIRECTIONS = {"view_direction": (0.0, 0.0, 1.0), "line_direction": (0.9, 0.1, 0.4)}
Array = np.ndarray


def build_cages() -> dict[str, Array | str | int]:
    """Two sheets whose gap is at x = 0, with free rims there."""
    V, faces, border = [], [], []
    for side in (-1.0, 1.0):
        first, columns = len(V), 0.5 * GAP + np.linspace(0.0, 1.0, CELLS + 1)
        for y in np.linspace(-1.0, 1.0, 2 * CELLS + 1):
            V += [(side * x, y, -0.15 * x * x - 0.1 * y * y) for x in columns]
            border += [0 if x == columns[0] and abs(y) < 0.99 else 2 for x in columns]
        for j in range(2 * CELLS):
            for i in range(first + j * (CELLS + 1), first + j * (CELLS + 1) + CELLS):
                corners = [i, i + 1, i + CELLS + 2, i + CELLS + 1]
                faces.append(corners if side > 0.0 else corners[::-1])
    return {"V": np.array(V), "face_offsets": 4 * np.arange(len(faces) + 1), "face_vertices": np.ravel(faces),
            "border": np.array(border), "level": LEVEL, "boundary": "preserve_corners", **DIRECTIONS}


def build_bridge(bare: reflines.CageOptimizer) -> dict[str, Array]:
    """Between the rows behind the rims, which have the same places along the gap."""
    V, F = bare.positions, bare.triangles
    rim = np.abs(V[:, 0]) < 0.6 * GAP
    left_out = rim[F].any(axis=1)
    beside = np.setdiff1d(F[left_out], np.flatnonzero(rim))
    sides = [beside[sign * V[beside, 0] > 0.0] for sign in (-1.0, 1.0)]
    one, other = (side[np.argsort(V[side, 1])] for side in sides)
    bridge = np.concatenate([np.column_stack([one[:-1], other[:-1], other[1:]]),
                             np.column_stack([one[:-1], other[1:], one[1:]])])
    return {"bridge": bridge, "bridge_parent": np.zeros(len(bridge), dtype=int), "left_out": left_out}


def test_a_bridge_takes_the_place_of_the_rims() -> None:
    cages = build_cages()
    bare = reflines.CageOptimizer(**cages)
    bridge = build_bridge(bare)
    joined = reflines.CageOptimizer(**cages, **bridge)
    rim = np.abs(bare.positions[:, 0]) < 0.6 * GAP
    assert len(joined.triangles) == len(bare.triangles) - bridge["left_out"].sum() + len(bridge["bridge"])
    assert len(joined.positions) == np.count_nonzero(~rim)
    assert np.array_equal(joined.positions, bare.positions[~rim])
    assert np.array_equal(joined.refined, bare.refined[~rim])
    assert np.array_equal(joined.cage_free, bare.cage_free)
    assert set(joined.parent[-len(bridge["bridge"]):]) == {0}


def test_over_a_bridge_both_sides_move_as_one() -> None:
    """Lines that are turned on one side alone turn the other, too."""
    cages = build_cages()
    bare = reflines.CageOptimizer(**cages)
    moves = {}
    for name, extra in (("apart", {}), ("joined", build_bridge(bare))):
        optimizer = reflines.CageOptimizer(**cages, **extra)
        curve = np.linspace(1.0, 0.0, 64)
        influence = reflines.falloff(optimizer, centre=(-0.3, 0.0), radius=0.6, curve=curve)
        optimizer.solve([reflines.turn(optimizer, angle=0.2, influence=influence)])
        moves[name] = (optimizer.cage_positions - cages["V"])[:, 2]
    rims = [np.flatnonzero((np.abs(cages["V"][:, 0] - 0.5 * side * GAP) < 1e-9) & (np.abs(cages["V"][:, 1]) < 0.7))
            for side in (-1.0, 1.0)]
    differences = {name: np.abs(move[rims[0]] - move[rims[1]]).max() for name, move in moves.items()}
    largest = np.abs(moves["joined"][rims[0]]).max()
    print(differences, largest)
    assert largest > 1e-4
    assert differences["joined"] < 0.3 * largest and differences["joined"] < 0.02 * differences["apart"]


@pytest.mark.parametrize(("change", "sentence"), [
    ({"bridge": [[0, 1, 100000]], "bridge_parent": [0]}, "The 1 triangles over the gap need corners among the"),
    ({"bridge": [[0, 1, 2]], "bridge_parent": []}, "and a face of the cage each"),
    ({"bridge": [[0, 1, 2]], "bridge_parent": [-1]}, "and a face of the cage each"),
    ({"left_out": np.zeros(3, dtype=bool)}, "mask of triangles that are left out has 3 entries")])
def test_a_bridge_that_does_not_fit_is_refused(change: dict, sentence: str) -> None:
    cages = build_cages()
    with pytest.raises(reflines.InvalidInput, match=sentence):
        reflines.CageOptimizer(**cages, **{**build_bridge(reflines.CageOptimizer(**cages)), **change})
