"""reflines: shape optimization using reflection lines. numpy in, numpy out, no Blender needed.

Names and shapes: V (#V x 3) vertex positions, F (#F x 3) triangles of the region to optimize, view_direction v (3, from the
surface towards the viewer), line_direction a (3, along the line lights). Angles are radians, lengths are those of V.
"""
from typing import Any, Callable, Generic, Literal, ParamSpec, Sequence, TypeVar
import numpy as np

Border = Literal["free", "fixed", "clamped", "curvature", "flow", "follow"]
Stencil = Literal["averaged", "quadratic", "hybrid", "consistent"]
CreaseRule = Literal["automatic", "marked", "none"]
Strategy = Literal["adaptive", "linearized", "gauss_newton", "newton"]
LinearSolver = Literal["cholmod", "umfpack"]
Scheme = Literal["catmull_clark", "loop"]
Boundary = Literal["all", "preserve_corners"]

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")

AUTOMATIC_LENGTH: float  # of flaws, relative to the diagonal of a panel
AUTOMATIC_LIMIT: float   # of the moves, relative to that length
FAIR_MARGIN: float       # lengths from a panel that a press with a fair border takes in
MOST_BOUNDED: int        # free vertices up to which a shape within a limit is solved for; above, moves are scaled to it
MOST_BOUNDED_CAGE: int   # likewise, unknowns of a cage

class InvalidInput(ValueError):
    """Raised for arrays that cannot be used. The text is one sentence: what, how many, what to do."""

class SolverFailure(RuntimeError):
    """Raised at a numerical breakdown; nothing was changed."""

class Cancelled(Exception):
    """Raised where a Progress was cancelled before there was a result. A solve reports it instead."""

class Progress:
    """The state of one computation, for the thread that computes and threads that watch or cancel it. Thread safe."""
    fraction: float  # read only, 0..1
    stage: str       # read only, e.g. "factorizing"
    cancelled: bool  # read only
    def __init__(self) -> None: ...
    def cancel(self) -> None:
        """Asks the computation to stop at its next step. Final."""

class Task(Generic[Result]):
    """A native call in the background, see `start`. It holds its arguments until it has ended; collecting it earlier waits
    for that.
    """
    done: bool  # read only
    def wait(self, seconds: float) -> bool:
        """Waits so long for the end of the call, without the GIL; returns whether it has ended."""
    def result(self) -> Result:
        """Waits for the end of the call; returns its result, or raises its error."""

def start(function: Callable[Arguments, Result], *args: Arguments.args, **kwargs: Arguments.kwargs) -> Task[Result]:
    """Starts a call of a function or method of this module on a background thread, which never takes the GIL: arguments are
    converted now, and the result when it is taken. What is no long work, such as a property, is done at once; classes
    are built in the background by their `create`. Python's exit waits for what was started. Raises InvalidInput for a
    function written in Python.
    """

class Note:
    """A code of native/include/reflines/note.h, as "limited", which the caller words for its users, and its numbers. Its text is
    for developers."""
    kind: str
    count: int
    before: float
    after: float

class Region:
    """Counts of a region's faces and vertices by their roles; `notes` tell what of it is left as it is."""
    triangles: int
    free: int
    fixed: int
    clamped: int
    pieces: int        # height-field pieces, each solved on its own, or with its mirror image
    silhouettes: int   # faces with |n.v| < 0.2 (12 degrees), their vertices held; see `face_of_triangle` of ShapeOptimizer
    turned_away: int   # faces with n.v <= -0.2, turned away, their vertices held
    unused_pieces: int # pieces without a free vertex
    creases: int       # edges held as creases
    marked_creases: int  # those of them that were marked
    features: int      # faces whose lines are kept: strong bends that run on for more than the smoothing length, or,
                       # before any smoothing and for the other tools, than a sixth of the region's diagonal
    hidden: int        # faces of less weight: the reflected ray is nearly parallel to the lines
    closed: bool       # the region has no border edge
    notes: list[Note]

class Target:
    """One wanted gradient of theta and one weight per triangle, for one family of lines. Arrays are copied when read and when
    assigned."""
    gradient: np.ndarray  # #F x 2, image plane, radians / length
    weight: np.ndarray    # #F, >= 0
    theta: np.ndarray     # #F wanted theta for a value fit (eq. 3), empty for a gradient fit (eq. 4). The gradient then
                          # only keeps the surface smooth at the scale of the triangles, and may be 0 x 2
    family: int           # which of the optimizer's line directions
    reachable_only: bool  # fits only the part that heights can attain; set by the builders of new lines, not by `smooth`
    def __init__(self, gradient: np.ndarray, weight: np.ndarray | None = None, *, theta: np.ndarray | None = None,
                 family: int = 0, reachable_only: bool = False) -> None: ...

class Report:
    """The termination of a solve, its counts of work, and the change of the energy."""
    termination: str   # "converged", "already_optimal", "no_progress", "iteration_limit", "cancelled"
    converged: bool
    message: str       # one sentence with the numbers compared
    strategy: str
    linear_solver: str
    iterations: int
    evaluations: int
    assemblies: int
    analyses: int
    factorizations: int
    solves: int
    energy_before: float
    energy_after: float
    gradient_before: float
    gradient_after: float
    seconds: float
    unknowns: int
    put_back: int         # vertices beyond the limit at the start, by a solve before: put back to it before anything else
    limited: int          # vertices that touch the limit
    limited_fraction: float  # of the free vertices
    largest_move: float   # along the view direction, scene units
    residual_rms: float   # rms of |grad theta - target| over the triangles that can change, radians / length

