"""Shut lines: gap, flush and the course of lines of smooth surfaces that are cut with a known gap and step."""
import numpy as np
import pytest
import reflines
from test_follow_border import DIRECTIONS, Array, cut, cylinder, half

Mesh = tuple[Array, Array]


def join(*meshes: Mesh) -> Mesh:
    starts = np.cumsum([0, *(len(V) for V, _ in meshes)])
    return np.concatenate([V for V, _ in meshes]), np.concatenate([F + k for (_, F), k in zip(meshes, starts[:-1],
                                                                                              strict=True)])


def check(own: Mesh, *beside: Mesh, before: Array | None = None, **options: object) -> object:
    V, F = own
    there, triangles = join(*beside) if beside else (np.zeros((0, 3)), np.zeros((0, 3), dtype=int))
    label = np.repeat(np.arange(len(beside)), [len(G) for _, G in beside])
    return reflines.check_shut_lines(V if before is None else before, V, F, np.ones(len(F), dtype=bool), there,
                                     triangles, label=label, **DIRECTIONS, **options)


def rows(line: object) -> dict:
    return {row.name: row for row in line.rows}


def turn(V: Array, angle: float) -> Array:
    """Turns positions around the y axis."""
    c, s = np.cos(angle), np.sin(angle)
    return V @ np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])


def straight(side: int, gap: float, cells: int = 20) -> Mesh:
    """Half of a square of the plane."""
    x, y = np.meshgrid(np.linspace(0.5 * gap, 0.5, cells + 1), np.linspace(-0.5, 0.5, 2 * cells + 1))
    i = np.arange(2 * cells * (cells + 1)).reshape(-1, cells + 1)[:, :-1].ravel()
    F = np.concatenate([np.column_stack([i, i + 1, i + cells + 2]), np.column_stack([i, i + cells + 2, i + cells + 1])])
    return np.column_stack([side * x.ravel(), y.ravel(), 0.0 * x.ravel()]), F if side > 0 else F[:, ::-1]


@pytest.mark.parametrize("angle", [0.0, 0.7])
def test_gap_and_step_of_a_cut_plane_are_known(angle: float) -> None:
    gap, step = 0.004, 0.0007
    (V, F), (W, G) = straight(-1, gap), straight(1, gap, 13)
    found = check((turn(V, angle), F), (turn(W + [0.0, 0.0, step], angle), G))
    assert len(found.list) == 1 and len(found.edges) == 40
    table = rows(found.list[0])
    for name, value in (("smallest gap", gap), ("largest gap", gap), ("lowest flush", step), ("highest flush", step),
                        ("kink", 0.0), ("uneven gap", 0.0)):
        assert table[name].after == pytest.approx(value, abs=1e-9), name
    assert found.list[0].length == pytest.approx(1.0) and found.list[0].label == 0
    assert not table["highest flush"].passes and table["uneven gap"].passes and not found.passes.any()


@pytest.mark.parametrize("gap", [0.0, 0.001, 0.004, 0.008])
@pytest.mark.parametrize("kinds", [("regular", "irregular"), ("irregular", "4-8")])
def test_a_curved_gap_in_a_bent_surface_is_no_kink(gap: float, kinds: tuple[str, str]) -> None:
    """The gap is `gap` wide along x; across the surface and the curve, which are not along the axes, it is less."""
    own, other = half(-1, gap, kinds[0], 40), half(1, gap, kinds[1], 29)
    found = check(own, other)
    table = rows(found.list[0])
    y = 0.5 * own[0][found.edges].sum(axis=1)[:, 1]
    wanted = measure_gap(y, gap)
    assert len(found.list) == 1 and len(found.edges) >= 38
    assert np.allclose(found.after.gap, wanted, atol=1e-6 + 2e-3 * gap)
    assert np.abs(found.after.flush).max() < 3e-6 and table["kink"].after < 0.02
    assert table["line offset"].after < 1.0 and table["line angle"].after < 1.0
    assert found.passes.all() == table["uneven gap"].passes


def measure_gap(y: Array, gap: float) -> Array:
    """The distance of the curve x = cut(y) + gap / 2 from that with - gap / 2 on the cylinder, by a fine polyline."""
    there = np.linspace(-0.6, 0.6, 240001)
    x = cut(there) + 0.5 * gap
    result = []
    for own in y:
        u = cut(own) - 0.5 * gap
        near = np.abs(there - own) < 0.02
        d = np.column_stack([x[near] - u, there[near] - own, cylinder(x[near], there[near]) - cylinder(u, own)])
        result.append(np.linalg.norm(d, axis=1).min())
    return np.array(result)


