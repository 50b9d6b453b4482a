"""The panels on which Smooth Lines is compared with Blender's tools: samples, and car bodies with planted flaws.

The samples' clean shapes come from the formulas that made them. The bodies are those of ../shared, which is not part of
the project; without it there are the samples only.
"""
from pathlib import Path
from types import ModuleType

import hood_shape
import numpy as np
import panel_shapes

from bench.restoration import JUDGE, load_judge, read_cage, read_panels

BODIES = {"subaru_hood": "dents", "drivaer_hood_wide": "ripple"}  # the panel in selections.json -> its flaw
DEPTH = 2.0   # of the judge's flaws, which the eye hardly sees
COUNT = 48    # of stripes
MARGIN = 0.06  # share of the diagonal that an unbounded region leaves free along the mesh's border

Panel = dict[str, np.ndarray]


def list_samples() -> dict[str, Panel]:
    """Returns the clean positions of the samples that have flaws, by the names of their files."""
    spout = panel_shapes.faucet()[2]
    door, _, x = panel_shapes.door()
    columns, rows = 136, 110  # of make_panels.py
    return {"hood": {"clean": hood_shape.panel(columns, rows)[0]}, "faucet": {"clean": spout},
            "door": {"clean": np.column_stack([x, door[:, 1:]])}}


def choose_inner_faces(judge: ModuleType, V: np.ndarray, offsets: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Returns the faces (#faces bool) that keep MARGIN away from the border of the mesh."""
    F = np.array([[face[0], face[k], face[k + 1]] for face in np.split(corners, offsets[1:-1])
                  for k in range(1, len(face) - 1)])
    inside = judge.border_distance(V, F, np.linalg.norm(np.ptp(V, axis=0))) > MARGIN
    return np.logical_and.reduceat(inside[corners], offsets[:-1])


def plant_flaw(judge: ModuleType, panel: dict, flaw: str) -> Panel:
    """Returns a body with its region, clean and flawed; the flaw fades before the region's border."""
    patch = panel.get("patch", [])
    V, offsets, corners, region = read_cage(panel | {"patch": patch}, "patch")
    if not patch:
        region = choose_inner_faces(judge, V, offsets, corners)
    faces = [face for face, chosen in zip(np.split(corners, offsets[1:-1]), region, strict=True) if chosen]
    triangles = [[face[0], face[k], face[k + 1]] for face in faces for k in range(1, len(face) - 1)]
    vertices, F = np.unique(triangles, return_inverse=True)
    view, diagonal = judge.unit(panel["view_direction"]), np.linalg.norm(np.ptp(V[vertices], axis=0))
    flawed = V.copy()
    heights = judge.heights(flaw, V[vertices], F.reshape(-1, 3), view, diagonal)
    flawed[vertices] += DEPTH * heights[:, None] * view
    return {"clean": V, "flawed": flawed, "offsets": offsets, "corners": corners, "region": region, "view": view,
            "light": judge.unit(panel["light_across"]), "count": np.array(COUNT)}


def list_bodies() -> dict[str, Panel]:
    """Returns the car bodies; none where they are not beside the project."""
    if not JUDGE.is_file():
        return {}
    judge, panels = load_judge(), read_panels(cages=False)
    return {name: plant_flaw(judge, panels[name], flaw) for name, flaw in BODIES.items()}


def write_panels(folder: Path) -> list[str]:
    """Writes NAME.npz of every panel; returns the names."""
    panels = list_samples() | list_bodies()
    for name, arrays in panels.items():
        np.savez(folder / f"{name}.npz", **arrays)
    return list(panels)