class ShapeOptimizer:
    """The optimizer of one region along one view, for lines seen along it or by eyes of their own. It is expensive to
    build and cheap to solve again.

    Raises InvalidInput for data that cannot be used; never changes the arrays handed in. It computes without the GIL, for one
    thread at a time: a call from another thread meanwhile (of a builder of targets, too) raises InvalidInput at once, except
    for constant data (frame, free, active, changeable, xy, centers, area). Any number of threads may read it at once.
    """
    region: Region
    frame: np.ndarray      # 3 x 3, rows: image-plane x, y and z = view_direction, in world coordinates
    heights: np.ndarray    # #V current heights along the view
    positions: np.ndarray  # #V x 3; vertices that cannot move carry the bits they came with
    at_limit: np.ndarray   # #V: -1 or 1 where the last solve's limit holds a vertex at its lowest or highest move, else 0
    free: np.ndarray       # #V bool
    xy: np.ndarray         # #V x 2, in the image plane
    centers: np.ndarray    # #F x 2, the triangles' centroids in the image plane
    area: np.ndarray       # #F, in the image plane; 0 where not active
    active: np.ndarray     # #F bool: triangles that belong to a height-field piece
    changeable: np.ndarray # #F bool: those of them with a vertex that can move
    def __init__(self, V: np.ndarray, F: np.ndarray, *, view_direction: Sequence[float],
                 line_direction: Sequence[float] | np.ndarray,   # 3, or #families x 3
                 eye_directions: np.ndarray | None = None,       # of each family, from the surface to the eye that sees it; None:
                                                                 # all along the view. What an eye does not see has no weight
                 blockers: tuple[np.ndarray, np.ndarray] | None = None,  # V, F of what may hide the region from an eye beside
                                                                 # itself
                 border: Border | np.ndarray = "clamped",        # or #V codes: 0 free, 1 fixed, 2 clamped, 3 curvature,
                                                                 # 4 flow, 5 follow
                 fixed: np.ndarray | None = None,                # #V bool: held whatever the border says
                 partner: np.ndarray | None = None,              # #V of mirror_pairs, mutual, -1: none. Partners keep equal
                                                                 # moves, and what holds or limits one holds for both
                 around: tuple[np.ndarray, np.ndarray] | None = None,  # for the borders "curvature" and "flow": positions
                                                                 # #S x 3 of vertices around, and triangles that name the region's
                                                                 # by 0 .. #V - 1 and those by #V and more
                 face_of_triangle: np.ndarray | None = None,     # #F: the face that each was cut from, by any numbers;
                                                                 # counts are those of faces. None: each is its own
                 stencil: Stencil = "consistent", linear_solver: LinearSolver = "cholmod",
                 crease_rule: CreaseRule = "automatic",          # creases are held, no stencil reaches across
                 marked_creases: np.ndarray = ...,               # #M x 2 vertices of edges; used unless the rule is "none"
                 crease_angle: float = 0.5236,                   # radians: sharper edges are creases unless round about
                 proximity: float = -1.0,                        # weight of staying near the start; -1: default
                 progress: Progress | None = None,               # watches from the start, see `watch`
                 ) -> None: ...
    @staticmethod
    def create(*args: Any, **kwargs: Any) -> ShapeOptimizer:
        """Builds as the constructor does, from its arguments; `start` takes this function."""
    def theta(self, family: int = 0) -> np.ndarray:
        """Returns the reflection function of every triangle (#F), radians in (-pi, pi]."""
    def field(self, family: int = 0) -> np.ndarray:
        """Returns the gradient of theta in every triangle (#F x 2), in the image plane, radians / length."""
    def sight(self, family: int = 0) -> np.ndarray:
        """Returns how well the family's eye saw every triangle at the start (#F, 0 to 1): 1 along the view."""
    def energy(self, target: Target | list[Target]) -> float:
        """Returns the energy that `solve` minimises, at the current heights; for several targets the sum of theirs."""
    def residual(self, target: Target) -> np.ndarray:
        """Returns |grad theta - target| of every triangle (#F), radians / length."""
    def score(self, length: float, family: int = 0) -> LineScore:
        """Scores the lines against their course without detail finer than `length`, over the triangles that can change."""
    def solve(self, target: Target | list[Target], *, strategy: Strategy = "adaptive", gradient_tolerance: float = 1e-6,
              max_iterations: int = 100, limit: float | np.ndarray | None = None, progress: Progress | None = None) -> Report:
        """Moves the heights to a minimum of the energy, from where they are. Not converging is no error: see
        Report.termination. A cancelled solve or one that raises SolverFailure leaves the heights as they were.

        `limit`: no vertex moves further along the view than this length from the heights the optimizer was built with, or,
        of #V x 2, beyond its lowest (<= 0) and highest (>= 0) move; infinity is no limit. It holds to the last bit, for
        `positions` too, until the next solve or a reset. The vertices of a cage's optimizer are those of its surface: the
        cage's own move as far as that allows, and those that would move vertices of limit 0 stay."""
    def watch(self, progress: Progress | None) -> None:
        """Reports the stages of smoothing and of the score to `progress`, and raises Cancelled there where it was cancelled.
        A solve has a progress of its own."""
    def scale_move(self, fraction: float) -> None:
        """Scales all moves from the heights that the optimizer was built with by a fraction between 0 and 1."""
    def keep_within(self, limit: float) -> int:
        """Scales all moves by the fraction that the limit is of the largest one, where that is beyond it; returns how many vertices
        were beyond it."""
    def reset(self) -> None:
        """Restores the heights that the optimizer was built with."""

class LineScore:
    """The score of lines: how far they are from their smooth course, in two numbers that can be checked on a picture."""
    shift: float  # mean over the area, degrees of theta: sideways shift within one length, at most 45 counts; with n lines
                  # round the circle it is n / 360 times as many distances of two lines
    turn: float   # mean along the lines, degrees in the image plane: angle between a line and its smooth course

class WorsePlace:
    """The place where lines got worse by most in one of the lights of a press; see native/include/reflines/smooth_panel.h."""
    light: int         # of the press; -1: there is none
    before: float      # degrees that lines are off their course there, in that light
    after: float
    place: np.ndarray  # 3, on the surface at the start

class HealedFlaws:
    """Tells what a press healed. The deviation of lines is how far they are from the course that they would have without flaws:
    degrees of theta, root mean square over a disk of a third of the length, in the light in which that is most."""
    area: float          # fraction of the region's area where lines deviated visibly and most of that went
    worst_before: float  # deviation of the worst place of the region
    worst_after: float
    mean_before: float   # likewise, root mean square over the healed area
    mean_after: float
    worse: WorsePlace
    worse_for_judges: WorsePlace  # likewise among the judges, lights with eyes that take no part in the press

class PressWork:
    """The work of a press, whose time it is: that of its smoother and its solves together."""
    factorizations: int
    solves: int  # with a factor, of one column

