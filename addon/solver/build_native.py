"""The native objects of a panel's problem: its optimizer, its smoother, and its part of a press of several."""
from collections.abc import Mapping

import numpy as np

from .. import native
from ..model.border import CODES, UNSET, needs_surroundings
from ..model.cage import Option
from ..model.joined_cage import JoinedCagePatch
from ..model.refusal import Refusal
from ..native_call import call
from .panel_problem import PanelProblem, choose_border, find_following, join_beside, join_surroundings, spread

# Arguments of reflines.PanelSmoother by their names.
PressSettings = Mapping[str, "str | float | bool"]
EdgeArguments = dict[str, "np.ndarray | tuple[np.ndarray, np.ndarray] | None"]


async def build_optimizer(problem: PanelProblem, border: str, progress: "native.Progress | None", *,
                          sparse: bool) -> "native.ShapeOptimizer":
    """Builds the native optimizer; `sparse` samples the surface of a cage more coarsely."""
    if problem.is_cage:
        return await call(
            native.reflines.CageOptimizer.create, **problem.patch.cage.build_arguments(problem.is_symmetric),
            **problem.directions, progress=progress, border=choose_border(problem, border), sparse=sparse,
            **problem.patch.creases.build_cage_arguments(), **choose_bridge(problem))
    return await call(
        native.reflines.ShapeOptimizer.create, problem.V, problem.F, **problem.directions, progress=progress,
        **choose_edges(problem, border), partner=problem.partner, face_of_triangle=repeat_faces(problem),
        **problem.patch.creases.build_arguments(problem.partner if problem.is_joined else None))


def choose_bridge(problem: PanelProblem) -> dict[str, np.ndarray]:
    """Returns what lies over the gaps between the surfaces of cages that are solved as one."""
    return problem.patch.bridge.build_arguments() if isinstance(problem.patch, JoinedCagePatch) else {}


async def build_smoother(problem: PanelProblem, border: str, settings: PressSettings, *,
                         fair: bool) -> "native.PanelSmoother":
    """Builds the native smoother, where `fair` with a border that moves, too; raises the module's errors."""
    if problem.is_cage:
        return await build_cage_smoother(problem, border, settings, fair=fair)
    beside = join_beside(problem)
    return await call(
        native.reflines.PanelSmoother.create, **choose_press_mesh(problem),
        parts_gap=None if beside is None or not find_following(problem, border).any() else beside.gap,
        **await choose_press_edges(problem, border, fair=fair), **settings)


async def build_cage_smoother(problem: PanelProblem, border: str, settings: PressSettings, *,
                              fair: bool) -> "native.PanelSmoother":
    if fair:
        raise Refusal(f"{problem.patch.name}: the border of a cage cannot be faired: switch Fair Border off, or solve "
                      "for the mesh")
    return await call(
        native.reflines.PanelSmoother.create_for_cage, **choose_cage_press(problem),
        border=choose_border(problem, border), **settings)


def choose_cage_press(problem: PanelProblem) -> dict[str, Option | np.ndarray | None]:
    """Returns the cage and the directions as arguments of the native presses."""
    arguments = problem.patch.cage.build_arguments(problem.is_symmetric)
    arguments["limit_surface"] = arguments.pop("limit")
    return {**arguments, **choose_press_directions(problem)}


def build_joint_panel(problem: PanelProblem, border: str, settings: PressSettings) -> "native.JointPanel":
    """Builds the panel of a press of several from a patch that follows what lies beside it; raises the module's errors.
    """
    codes = np.where(find_following(problem, border), CODES["follow"], choose_border(problem, border))
    if problem.is_cage:
        beside = problem.patch.beside
        return native.reflines.JointPanel.for_cage(
            **choose_cage_press(problem), border=codes, gap=beside.gap, margin=beside.margin, **settings)
    beside, around = join_beside(problem), join_surroundings(problem)
    return native.reflines.JointPanel(
        **choose_press_mesh(problem), border=codes, around=(around.V, around.F), beside=(beside.V, beside.F),
        gap=beside.gap, margin=beside.margin, **settings)


def choose_edges(problem: PanelProblem, border: str, *, fair: bool = False) -> EdgeArguments:
    """Returns what holds at the border as arguments of the native module; `fair` moves what has no border of its own in
    the native press.
    """
    codes = choose_border(problem, border)
    around = join_surroundings(problem) if fair or needs_surroundings(codes) else None
    edges = {"border": codes, "around": None if around is None else (around.V, around.F)}
    return {**edges, "fair_border": problem.border == UNSET} if fair else edges


async def choose_press_edges(problem: PanelProblem, border: str, *, fair: bool) -> EdgeArguments:
    """Returns what holds at the border as arguments of the native press. A border that is faired moves to where the
    joined faces beside it tell, and follows no others.
    """
    edges, beside = choose_edges(problem, border, fair=fair), join_beside(problem)
    if beside is None or fair:
        return edges
    joined = join_surroundings(problem)
    found = await call(native.reflines.continue_over_gap, problem.V, problem.F, beside.V, beside.F,
                       around=(joined.V, joined.F), gap=beside.gap, margin=beside.margin)
    follows = find_following(problem, border) & found.followed
    if not follows.any():
        return edges
    return {"border": np.where(follows, CODES["follow"], choose_border(problem, border)), "around": (found.V, found.F)}


def choose_press_mesh(problem: PanelProblem) -> dict[str, np.ndarray | None]:
    """Returns the mesh and the directions that the native press takes, with what of it stays and is alike, as its
    arguments.
    """
    return {"V": problem.V, "F": problem.F, "fixed": spread(problem, hold_marked_creases(problem), False),
            "partner": problem.partner, "face_of_triangle": repeat_faces(problem), **choose_press_directions(problem)}


def choose_press_directions(problem: PanelProblem) -> dict[str, np.ndarray]:
    """Returns the directions as arguments of the native presses, which add the crossed lines themselves."""
    return {"view_direction": problem.view.view_direction, "line_direction": problem.view.line_direction}


def hold_marked_creases(problem: PanelProblem) -> np.ndarray:
    """Returns which vertices of the patch the automatic press of Smooth holds: #V, bool. The automatic rule would take
    noise for creases, and the native press keeps by itself what bends.
    """
    held, creases = np.zeros(len(problem.patch.V), dtype=bool), problem.patch.creases
    if creases.rule != "none":
        held[creases.marked.ravel()] = True
    return held


def repeat_faces(problem: PanelProblem) -> np.ndarray:
    """Returns the mesh's face that each triangle of a mesh was cut from, or is the image of: #F."""
    return np.tile(problem.patch.face_of_triangle, 1 + problem.is_joined)
