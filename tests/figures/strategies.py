"""Figure 7: time and iterations to the same energy by strategy and size: a bump on a cylinder is made, or removed."""
import csv
from pathlib import Path

from bench.report import FIGURE_SIZES, TASKS, medians, run
from matplotlib import pyplot

STRATEGIES = {"linearized": "linearized (the paper)", "newton": "newton (projected)", "gauss_newton": "gauss_newton",
              "adaptive": "adaptive (default)"}
REPETITIONS = 3


def plot(runs: dict[str, list[dict]], path: Path) -> None:
    times = medians(runs)
    figure, panels = pyplot.subplots(1, 4, figsize=(14, 3.9), layout="constrained")
    for column, task in enumerate(TASKS):
        for (strategy, label), marker in zip(STRATEGIES.items(), "osD^", strict=True):
            names = [f"strategy/{task}/{strategy}/{size}" for size in FIGURE_SIZES]
            unknowns = [runs[name][0]["unknowns"] for name in names]
            panels[column].loglog(unknowns, [times[name] / 1000 for name in names], marker=marker, label=label)
            steps = [runs[name][0]["iterations"] for name in names]
            panels[2 + column].loglog(unknowns, steps, marker=marker, label=label)
            missed = [k for k, name in enumerate(names) if not runs[name][0]["reached"]]
            panels[2 + column].loglog([unknowns[k] for k in missed], [steps[k] for k in missed], marker="x", color="k",
                                      markersize=10, linestyle="")
        panels[column].set(title=f"bump {task}: time", xlabel="unknowns", ylabel="seconds to the same energy")
        panels[2 + column].set(title=f"bump {task}: iterations", xlabel="unknowns", ylabel="steps to the same energy")
    for axes in panels:
        axes.grid(alpha=0.3)
    panels[0].legend(fontsize=8)
    figure.suptitle("Figure 7: strategies on a cylinder with a bump, irregular meshes, two cores"
                    " (x: not there yet after the 256 steps allowed)")
    figure.savefig(path, dpi=110)
    pyplot.close(figure)


def make(folder: Path) -> None:
    runs, _ = run("bench_solve", "^strategy/", REPETITIONS)
    with (folder / "figure7.csv").open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["problem", "strategy", "cells a side", "unknowns", "median ms", "iterations", "factorizations",
                         "energy reached"])
        for name, time in medians(runs).items():
            entry = runs[name][0]
            counts = [int(entry[key]) for key in ("iterations", "factorizations", "reached")]
            writer.writerow([*name.split("/")[1:], int(entry["unknowns"]), f"{time:.1f}", *counts])
    plot(runs, folder / "figure7.png")