class SmoothPanelReport:
    """The report of `smooth_panel`."""
    solve: Report              # of the last solve
    work: PressWork            # of this press alone
    length: float              # the size of the flaws that was used
    limit: float               # no vertex moved further than this
    largest_move: float        # of the surface along the view direction
    largest_control_move: float  # of the vertices: those of a cage move further than its surface
    limited: int               # vertices that the limit holds back
    bumps: int                 # round dents and bumps that were taken away
    mirrored: int              # vertices of a symmetric panel; 0: it is not symmetric
    held_faces: int            # faces that would have turned by more than 45 degrees and were held instead
    longer_waves: bool         # waves longer than the flaws were left, which may be flaws, too: a press with twice the flaw_size
                               # takes them for flaws
    score_before: list[LineScore]  # one for each light, at `length`
    score_after: list[LineScore]
    unevenness_before: list[float]  # one for each light: how far the lines are from their smoothed selves within one
    unevenness_after: list[float]   # length, degrees, root mean square; creases are those of both shapes
    seen: list[float]          # one for each light: fraction of the panel's area that its eye sees; 1 along the view
    healed: HealedFlaws
    line_deviation: np.ndarray          # #F: how far the field of the light given is from its smoothed self in the shape that is returned,
                               # radians / length; by area its root mean square is the first unevenness over the length
    verdict: np.ndarray        # #F: 1 where flaws were healed, -1 where the surface counts as design and was kept, 0 where there was
                               # nothing to heal; between them by degree
    region: Region             # of the panel as it came
    flush_before: float        # by how much the flush is off its even course at most; 0 without `even_flush`
    flush_after: float
    applied: bool              # False: some light would have become worse, and nothing was moved
    notes: list[Note]          # the most important first

class LightSet:
    """The lights of one press, each with the eye that sees it: directions #lights x 3, those of eyes from the surface to the eye.
    Without eyes all are seen along the view. `weight` (#lights, 0 or more) is how much each counts where a limit or a cage keeps
    a press from the shape without flaws; all are judged alike. `blockers` (V, F) may hide the panel from an eye."""
    def __init__(self, line_directions: np.ndarray, eye_directions: np.ndarray | None = None, *,
                 weight: Sequence[float] = ..., blockers: tuple[np.ndarray, np.ndarray] | None = None) -> None: ...

class PanelSmoother:
    """Presses of Smooth on one panel, of which the second costs a tenth of the first: the flaws are found once.

    The arguments are those of smooth_panel and, of `create_for_cage`, of smooth_cage_panel, but for strength, limit, limit_range
    and progress, which each press has. It computes without the GIL, for one caller at a time: a second one gets InvalidInput."""
    def __init__(self, V: np.ndarray, F: np.ndarray, *, view_direction: Sequence[float], line_direction: Sequence[float],
                 border: Border | np.ndarray = "clamped", fixed: np.ndarray | None = None, partner: np.ndarray | None = None,
                 around: tuple[np.ndarray, np.ndarray] | None = None, face_of_triangle: np.ndarray | None = None,
                 fair_border: np.ndarray | None = None, parts_gap: float | None = None, lights: Literal["crossed", "single"] = "crossed",
                 light_set: LightSet | None = None, judges: LightSet | None = None, length: float | None = None, flaw_size: float = 1.0, symmetric: bool = True,
                 even_flush: bool = False) -> None: ...
    @staticmethod
    def create(V: np.ndarray, F: np.ndarray, *, view_direction: Sequence[float], line_direction: Sequence[float],
               border: Border | np.ndarray = "clamped", fixed: np.ndarray | None = None, partner: np.ndarray | None = None,
               around: tuple[np.ndarray, np.ndarray] | None = None, face_of_triangle: np.ndarray | None = None,
               fair_border: np.ndarray | None = None, parts_gap: float | None = None, lights: Literal["crossed", "single"] = "crossed",
               light_set: LightSet | None = None, judges: LightSet | None = None, length: float | None = None, flaw_size: float = 1.0, symmetric: bool = True,
               even_flush: bool = False) -> PanelSmoother:
        """Builds one as the constructor does; `start` runs it in the background."""
    @staticmethod
    def create_for_cage(V: np.ndarray, face_offsets: np.ndarray, face_vertices: np.ndarray, *,
                        view_direction: Sequence[float], line_direction: Sequence[float],
                        region: np.ndarray | None = None, border: Border | np.ndarray = "clamped",
                        fixed: np.ndarray | None = None, partner: np.ndarray | None = None,
                        image_of: np.ndarray | None = None, level: int = 2, scheme: Scheme = "catmull_clark",
                        boundary: Boundary = "all", creases: np.ndarray = ..., crease_sharpness: np.ndarray = ...,
                        corners: np.ndarray = ..., corner_sharpness: np.ndarray = ..., limit_surface: bool = True,
                        lights: Literal["crossed", "single"] = "crossed", light_set: LightSet | None = None, judges: LightSet | None = None, length: float | None = None,
                        flaw_size: float = 1.0, symmetric: bool = True) -> PanelSmoother: ...
    def press(self, *, strength: float = 1.0, limit: float | None = None, limit_range: np.ndarray | None = None,
              progress: Progress | None = None, judged: bool = True) -> tuple[np.ndarray, SmoothPanelReport]:
        """Presses the panel as it was given: returns what smooth_panel returns, bit for bit, whatever was pressed before.

        Not `judged`, the report has no measures of the result, and a light that became worse refuses nothing: for what a
        drag shows, at a tenth of the work where the strength alone has changed."""

class SolvePanelReport:
    """The report of `solve_panel`. Residuals are those of the first target, radians / length."""
    solve: Report              # of the last solve
    limited: int               # vertices that the limit holds back
    score_before: LineScore    # of the heights that the optimizer was built with
    score_after: LineScore
    residual_before: float     # root mean square by area and weight
    residual_after: float
    residual: np.ndarray       # #F
    falls_short: bool          # less than a fifth was reached of a target that is a visible change
    held_faces: int            # faces that would have turned by more than 45 degrees and were held instead
    turned_faces: int          # faces that turned so far all the same
    rim_bend: float            # by which the edges to the faces around bend more than before, at most, radians

