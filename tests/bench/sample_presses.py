"""Presses Smooth at its automatic length on every sample, in a Blender in the background, for the restoration sheet.

    blender -b --factory-startup --python tests/in_blender.py -- tests/bench/sample_presses.py

Writes build/bench/samples/NAME.npz: V and pressed (#V x 3) and F (#F x 3) of the object as it is shown, view and light.
"""
import sys
from pathlib import Path

import bpy
import numpy as np

import installation

ROOT = Path(__file__).resolve().parents[2]
OUT = ROOT / "build/bench/samples"


def read_shown(ob: bpy.types.Object) -> tuple[np.ndarray, np.ndarray]:
    """Returns positions (world space) and triangles of an object with its modifiers."""
    bpy.ops.object.mode_set(mode='OBJECT')
    mesh = ob.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    V, F = np.empty(3 * len(mesh.vertices), np.float32), None
    mesh.vertices.foreach_get("co", V)
    mesh.calc_loop_triangles()
    F = np.empty(3 * len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("vertices", F)
    matrix = np.array(ob.matrix_world)
    bpy.ops.object.mode_set(mode='EDIT')
    return V.reshape(-1, 3).astype(float) @ matrix[:3, :3].T + matrix[:3, 3], F.reshape(-1, 3)


def press(path: Path) -> None:
    bpy.ops.wm.open_mainfile(filepath=str(path), load_ui=False)
    ob = bpy.context.view_layer.objects.active
    if ob is None or ob.type != 'MESH':
        return
    bpy.ops.object.mode_set(mode='EDIT')
    patch = sys.modules["reflection_lines.read.gather"].gather_patch(ob, as_mesh=True, or_all=True)
    view = sys.modules["reflection_lines.view.facing"].read_patch_view(bpy.context.scene, patch)
    V, F = read_shown(ob)
    bpy.ops.reflines.smooth('EXEC_DEFAULT', length=0.0, directional=False)
    pressed, _ = read_shown(ob)
    print(f"{path.name}: {ob.reflection_lines.report.headline()}")
    np.savez(OUT / f"{path.stem}.npz", V=V, pressed=pressed, F=F, view=view.view_direction, light=view.line_direction)


def main() -> None:
    installation.install()
    OUT.mkdir(parents=True, exist_ok=True)
    for path in sorted((ROOT / "blend_samples").glob("*.blend")):
        press(path)


main()
