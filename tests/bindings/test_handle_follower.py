"""Handles that are followed without a solve: lines meet the mouse, others stay, and it hardly matters how."""
import numpy as np
import pytest
import reflines
import sample_cages
from test_line_handles import STEP, across, crown, draw_map, mesh, middle, moves_of_lines, pull

import meshes

CELLS = 80  # a side: more vertices than the ordinary solve is used for
Array = np.ndarray


def region(kind: str, **options: object) -> tuple[Array, Array]:
    points, triangles = meshes.stretched(180, 45, "regular") if "stretched" in kind else meshes.KINDS[kind](CELLS)
    return crown(points * (1.5, 1.2)), triangles


class Session:
    """Two optimizers of a region, the first at the start, as a drag has them."""

    def __init__(self, kind: str = "irregular", **options: object) -> None:
        directions = {"view_direction": (0, 0, 1), "line_direction": [(0.3, 1, 0), (-1, 0.3, 0)]}
        self.start, self.other = (reflines.ShapeOptimizer(*region(kind), **directions, **options) for _ in range(2))
        self.lines = reflines.LineHandles(self.start)
        self.follower = reflines.HandleFollower(self.start, self.lines)
        self.before, self.middle = reflines.vertex_theta(self.start), middle(self.start)

    def pull(self, length: float, at: tuple[float, float] = (0.0, 0.0)) -> reflines.Handle:
        start = self.middle + at
        return pull(self.lines, start, start + across(self.start, length))

    def follow(self, handles: list[reflines.Handle]) -> list[float]:
        """Returns how far the lines pass beside the handles, as shares of their spacing."""
        assert self.follower.follow(handles, self.other)
        return [reach.fraction for reach in self.lines.measure(handles, self.other, line_step=STEP)]


@pytest.mark.parametrize("border", ("clamped", "free"))
@pytest.mark.parametrize("kind", ("regular", "4-8", "irregular", "regular stretched"))
def test_the_line_meets_the_mouse_and_lines_beyond_the_radius_stay(kind: str, border: str) -> None:
    session = Session(kind, border=border)
    for length in (0.03, 0.1):
        assert max(session.follow([session.pull(length)])) < 0.01
    moved = moves_of_lines(session.other, session.before)
    beyond = np.linalg.norm(session.start.xy - session.middle, axis=1) > 0.44
    assert moved[beyond].max() < 0.02 and 0.2 < moved.max() < 0.4


def test_it_is_near_what_the_solve_makes() -> None:
    """Which weighs the values at the handle instead of raising what is asked for."""
    session = Session()
    handle, z = session.pull(0.06), session.start.heights.copy()
    session.follow([handle])
    followed = reflines.vertex_theta(session.other)
    session.start.solve([*session.lines.build([handle]), reflines.keep(session.start, family=1)])
    solved = moves_of_lines(session.start, session.before)
    off = np.abs(followed - reflines.vertex_theta(session.start)) / STEP
    assert off.max() < 0.22 * solved.max() and np.sqrt(np.mean(off**2)) < 0.025 * solved.max()
    moves = [solver.heights - z for solver in (session.other, session.start)]
    assert np.abs(moves[1] - moves[0]).max() < 0.14 * np.abs(moves[1]).max()


def test_what_is_shown_depends_on_the_handle_alone() -> None:
    session = Session()
    shapes = []
    for length in (0.05, -0.02, 0.08, 0.05, 0.0):
        session.follow([session.pull(length)])
        shapes.append(session.other.heights.copy())
    assert np.abs(shapes[3] - shapes[0]).max() < 1e-6 < np.abs(shapes[2] - shapes[0]).max()
    assert shapes[4].tobytes() == session.start.heights.tobytes()


def test_other_lines_are_kept_where_that_is_wanted() -> None:
    changes = []
    for keep in (True, False):
        session = Session()
        session.follower.follow([session.pull(0.1)], session.other, keep_others=keep)
        changes.append(np.abs(session.other.theta(1) - session.start.theta(1)).mean())
    assert changes[0] < 0.995 * changes[1]


def test_several_handles_and_pins_are_met() -> None:
    session = Session()
    pulls = [session.pull(0.06, (-0.15, 0.0)), session.pull(-0.05, (0.2, 0.1))]
    area = np.flatnonzero(np.linalg.norm(session.start.centers - session.middle - [0.0, 0.25], axis=1) < 0.05)
    curve = session.middle + [[0.0, -0.25], [0.1, -0.2]]
    assert max(session.follow([*pulls, reflines.Handle(curve), reflines.Handle(triangles=area)])[:3]) < 0.02
    at = region("irregular")[1][area].ravel()
    pinned = moves_of_lines(session.other, session.before)[at].max()
    session.follow(pulls)
    assert pinned < 0.02 < moves_of_lines(session.other, session.before)[at].max()


def test_a_handle_near_a_border_that_holds_is_met() -> None:
    session = Session("regular")
    assert max(session.follow([session.pull(0.03, (0.0, 0.48))])) < 0.01
    held = ~session.start.free
    assert np.array_equal(session.other.positions[held], session.start.positions[held])


