"""The rows of the tools on designed panels: what is left of wanted changes, and what they do to the crossed lines.

Six changes each with a clamped and a free border, on the bonnets of ../shared: lines turned everywhere and within a
fall-off, denser and straightened, an image's waves, and a warp. Theta is the judge's, which shares no code with the
solver.

    PYTHONPATH=addon:tests python3 -m bench.design_tools    prints the rows
"""
from collections.abc import Iterator

import numpy as np
import reflines

from bench.restoration import JUDGE, load_judge, read_panels
from bench.row import Row

PANELS = ("subaru_hood", "drivaer_hood")
TURNED = np.cos(np.radians(45.0))


def build_changes(o: reflines.ShapeOptimizer, diagonal: float) -> Iterator[reflines.Target]:
    centre, radius = o.xy.mean(axis=0), 0.25 * diagonal
    t = np.linspace(1.0, 0.0, 257)
    near = reflines.falloff(o, centre=centre, radius=radius, curve=t * t * (3.0 - 2.0 * t))
    yield reflines.turn(o, angle=np.radians(10.0))
    yield reflines.turn(o, angle=np.radians(20.0), influence=near)
    yield reflines.uniform(o, density=1.2)
    yield reflines.uniform(o, influence=near)
    x, y = np.meshgrid(*2 * [np.linspace(0.0, 1.0, 64)])
    waves = 0.5 + 0.5 * np.sin(4.0 * np.pi * x) * np.sin(np.pi * y)**2
    yield reflines.pattern(o, image=waves, strength=0.15, centre=centre, width=0.5 * diagonal)
    yield build_warp(o, centre, radius, 0.04 * diagonal)


def build_warp(o: reflines.ShapeOptimizer, centre: np.ndarray, radius: float, shift: float) -> reflines.Target:
    """Moves the lines of the middle along the diagonal of the picture."""
    low, high = o.xy.min(axis=0) - 1e-3 * radius, o.xy.max(axis=0) + 1e-3 * radius
    x, y = np.meshgrid(np.linspace(low[0], high[0], 65), np.linspace(low[1], high[1], 65))
    rest = np.column_stack([x.ravel(), y.ravel()])
    inside = np.maximum(1.0 - ((rest - centre)**2).sum(axis=1) / radius**2, 0.0)
    position = rest + shift * (inside**2)[:, None]
    return reflines.warp(o, low=low, high=high, columns=64, rows=64, position=position)[0]


def measure_changes() -> np.ndarray:
    """#changes x 4: what is left of the change, that of the crossed lines (degrees), the largest move (% of the
    diagonal), and the triangles turned by more than 45 degrees."""
    judge, rows = load_judge(), []
    for name in PANELS:
        panel = read_panels(cages=False)[name]
        V, F = judge.load(panel["file"], panel.get("patch"))
        view, line = judge.unit(panel["view_direction"]), judge.unit(panel["light_across"])
        crossed, diagonal = judge.unit(np.cross(view, line)), np.linalg.norm(np.ptp(V, axis=0))
        before = judge.theta(V, F, view, crossed)
        for border in ("clamped", "free"):
            o = reflines.ShapeOptimizer(V, F, view_direction=view, line_direction=[line, crossed], border=border)
            start, area = o.field(), o.area * o.changeable
            for target in list(build_changes(o, diagonal)):
                o.reset()
                o.solve([target, reflines.keep(o, family=1)])
                asked, left = (area @ ((target.gradient - field)**2).sum(axis=1) for field in (start, o.field()))
                off = (judge.theta(o.positions, F, view, crossed) - before + np.pi) % (2.0 * np.pi) - np.pi
                rows.append((np.sqrt(left / asked), np.degrees(np.sqrt(area @ off**2 / area.sum())),
                             100.0 * np.abs((o.positions - V) @ view).max() / diagonal,
                             count_turned(V, o.positions, F)))
    return np.array(rows)


def count_turned(before: np.ndarray, after: np.ndarray, F: np.ndarray) -> int:
    one, other = (np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]]) for V in (before, after))
    return int(((one * other).sum(axis=1) < TURNED * np.linalg.norm(one, axis=1) * np.linalg.norm(other, axis=1)).sum())


def rows() -> list[Row]:
    if not JUDGE.is_file():
        return []
    measured = measure_changes()
    note = f"{len(measured)} changes to two bonnets"
    return [Row("tools_left", float(measured[:, 0].mean()), "", f"share of the wanted change left, mean of {note}"),
            Row("tools_crossed", float(measured[:, 1].mean()), "deg", f"change of the crossed lines, mean of {note}"),
            Row("tools_move", float(measured[:, 2].max()), "%", f"largest move of a vertex, of the diagonal, without a "
                f"limit, of {note}"),
            Row("tools_turned", float(measured[:, 3].sum()), "", f"triangles turned by more than 45 degrees by {note}")]


if __name__ == "__main__":
    for row in rows():
        print(f"{row.name:28} {row.value:8.3f} {row.unit:4} {row.note}")
