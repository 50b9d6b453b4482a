"""One picture before and after for every operation, from the samples: `./run gallery`, or

    blender -b --factory-startup -P tests/in_blender.py -- blend_samples/gallery.py OUTPUT_FOLDER [NAME...]

Every operation is one press of its button with the settings that its sample is saved with, or those that stand here.
The folder `manual` below the output's gets the small copies that the add-on's manual shows.
"""
import pathlib
import sys
from collections.abc import Callable
from dataclasses import dataclass

import bpy

import checkout
import pictures

HERE = pathlib.Path(__file__).resolve().parent
WIDTH = 480  # pixels of each part of a picture of the manual


@dataclass(frozen=True)
class Operation:
    name: str        # of the picture
    sample: str
    press: Callable[[], set[str]]
    rival: Callable[[], set[str]] | None = None  # what Blender has for the same job, shown between


OPERATIONS = (
    Operation("smooth", "faucet.blend", lambda: bpy.ops.reflines.smooth()),
    Operation("smooth_along", "door.blend", lambda: bpy.ops.reflines.smooth(),
              rival=lambda: bpy.ops.mesh.vertices_smooth(factor=0.5, repeat=200)),
    Operation("direction", "plate.blend", lambda: bpy.ops.reflines.direction(
        direction='ANGLE', angle=0.35, border='free', centre='EVERYWHERE')),
    Operation("density", "plate.blend", lambda: bpy.ops.reflines.direction(
        direction='MEAN', density=1.8, centre='REGION', radius=0.4, border='clamped')),
    Operation("turn", "fender.blend", lambda: bpy.ops.reflines.direction()),
    Operation("warp", "hood_warp.blend", lambda: bpy.ops.reflines.warp()),
    Operation("cage", "cage_hood.blend", lambda: bpy.ops.reflines.smooth()),
    Operation("cage_creased", "cage_fender.blend", lambda: bpy.ops.reflines.smooth()),
    Operation("pattern", "plate.blend", lambda: bpy.ops.reflines.pattern()),
)


def opened(operation: Operation) -> bpy.types.Object:
    bpy.ops.wm.open_mainfile(filepath=str(HERE / operation.sample), load_ui=False)
    return bpy.context.view_layer.objects.active


def shown(operation: Operation, folder: pathlib.Path) -> None:
    parts = [folder / "before.png"]
    panel = opened(operation)
    pictures.picture(parts[0], "before")
    if operation.rival is not None:
        parts.append(folder / "rival.png")
        operation.rival()
        pictures.picture(parts[1], "Blender's Smooth Vertices")
        panel = opened(operation)
    operation.press()
    print(f"gallery: {operation.name}: {panel.reflection_lines.report.headline()}")
    parts.append(folder / "after.png")
    pictures.picture(parts[-1], "after")
    whole = folder / f"{operation.name}.jpg"
    pictures.side_by_side(parts, whole)
    pictures.shrink(whole, folder / "manual" / whole.name, WIDTH * len(parts))
    for part in parts:
        part.unlink()


def main(folder: pathlib.Path, names: list[str]) -> None:
    (folder / "manual").mkdir(parents=True, exist_ok=True)
    checkout.enable_add_on()
    for operation in OPERATIONS:
        if not names or operation.name in names:
            shown(operation, folder)
    print(f"gallery: look at {folder}")


given = sys.argv[1:]
main(pathlib.Path(given[0]).resolve(), given[1:])
