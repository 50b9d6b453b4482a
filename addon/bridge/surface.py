"""The surface that the viewport shows of an object: modifiers applied, hidden faces left out."""
from dataclasses import dataclass

import bpy
import numpy as np

from . import gather, region


@dataclass(frozen=True)
class Topology:
    """What a triangulation follows from; as long as it stays, so do the triangles."""
    corners: np.ndarray     # #corners: their vertices
    sizes: np.ndarray       # #faces
    shown: np.ndarray       # #faces, bool
    triangles: np.ndarray   # #F x 3
    faces: np.ndarray       # #F: the face of each

    def same(self, corners: np.ndarray, sizes: np.ndarray, shown: np.ndarray) -> bool:
        return (np.array_equal(self.corners, corners) and np.array_equal(self.sizes, sizes)
                and np.array_equal(self.shown, shown))


@dataclass(frozen=True)
class Surface:
    """In object space."""
    V: np.ndarray         # #V x 3
    topology: Topology
    selected: np.ndarray  # #F, bool
    normals: np.ndarray | None = None  # #V x 3, where they are known without a fit

    @property
    def F(self) -> np.ndarray:
        return self.topology.triangles


def read(ob: bpy.types.Object, depsgraph: bpy.types.Depsgraph, last: Topology | None) -> Surface:
    """`to_mesh` of the evaluated object is right in both modes; its plain data are empty in Edit Mode.

    `last` is the topology of an earlier call: reading 400,000 triangles takes longer than all else together.
    """
    evaluated = ob.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh()
    V = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", V)
    topology = read_topology(mesh, last)
    selected = region.flags(mesh, "select")[topology.faces]
    evaluated.to_mesh_clear()
    return Surface(V.reshape(-1, 3).astype(np.float64), topology, selected)


def read_topology(mesh: bpy.types.Mesh, last: Topology | None) -> Topology:
    corners, sizes = gather.corners(mesh)
    shown = region.visible(mesh)
    if last is not None and last.same(corners, sizes, shown):
        return last
    triangles, faces = gather.triangles(mesh)
    seen = shown[faces]
    return Topology(corners, sizes, shown, triangles[seen], faces[seen])
