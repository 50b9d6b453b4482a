"""The inspection of a panel in the lights and from the views of a walk around it."""
from dataclasses import dataclass
from functools import partial

import numpy as np

from .. import native
from ..model.inspection import VIEWS, Inspection, Spot
from ..model.light_set import LightSet
from ..model.patch import Patch
from ..model.surface import CheckedSurface
from ..model.view import View
from ..native_call import call

NOISE_FLOOR = 0.1  # degrees: places whose lines deviate by less are not listed
LEAST_SEEN = 0.05  # fraction of the panel: a view that sees less of it does not tell of it


@dataclass(frozen=True)
class Inspected:
    """The input of an inspection, in world space."""
    surface: CheckedSurface
    seen: View
    up: np.ndarray      # 3, in the picture
    patch: Patch        # of the panel
    light_set: LightSet | None = None  # takes the place of the walk around


class Pairs:
    """The pairs of a view and a light that a set of lights has, without what is there twice; the first view is the view
    camera's, along which the panel is a height field.
    """

    def __init__(self, wanted: Inspected) -> None:
        self.lights = wanted.light_set.lights
        self.eyes = [light.find_eye(wanted.patch.center) for light in self.lights]
        self.views, view = find_unique(np.array([wanted.seen.view_direction, *self.eyes]))
        self.lines, line = find_unique(np.array([light.line for light in self.lights]))
        self.light: dict[tuple[int, int], int] = {}
        for index, pair in enumerate(zip(view[1:].tolist(), line.tolist(), strict=True)):
            self.light.setdefault(pair, index)
        self.mask = np.zeros((len(self.views), len(self.lines)), dtype=bool)
        self.mask[tuple(np.array(list(self.light)).T)] = True

    def make_spot(self, spot: "native.WorstSpot") -> Spot:
        index = self.light[spot.view, spot.light]
        return Spot(tuple(spot.place.tolist()), spot.size, spot.degrees, spot.height, self.lights[index].name, index,
                    self.lights[index].line, tuple(self.eyes[index].tolist()))

    def read(self, found: "native.PanelInspection") -> Inspection:
        worst = max(self.light, key=lambda pair: found.degrees[pair])
        unseen = tuple(self.lights[index].name for (view, _), index in self.light.items()
                       if found.seen[view] < LEAST_SEEN)
        return Inspection(tuple(self.make_spot(spot) for spot in found.spots), found.mean,
                          f"in {self.lights[self.light[worst]].name}", unseen)


def find_unique(directions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the directions (#D x 3) without repetitions, in their order, and the number of each among them."""
    _, first, number = np.unique(directions, axis=0, return_index=True, return_inverse=True)
    order = np.argsort(first)
    return directions[first[order]], np.argsort(order)[number.ravel()]


async def inspect_surface(wanted: Inspected, progress: "native.Progress | None" = None) -> Inspection:
    """Inspects the region of a surface; all else of the surface may hide it. Raises the native module's errors."""
    surface = wanted.surface
    look = partial(call, native.reflines.inspect_panel, surface.after, surface.F[surface.region], flaw_size=1.0,
                   noise_floor=NOISE_FLOOR, blockers=choose_blockers(surface), progress=progress)
    if wanted.light_set is not None:
        pairs = Pairs(wanted)
        return pairs.read(await look(views=pairs.views, lines=pairs.lines, pairs=pairs.mask))
    views, lines = native.reflines.walk_around(wanted.seen.view_direction, wanted.seen.line_direction, wanted.up)
    found = await look(views=views, lines=lines)
    spots = tuple(Spot(tuple(spot.place.tolist()), spot.size, spot.degrees, spot.height, VIEWS[spot.view], spot.light,
                       tuple(lines[spot.front_light].tolist())) for spot in found.spots)
    unseen = tuple(name for name, fraction in zip(VIEWS, found.seen, strict=True) if fraction < LEAST_SEEN)
    return Inspection(spots, found.mean, f"from {VIEWS[found.worst_view]}", unseen)


def choose_blockers(surface: CheckedSurface) -> tuple[np.ndarray, np.ndarray] | None:
    """Returns the vertices and triangles beside the region whose coordinates are finite; None where there are none."""
    finite = np.isfinite(surface.after).all(axis=1)
    F = surface.F[~surface.region]
    F = F[finite[F].all(axis=1)]
    if not len(F):
        return None
    used, corners = np.unique(F, return_inverse=True)
    return surface.after[used], corners.reshape(-1, 3)
