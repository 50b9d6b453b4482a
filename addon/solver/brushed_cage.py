"""Dabs of Fair Brush on a cage: its vertices within the circle move until the lines of its surface are smoother."""
from dataclasses import replace

import numpy as np

from .. import native
from ..model.cage import Cage, CagePatch
from ..model.patch import Patch
from ..model.view import View
from . import live_optimizer
from .brush import TOLERANCE, Brush, BrushedPatch, BrushedRegion, build_dab_target
from .panel_problem import choose_border, pose_cage

PICK_LEVEL = 1  # of the surface on which the mouse is found
CONTEXT = 0.8  # of the radius: what the filter sees beyond the circle; with 0.25 moves differ by 4 %, with 0.8 by 0.7 %
# The surface is sampled at two levels where the window has at most so many faces, and at one where it has more, which
# makes moves differ by 2 to 4 %. A dab with this context takes 40 ms, with 0.25 and 110 faces it took 25.
MOST_FACES = 250
MOST_HOLDS = 3  # times that vertices which the limit stops are held there and the rest is solved again


class BrushedCage(BrushedRegion):
    """A cage under a brush. Vertices outside the circle stay; the surface changes up to two faces beyond it, as with
    every move of a vertex.
    """

    def __init__(self, patch: CagePatch, view: View, border: str) -> None:
        """Takes the border of the region, which holds below the brush, too."""
        problem = pose_cage(patch, view)
        self.patch, self.cage, self.problem = patch, patch.cage, problem
        self.border = choose_border(problem, border)
        self.region = self.cage.build_arguments(problem.is_symmetric)["region"]
        self.inside = self.cage.find_vertices(self.region)
        partner = np.where(self.cage.partner < 0, np.arange(len(self.cage.V)), self.cage.partner)
        super().__init__(self.cage.V, live_optimizer.compute_image_frame(patch, view), problem.limit_range,
                         partner if problem.is_symmetric else None)

    @property
    def positions(self) -> np.ndarray:
        """The present positions of the patch: #V x 3, world space."""
        return self.moved[self.patch.index]

    @property
    def surface(self) -> tuple[np.ndarray, np.ndarray]:
        """The surface at the start of the stroke, on which the mouse is found: vertices and triangles. Refuses cages
        that cannot be subdivided.
        """
        arguments = {**self.cage.build_topology_arguments(), "level": PICK_LEVEL}
        with live_optimizer.convert_native_errors(self.patch):
            refined = native.reflines.Subdivision(**arguments, vertices=len(self.cage.V))
        quads = refined.faces[self.region[refined.face_parent]]
        return refined.positions(self.cage.V), np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])

    def solve(self, place: np.ndarray, brush: Brush) -> tuple[np.ndarray, np.ndarray] | None:
        found = self.cut_window(place, brush.radius, self.move)
        if found is None:
            return None
        return found[1], self.solve_window(*found, place, brush)

    def build_around(self, place: np.ndarray, radius: float, move: np.ndarray) -> "native.CageOptimizer | None":
        found = self.cut_window(place, radius, move)
        return None if found is None else self.build_window(*found)

    def cut_window(self, place: np.ndarray, radius: float,
                   move: np.ndarray) -> tuple[Cage, np.ndarray, np.ndarray] | None:
        """Cuts out the cage around a circle with its vertices moved by `move` (#V): the part, its vertices, and which
        of them are free; None where none is.
        """
        apart = np.linalg.norm(self.xy - place, axis=1)
        free = (apart < radius) & self.inside
        if not free.any():
            return None
        whole = replace(self.cage, V=self.start + move[:, None] * self.frame[2])
        cage, vertices = whole.cut_out(self.choose_window(free, apart, radius))
        return cage, vertices, free[vertices]

    def choose_window(self, free: np.ndarray, apart: np.ndarray, radius: float) -> np.ndarray:
        """Returns the region's faces that are solved for: those whose surface depends on a free vertex, and some more
        that the filter sees.
        """
        depending = self.cage.find_faces(self.cage.find_vertices(self.cage.find_faces(free)))
        return self.region & (depending | self.cage.find_faces(apart < (1.0 + CONTEXT) * radius))

    def solve_window(self, cage: Cage, vertices: np.ndarray, free: np.ndarray, place: np.ndarray,
                     brush: Brush) -> np.ndarray:
        """Solves for smooth lines in a window of the cage; returns the further moves of its vertices. Those that come
        to the limit are held there, and the rest is solved again.
        """
        before, ranges = self.move[vertices], brush.limit * self.limit_range[vertices]
        move, targets = np.zeros(len(vertices)), None
        for _ in range(MOST_HOLDS):
            optimizer = self.build_window(replace(cage, V=cage.V + move[:, None] * self.frame[2]), vertices, free)
            targets = targets or [build_dab_target(optimizer, place, brush, each) for each in range(brush.families)]
            optimizer.solve(targets, gradient_tolerance=TOLERANCE)
            found = (optimizer.cage_positions - cage.V) @ self.frame[2]
            move = np.clip(before + found, *ranges.T) - before
            reached = free & (move != found)
            free = free & ~reached
            if not reached.any() or not free.any():
                break
            move = np.where(free, 0.0, move)
        return move

    def build_window(self, cage: Cage, vertices: np.ndarray, free: np.ndarray) -> "native.CageOptimizer":
        """Builds the optimizer of a window, whose free vertices alone move."""
        arguments = cage.build_arguments(symmetric=False)
        arguments["level"] = 2 if np.count_nonzero(cage.region) <= MOST_FACES else 1
        return native.reflines.CageOptimizer(**arguments, **self.problem.directions,
                                             border=self.border[vertices], fixed=~free,
                                             **self.patch.creases.build_cage_arguments())


def take_under_brush(patch: Patch, view: View, border: str) -> BrushedPatch | BrushedCage:
    """Takes a patch under the brush, as a mesh or as a cage."""
    return (BrushedCage if isinstance(patch, CagePatch) else BrushedPatch)(patch, view, border)