def solve_panel(optimizer: ShapeOptimizer, targets: list[Target], *, length: float, limit: float,
                limit_range: np.ndarray | None = None, around: tuple[np.ndarray, np.ndarray] | None = None,
                most_bounded: int = 0, progress: Progress | None = None) -> SolvePanelReport:
    """Solves for a tool's targets from the optimizer's present heights, with the rules that hold for every tool: freely, and where
    a vertex moved beyond the limit again within it; where few faces turn by more than 45 degrees again with these held. Scores
    are taken at `length`; `limit_range` (#V x 2) has each vertex's fractions of the limit, `around` the faces that the rim is bent
    against. More than `most_bounded` unknowns (0: MOST_BOUNDED, of a cage MOST_BOUNDED_CAGE) have all moves scaled to the limit.

    Raises InvalidInput, SolverFailure; a cancelled solve leaves the heights and says so."""

def measure_residual(optimizer: ShapeOptimizer, target: Target) -> float:
    """Returns the root mean square of the residual over the triangles that can change, by area and the target's weight."""

class JointPanel:
    """One panel of several that are pressed as one problem: the arguments of smooth_panel, and of continue_over_gap what stays
    beside it. Border vertices with the code 5, "follow", follow the other panels and what stays; `around` tells where the border
    is open."""
    def __init__(self, V: np.ndarray, F: np.ndarray, *, view_direction: Sequence[float], line_direction: Sequence[float],
                 border: Border | np.ndarray = "follow", fixed: np.ndarray | None = None, partner: np.ndarray | None = None,
                 around: tuple[np.ndarray, np.ndarray] | None = None, face_of_triangle: np.ndarray | None = None,
                 lights: Literal["crossed", "single"] = "crossed", light_set: LightSet | None = None, judges: LightSet | None = None,
                 length: float | None = None, flaw_size: float = 1.0,
                 symmetric: bool = True, beside: tuple[np.ndarray, np.ndarray] | None = None, gap: float | None = None,
                 margin: float | None = None, even_flush: bool = False) -> None: ...
    @staticmethod
    def for_cage(V: np.ndarray, face_offsets: np.ndarray, face_vertices: np.ndarray, *,
                 view_direction: Sequence[float], line_direction: Sequence[float],
                 region: np.ndarray | None = None, border: Border | np.ndarray = "follow",
                 fixed: np.ndarray | None = None, partner: np.ndarray | None = None,
                 image_of: np.ndarray | None = None, level: int = 2, scheme: Scheme = "catmull_clark",
                 boundary: Boundary = "all", creases: np.ndarray = ..., crease_sharpness: np.ndarray = ...,
                 corners: np.ndarray = ..., corner_sharpness: np.ndarray = ..., limit_surface: bool = True,
                 lights: Literal["crossed", "single"] = "crossed", light_set: LightSet | None = None,
                 judges: LightSet | None = None, length: float | None = None, flaw_size: float = 1.0,
                 symmetric: bool = True, gap: float | None = None, margin: float | None = None) -> JointPanel:
        """Makes the panel of a cage, with the arguments of smooth_cage_panel. Its surface faces the other panels; what of its border
        faces none is clamped. It takes of its surface's move what it can, and as much as makes lines more even; the rims of meshes
        across follow it."""

class JointSmoother:
    """Presses of Smooth on several panels that face each other over gaps: lines are smoothed across as inside, and both sides of a
    gap move alike, so that it keeps its width and its step. The order of the panels does not matter. A panel that faces no other
    is pressed as smooth_panel does. Where a panel would have a worse place than before, all are pressed with a border that is
    clamped towards the others, and the reports' messages say so.

    Where both sides have `even_flush`, the flush (the step between the rims) is made even first, by half on each side: straight
    along a shut line from one end to the other, and constant around one that is closed."""
    def __init__(self, panels: Sequence[JointPanel]) -> None: ...
    @staticmethod
    def create(panels: Sequence[JointPanel]) -> JointSmoother:
        """Builds one as the constructor does; `start` runs it in the background."""
    def press(self, *, strengths: Sequence[float], limits: Sequence[float | None],
              limit_ranges: Sequence[np.ndarray | None],
              progress: Progress | None = None) -> list[tuple[np.ndarray, SmoothPanelReport]]:
        """Presses the panels as they were given, each by an amount of its own: returns what smooth_panel returns for each."""

def smooth_panel(V: np.ndarray, F: np.ndarray, *, view_direction: Sequence[float], line_direction: Sequence[float],
                 border: Border | np.ndarray = "clamped",           # or #V codes: 0 free, 1 fixed, 2 clamped, 3 curvature,
                                                                    # 4 flow, 5 follow
                 fixed: np.ndarray | None = None,                   # #V bool: held whatever the border says
                 partner: np.ndarray | None = None,                 # #V, as in ShapeOptimizer
                 around: tuple[np.ndarray, np.ndarray] | None = None,  # as in ShapeOptimizer
                 face_of_triangle: np.ndarray | None = None,        # #F, as in ShapeOptimizer
                 fair_border: np.ndarray | None = None,             # #V bool: border vertices that move, too, see below
                 parts_gap: float | None = None,  # widest between parts that no edge joins, which are smoothed as one; None: touching
                 lights: Literal["crossed", "single"] = "crossed",  # with the lines turned by 90 degrees, or without
                 light_set: LightSet | None = None,                 # takes the place of these; flaws are found as without it
                 judges: LightSet | None = None,                    # take no part; see HealedFlaws.worse_for_judges
                 length: float | None = None,                       # size of the flaws; None: the diagonal / 14 times flaw_size
                 flaw_size: float = 1.0,
                 strength: float = 1.0,                             # fraction of the move that is made, 0 to 1
                 limit: float | None = None,                        # largest move along the view; None: length / 20
                 limit_range: np.ndarray | None = None,             # #V x 2 fractions of it: lowest -1 to 0, highest 0 to 1
                 symmetric: bool = True,                            # what one half of a symmetric panel has alone is a flaw
                 even_flush: bool = False,                          # of parts that move with each other, see JointSmoother
                 progress: Progress | None = None) -> tuple[np.ndarray, SmoothPanelReport]:
    """Takes flaws (noise, ripples, dents) out of a panel and leaves its design alone: the whole press of Smooth, with all its
    automatic rules. Returns the positions (#V x 3; vertices that did not move carry the bits they came with) and a report.

    A border that is held keeps its flaws. Border vertices with `fair_border` move instead, as inner ones do: the press then takes
    in the faces of `around` within two lengths of the region, which stay, and everything is judged over the region alone. Of
    those faces the ones without area, doubled, at an edge of more than two, or not connected with the region are left out; where
    none are beside the border it is held, and the report's notes say so.

    With the borders "curvature" and "flow" the region is pressed with "clamped", too. That result is returned, and the report's
    notes say so, where lines would have ended less even than with it in some light, or nothing could have been changed.

    Raises InvalidInput, SolverFailure, and Cancelled where `progress` was cancelled."""

