"""A set of lights for one press, each with the view that sees it."""
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .. import native
from .patch import Patch
from .refusal import Refusal
from .view import View

PARALLEL = 1e-3    # sine of the angle between a light and its view below which no lines are seen
LEAST_SEEN = 0.05  # share of the region: a view that sees less of it does not tell of it
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
        eye = np.array(self.eye) - center if self.is_place else np.array(self.eye)
        eye = eye / max(float(np.linalg.norm(eye)), 1e-300)
        line = np.array(self.line)
        if np.linalg.norm(np.cross(eye, line)) < PARALLEL * np.linalg.norm(line):
            raise Refusal(f"The light {self.name} of the set is parallel to its view, so it shows no lines: turn one, "
                          "or mute it")
        return eye


@dataclass(frozen=True, eq=False)
class Blockers:
    """The surface of an object, which may hide a region from a view, in world space."""
    name: str         # of the object
    V: np.ndarray     # #B x 3
    F: np.ndarray     # #G x 3
    face: np.ndarray  # #G: the mesh's face that each was cut from

    def __eq__(self, other: "Blockers") -> bool:
        return (self.name == other.name and np.array_equal(self.V, other.V) and np.array_equal(self.F, other.F)
                and np.array_equal(self.face, other.face))

    def leave_out(self, patch: Patch) -> tuple[np.ndarray, np.ndarray]:
        """Returns vertices and triangles without those of a region, whose shape before its last run may be another."""
        F = self.F if self.name != patch.name else self.F[~patch.faces[self.face]]
        used, corners = np.unique(F, return_inverse=True)
        return self.V[used], corners.reshape(-1, 3)


@dataclass(frozen=True)
class LightSet:
    """The lights that are not muted, at least one."""
    lights: tuple[SetLight, ...]
    blockers: tuple[Blockers, ...] = ()

    def build_argument(self, patch: Patch) -> "native.LightSet":
        """Builds what the native press of a patch takes."""
        eyes = np.array([light.find_eye(patch.center) for light in self.lights])
        beside = join([each.leave_out(patch) for each in self.blockers]) if self.blockers else None
        return native.reflines.LightSet(np.array([light.line for light in self.lights]), eyes,
                                        weight=[light.weight for light in self.lights], blockers=beside)

    def name_light(self, index: int) -> tuple[str, Direction]:
        """Returns the name of a light and the direction of its lines."""
        return self.lights[index].name, self.lights[index].line

    def describe(self, seen: Sequence[float], before: Sequence[float], after: Sequence[float], *,
                 applied: bool) -> tuple[str, ...]:
        """Describes what a press says of the lights by their names: those that see next to nothing of the region, and
        for which one it was not applied; `before` and `after` are how uneven the lines are in each.
        """
        blind = [light.name for light, share in zip(self.lights, seen, strict=True) if share < LEAST_SEEN]
        notes = (f"Not seen from {', '.join(blind)}: no weight there",) if blind else ()
        worse = int(np.argmax(np.array(after) / np.maximum(before, 1e-300)))
        if not applied and after[worse] > before[worse]:
            return (f"That light of the set is {self.lights[worse].name}", *notes)
        return notes


def join(surfaces: Sequence[tuple[np.ndarray, np.ndarray]]) -> tuple[np.ndarray, np.ndarray]:
    """Joins surfaces, each vertices and triangles, to one."""
    first = np.cumsum([0, *(len(V) for V, _ in surfaces)])
    return (np.concatenate([V for V, _ in surfaces]),
            np.concatenate([F + start for (_, F), start in zip(surfaces, first[:-1], strict=True)]))


def find_walk(seen: View, up: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Finds the views (5 x 3, as inspection.VIEWS names them) and the light lines (2 x 3: the light, and the crossed
    one) of a walk around; `up` (3) is up in the picture. Refuses a light that is parallel to the view.
    """
    try:
        eyes, lines = native.reflines.walk_around(seen.view_direction, seen.line_direction, up)
    except native.InvalidInput as error:
        raise Refusal(str(error)) from error
    return eyes, lines[[0, len(lines) // 2]]
