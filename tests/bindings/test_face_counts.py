"""Reports count the faces that triangles were cut from: each once where any of its triangles counts."""
import numpy as np
import pytest
import reflines
from sample_panels import LINE, VIEW, grid

CELLS = 40


def arch() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A half tube whose sides the view sees edge on; with the quad behind each triangle, in numbers with gaps."""
    plane, F = grid(CELLS)
    angle = np.radians(176.0) * (plane[:, 0] - plane[:, 0].mean()) / np.ptp(plane[:, 0])
    corner = np.floor(plane[F].mean(axis=1) / np.ptp(plane[:, 0]) * CELLS + 1e-9).astype(int)
    V = np.stack([np.sin(angle), plane[:, 1] + 0.02 * angle, np.cos(angle)], 1)
    return V, F, 7 * (1000 * corner[:, 0] + corner[:, 1])


def find_edge_on(V: np.ndarray, F: np.ndarray) -> np.ndarray:
    normal = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    return np.abs(normal @ VIEW) < 0.2 * np.linalg.norm(normal, axis=1)


def test_faces_are_counted_once() -> None:
    V, F, face = arch()
    assert len(np.unique(face)) == CELLS**2
    edge_on, options = find_edge_on(V, F), {"view_direction": VIEW, "line_direction": LINE}
    shuffled = np.random.default_rng(1).permutation(len(F))
    for order in (np.arange(len(F)), shuffled):
        region = reflines.ShapeOptimizer(V, F[order], face_of_triangle=face[order], **options).region
        faces = len(np.unique(face[edge_on]))
        assert region.silhouettes == faces and faces < edge_on.sum()
        assert [(note.kind, note.count) for note in region.notes if note.kind == "edge_on"] == [("edge_on", faces)]
    assert reflines.ShapeOptimizer(V, F, **options).region.silhouettes == edge_on.sum()
    told = reflines.smooth_panel(V, F, face_of_triangle=face, **options)[1]
    assert told.region.silhouettes == len(np.unique(face[edge_on]))


@pytest.mark.parametrize("call", [reflines.ShapeOptimizer, reflines.smooth_panel])
def test_other_numbers_of_faces_are_refused(call) -> None:
    V, F, face = arch()
    with pytest.raises(reflines.InvalidInput, match="faces for 3200 triangles"):
        call(V, F, view_direction=VIEW, line_direction=LINE, face_of_triangle=face[1:])


def test_a_face_and_its_image_count_once() -> None:
    V, quads = np.empty((0, 3)), []
    for side in (0, 1):  # two strips of quads beside each other, the outer halves of which are steep
        x = np.array([0.0, 1.0, 1.05])
        sign = -1.0 if side else 1.0
        strip = np.array([[sign * (a + 0.001), b, -10.0 * max(a - 1.0, 0.0)] for b in range(4) for a in x])
        for j in range(3):
            for i in range(2):
                quad = [3 * j + i, 3 * j + i + 1, 3 * j + i + 4, 3 * j + i + 3]
                quads.append([len(V) + k for k in (quad[::-1] if side else quad)])
        V = np.concatenate([V, strip])
    offsets, corners = np.arange(0, 4 * len(quads) + 1, 4), np.ravel(quads)
    options = {"view_direction": VIEW, "line_direction": LINE, "limit": False, "border": "free", "level": 1}
    both = reflines.CageOptimizer(V, offsets, corners, **options).region
    once = reflines.CageOptimizer(V, offsets, corners, image_of=np.arange(12) % 6, **options).region
    assert both.silhouettes == 2 * once.silhouettes > 0
    with pytest.raises(reflines.InvalidInput, match="list of mirrored faces"):
        reflines.CageOptimizer(V, offsets, corners, image_of=np.arange(3), **options)
