"""Remarks: sentences about a finished solve that the artist should read."""
import numpy as np

from ..model import mirror
from ..model.patch import Patch
from .formulation import Formulation

FAR_MOVE = 0.05  # relative to the patch's diagonal; larger moves are mentioned
TURNED = np.radians(45.0)  # radians; triangles that turn further are mentioned


def describe_mirror(formulation: Formulation) -> tuple[str, ...]:
    """Describes why a region with Mirror X was not solved symmetrically."""
    plane = formulation.patch.mirror
    return () if plane is None else mirror.describe_asymmetry(plane, formulation.is_symmetric)


def describe_marked_creases(patch: Patch) -> tuple[str, ...]:
    """Says how many marked edges the automatic press of Smooth holds."""
    count = 0 if patch.creases.rule == "none" else len(patch.creases.marked)
    return (f"{count} edge{'s are' if count > 1 else ' is'} marked as creases; held",) if count else ()


def describe_small_share(reached: float, border: str) -> tuple[str, ...]:
    """Describes why only a part of the target was reached: a held border keeps the mean of the gradient across it."""
    why = ("no smooth surface has such lines here: ask for less, or over a larger radius" if border == "free" else
           f"the border {border.capitalize()} keeps the lines' mean")
    return (f"Only {max(reached, 0.0):.0%} of the target was reached: {why}",)


def describe_far_move(patch: Patch, move: float, border: str) -> tuple[str, ...]:
    """Warns where vertices moved by more than FAR_MOVE of the patch's diagonal."""
    if move <= FAR_MOVE * patch.diagonal:
        return ()
    remedy = "less strength" if border == "clamped" else "less strength, or the border Clamped,"
    return (f"Vertices move by up to {move / patch.diagonal:.0%} of the panel's size: the lines asked for are far from "
            f"those of its shape; {remedy} keeps it nearer",)


def describe_turned_faces(patch: Patch, positions: np.ndarray) -> tuple[str, ...]:
    """Warns where triangles turned by more than TURNED: a move along the view slides a steep face over its neighbour.
    """
    before, after = compute_unit_normals(patch.V, patch.F), compute_unit_normals(positions, patch.F)
    count = int(np.count_nonzero((before * after).sum(axis=1) < np.cos(TURNED)))
    if count == 0:
        return ()
    return (f"{count} triangle{'s turn' if count > 1 else ' turns'} by more than {np.degrees(TURNED):.0f} degrees: "
            "deselect the faces that the view sees at a slant, or turn the view camera towards them",)


def compute_unit_normals(V: np.ndarray, F: np.ndarray) -> np.ndarray:
    """Returns the unit normals of triangles: #F x 3; zero where a triangle has no area."""
    a, b, c = V[F[:, 0]], V[F[:, 1]], V[F[:, 2]]
    normals = np.cross(b - a, c - a)
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
