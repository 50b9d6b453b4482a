"""The target that a cage is fitted to: lines and heights of another, dense mesh."""
from dataclasses import dataclass, field

import numpy as np

from .. import native
from ..native_call import call

COVERED = 0.5  # least fraction of the patch's area that lies over the dense mesh


@dataclass(frozen=True)
class DenseMesh:
    """A triangle mesh in world space."""
    name: str
    V: np.ndarray  # #V x 3
    F: np.ndarray  # #F x 3


@dataclass(frozen=True)
class Misfit:
    """Distances of a surface from the dense mesh where both overlap: along the view in world units, and of theta in
    radians.
    """
    mean: float     # root mean square
    largest: float
    angle: float    # root mean square


@dataclass
class Fit:
    """Builds the target of the dense mesh's lines, and first fits the optimizer's heights to its own by least squares.
    """
    dense: DenseMesh
    view_direction: np.ndarray
    line_direction: np.ndarray
    match: "tuple[native.Target, np.ndarray, np.ndarray, np.ndarray] | None" = field(default=None, init=False)
    optimizer: "native.CageOptimizer | None" = field(default=None, init=False)
    before: Misfit | None = field(default=None, init=False)

    async def __call__(self, optimizer: "native.CageOptimizer") -> "native.Target":
        self.optimizer = optimizer
        try:
            dense = await call(native.reflines.ShapeOptimizer.create, self.dense.V, self.dense.F,
                               view_direction=self.view_direction, line_direction=self.line_direction, border="free")
        except native.InvalidInput as error:
            raise native.InvalidInput(f"{self.dense.name}: {error}") from error
        target, _, heights, weight = self.match = await call(native.reflines.match_dense, optimizer, dense)
        covered = float(optimizer.area @ (target.weight > 0.0) / max(optimizer.area.sum(), 1e-300))
        if covered < COVERED:
            raise native.InvalidInput(f"Seen by the view camera, {self.dense.name} covers {covered:.0%} of the panel "
                                      "only: move it there, or select the faces that it covers")
        self.before = self.misfit()
        await call(optimizer.fit, heights, weight)
        return target

    def misfit(self) -> Misfit:
        """Measures the optimizer's present surface against the dense mesh."""
        target, theta, heights, weight = self.match
        apart = (self.optimizer.heights - heights)[weight > 0.0]
        turned = (self.optimizer.theta() - theta + np.pi) % (2.0 * np.pi) - np.pi
        area = self.optimizer.area * (target.weight > 0.0)
        return Misfit(float(np.sqrt(np.average(apart**2, weights=weight[weight > 0.0]))), float(np.abs(apart).max()),
                      float(np.sqrt(np.average(turned**2, weights=area))))
