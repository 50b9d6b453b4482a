"""The problem of one panel: all that the native solver takes for a patch that is seen in a view.

There are four kinds: the patch alone, a patch that is symmetric in itself, a patch joined with the image that a Mirror
modifier adds, and a cage. `pose_problem` decides once which one holds. `spread` takes values of the patch's vertices to
all that is solved; read_solved.py has the way back.
"""
from dataclasses import dataclass

import numpy as np

from .. import native
from ..model import mirror
from ..model.beside import Beside
from ..model.border import CODES, UNSET
from ..model.cage import CagePatch
from ..model.patch import Patch
from ..model.surroundings import Surroundings, join_images
from ..model.view import View


@dataclass(frozen=True)
class PanelProblem:
    """The vertices, triangles and conditions that are solved for a patch, in world space."""
    patch: Patch
    view: View
    V: np.ndarray                # #V x 3: the patch's vertices, and after them those of its image; or those of the cage
    F: np.ndarray                # #F x 3, likewise; of a cage those of the patch
    source: np.ndarray           # #V: the vertex of the patch that each one is, or is the image of; -1: neither
    border: np.ndarray           # #V: codes of the vertices that have a border of their own, border.UNSET for others
    partner: np.ndarray | None   # #V: mirror images, which keep equal moves; None where no symmetry is kept
    sign: np.ndarray | None      # 3: signs of an object-space vector's components after mirroring; None likewise
    is_joined: bool = False      # whether the image of the patch stands after it

    @property
    def is_cage(self) -> bool:
        """True where the vertices are those of a cage."""
        return isinstance(self.patch, CagePatch)

    @property
    def is_symmetric(self) -> bool:
        """True where the solve keeps the symmetry of the patch."""
        return self.sign is not None

    @property
    def image_sign(self) -> np.ndarray | None:
        """The signs of mirroring where targets must have both halves; None where there is one half, or complete_target
        adds the other.
        """
        return None if self.is_joined else self.sign

    @property
    def directions(self) -> "dict[str, np.ndarray | tuple[np.ndarray, np.ndarray] | None]":
        """The directions as arguments of the native constructors: the lines', and those that cross them, or those of a
        set of lights with their eyes.
        """
        families = self.view.families
        if families is None:
            return {"view_direction": self.view.view_direction, "line_direction": self.view.both_directions}
        return {"view_direction": self.view.view_direction, "line_direction": families.lines,
                "eye_directions": families.eyes, "blockers": families.blockers}

    @property
    def limit_range(self) -> np.ndarray | None:
        """The range of each vertex's move, as fractions of the limit: #V x 2; None: the whole limit.
        """
        own = self.patch.limit_range
        return None if own is None else spread(self, own, np.array([-1.0, 1.0]))


def spread(problem: PanelProblem, values: np.ndarray, otherwise: float | np.ndarray) -> np.ndarray:
    """Returns values of the patch's vertices for all that is solved, and another one for what is none of them."""
    source = problem.source.reshape(-1, *[1] * (values.ndim - 1))
    return np.where(source >= 0, values[problem.source], otherwise)


def pose_problem(patch: Patch, view: View) -> PanelProblem:
    """Poses the problem of a patch: by its kind, and by whether view and light are symmetric about its plane."""
    if isinstance(patch, CagePatch):
        return pose_cage(patch, view)
    plane = patch.mirror
    if plane is None or not plane.is_whole or not mirror.is_symmetric_setup(
            plane, patch.matrix, view.view_direction, view.line_direction):
        return pose_alone(patch, view)
    if plane.image:
        return pose_joined(patch, view)
    return PanelProblem(patch, view, patch.V, patch.F, np.arange(len(patch.V)), patch.border, plane.partner, plane.sign)


def pose_alone(patch: Patch, view: View) -> PanelProblem:
    """Poses the patch alone. Below a Mirror modifier its seam is clamped, so that both halves join smoothly."""
    border = patch.border
    if patch.mirror is not None and patch.mirror.image:
        border = np.where(patch.mirror.seam, CODES["clamped"], border)
    return PanelProblem(patch, view, patch.V, patch.F, np.arange(len(patch.V)), border, None, None)


def pose_joined(patch: Patch, view: View) -> PanelProblem:
    """Poses a patch joined along the seam with the image that a Mirror modifier adds."""
    local, F, partner = mirror.join_with_image(patch.mirror, patch.local, patch.F)
    source = np.append(np.arange(len(patch.V)), partner[len(patch.V):])
    return PanelProblem(patch, view, patch.to_world(local), F, source, patch.border[source], partner, patch.mirror.sign,
                        is_joined=True)


def pose_cage(patch: CagePatch, view: View) -> PanelProblem:
    """Poses a cage, whose vertices are the unknowns; symmetric where moves along the view keep it so. The image that a
    Mirror modifier adds has the border of the mesh's own half. Where no symmetry is kept the seam is clamped, as that
    of a mesh is: moved along an oblique view it would leave its plane.
    """
    cage, symmetric = patch.cage, patch.is_symmetric_for(view.view_direction)
    source, image = np.full(len(cage.V), -1), cage.partner[patch.index]
    source[image[image >= 0]] = np.flatnonzero(image >= 0)
    source[patch.index] = np.arange(len(patch.index))
    border = np.where(source >= 0, patch.border[source], UNSET)
    if not symmetric and cage.own_faces < len(cage.sizes):
        border[cage.partner == np.arange(len(cage.V))] = CODES["clamped"]
    sign = np.where(np.arange(3) == patch.mirror_axis, -1.0, 1.0) if symmetric else None
    return PanelProblem(patch, view, cage.V, patch.F, source, border, cage.partner if symmetric else None, sign)


def choose_border(problem: PanelProblem, border: str) -> np.ndarray:
    """Returns the border's codes for each vertex of all that is solved (#V), with the given one where a vertex has none
    of its own: clamped where it would follow its neighbours, which the automatic press of Smooth alone does.
    """
    if border not in CODES:  # a changed file may hold any
        raise native.InvalidInput(f"There is no border named '{border}'; choose one of {', '.join(sorted(CODES))}.")
    codes = np.where(problem.border == UNSET, CODES[border], problem.border)
    return np.where(codes == CODES["follow"], CODES["clamped"], codes)


def find_following(problem: PanelProblem, border: str) -> np.ndarray:
    """Returns which vertices are to follow what lies beside them: #V, bool."""
    return np.where(problem.border == UNSET, CODES[border], problem.border) == CODES["follow"]


def join_surroundings(problem: PanelProblem) -> Surroundings:
    """Returns the surroundings of all that is solved."""
    patch, around, own = problem.patch, problem.patch.around, len(problem.patch.V)
    if not problem.is_joined:
        return around
    seam = mirror.find_seam(patch.mirror, patch.to_local(around.V))
    return join_images(around, patch.mirror_points(around.V), seam, own, problem.partner[:own], len(problem.V))


def join_beside(problem: PanelProblem) -> Beside | None:
    """Returns what the border of all that is solved can follow."""
    patch, beside = problem.patch, problem.patch.beside
    return beside if beside is None or not problem.is_joined else beside.add_image(patch.mirror_points(beside.V))