def smooth_cage_panel(V: np.ndarray, face_offsets: np.ndarray, face_vertices: np.ndarray, *,
                      view_direction: Sequence[float], line_direction: Sequence[float],
                      region: np.ndarray | None = None, border: Border | np.ndarray = "clamped", fixed: np.ndarray | None = None,
                      partner: np.ndarray | None = None, image_of: np.ndarray | None = None, level: int = 2,
                      scheme: Scheme = "catmull_clark",
                      boundary: Boundary = "all", creases: np.ndarray = ..., crease_sharpness: np.ndarray = ...,
                      corners: np.ndarray = ..., corner_sharpness: np.ndarray = ...,
                      limit_surface: bool = True,          # Subdivision's `limit`
                      lights: Literal["crossed", "single"] = "crossed", light_set: LightSet | None = None, judges: LightSet | None = None, length: float | None = None,
                      flaw_size: float = 1.0, strength: float = 1.0,
                      limit: float | None = None,          # largest move along the view, of the cage and so of its surface
                      limit_range: np.ndarray | None = None,  # #V x 2, of the cage
                      symmetric: bool = True,
                      progress: Progress | None = None) -> tuple[np.ndarray, SmoothPanelReport]:
    """Does what smooth_panel does for the cage of a subdivision surface: flaws are looked for in the surface, and the cage's
    vertices move. The arguments are those of CageOptimizer and smooth_panel. Returns the cage's positions (#V x 3)."""

class CheckRow:
    """One line of a check: the largest value along the seams, or the deviation."""
    name: str            # "border gap", "border angle", "border curvature", "crease angle", "crease curvature", "deviation",
                         # "deviation of 95 %"
    unit: str            # "length" (that of V), "degrees", "percent"
    before: float
    after: float
    mark: float | None   # of a crease that for the change
    passes: bool
    place: np.ndarray    # 3: where it is worst; of a line that is worse than before where it grew most
    change: str          # "better", "unchanged", "worse" against before, by more than the mark or across it: of the largest
                         # value, and of most seams
    better: int          # seams that are
    worse: int

class GapContinuation:
    """The result of `continue_over_gap`; see native/include/reflines/gap_continuation.h."""
    V: np.ndarray         # #S x 3: `around` of a press is (V, F)
    F: np.ndarray         # #G x 3: names the region's vertices by their numbers and those of V after them
    followed: np.ndarray  # #V bool: border vertices that can have the border "follow"
    gap: float            # the widest gap that was crossed
    width: np.ndarray     # #V: of the gap at followed vertices
    flush: np.ndarray     # #V: the step there, by which the other side is higher

AUTOMATIC_GAP: float  # relative to the diagonal

def continue_over_gap(V: np.ndarray, F: np.ndarray, V_beside: np.ndarray, F_beside: np.ndarray, *,
                      around: tuple[np.ndarray, np.ndarray] | None = None,  # the faces joined with the region
                      gap: float | None = None,    # the widest gap; None: AUTOMATIC_GAP times the diagonal
                      margin: float | None = None   # how far the surfaces are followed; None: the widest gap
                      ) -> GapContinuation:
    """Continues a region V (#V x 3), F (#F x 3) over the gap between its open border and the surfaces beside it. Raises
    InvalidInput."""

class PanelCheck:
    """The result of `check`; see native/include/reflines/check_panel.h."""
    edges: np.ndarray           # #E x 2: the seams
    kind: list[str]             # #E: "border", "crease", "open" (nothing on the other side: not judged)
    gap_before: np.ndarray      # #E, units of V
    gap_after: np.ndarray
    angle_before: np.ndarray    # #E, degrees
    angle_after: np.ndarray
    curvature_before: np.ndarray  # #E, percent
    curvature_after: np.ndarray
    passes: np.ndarray          # #E bool
    change: list[str]           # #E: "better", "unchanged", "worse" against before
    deviation: np.ndarray       # #V: distance from the surface before
    largest_deviation: float
    deviation_95: float         # not exceeded by 95 % of the region's vertices
    rows: list[CheckRow]
    all_pass: bool

def check(before: np.ndarray, after: np.ndarray, F: np.ndarray, region: np.ndarray, *, crease_rule: CreaseRule = "automatic",
          marked_creases: np.ndarray = ..., crease_angle: float = 0.5236, neighbor_distance: float = 0.1,
          gap: float = 2e-5,                # pass marks: in units of V, 0.02 mm where that is a metre;
          angle: float = 0.1,               # degrees;
          curvature: float = 5.0,           # percent;
          deviation: float | None = None    # in units of V
          ) -> PanelCheck:
    """Measures a changed panel: gap, angle and curvature along the borders and creases of the triangles `region` (#F bool) against
    their other side, before and after, with pass marks; and its distance from the surface before. `before` and `after` are #V x 3
    with the neighbours of the region (three rings or more), F #F x 3. Raises InvalidInput."""

class ShutMeasures:
    """The measures of the edges of shut lines (#E); see native/include/reflines/shut_lines.h."""
    gap: np.ndarray          # units of V
    flush: np.ndarray        # by how much the other side is higher, units of V
    kink: np.ndarray         # angle between the normals, degrees
    line_angle: np.ndarray   # by which lines turn, degrees
    line_offset: np.ndarray  # by which lines jump, percent of their spacing

class ShutLine:
    """A row of border edges across a gap from one surface."""
    label: int           # of what lies beside; -1: other faces of the same mesh
    edges: list[int]     # numbers in ShutLines.edges
    length: float
    rows: list[CheckRow]  # "smallest gap", "largest gap", "uneven gap", "lowest flush", "highest flush", "kink"; with
                          # directions "line angle", "line offset"

class ShutLines:
    """The result of `check_shut_lines`."""
    gap: float          # the widest that was looked for
    edges: np.ndarray   # #E x 2
    before: ShutMeasures
    after: ShutMeasures
    passes: np.ndarray  # #E bool
    change: list[str]   # #E: "better", "unchanged", "worse" against before
    list: list[ShutLine]

