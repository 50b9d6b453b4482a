"""Compares Smooth Lines with Blender's own Fair Tangency, Smooth Vertices and Relax, in numbers and in stripes."""
import subprocess
from datetime import date
from pathlib import Path

import json_lines
import suites

from bench.report import machine
from figures import compared_panels, compare_shapes, stripe_sheet
from figures.tool_table import PANELS, SHAPES

PATIENCE = 1200  # seconds for Blender


def press(folder: Path) -> None:
    """Applies the tools to the panels of a folder, in a Blender with a window."""
    command = [*suites.window_command(800, 600), *suites.script_options("tests/figures/press_blender_tools.py"), folder]
    subprocess.run(command, cwd=suites.ROOT, check=True, env=suites.blender_environment(), timeout=PATIENCE,
                   stdout=subprocess.DEVNULL)


def make(folder: Path) -> None:
    """Writes blender_tools.json and the sheet, as PNG and as the smaller WebP of the manual."""
    work = folder / "blender_tools"
    work.mkdir(exist_ok=True)
    names = compared_panels.write_panels(work)
    press(work)
    measured = {name: compare_shapes.measure_panel(work / f"{name}_shapes.npz") for name in names}
    kept = {"date": date.today().isoformat(), "machine": machine(), "blender": str(measured[names[0]][1]["blender"]),
            "panels": {name: {shape: numbers[shape] for shape in SHAPES} for name, (numbers, _) in measured.items()}}
    (folder / "blender_tools.json").write_text(json_lines.dump(kept) + "\n")
    shapes = {PANELS[name].replace(": ", "\n"): shapes for name, (_, shapes) in measured.items()}
    for suffix in ("png", "webp"):
        stripe_sheet.draw_sheet(shapes, folder / f"blender_tools.{suffix}")
