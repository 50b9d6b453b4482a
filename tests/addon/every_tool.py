"""Runs every tool on an object, whatever state it is in: each ends soon, finished or with a sentence. What it refused
has changed nothing, and what it finished has moved nothing out of sight.
"""
import json
import time

import bpy
import numpy as np

import scenes

SLOWEST = 8.0    # seconds of a tool on two cores with other work
FURTHEST = 10.0  # diagonals of the mesh
PULL = json.dumps([{"start": [0.1, 0.0, 0.0], "end": [0.1, 0.1, 0.0], "radius": 0.5, "pinned": [], "muted": False}])
CHANGING = {
    "smooth": {}, "smooth by length": {"length": 0.5}, "smooth to the border": {"border": 'free', "length": 0.3},
    "direction": {"density": 2.0, "axis": 'ALONG', "centre": 'EVERYWHERE'}, "direction of most lines": {"density": 1e6},
    "direction as set": {}, "direction turned": {"angle": 0.5}, "direction straight": {"direction": 'MEAN'},
    "warp": {}, "warp by place": {"fit": 'VALUE'}, "pattern": {},
    "pattern by place": {"fit": 'VALUE', "blur": 0.0}, "pull_line": {"handles": PULL}, "fit": {}, "check": {},
    "inspect": {}, "inspect in the set": {"lights": 'SET'}, "show_spot": {}, "show_spot worse": {"worse": True},
    "show_spot of none": {"index": 10**6},
    "set_border": {"border": 'fixed'}, "resolve": {}, "bake_handles": {},
    "smooth into a key": {"result": 'SHAPE_KEY'}, "smooth for the set": {"lights": 'SET'},
}
# Of the scene rather than of the object.
OTHERS = {
    "add_warp_lattice": {}, "live_warp": {}, "live_warp kept": {"action": 'APPLY'},
    "live_warp taken back": {"action": 'DISCARD'}, "set_up": {}, "set_up as before": {"part": 'PANEL'},
    "set_up of a light": {"part": 'LIGHT'}, "set_up of another camera": {"part": 'CAMERA'},
    "delete_handles": {}, "light_set": {}, "light_set with another": {"action": 'ADD'},
    "light_set with one less": {"action": 'REMOVE'},
}


def provoke(name: str, settings: dict) -> str:
    """Runs a tool; returns the sentence with which it was refused, empty where it finished."""
    start = time.monotonic()
    try:
        getattr(bpy.ops.reflines, name.split()[0])('EXEC_DEFAULT', True, **settings)
        said = ""
    except RuntimeError as error:
        said = str(error)
    assert "Traceback" not in said, f"{name}: {said}"
    assert time.monotonic() - start < SLOWEST, f"{name}: {time.monotonic() - start:.1f} s"
    return said


def require_in_sight(before: np.ndarray, after: np.ndarray, name: str) -> None:
    """No vertex has come to a place that is none, or far from where it was."""
    finite = np.isfinite(before).all(axis=1)
    before, after = before[finite].astype(np.float64), after[finite].astype(np.float64)
    assert np.isfinite(after).all(), name
    if len(before):
        assert np.abs(after - before).max() <= FURTHEST * np.linalg.norm(np.ptp(before, axis=0)), name


def run_every_tool(ob: bpy.types.Object) -> None:
    for name, settings in CHANGING.items():
        before, place = scenes.fingerprint(ob), scenes.positions(ob)
        if provoke(name, settings):
            assert scenes.fingerprint(ob) == before, name
        else:
            require_in_sight(place, scenes.positions(ob), name)
        ob.reflection_lines.report.headline()
    for name, settings in OTHERS.items():
        provoke(name, settings)