def check_shut_lines(before: np.ndarray, after: np.ndarray, F: np.ndarray, region: np.ndarray, V_beside: np.ndarray = ...,
                     F_beside: np.ndarray = ..., *, label: np.ndarray = ...,  # of each triangle beside
                     gap: float | None = None,       # the widest that counts; None: AUTOMATIC_GAP times the diagonal
                     view_direction: Sequence[float] | None = None,  # without them lines are not measured
                     line_direction: Sequence[float] | None = None,
                     spacing: float = 0.1,           # of the lines, radians of theta
                     uneven: float = 5e-4, flush: float = 5e-4, kink: float = 0.3, line_angle: float = 5.0,  # pass marks
                     line_offset: float = 2.0) -> ShutLines:
    """Measures gap and flush of the region's border towards what lies across a gap: triangles beside (#W x 3, #G x 3), and
    other faces of its own mesh. Raises InvalidInput as `check` does."""

class WorstSpot:
    """A connected place whose lines deviate by more than the noise floor."""
    place: np.ndarray        # 3: on the panel, where the lines deviate most
    size: float              # diameter of a disk with the area where they deviate by half of that or more
    degrees: float           # deviation there in the light and view that show it best
    height: float            # of the flaw over the reference surface along its normal: negative of a dent
    view: int                # those that show it best
    light: int
    front_light: int         # the one that shows it best from the first view
    triangles: list[int]     # those that deviate by half of that or more, ascending

class PanelInspection:
    """The result of `inspect_panel`; see native/include/reflines/inspect_panel.h."""
    length: float            # size of the flaws that were looked for
    degrees: np.ndarray      # #views x #lights: deviation, root mean square over the area that is seen
    seen: np.ndarray         # #views: fraction of the panel's area that is seen and not at a grazing angle
    deviation: np.ndarray    # #F: degrees, of each triangle in the light and view in which that is most
    view: np.ndarray         # #F: those
    light: np.ndarray        # #F
    height: np.ndarray       # #V: of the surface over the reference one along the first view
    maps: np.ndarray         # #F x #views #lights, float32, those of a view beside each other; empty without `maps`
    mean: float              # of `degrees`
    worst_view: int          # with the largest mean of its lights
    worst_light: int         # with the largest mean over its views
    spots: list[WorstSpot]   # the worst first

def inspect_panel(V: np.ndarray, F: np.ndarray, views: np.ndarray, lines: np.ndarray, *,
                  length: float | None = None,     # size of the flaws; automatic: a 14th of the diagonal times flaw_size
                  flaw_size: float = 1.0,
                  noise_floor: float = 0.1,        # degrees: places that deviate by less are no spots
                  most_spots: int = 100, maps: bool = False,
                  blockers: tuple[np.ndarray, np.ndarray] | None = None,  # V, F of what may hide the panel beside itself
                  pairs: np.ndarray | None = None,  # #views x #lights, bool: those that are looked at; None: all
                  progress: Progress | None = None) -> PanelInspection:
    """Tells how even the lines of a panel V (#V x 3), F (#F x 3) are from `views` (#views x 3, from the surface to the viewer; along
    the first the panel is a height field) in light lines of the directions `lines` (#lights x 3), and where its worst places are.
    Nothing is solved or moved. Triangles that are hidden from a view or seen at a grazing angle have no weight there. Raises
    InvalidInput, SolverFailure, Cancelled."""

def judge_change(before: np.ndarray, after: np.ndarray, F: np.ndarray, *, view_direction: Sequence[float], lights: LightSet,
                 length: float, progress: Progress | None = None) -> WorsePlace:
    """Finds where lines of the panel F (#F x 3) became worse by most in one of the lights, each with an eye, between positions
    (#V x 3) that differ along the view: see native/include/reflines/judge_change.h. Raises InvalidInput, SolverFailure, Cancelled."""

def judge_solve(optimizer: ShapeOptimizer, *, lights: LightSet, length: float, progress: Progress | None = None) -> WorsePlace:
    """Judges likewise what an optimizer's solves have changed."""

def walk_around(view_direction: Sequence[float], line_direction: Sequence[float],
                up: Sequence[float] = ...) -> tuple[np.ndarray, np.ndarray]:
    """Returns the views (5 x 3: the one given, from its left, its right, above and below) and light lines (8 x 3) of a walk around
    a panel, for inspect_panel. `up` is up in the picture. Raises InvalidInput."""

class CageOptimizer(ShapeOptimizer):
    """The optimizer of a region of a subdivision surface whose unknowns are the heights of its cage; see
    native/include/reflines/cage_optimizer.h. The surface, cut into triangles, is the region of ShapeOptimizer: every builder
    of targets takes it. Faces, creases, corners, scheme and boundary are those of Subdivision; `level` says how finely the
    surface is sampled.
    """
    cage_positions: np.ndarray  # #V x 3; vertices that did not move carry the bits they came with
    cage_free: np.ndarray       # #V bool
    triangles: np.ndarray       # #F x 3 of the region's vertices, those of `positions`
    parent: np.ndarray          # #F: the cage's face
    refined: np.ndarray         # #region vertices: which of Subdivision's refined vertices each is
    def __init__(self, V: np.ndarray, face_offsets: np.ndarray, face_vertices: np.ndarray, *,
                 view_direction: Sequence[float], line_direction: Sequence[float] | np.ndarray,
                 eye_directions: np.ndarray | None = None, blockers: tuple[np.ndarray, np.ndarray] | None = None,
                 region: np.ndarray | None = None,    # #faces bool: those that may change; default all
                 border: Border | np.ndarray = "clamped",  # of the region, on the surface: its limit position and tangents
                                                      # stay; or #V codes 0 free, 1 fixed, 2 clamped, see cage_border.h
                 fixed: np.ndarray | None = None,     # #V bool: held whatever the border says
                 partner: np.ndarray | None = None,   # #V of mirror_pairs, mutual, -1: none. Partners keep equal moves
                 image_of: np.ndarray | None = None,  # #faces: the one that each is the mirror image of, or its own
                                                      # number; counts take both for one
                 level: int = 2, scheme: Scheme = "catmull_clark", boundary: Boundary = "all",
                 creases: np.ndarray = ..., crease_sharpness: np.ndarray = ...,
                 corners: np.ndarray = ..., corner_sharpness: np.ndarray = ..., limit: bool = True,
                 sparse: bool = False,                # for drags: from level 3 on, the energy is sampled on few triangles
                 stencil: Stencil = "consistent", linear_solver: LinearSolver = "cholmod",
                 crease_rule: CreaseRule = "automatic", crease_angle: float = 1.0472,
                 proximity: float = -1.0,
                 bridge: np.ndarray = ...,            # #T x 3: triangles of the region's vertices over a gap, see
                 bridge_parent: np.ndarray = ...,     # #T: face of the cage    # CageBridge in cage_optimizer.h
                 left_out: np.ndarray | None = None,  # #F bool: triangles that they take the place of
                 progress: Progress | None = None) -> None: ...
    @staticmethod
    def create(*args: Any, **kwargs: Any) -> CageOptimizer:
        """Builds as the constructor does, from its arguments; `start` takes this function."""
    def fit(self, heights: np.ndarray, weight: np.ndarray) -> None:
        """Moves the cage so that its surface is nearest to these heights along the view (#region vertices), by least squares;
        `weight` is the area of each, 0 where there is none. Later solves are pulled to the heights."""

