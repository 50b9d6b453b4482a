"""Remarks: sentences about a finished solve that the artist should read."""
import numpy as np

from ..model import mirror
from ..model.border import CODES, NAMES
from ..model.patch import Patch
from ..model.solution import SolveReport
from .panel_problem import PanelProblem

FAR_MOVE = 0.05  # relative to the patch's diagonal; larger moves are mentioned


def describe_mirror(problem: PanelProblem) -> tuple[str, ...]:
    """Describes why a region with Mirror X was not solved symmetrically."""
    plane = problem.patch.mirror
    return () if plane is None else mirror.describe_asymmetry(plane, problem.is_symmetric)


def describe_marked_creases(patch: Patch) -> tuple[str, ...]:
    """Says how many marked edges the automatic press of Smooth holds."""
    count = 0 if patch.creases.rule == "none" else len(patch.creases.marked)
    return (f"{count} edge{'s are' if count > 1 else ' is'} marked as creases; held",) if count else ()


def describe_shortfall(reached: float, border: str) -> tuple[str, ...]:
    """Describes why only a part of the target was reached: a held border keeps the mean of the gradient across it."""
    why = ("no smooth surface has such lines here: ask for less, or over a larger radius" if border == "free" else
           f"the border {NAMES[border]} keeps the lines' mean")
    return (f"Only {max(reached, 0.0):.0%} of the target was reached: {why}",)


def describe_bent_rim(bend: float) -> tuple[str, ...]:
    """Warns where the rim of the region bends by more than before, and says what to press."""
    return (f"The border of the region bends by up to {np.degrees(bend):.1f} degrees more against the faces beside it: "
            f"with the border {NAMES['clamped']} it keeps its tangents",) if bend else ()


def describe_far_move(patch: Patch, move: float, border: str) -> tuple[str, ...]:
    """Warns where vertices moved by more than FAR_MOVE of the patch's diagonal."""
    if move <= FAR_MOVE * patch.diagonal:
        return ()
    milder = "less strength"
    remedy = milder if CODES[border] >= CODES["clamped"] else f"{milder}, or the border {NAMES['clamped']},"
    return (f"Vertices move by up to {move / patch.diagonal:.0%} of the panel's size: the lines asked for are far from "
            f"those of its shape; {remedy} keeps it nearer",)


def describe_limit(limited: int, limit: float, *, automatic: bool) -> tuple[str, ...]:
    """Says that the limit of the move held vertices back, and what to press."""
    if not limited:
        return ()
    own = "automatic limit" if automatic else "limit"
    return (f"The {own} holds {limited} {'vertices' if limited > 1 else 'vertex'} back: ask for less, or raise Limit",)


def describe_unfinished(report: SolveReport) -> tuple[str, ...]:
    """Says that a solve stopped before its end, and what to press."""
    finished = report.termination in {"converged", "already_optimal", "cancelled"}
    return () if finished else ("The solver stopped before its end: ask for less, or select less",)


def describe_held_faces(count: int) -> tuple[str, ...]:
    """Says how many faces were held since they would have turned far."""
    return (f"{count} face{'s' if count > 1 else ''} seen at a slant stayed: they would have turned by more than "
            "45 degrees",) if count else ()


def describe_turned_faces(count: int) -> tuple[str, ...]:
    """Warns where faces turned by more than 45 degrees all the same."""
    if count == 0:
        return ()
    return (f"{count} face{'s turn' if count > 1 else ' turns'} by more than 45 degrees: "
            "deselect the faces that the view sees at a slant, or turn the view camera towards them",)
