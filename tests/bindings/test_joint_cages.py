"""Presses of Smooth on several panels of which some are cages: the cage takes what it can, and the meshes follow."""
import numpy as np
import reflines
import sample_cages
from meshes import KINDS
from test_follow_border import DIRECTIONS, REACH, Array, cut, cylinder

GAP, DEPTH, RADIUS = 0.004, 0.003, 0.06
Cage = tuple[Array, Array, Array]


def place(u: Array, y: Array, side: int) -> Array:
    """The half of the cylinder beside the cut, u from -0.5 to 0.5 across."""
    end = cut(y) + 0.5 * side * GAP
    x = end - (0.5 - u) * (end + 0.5) if side < 0 else end + (u + 0.5) * (0.5 - end)
    return np.column_stack([x, y, cylinder(x, y)])


def make_mesh(side: int) -> tuple[Array, Array]:
    points, F = KINDS["irregular"](40)
    return place(*points.T, side), F


def make_cage(side: int, cells: int = 16, share: float = 1.0) -> Cage:
    """A cage whose surface is the half with its share of the dent, at the places of the cage's vertices."""
    t = np.linspace(-0.5, 0.5, cells + 1)
    offsets, corners = sample_cages.sheet(cells, cells)
    u, y = np.meshgrid(t, t)
    clean = place(u.ravel(), y.ravel(), side)
    wanted = V = clean + share * dent(clean)
    surface = reflines.Subdivision(offsets, corners, vertices=len(V), level=2, boundary="preserve_corners")
    for _ in range(60):
        V = V + wanted - surface.positions(V)[:len(V)]
    return V, offsets, corners


def dent(V: Array) -> Array:
    return DEPTH * np.exp(-((V[:, 0] - cut(V[:, 1])) ** 2 + V[:, 1] ** 2) / RADIUS**2)[:, None] * [0.0, 0.0, -1.0]


def look_at(cage: Cage) -> Array:
    """The points of its surface."""
    return reflines.Subdivision(cage[1], cage[2], vertices=len(cage[0]), level=2,
                                boundary="preserve_corners").positions(cage[0])


def press(*panels: reflines.JointPanel, **amount: object) -> list:
    count = len(panels)
    return reflines.JointSmoother(panels).press(**{"strengths": [1.0] * count, "limits": [None] * count,
                                                   "limit_ranges": [None] * count, **amount})


def panel(mesh: tuple[Array, Array]) -> reflines.JointPanel:
    return reflines.JointPanel(*mesh, **DIRECTIONS, margin=REACH)


def cage_panel(cage: Cage, **options: object) -> reflines.JointPanel:
    return reflines.JointPanel.for_cage(*cage, **DIRECTIONS, margin=REACH, boundary="preserve_corners", **options)


def rim(points: Array, side: int) -> tuple[Array, Array]:
    """Heights above the clean surface along the rim."""
    at = points[np.abs(points[:, 0] - cut(points[:, 1]) - 0.5 * side * GAP) < 2e-5]
    at = at[np.argsort(at[:, 1])]
    return at[:, 1], at[:, 2] - cylinder(at[:, 0], at[:, 1])


def leave_off(points: Array) -> float:
    """The largest distance along the view from the clean surface."""
    return float(np.abs(points[:, 2] - cylinder(points[:, 0], points[:, 1])).max())


def flush(left: Array, right: Array) -> Array:
    (y, one), (other_y, other) = rim(left, -1), rim(right, 1)
    return np.interp(y, other_y, other) - one


def test_a_dent_across_a_gap_between_a_mesh_and_a_cage_goes_and_the_gap_stays() -> None:
    (V, F), cage = make_mesh(-1), make_cage(1)
    dented = V + dent(V)
    (left, told), (moved, other) = press(panel((dented, F)), cage_panel(cage))
    before, after = look_at(cage), look_at((moved, *cage[1:]))
    assert told.applied and other.applied
    assert max(leave_off(left), leave_off(after)) < 0.06 * min(leave_off(dented), leave_off(before))
    assert max(told.healed.worst_after, other.healed.worst_after) < 0.13 * told.healed.worst_before
    assert np.array_equal(moved[:, :2], cage[0][:, :2]) and np.array_equal(left[:, :2], V[:, :2])
    assert np.abs(flush(left, after) - flush(dented, before)).max() < 0.01 * DEPTH


def test_a_dent_across_a_gap_between_two_cages_goes() -> None:
    cages = make_cage(-1, 14), make_cage(1)
    results = press(*map(cage_panel, cages))
    before, after = map(look_at, cages), (look_at((moved, *cage[1:])) for (moved, _), cage in
                                          zip(results, cages, strict=True))
    left, right = after
    assert max(leave_off(left), leave_off(right)) < 0.08 * DEPTH
    assert np.abs(flush(left, right) - flush(*before)).max() < 0.03 * DEPTH


def test_the_order_of_cages_and_meshes_does_not_matter() -> None:
    (V, F), cage = make_mesh(-1), make_cage(1)
    one = press(panel((V + dent(V), F)), cage_panel(cage))
    other = press(cage_panel(cage), panel((V + dent(V), F)))[::-1]
    assert all(np.array_equal(a, b) for (a, _), (b, _) in zip(one, other, strict=True))


def test_a_cage_that_faces_nothing_is_pressed_alone() -> None:
    cage, far = make_cage(1), make_cage(-1)
    found = press(cage_panel(cage), cage_panel((far[0] - [1.0, 0.0, 0.0], *far[1:])))[0]
    alone = reflines.smooth_cage_panel(*cage, **DIRECTIONS, boundary="preserve_corners")
    assert np.array_equal(found[0], alone[0])


def test_a_cage_whose_border_is_clamped_stays_at_the_gap_and_so_does_the_mesh() -> None:
    (V, F), cage = make_mesh(-1), make_cage(1)
    dented = V + dent(V)
    (left, _), (moved, _) = press(panel((dented, F)), cage_panel(cage, border="clamped"))
    for mesh, surface in ((dented, left), (look_at(cage), look_at((moved, *cage[1:])))):
        (_, before), (_, after) = (rim(each, -1 if mesh is dented else 1) for each in (mesh, surface))
        assert np.array_equal(before, after)


def test_no_vertex_of_a_cage_moves_beyond_the_limit_and_the_strength_is_a_share() -> None:
    (V, F), cage = make_mesh(-1), make_cage(1)
    panels = panel((V + dent(V), F)), cage_panel(cage)
    (_, _), (moved, told) = press(*panels, limits=[1e-3] * 2)
    assert 9e-4 < np.abs(moved - cage[0]).max() <= 1e-3 and told.largest_control_move <= 1e-3
    whole, half = (press(*panels, strengths=[strength] * 2)[1][0] for strength in (1.0, 0.5))
    assert np.allclose(half - cage[0], 0.5 * (whole - cage[0]), atol=1e-12)


def test_a_cage_keeps_its_own_inner_border() -> None:
    """Where its region ends inside the surface nothing beyond moves, and the dent across the gap goes all the same."""
    (V, F), cage = make_mesh(-1), make_cage(1)
    u = np.arange(len(cage[1]) - 1) % 16
    found, told = press(panel((V + dent(V), F)), cage_panel(cage, region=u < 10))[1]
    outside = np.arange(len(cage[0])) % 17 >= 10
    assert told.applied and np.array_equal(found[outside], cage[0][outside])
    assert leave_off(look_at((found, *cage[1:]))) < 0.1 * DEPTH
