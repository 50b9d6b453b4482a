"""Creases: the edges of a patch that are held, so that the lines are solved separately on each side of them."""
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Creases:
    """The artist's choice: the rule by its native name, and the edges that are marked."""
    rule: str           # "automatic", "marked" or "none"
    marked: np.ndarray  # #M x 2, vertices of the patch

    def build_arguments(self, image: np.ndarray | None = None) -> dict[str, str | np.ndarray]:
        """Builds the arguments of reflines.ShapeOptimizer; `image` (#V) adds the edges of the mirror image."""
        marked = self.marked if image is None else np.concatenate([self.marked, image[self.marked]])
        return {"crease_rule": self.rule, "marked_creases": marked}

    def build_cage_arguments(self) -> dict[str, str]:
        """Builds the arguments of reflines.CageOptimizer, cut where its surface bends at the cage's own creases,
        whatever else is marked.
        """
        return {"crease_rule": "none" if self.rule == "none" else "automatic"}


AUTOMATIC = Creases("automatic", np.empty((0, 2), dtype=np.int64))
