"""Draws the sheet of the press of Smooth: stripes of real panels before and after it, in both lights, to be looked at.

    PYTHONPATH=addon:tests:tests/bindings python3 -m bench.restoration_sheet    writes build/bench/restoration.png

A row a panel: flawed by dents and healed, then clean and pressed, each in the light given and in the crossed one; then
careless selections of a bonnet, a boot and a scoop, and the samples, before and after a press: these where
tests/bench/sample_presses.py has pressed them. The stripes are drawn from the normals of the triangles, by the judge's
own formula of theta.
"""
from collections.abc import Iterator

import matplotlib
import numpy as np
import reflines

import careless
from bench.restoration import ROOT, load_judge, read_cage, read_panels

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  (after the choice of what draws)

CARELESS = ("bonnet", "boot", "Subaru scoop")
STRIPES = 24  # over the circle of theta
Shape = tuple[np.ndarray, np.ndarray]  # V #V x 3, F #F x 3


def press_mesh(judge: object, panel: dict) -> Iterator[tuple[str, Shape]]:
    """Yields the shapes of a mesh's row with their titles."""
    V, F = judge.load(panel["file"], panel.get("patch"))
    v, a = judge.unit(panel["view_direction"]), judge.unit(panel["light_across"])
    diagonal = np.linalg.norm(np.ptp(V, axis=0))
    flawed = V + 2 * judge.heights("dents", V, F, v, diagonal)[:, None] * v
    yield "dents", (flawed, F)
    yield "dents, pressed", (judge.present(flawed, F, v, a), F)
    yield "clean", (V, F)
    yield "clean, pressed", (judge.present(V, F, v, a), F)


def press_cage(judge: object, panel: dict) -> Iterator[tuple[str, Shape]]:
    """Yields the shapes of a cage's row: what a careless selection takes, and the patch."""
    for selected in ("box", "patch"):
        V, offsets, corners, region = read_cage(panel, selected)
        surface = reflines.Subdivision(offsets, corners, vertices=len(V), level=2)
        quads = surface.faces[region[surface.face_parent]]
        F = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
        pressed, _ = reflines.smooth_cage_panel(V, offsets, corners, region=region,
                                                view_direction=panel["view_direction"],
                                                line_direction=panel["light_across"])
        yield selected, (surface.positions(V), F)
        yield f"{selected}, pressed", (surface.positions(pressed), F)


def read_careless(judge: object) -> dict[str, tuple[list[tuple[str, Shape]], np.ndarray, np.ndarray]]:
    """Returns the shapes of careless selections with their titles, their views and lights."""
    rows = {}
    for selection in careless.SELECTIONS:
        if selection.name in CARELESS:
            V, F = careless.select(selection)
            v, a = judge.unit(np.array(selection.view, float)), judge.unit(np.array(selection.light, float))
            rows[selection.name] = [("before", (V, F)), ("pressed", (judge.present(V, F, v, a), F))], v, a
    return rows


def read_samples() -> dict[str, tuple[list[tuple[str, Shape]], np.ndarray, np.ndarray]]:
    """Returns the shapes of each sample's row with their titles, its view and its light."""
    rows = {}
    for path in sorted((ROOT / "build/bench/samples").glob("*.npz")):
        data = np.load(path)
        rows[path.stem] = ([("before", (data["V"], data["F"])), ("pressed", (data["pressed"], data["F"]))],
                           data["view"], data["light"])
    return rows


def read_rows(judge: object) -> dict[str, tuple[list[tuple[str, Shape]], np.ndarray, np.ndarray]]:
    """Returns the same of all panels and samples."""
    rows = {}
    for name, panel in (read_panels(cages=False) | read_panels(cages=True)).items():
        shapes = list((press_cage if panel["cage"] else press_mesh)(judge, panel))
        rows[name] = shapes, judge.unit(panel["view_direction"]), judge.unit(panel["light_across"])
    return rows | read_careless(judge) | read_samples()


def draw(axes: pyplot.Axes, judge: object, shape: Shape, view: np.ndarray, light: np.ndarray) -> None:
    V, F = shape
    x, y, _ = reflines.image_plane(view, light)
    normals = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    facing = normals @ view > 0.2 * np.linalg.norm(normals, axis=1)
    shade = 0.5 + 0.5 * np.tanh(4 * np.sin(STRIPES * judge.theta(V, F, view, light)))
    axes.tripcolor(V @ x, V @ y, F[facing], facecolors=shade[facing], cmap="gray", vmin=0, vmax=1)
    axes.set_aspect("equal")
    axes.axis("off")


def main() -> None:
    judge = load_judge()
    rows = read_rows(judge)
    figure, grid = pyplot.subplots(len(rows), 8, figsize=(24, 3 * len(rows)))
    for axes in grid.ravel():
        axes.axis("off")
    for row, (name, (shapes, v, a)) in zip(grid, rows.items(), strict=True):
        for k, (title, shape) in enumerate(shapes):
            for light in (0, 1):
                draw(row[k + 4 * light], judge, shape, v, (a, judge.unit(np.cross(v, a)))[light])
                row[k + 4 * light].set_title(f"{name}: {title}{', crossed' if light else ''}", fontsize=7)
    out = ROOT / "build/bench/restoration.png"
    out.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(out, dpi=80, bbox_inches="tight")
    print(f"{out.relative_to(ROOT)}: {len(rows)} panels and samples")


if __name__ == "__main__":
    main()