def mirror_pairs(V: np.ndarray, *, point: Sequence[float], normal: Sequence[float], tolerance: float) -> np.ndarray:
    """Returns the vertex at each one's mirror image: #V, itself on the plane, -1 where there is none."""

# Builders of targets. `family` says which light lines; `weight` (#F, >= 0) multiplies each triangle's term in the energy;
# `influence` (#F in [0, 1]) blends from the current field, 0 keeps it bit for bit. Directions and positions with two
# coordinates are in the image plane: (p @ optimizer.frame[0], p @ optimizer.frame[1]) of a world point or direction p.

def smooth(optimizer: ShapeOptimizer, *, length: float, strength: float = 1.0, directional: bool = False,
           family: int = 0, weight: np.ndarray | None = None) -> Target:
    """Builds the target of the current field without its detail finer than `length` (scene units); see
    native/src/reflection/line_smoother.h."""

def uniform(optimizer: ShapeOptimizer, *, direction: Sequence[float] = (0, 0), density: float = 1.0, relative: bool = True,
            density_end: float = -1.0, axis: Sequence[float] = (0, 0), influence: np.ndarray | None = None,
            weight: np.ndarray | None = None, family: int = 0) -> Target:
    """Builds the target of lines of one direction ((0, 0): that of the region's median) and density (a factor of the median's, or
    |grad theta| in radians / length); along `axis` the density goes linearly from density to density_end."""

def median_gradient(optimizer: ShapeOptimizer, *, family: int = 0) -> np.ndarray:
    """Returns the median of the region's field, by area (2): the gradient of the lines that `uniform` makes by itself."""

def turn(optimizer: ShapeOptimizer, *, angle: float = 0.0, density: float = 1.0, density_end: float = -1.0,
         axis: Sequence[float] = (0, 0), influence: np.ndarray | None = None, weight: np.ndarray | None = None,
         family: int = 0) -> Target:
    """Builds the target of the current gradients turned by `angle` radians, counter-clockwise in the image plane, and scaled by
    `density`, which goes linearly to `density_end` along `axis`; both times the influence."""

def keep(optimizer: ShapeOptimizer, *, family: int) -> Target:
    """Builds the target of the lines as they are, with a hundredth of the weight: solved for together with new lines of another
    family, it keeps those that cross them as far as these allow."""

def falloff(optimizer: ShapeOptimizer, *, centre: Sequence[float], radius: float, curve: np.ndarray) -> np.ndarray:
    """Returns the curve, tabulated at equal steps from 0 to radius, at each triangle's distance from `centre`: #F."""

def warp(optimizer: ShapeOptimizer, *, low: Sequence[float], high: Sequence[float], columns: int, rows: int,
         position: np.ndarray, by_value: bool = False, family: int = 0) -> tuple[Target, int]:
    """Builds the target of lines carried along by a map of the image plane: `position` ((rows + 1) * (columns + 1) x 2, x
    fastest) is where the nodes of a regular grid over low .. high go. Also returns the number of triangles that would show
    lines from outside the region."""

def pattern(optimizer: ShapeOptimizer, *, image: np.ndarray, strength: float = 1.0, blur: float = 0.0, keep: float = 1.0,
            centre: Sequence[float] = (0, 0), width: float = 1.0, angle: float = 0.0, by_value: bool = False,
            weight: np.ndarray | None = None, family: int = 0) -> Target:
    """Adds `strength` radians of theta between black and white of a grey image (#rows x #columns, first row at the bottom)
    to `keep` times the current lines; by value the target is theta itself (eq. 3), not only its gradient; see
    native/include/reflines/pattern_target.h."""

class Handle:
    """A place where a line is wanted. With a `value` (theta, radians) it pulls that line to a point or along a polyline; without
    one it is a pin: the lines at the point, along the polyline or in the triangles stay."""
    def __init__(self, points: np.ndarray = ...,            # #P x 2, in the image plane: a point or the corners of a polyline
                 *, value: float | None = None,
                 radius: float = 0.0,                       # of a pull: lines farther from `centre` stay
                 centre: np.ndarray | None = None,          # #C x 2, a point or polyline; default `points`
                 triangles: np.ndarray = ...,               # of a pin: triangles of the region
                 name: str = "") -> None: ...               # for messages

class HandleResidual:
    """The distance between a handle and its line at the farthest of its points; of a pin, the move of its lines."""
    theta: float     # radians
    distance: float  # along the surface, scene units
    fraction: float  # of the spacing of the lines

