"""The vertices and edges of a mesh in Edit Mode as arrays, to be drawn over the stripes."""
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class EditCage:
    """The visible vertices and edges, and which of them are selected."""
    V: np.ndarray               # #V x 3, object space
    vertices: np.ndarray        # the visible ones
    edges: np.ndarray           # #E x 2: the visible ones
    vertex_selected: np.ndarray  # #V, bool
    edge_selected: np.ndarray    # #E, bool

    def measure_edge(self) -> float:
        """Returns the mean length of the edges; 0 where there are none."""
        ends = self.V[self.edges]
        return float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).mean()) if len(ends) else 0.0
