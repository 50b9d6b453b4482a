"""The surfaces beside a region that are not joined with it: other objects, and faces of its mesh across a gap."""
from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from .border import CODES


@dataclass(frozen=True)
class Crossing:
    """The choice of what a border follows."""
    everywhere: bool  # whether the whole border does, or only the segments that are set so
    joint: frozenset[str] = frozenset()  # names of objects that are solved with this one
    cages: frozenset[str] = frozenset()  # those of them that are solved for their cages

    def concerns(self, border: np.ndarray) -> bool:
        """Returns whether something of a border with these codes (#V) follows."""
        return self.everywhere or bool((border == CODES["follow"]).any())


@dataclass(frozen=True)
class Beside:
    """Triangles beside a region, in world space, whose normals point outwards."""
    V: np.ndarray  # #S x 3
    F: np.ndarray  # #G x 3
    gap: float     # widest gap that is crossed, world units
    margin: float  # how far beyond the gap they were read, world units

    def add_soups(self, soups: Iterable[tuple[np.ndarray, np.ndarray]]) -> "Beside":
        """Returns these and more triangles (vertices, triangles)."""
        V, F = join_soups([(self.V, self.F), *soups])
        return replace(self, V=V, F=F)

    def add_image(self, mirrored: np.ndarray) -> "Beside":
        """Returns these and their mirror images, whose vertices are given (#S x 3)."""
        return Beside(np.concatenate([self.V, mirrored]),
                      np.concatenate([self.F, self.F[:, ::-1] + len(self.V)]), self.gap, self.margin)


@dataclass(frozen=True)
class Neighbors:
    """The triangles of other objects near a panel, in world space."""
    V: np.ndarray       # #W x 3
    F: np.ndarray       # #G x 3
    label: np.ndarray   # #G: number of the object that each is of
    names: list[str]    # of these objects


def label_soups(soups: dict[str, tuple[np.ndarray, np.ndarray]]) -> Neighbors:
    """Joins meshes (vertices, triangles), by the names of their objects."""
    V, F = join_soups(list(soups.values()))
    label = np.repeat(np.arange(len(soups)), [len(F) for _, F in soups.values()])
    return Neighbors(V, F, label, list(soups))


def join_soups(soups: list[tuple[np.ndarray, np.ndarray]]) -> tuple[np.ndarray, np.ndarray]:
    """Joins meshes (vertices, triangles) to one."""
    starts = np.cumsum([0, *(len(V) for V, _ in soups)])
    V = [np.zeros((0, 3)), *(V for V, _ in soups)]
    F = [np.zeros((0, 3), dtype=np.int64), *(F + start for (_, F), start in zip(soups, starts[:-1], strict=True))]
    return np.concatenate(V), np.concatenate(F)