class LineHandles:
    """The builder of targets by handles, for a region as its lines are when this is made; see
    native/include/reflines/line_handles.h. Points that move within the same `centre` and `radius` take one back substitution.
    `falloff` (#V in [0, 1]) says where lines may follow the handles: 0 holds them, 1 lets them go."""
    def __init__(self, optimizer: ShapeOptimizer, *, family: int = 0, falloff: np.ndarray | None = None) -> None: ...
    @staticmethod
    def create(*args: Any, **kwargs: Any) -> LineHandles:
        """Builds as the constructor does, from its arguments; `start` takes this function."""
    def build(self, handles: Sequence[Handle]) -> list[Target]:
        """Builds the three targets to solve for together: the gradient's, that of the values around pulls and beyond the radii,
        and that of the values at the handles. Handles that change nothing give the lines at the start, bit for bit."""
    def find_conflicts(self, handles: Sequence[Handle]) -> list[str]:
        """Returns a sentence for each pair of pulls that forces lines to cross."""
    def read_theta(self, points: np.ndarray) -> np.ndarray:
        """Returns theta of the line through each point (#P x 2): #P, at the start."""
    def can_follow(self, points: np.ndarray) -> np.ndarray:
        """Returns whether the line at each point (#P x 2) can be laid elsewhere: #P bool; False beside a border that holds,
        and where no line can be read."""
    def measure(self, handles: Sequence[Handle], optimizer: ShapeOptimizer, *, line_step: float) -> list[HandleResidual]:
        """Measures at the optimizer's present heights; `line_step` is the step of theta from line to line, radians."""

class HandleFollower:
    """Follows handles without a solve, in a time that hardly depends on the size of the mesh; see
    native/include/reflines/handle_follower.h. `start` stays at its heights."""
    def __init__(self, start: ShapeOptimizer, lines: LineHandles) -> None: ...
    def follow(self, handles: Sequence[Handle], optimizer: ShapeOptimizer, *, keep_others: bool = True) -> bool:
        """Moves another optimizer of the region to where the lines meet the handles, by smooth motions. Returns False, and
        changes nothing, where the solve is to be used: cages, few vertices, very different radii, handles on several
        pieces."""

def handles(optimizer: ShapeOptimizer, handles: Sequence[Handle], *, family: int = 0,
            falloff: np.ndarray | None = None) -> list[Target]:
    """Builds the targets of handles on the present lines: LineHandles(optimizer, falloff=falloff).build(handles)."""

def vertex_theta(optimizer: ShapeOptimizer, *, family: int = 0) -> np.ndarray:
    """Returns theta at the vertices (#V), radians in (-pi, pi]; 0 where no active triangle is."""

def match_dense(optimizer: ShapeOptimizer, dense: ShapeOptimizer, *, family: int = 0
                ) -> tuple[Target, np.ndarray, np.ndarray, np.ndarray]:
    """Builds the target of another mesh's lines, with weight 0 where the view meets none of it. Also returns theta there
    (#F), its heights at the region's vertices (#V), and the area of each, the arguments of CageOptimizer.fit. Both have the
    same view and lines."""

def crease_edges(V: np.ndarray, F: np.ndarray, *, angle: float = 0.5236) -> np.ndarray:
    """Returns the edges (#E x 2) that crease_rule "automatic" finds. Raises InvalidInput for arrays that are no surface."""

def rasterize(points: np.ndarray, F: np.ndarray, *, width: int, height: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Draws triangles F (#F x 3) of points (#V x 3: pixels to the right and down, and nearness to the viewer). Returns for each
    pixel (height x width) the triangle that is seen, or -1, and the weights of its second and third corner. Raises InvalidInput."""

def split_at_creases(V: np.ndarray, F: np.ndarray, *, angle: float = 0.5236) -> tuple[np.ndarray, np.ndarray]:
    """Returns (F, vertex): the same triangles (#F x 3) of vertices that are split where edges bend by more than `angle`
    (radians), and the original of each (#S, the first #V themselves). Normals of V[vertex] are then those of each side of a
    crease."""

class NormalFit:
    """Vertex normals by a local quadratic fit (paper, section 3), with kept coefficients: cheap for new positions."""
    def __init__(self, V: np.ndarray, F: np.ndarray, *, refit_angle: float = 0.35) -> None: ...
    @staticmethod
    def create(*args: Any, **kwargs: Any) -> NormalFit:
        """Builds as the constructor does, from its arguments; `start` takes this function."""
    def normals(self, V: np.ndarray) -> np.ndarray:
        """Returns unit normals (#V x 3) for the positions V; vertices without a triangle get (0, 0, 1)."""
    def kept_normals(self, V: np.ndarray) -> np.ndarray:
        """Returns the normals by the present fits: changes nothing, so any number of threads may call it at once."""
    def copy(self) -> "NormalFit":
        """Returns an independent copy of the fit, with its kept coefficients."""

class Subdivision:
    """A cage under a Subdivision Surface, with the modifier's rules: refined vertices are a matrix S times the cage's
    vertices.

    Face f has the vertices face_vertices[face_offsets[f]:face_offsets[f + 1]]. Sharpness is 0 (smooth) to 10 (sharp): a
    crease c of Blender is 10 c^2. The first refined vertices are the cage's own in their order; see
    native/include/reflines/subdivision.h.
    """
    faces: np.ndarray        # #refined faces x 4 (loop: x 3)
    face_parent: np.ndarray  # #refined faces: the cage's face
    def __init__(self, face_offsets: np.ndarray, face_vertices: np.ndarray, *, vertices: int, level: int = 2,
                 scheme: Scheme = "catmull_clark", boundary: Boundary = "all",    # boundary: Blender's boundary_smooth
                 creases: np.ndarray = ..., crease_sharpness: np.ndarray = ...,   # #C x 2 vertices of edges, #C
                 corners: np.ndarray = ..., corner_sharpness: np.ndarray = ...,   # #K vertices, #K
                 limit: bool = True) -> None: ...                                 # on the limit surface, or refined only
    @staticmethod
    def create(*args: Any, **kwargs: Any) -> Subdivision:
        """Builds as the constructor does, from its arguments; `start` takes this function."""
    def positions(self, V: np.ndarray) -> np.ndarray:
        """Returns the refined vertices (#refined x 3) of a cage's (#V x 3)."""
    def normals(self, V: np.ndarray) -> np.ndarray:
        """Returns unit normals of the limit surface at the refined vertices (#refined x 3)."""
    def matrix(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Returns S as compressed rows: data, column indices, row starts."""

def image_plane(view_direction: Sequence[float], line_direction: Sequence[float]) -> np.ndarray:
    """Returns the rows a_perp, a_v, v (3 x 3). Raises InvalidInput where the two directions are parallel."""

def theta(normals: np.ndarray, view_direction: np.ndarray, line_direction: Sequence[float]) -> np.ndarray:
    """Returns theta (#N) of normals (#N x 3, any length but 0), radians in (-pi, pi]; view_direction is 3 or #N x 3."""

__version__: str
