"""Recomputes the paper's figures 5, 6, 7 and 11 as CSV files and plots: `./run figures [NUMBER...]`."""
import argparse
from pathlib import Path

from figures import normals, smoothing, sphere, strategies

MAKERS = {5: sphere.make, 6: normals.make, 7: strategies.make, 11: smoothing.make}
OUT = Path(__file__).resolve().parents[2] / "build/figures"


def main() -> None:
    parser = argparse.ArgumentParser(prog="./run figures", description=__doc__)
    parser.add_argument("numbers", nargs="*", type=int, default=list(MAKERS), metavar="NUMBER", help="5, 6, 7 or 11")
    OUT.mkdir(parents=True, exist_ok=True)
    for number in parser.parse_args().numbers:
        MAKERS[number](OUT)
        print(f"build/figures/figure{number}.png")


if __name__ == "__main__":
    main()