def test_a_kink_and_its_lines_are_told_with_their_place() -> None:
    (V, F), right = half(-1, 0.004, "regular", 40), half(1, 0.004, "irregular", 29)
    bent = V + np.outer(0.06 * (V[:, 0] - cut(V[:, 1]) + 0.002) * np.exp(-((V[:, 1] - 0.2) / 0.1)**2), [0.0, 0.0, 1.0])
    found = check((bent, F), right, before=V)
    table = rows(found.list[0])
    kink = table["kink"]
    assert kink.before < 0.02 and kink.after == pytest.approx(np.degrees(0.06), rel=0.1) and kink.change == "worse"
    assert abs(kink.place[1] - 0.2) < 0.03 and not kink.passes
    assert table["line offset"].after > 50.0 and not table["line offset"].passes
    assert table["largest gap"].after == pytest.approx(table["largest gap"].before, abs=1e-5)
    y = bent[found.edges].mean(axis=1)[:, 1]
    assert set(np.array(found.change)[np.abs(y - 0.2) < 0.05]) == {"worse"}
    assert set(np.array(found.change)[y < -0.2]) == {"unchanged"} and found.passes[y < -0.2].all()


def test_a_gap_that_widens_is_uneven() -> None:
    (V, F), (W, G) = straight(-1, 0.004), straight(1, 0.004)
    W = W + np.outer(0.002 * (W[:, 1] + 0.5), [1.0, 0.0, 0.0])
    table = rows(check((V, F), (W, G)).list[0])
    assert table["smallest gap"].after == pytest.approx(0.004, abs=1e-4)
    assert table["largest gap"].after == pytest.approx(0.006, abs=1e-4)
    assert table["smallest gap"].place[1] < -0.45 and table["largest gap"].place[1] > 0.45
    assert not table["uneven gap"].passes
    assert rows(check((V, F), (W, G), uneven=0.003).list[0])["uneven gap"].passes


def test_each_side_of_a_corner_and_each_neighbour_is_a_line_of_its_own() -> None:
    """A square with one neighbour to its right, and two above it that meet over its middle."""
    def square(low: tuple[float, float], high: tuple[float, float]) -> Mesh:
        V, F = straight(1, 0.0, 10)
        return V * [2.0 * (high[0] - low[0]), high[1] - low[1], 0.0] + [low[0], 0.5 * (low[1] + high[1]), 0.0], F

    own, right = square((0.0, 0.0), (1.0, 1.0)), square((1.004, 0.0), (2.0, 1.0))
    above = square((0.0, 1.006), (0.498, 2.0)), square((0.502, 1.006), (1.0, 2.0))
    found = check(own, right, *above)
    told = {line.label: round(rows(line)["largest gap"].after, 9) for line in found.list}
    assert told == {0: 0.004, 1: 0.006, 2: 0.006} and len(found.list) == 3


def test_parts_of_one_mesh_that_are_not_joined_have_a_shut_line() -> None:
    (V, F), (W, G) = half(-1, 0.002, "regular", 30), half(1, 0.002, "regular", 30)
    found = check(join((V, F), (W, G)))
    assert [line.label for line in found.list] == [-1]
    assert found.edges.max() < len(V)


@pytest.mark.parametrize("change", ["behind", "turned", "over", "far"])
def test_what_is_no_neighbour_has_no_shut_line(change: str) -> None:
    (V, F), (W, G) = straight(-1, 0.004), straight(1, 0.004)
    moved = {"behind": W - [0.0, 0.0, 0.05], "turned": W, "over": W - [0.2, 0.0, -0.004], "far": W + [0.1, 0.0, 0.0]}
    assert not check((V, F), (moved[change], G[:, ::-1] if change == "turned" else G)).list


def test_bad_input_is_refused() -> None:
    V, F = straight(-1, 0.004)
    with pytest.raises(reflines.InvalidInput, match="needs a label"):
        reflines.check_shut_lines(V, V, F, np.ones(len(F), dtype=bool), V, F, label=[1])
    with pytest.raises(reflines.InvalidInput, match="beyond the 0"):
        reflines.check_shut_lines(V, V, F, np.ones(len(F), dtype=bool), np.zeros((0, 3)), F)
    with pytest.raises(reflines.InvalidInput, match="spacing"):
        check((V, F), spacing=0.0)
    with pytest.raises(reflines.InvalidInput, match="or neither"):
        reflines.check_shut_lines(V, V, F, np.ones(len(F), dtype=bool), view_direction=(0.0, 0.0, 1.0))
