"""Recomputes the paper's figures 5, 6, 7 and 11, the transfer function of Smooth, and its comparison with Blender's own
tools, as CSV or JSON files and plots: `./run figures [--keep] [NAME...]`.

With --keep the comparison's numbers and sheet become those that the manual shows.
"""
import argparse
import shutil
from pathlib import Path

from figures import blender_tools, compared_panels, normals, smoothing, sphere, strategies, tool_table, transfer

MAKERS = {"figure5": sphere.make, "figure6": normals.make, "figure7": strategies.make, "figure11": smoothing.make,
          "transfer": transfer.make, "blender_tools": blender_tools.make}
ROOT = Path(__file__).resolve().parents[2]
OUT = ROOT / "build/figures"
KEPT = {"blender_tools.json": tool_table.KEPT, "blender_tools.webp": ROOT / "addon/manual/pictures/blender_tools.webp"}


def main() -> None:
    parser = argparse.ArgumentParser(prog="./run figures", description=__doc__)
    parser.add_argument("names", nargs="*", choices=[*MAKERS, []], default=[], metavar="NAME", help=", ".join(MAKERS))
    parser.add_argument("--keep", action="store_true", help="keep the comparison with Blender's tools for the manual")
    arguments = parser.parse_args()
    names = arguments.names or list(MAKERS)
    if arguments.keep and ("blender_tools" not in names or not compared_panels.list_bodies()):
        parser.error("to keep the comparison it has to be made, with the car bodies beside the project")
    OUT.mkdir(parents=True, exist_ok=True)
    for name in names:
        MAKERS[name](OUT)
        print(f"build/figures/{name}.png")
    if arguments.keep:
        for name, kept in KEPT.items():
            shutil.copyfile(OUT / name, kept)


if __name__ == "__main__":
    main()
