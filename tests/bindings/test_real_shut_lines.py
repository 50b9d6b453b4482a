"""Real clean panels that are cut in two and pressed as one problem: no more harm than to the whole, and no tear."""
import numpy as np
import pytest
import reflines
import real_meshes

Array = np.ndarray
# File, view and lines; the wing, the roof and the lid are cut as doors and quarters beside them are.
PANELS = {"hood": ("drivaer_hood.obj", (0.0, 0.0, 1.0), (0.0, -1.0, 0.0)),
          "roof": ("subaru_roof.obj", (0.0, 0.0, 1.0), (0.0, -1.0, 0.0)),
          "wing": ("subaru_front_wing.obj", (-1.0, 0.0, 0.0), (0.0, 0.4472136, 0.8944272)),
          "boot lid": ("porsche_boot_lid.obj", (0.0, 0.9578263, -0.2873479), (0.9713243, 0.0683194, 0.2277315)),
          "bonnet": ("r8_bonnet.obj", (0.0, 0.0, 1.0), (0.0, -1.0, 0.0))}  # coarse: the cut has hardly a free vertex


def normals(V: Array, F: Array) -> Array:
    return np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])


def turn(before: Array, after: Array, F: Array) -> float:
    """By how much triangles turn: root mean square over the area, degrees."""
    one, other = normals(before, F), normals(after, F)
    angle = np.degrees(np.arctan2(np.linalg.norm(np.cross(one, other), axis=1), (one * other).sum(axis=1)))
    return float(np.sqrt(np.average(angle**2, weights=np.linalg.norm(one, axis=1))))


@pytest.mark.parametrize("name", list(PANELS))
def test_a_panel_cut_in_two_is_harmed_no_more_than_whole_and_does_not_tear(name: str) -> None:
    file, view, lines = PANELS[name]
    V, F = real_meshes.triangles(file)
    view, lines = np.array(view), np.array(lines)
    along = V[F].mean(axis=1) @ np.cross(view, lines)
    parts = [np.unique(F[half], return_inverse=True) for half in (along < np.median(along), along >= np.median(along))]
    directions = {"view_direction": view, "line_direction": lines}
    reach = 0.15 * np.linalg.norm(np.ptp(V, axis=0))
    panels = [reflines.JointPanel(V[used], G.reshape(-1, 3), **directions, margin=reach) for used, G in parts]
    results = reflines.JointSmoother(panels).press(strengths=[1.0] * 2, limits=[None] * 2, limit_ranges=[None] * 2)
    moved, again = V.copy(), V.copy()
    moved[parts[0][0]], again[parts[1][0]] = results[0][0], results[1][0]
    both = np.intersect1d(parts[0][0], parts[1][0])
    assert len(both) > 5 and np.array_equal(moved[both], again[both])
    moved[parts[1][0]] = results[1][0]
    whole = reflines.smooth_panel(V, F, **directions)[0]
    print(name, turn(V, moved, F), turn(V, whole, F))
    assert turn(V, moved, F) < 1.15 * turn(V, whole, F)