FREE, FIXED, CLAMPED = 0, 1, 2


def test_a_border_by_segment_holds_in_what_is_shown_and_in_what_is_solved() -> None:
    """The left side is fixed, the right one free, the others are clamped, and lines are pulled beside each."""
    points = region("regular")[0][:, :2]
    side = np.abs(points[:, 1]) < np.abs(points[:, 1]).max() - 1e-9
    right, left = (side & (np.abs(points[:, 0] - end) < 1e-9) for end in (points[:, 0].max(), points[:, 0].min()))
    codes = np.where(right, FREE, np.where(left, FIXED, CLAMPED)).astype(np.int32)
    session, solved = Session("regular", border=codes), Session("regular", border=codes).start
    step = np.diff(np.unique(points[:, 0].round(9)))[0]
    beside = side & (np.abs(points[:, 0] - points[:, 0].min() - step) < 1e-9)  # of the fixed side: moves
    clamped = np.abs(points[:, 1]) > np.abs(points[:, 1]).max() - 1.5 * step
    handles = [session.pull(0.03, session.start.frame[:2] @ (x, 0.0, 0.0) - session.middle) for x in (-0.6, 0.6)]
    solved.solve(session.lines.build(handles))
    assert max(session.follow(handles)) < 0.02
    for optimizer in (session.other, solved):
        moved = (optimizer.positions != session.start.positions).any(axis=1)
        middle_rows = np.abs(points[:, 1]) < 0.2
        assert not moved[left | clamped & ~right].any()
        assert moved[right & middle_rows].all() and moved[beside & middle_rows].all()


def test_small_regions_and_cages_are_left_to_the_solve() -> None:
    for make in (lambda: reflines.ShapeOptimizer(*mesh("regular"), view_direction=(0, 0, 1), line_direction=(0, 1, 0)),
                 lambda: sample_cages.optimizer(sample_cages.hood())):
        start = make()
        lines, other = reflines.LineHandles(start), make()
        handle = pull(lines, middle(start), middle(start) + across(start, 0.05))
        assert not reflines.HandleFollower(start, lines).follow([handle], other)
        assert other.heights.tobytes() == start.heights.tobytes()


def test_lines_stay_where_the_fall_off_map_is_0() -> None:
    session = Session()
    free = draw_map(session.start)
    session.follow([session.pull(0.1)])
    plain = moves_of_lines(session.other, session.before)[free == 0.0].max()
    session.lines = reflines.LineHandles(session.start, falloff=free)
    session.follower = reflines.HandleFollower(session.start, session.lines)
    assert max(session.follow([session.pull(0.1)])) < 0.01
    mapped = moves_of_lines(session.other, session.before)[free == 0.0].max()
    assert mapped < 0.01 < 0.05 < plain, (mapped, plain)


def test_very_different_radii_are_left_to_the_solve() -> None:
    """Their window would have as many motions as the mesh has vertices."""
    points, triangles = meshes.KINDS["regular"](200)
    V = crown(points * (1.5, 1.2))
    start, other = (reflines.ShapeOptimizer(V, triangles, view_direction=(0, 0, 1), line_direction=(0.3, 1, 0))
                    for _ in range(2))
    lines, place = reflines.LineHandles(start), middle(start)[None]
    value = lines.read_theta(place)[0] + 1e-3
    small, wide = (reflines.Handle(place, value=value, radius=radius, centre=place) for radius in (0.05, 5.0))
    follower = reflines.HandleFollower(start, lines)
    assert follower.follow([small], other) and follower.follow([wide], other)
    assert not follower.follow([small, wide], other)


def test_bad_handles_are_refused_in_a_sentence() -> None:
    session = Session()
    for handles, words in (([], "no handle that pulls"), ([session.pull(9.0)], "off the region"),
                           ([reflines.Handle(session.middle[None], value=0.1)], "no radius")):
        with pytest.raises(reflines.InvalidInput, match=words):
            session.follower.follow(handles, session.other)
    assert session.other.heights.tobytes() == session.start.heights.tobytes()


def test_lines_of_another_region_are_refused() -> None:
    session = Session()
    V, F = region("irregular")
    for other in (mesh("regular"), (np.vstack([V, V[:1]]), F), (V + [0.1, 0.0, 0.0], F)):
        optimizer = reflines.ShapeOptimizer(*other, view_direction=(0, 0, 1), line_direction=(0.3, 1, 0))
        for start, lines in ((session.start, reflines.LineHandles(optimizer)), (optimizer, session.lines)):
            with pytest.raises(reflines.InvalidInput, match="another region"):
                reflines.HandleFollower(start, lines)


def test_one_follower_is_used_by_one_thread_at_a_time() -> None:
    """Two that moved an optimizer each wrote into one window: a segmentation fault."""
    session, beside = Session(), Session().other
    handles = [session.pull(0.001, (x, y)) for x in np.linspace(-0.3, 0.3, 7) for y in np.linspace(-0.3, 0.3, 7)]
    first = reflines.start(session.follower.follow, handles, session.other)
    with pytest.raises(reflines.InvalidInput, match="follower is in use by another thread"):
        session.follower.follow(handles, beside)
    assert first.result()
