"""Measures what Smooth Lines, Fair Tangency and Smooth Vertices made of a panel: lines, distances, borders, time.

Wobble and turn are the solver's score at the length that Smooth takes for the region; distances, and angles across the
border, are those of its check. How far lines are off the clean panel is measured here: theta of the mean normals at the
vertices against theta at the nearest places of the clean panel, so that sliding along the surface is no error.
"""
import re
import statistics
from pathlib import Path

import numpy as np
import reflines

LENGTHS = 14        # in the region's diagonal: the automatic length of Smooth
STEEPEST = 0.2      # cosine to the view of normals whose lines are measured
REPEATED = re.compile(r"flawed_vertices_(\d+)")
TOOLS = ("smooth", "length", "fair", "vertices", "relax")

Shapes = dict[str, np.ndarray]
Numbers = dict[str, float]


def to_unit(vector: np.ndarray) -> np.ndarray:
    return vector / np.linalg.norm(vector, axis=-1, keepdims=True)


def list_lights(shapes: Shapes) -> list[np.ndarray]:
    """Returns the light of the panel and the crossed one."""
    view, light = to_unit(shapes["view"]), to_unit(shapes["light"])
    return [light, to_unit(np.cross(view, light))]


def compute_normals(V: np.ndarray, F: np.ndarray) -> np.ndarray:
    """Returns the mean normal of every vertex (#V x 3), by the area of its triangles."""
    flat, normals = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]]), np.zeros_like(V)
    for corner in range(3):
        np.add.at(normals, F[:, corner], flat)
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)


def compute_theta(normals: np.ndarray, view: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Returns the angle around the light of the mirrored view, radians: equation 1 of the paper."""
    mirrored = 2.0 * (normals @ view)[:, None] * normals - view
    facing = to_unit(view - (view @ light) * light)
    return np.arctan2(mirrored @ np.cross(light, facing), mirrored @ facing)


def weigh_corners(places: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Returns the barycentric weights (#P x 3) of places in triangles (#P x 3 corners x 3)."""
    one, two, to = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0], places - corners[:, 0]
    flat = np.cross(one, two)
    area = np.maximum((flat * flat).sum(axis=1), 1e-300)
    second = (np.cross(to, two) * flat).sum(axis=1) / area
    third = (np.cross(one, to) * flat).sum(axis=1) / area
    return np.column_stack([1.0 - second - third, second, third])


def measure_line_error(shapes: Shapes, name: str) -> list[float]:
    """Returns how far the lines of a shape are off the clean panel's in both lights, root mean square, degrees."""
    F, clean, view = shapes["F"], shapes["clean"], to_unit(shapes["view"])
    vertices = np.unique(F[shapes["region"]])
    triangles = F[shapes[f"{name}_triangle"]]
    weights = weigh_corners(shapes[f"{name}_place"], clean[triangles])
    wanted = to_unit((compute_normals(clean, F)[triangles] * weights[:, :, None]).sum(axis=1))
    found = compute_normals(shapes[name], F)[vertices]
    seen = (wanted @ view > STEEPEST) & (found @ view > STEEPEST)
    errors = []
    for light in list_lights(shapes):
        off = compute_theta(found[seen], view, light) - compute_theta(wanted[seen], view, light)
        errors.append(float(np.degrees(np.sqrt((((off + np.pi) % (2 * np.pi) - np.pi)**2).mean()))))
    return errors


def score(shapes: Shapes, name: str) -> Numbers:
    """Returns wobble and turn of the region's lines in both lights, degrees."""
    vertices, F = np.unique(shapes["F"][shapes["region"]], return_inverse=True)
    optimizer = reflines.ShapeOptimizer(shapes[name][vertices], F.reshape(-1, 3).astype(np.int32),
                                        view_direction=shapes["view"], line_direction=list_lights(shapes))
    length = np.linalg.norm(np.ptp(shapes["flawed"][vertices], axis=0)) / LENGTHS
    given, crossed = (optimizer.score(length, family) for family in (0, 1))
    return {"wobble": given.shift, "wobble_crossed": crossed.shift, "turn": given.turn, "turn_crossed": crossed.turn}


