"""Recomputes the paper's figures 5, 6, 7 and 11, and the transfer function of Smooth, as CSV files and plots:
`./run figures [NAME...]`.
"""
import argparse
from pathlib import Path

from figures import normals, smoothing, sphere, strategies, transfer

MAKERS = {"figure5": sphere.make, "figure6": normals.make, "figure7": strategies.make, "figure11": smoothing.make,
          "transfer": transfer.make}
OUT = Path(__file__).resolve().parents[2] / "build/figures"


def main() -> None:
    parser = argparse.ArgumentParser(prog="./run figures", description=__doc__)
    parser.add_argument("names", nargs="*", choices=[*MAKERS, []], default=[], metavar="NAME", help=", ".join(MAKERS))
    OUT.mkdir(parents=True, exist_ok=True)
    for name in parser.parse_args().names or MAKERS:
        MAKERS[name](OUT)
        print(f"build/figures/{name}.png")


if __name__ == "__main__":
    main()
