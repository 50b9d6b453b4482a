"""A set of lights for one press, each with the view that sees it."""
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from .. import native
from .beside import join_soups
from .gain import Worse
from .patch import Patch
from .refusal import Refusal
from .view import Families, View

PARALLEL = 1e-3    # sine of the angle between a light and its view below which no lines are seen
LEAST_SEEN = 0.05  # fraction of the region: a view that sees less of it does not tell of it
Direction = tuple[float, float, float]


@dataclass(frozen=True)
class SetLight:
    """One light, in world space."""
    name: str
    line: Direction  # along the line lights
    eye: Direction   # from the surface to the viewer, or the viewer's place
    is_place: bool   # whether `eye` is a place, as that of a perspective camera
    weight: float

    def find_eye(self, center: np.ndarray) -> np.ndarray:
        """Returns the unit direction to the viewer from a region around this centre; refuses where it shows no lines.
        """
        if self.is_parallel(center):
            raise Refusal(f"The light {self.name} of the set is parallel to its view, so it shows no lines: turn one, "
                          "or mute it")
        return self.look_from(center)

    def look_from(self, center: np.ndarray) -> np.ndarray:
        eye = np.array(self.eye) - center if self.is_place else np.array(self.eye)
        return eye / max(float(np.linalg.norm(eye)), 1e-300)

    def is_parallel(self, center: np.ndarray) -> bool:
        """Returns whether the light shows no lines of a region around this centre."""
        line = np.array(self.line)
        return bool(np.linalg.norm(np.cross(self.look_from(center), line)) < PARALLEL * np.linalg.norm(line))


@dataclass(frozen=True)
class Blockers:
    """The surface of an object, which may hide a region from a view, in world space."""
    name: str         # of the object
    V: np.ndarray     # #B x 3
    F: np.ndarray     # #G x 3
    face: np.ndarray  # #G: the mesh's face that each was cut from

    def leave_out(self, patch: Patch) -> tuple[np.ndarray, np.ndarray]:
        """Returns vertices and triangles without those of a region, whose shape before its last run may be another."""
        own = next((panel for panel in patch.panels if panel.name == self.name), None)
        F = self.F if own is None else self.F[~own.faces[self.face]]
        used, corners = np.unique(F, return_inverse=True)
        return self.V[used], corners.reshape(-1, 3)


@dataclass(frozen=True)
class LightSet:
    """The lights that are not muted, at least one."""
    lights: tuple[SetLight, ...]
    blockers: tuple[Blockers, ...] = ()

    def build_families(self, patch: Patch) -> Families:
        """Builds the lights as a solve of a patch takes them."""
        eyes = np.array([light.find_eye(patch.center) for light in self.lights])
        beside = join_soups([each.leave_out(patch) for each in self.blockers]) if self.blockers else None
        return Families(np.array([light.line for light in self.lights]), eyes,
                        np.array([light.weight for light in self.lights]), beside)

    def build_argument(self, patch: Patch) -> "native.LightSet":
        """Builds what the native press of a patch takes."""
        built = self.build_families(patch)
        return native.reflines.LightSet(built.lines, built.eyes, weight=built.weight.tolist(), blockers=built.blockers)

    def leave_parallel(self, center: np.ndarray) -> "LightSet | None":
        """Returns the set without the lights that show no lines of a region around this centre; None where none is
        left.
        """
        lights = tuple(light for light in self.lights if not light.is_parallel(center))
        return replace(self, lights=lights) if lights else None

    def tell_worse(self, worse: "native.WorsePlace", center: np.ndarray, size: float) -> Worse | None:
        """Tells of the place that became worse in a light of the set, seen from a region around this centre; None where
        there is none.
        """
        if worse.light < 0:
            return None
        light = self.lights[worse.light]
        return Worse(light.name, light.line, tuple(worse.place.tolist()), size, worse.before, worse.after,
                     tuple(light.look_from(center).tolist()))

    def describe(self, seen: Sequence[float], before: Sequence[float], after: Sequence[float], *,
                 applied: bool) -> tuple[str, ...]:
        """Describes what a press says of the lights by their names: those that see next to nothing of the region, and
        for which one it was not applied; `before` and `after` are how uneven the lines are in each.
        """
        blind = [light.name for light, fraction in zip(self.lights, seen, strict=True) if fraction < LEAST_SEEN]
        notes = (f"Not seen from {', '.join(blind)}: no weight there",) if blind else ()
        worse = int(np.argmax(np.array(after) / np.maximum(before, 1e-300)))
        if not applied and after[worse] > before[worse]:
            return (f"That light of the set is {self.lights[worse].name}", *notes)
        return notes


def find_walk(seen: View, up: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Finds the views (5 x 3, as inspection.VIEWS names them) and the light lines (2 x 3: the light, and the crossed
    one) of a walk around; `up` (3) is up in the picture. Refuses a light that is parallel to the view.
    """
    try:
        eyes, lines = native.reflines.walk_around(seen.view_direction, seen.line_direction, up)
    except native.InvalidInput as error:
        raise Refusal(str(error)) from error
    return eyes, lines[[0, len(lines) // 2]]
