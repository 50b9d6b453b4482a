"""Flawed panels whose clean shape is known: the car's bonnet and door and the cages of the samples, and real panels.

The real ones are those of ../shared/restoration with its judge's dents; without it there are the samples only.
"""
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import cage_shapes
import car_mesh
import car_sheets
import numpy as np
import reflines

from bench.restoration import JUDGE, load_judge, read_panels

Array = np.ndarray
Pressed = tuple[Array, "reflines.SmoothPanelReport"]


@dataclass(frozen=True)
class FlawedPanel:
    name: str
    clean: Array   # #V x 3, of the surface
    flawed: Array
    F: Array
    view: Array
    light: Array
    press: Callable[["reflines.LightSet"], Pressed]  # returns the surface (#V x 3) after a press for a set of lights


@dataclass(frozen=True)
class Seen:
    """How a sample is looked at."""
    view: tuple[float, float, float]
    light: tuple[float, float, float]
    axis: int  # of a cage: the coordinate that is wrong


PANELS = {"Bonnet": Seen((0.0, -0.42, 0.91), (0.0, 1.0, 0.1), 2), "Door": Seen((0.99, 0.0, 0.14), (0.0, 0.2, 1.0), 0)}
CAGES = {"hood": Seen((0.1, -0.7, 1.0), (0.0, 1.0, 0.12), 2), "fender": Seen((1.0, -0.1, 0.25), (0.0, 1.0, 0.0), 0)}


def unit(vector: Array) -> Array:
    return np.asarray(vector, float) / np.linalg.norm(vector)


def cut_quads(quads: Array) -> Array:
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def make_mesh(name: str, clean: Array, flawed: Array, F: Array, view: Array, light: Array) -> FlawedPanel:
    def press(light_set: "reflines.LightSet") -> Pressed:
        return reflines.smooth_panel(flawed, F, view_direction=view, line_direction=light, light_set=light_set)

    return FlawedPanel(name, clean, flawed, F, view, light, press)


def read_real(name: str, panel: dict) -> FlawedPanel:
    judge = load_judge()
    V, F = judge.load(panel["file"], panel.get("patch"))
    V, view = V - V.mean(0), unit(panel["view_direction"])
    dents = judge.heights("dents", V, F, view, np.linalg.norm(np.ptp(V, axis=0)))
    return make_mesh(name, V, V + dents[:, None] * view, F, view, unit(panel["light_across"]))


def make_car_panel(name: str) -> FlawedPanel:
    sheet = next(each for each in car_sheets.dense_sheets() if each.name == name)
    flawed, clean, seen = car_mesh.dense_of(sheet), car_mesh.dense_of(sheet, flawed=False), PANELS[name]
    return make_mesh(f"car_{name.lower()}", clean.V, flawed.V, cut_quads(flawed.quads), unit(seen.view),
                     unit(seen.light))


def make_cage(name: str) -> FlawedPanel:
    flawed, quads, height = getattr(cage_shapes, name)()
    seen, clean, view, light = CAGES[name], flawed.copy(), unit(CAGES[name].view), unit(CAGES[name].light)
    clean[:, seen.axis] = height
    offsets, corners, creases = np.arange(0, 4 * len(quads) + 1, 4), quads.ravel(), find_creases(name, quads)
    surface = reflines.Subdivision(offsets, corners, vertices=len(flawed), level=2, **creases)

    def press(light_set: "reflines.LightSet") -> Pressed:
        pressed, report = reflines.smooth_cage_panel(flawed, offsets, corners, view_direction=view,
                                                     line_direction=light, light_set=light_set, **creases)
        return surface.positions(pressed), report

    return FlawedPanel(f"cage_{name}", surface.positions(clean), surface.positions(flawed), cut_quads(surface.faces),
                       view, light, press)


def find_creases(name: str, quads: Array) -> dict[str, Array]:
    """Returns the creases of a sample's cage, as its script makes them."""
    if name != "fender":
        return {}
    columns = int(quads[0][2]) - 1
    row = cage_shapes.CREASE_ROW * columns + np.arange(columns)
    return {"creases": np.column_stack([row[:-1], row[1:]]),
            "crease_sharpness": np.full(columns - 1, 10.0 * cage_shapes.CREASE)}


def list_panels() -> dict[str, Callable[[], FlawedPanel]]:
    """Returns what makes each panel, by its name."""
    made = ({f"car_{name.lower()}": partial(make_car_panel, name) for name in PANELS}
            | {f"cage_{name}": partial(make_cage, name) for name in CAGES})
    if not JUDGE.is_file():
        return made
    return made | {name: partial(read_real, name, panel) for name, panel in read_panels(cages=False).items()}