def refuse_moves_outside(shapes: Shapes, name: str) -> None:
    """Raises ValueError where a tool moved vertices that are in no face of the region."""
    outside = np.setdiff1d(np.arange(len(shapes["clean"])), shapes["F"][shapes["region"]])
    if (shapes[name][outside] != shapes[name.split("_")[0]][outside]).any():
        raise ValueError(f"{name}: vertices outside the region moved")


def compare(shapes: Shapes, before: str, after: str) -> reflines.PanelCheck:
    return reflines.check(shapes[before], shapes[after], shapes["F"], shapes["region"])


def measure_border(check: reflines.PanelCheck) -> Numbers:
    """Returns how far border vertices came off the surface, and how the angle across edges grew, root mean square."""
    border = np.array(check.kind) == "border"
    edges = np.asarray(check.edges)[border]
    growth = np.maximum(check.angle_after - check.angle_before, 0.0)[border]
    return {"border_moved": float(check.deviation[np.unique(edges)].max()),
            "border_kink": float(np.sqrt((growth**2).mean()))}


def measure_shape(shapes: Shapes, name: str) -> Numbers:
    """Returns the lines of a shape and its distances from the clean panel."""
    vertices = np.unique(shapes["F"][shapes["region"]])
    off = compare(shapes, "clean", name).deviation[vertices]
    lines = measure_line_error(shapes, name)
    return score(shapes, name) | {"lines_off": lines[0], "lines_off_crossed": lines[1],
                                  "off": float(np.sqrt((off**2).mean()))}


def measure_tool(shapes: Shapes, tool: str) -> Numbers:
    """Returns all numbers of a tool: lines and moves on the flawed panel, its harm to the clean one, and its time; the
    drag of Relax has none.
    """
    for shape in ("flawed", "clean"):
        refuse_moves_outside(shapes, f"{shape}_{tool}")
    check = compare(shapes, "flawed", f"flawed_{tool}")
    harm = measure_line_error(shapes, f"clean_{tool}")
    seconds = shapes.get(f"flawed_{tool}_seconds")
    return (measure_shape(shapes, f"flawed_{tool}") | measure_border(check)
            | {"moved": check.largest_deviation, "harm": harm[0], "harm_crossed": harm[1],
               "harm_moved": compare(shapes, "clean", f"clean_{tool}").largest_deviation}
            | ({} if seconds is None else {"seconds": statistics.median(seconds)}))


def choose_repeats(shapes: Shapes, wobble: float) -> int:
    """Returns how often Smooth Vertices is repeated: until the mean wobble of both lights is this, or to the end."""
    repeats = sorted(int(found[1]) for found in map(REPEATED.fullmatch, shapes) if found)
    for repeat in repeats:
        numbers = score(shapes, f"flawed_vertices_{repeat}")
        if numbers["wobble"] + numbers["wobble_crossed"] <= 2.0 * wobble:
            return repeat
    return repeats[-1]


def measure_panel(path: Path) -> tuple[dict[str, Numbers], dict[str, np.ndarray]]:
    """Returns the numbers of the flawed and the clean panel and of each tool, and the shapes with the chosen repeats of
    Smooth Vertices under its name.
    """
    shapes = dict(np.load(path))
    smooth = score(shapes, "flawed_smooth")
    repeat = choose_repeats(shapes, 0.5 * (smooth["wobble"] + smooth["wobble_crossed"]))
    suffix = f"_vertices_{repeat}"
    shapes |= {name.replace(suffix, "_vertices"): values for name, values in shapes.items()
               if name.endswith(suffix) or f"{suffix}_" in name}
    numbers = {name: measure_shape(shapes, name) for name in ("flawed", "clean")}
    numbers |= {tool: measure_tool(shapes, tool) for tool in TOOLS}
    numbers["vertices"]["repeats"] = repeat
    return numbers, shapes
