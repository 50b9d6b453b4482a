"""The inspection of a panel in the lights and from the views of a walk around it."""
from dataclasses import dataclass

import numpy as np

from .. import native
from ..model.checked_surface import CheckedSurface
from ..model.inspection import VIEWS, Inspection, Spot
from ..model.view import View
from ..native_call import call

LEAST_SEEN = 0.05  # share of the panel: a view that sees less of it does not tell of it


@dataclass(frozen=True)
class Inspected:
    """The input of an inspection, in world space."""
    surface: CheckedSurface
    seen: View
    up: np.ndarray  # 3, in the picture


async def inspect_surface(wanted: Inspected, flaw_size: float, noise_floor: float,
                          progress: "native.Progress | None" = None) -> Inspection:
    """Inspects the region of a surface; all else of the surface may hide it. Raises the native module's errors."""
    surface = wanted.surface
    views, lines = native.reflines.walk_around(wanted.seen.view_direction, wanted.seen.line_direction, wanted.up)
    found = await call(native.reflines.inspect_panel, surface.after, surface.F[surface.region], views, lines,
                       flaw_size=flaw_size, noise_floor=noise_floor, blockers=choose_blockers(surface),
                       progress=progress)
    spots = tuple(Spot(tuple(spot.place.tolist()), spot.size, spot.degrees, spot.height, VIEWS[spot.view], spot.light,
                       tuple(lines[spot.front_light].tolist())) for spot in found.spots)
    unseen = tuple(name for name, share in zip(VIEWS, found.seen, strict=True) if share < LEAST_SEEN)
    return Inspection(spots, found.mean, VIEWS[found.worst_view], found.worst_light, unseen)


def choose_blockers(surface: CheckedSurface) -> tuple[np.ndarray, np.ndarray] | None:
    """Returns the vertices and triangles beside the region whose coordinates are finite; None where there are none."""
    finite = np.isfinite(surface.after).all(axis=1)
    F = surface.F[~surface.region]
    F = F[finite[F].all(axis=1)]
    if not len(F):
        return None
    used, corners = np.unique(F, return_inverse=True)
    return surface.after[used], corners.reshape(-1, 3)
