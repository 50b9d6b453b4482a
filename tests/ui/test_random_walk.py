"""A random walk through Blender in a window: no step may end in an error of Python or a crash, whatever came before.

    REFLINES_WALK=500 REFLINES_SEED=3    length and seed; the suite walks a shorter way, `./run walk` a long one
"""
import os
import sys
import tempfile
from pathlib import Path

import addon_utils

import random_steps as steps
import window
from window import Steps

LENGTH = int(os.environ.get("REFLINES_WALK", "80"))
SEED = int(os.environ.get("REFLINES_SEED", "1"))
# How often each step is taken, as a share of the sum.
STEPS = {
    steps.run_tool: 14, steps.drag_tool: 14, steps.surprised_drag: 5, steps.grab: 3, steps.undo: 9, steps.redo: 5,
    steps.change_mode: 8, steps.change_settings: 8, steps.select: 8, steps.change_mesh: 6, steps.add_modifier: 3,
    steps.delete_something: 4, steps.activate: 5, steps.reload_addon: 3, steps.reinstall: 2, steps.save: 3,
    steps.load: 3, steps.new_panel: 8, steps.another_panel: 2, steps.pull_lattice: 12,
    steps.pull_lines: 10, steps.press_on_many_faces: 5,
}


class Listener:
    """Stands for stderr: what Blender prints of errors in operators, handlers, timers and threads goes through it."""

    def __init__(self, stream: object) -> None:
        self.stream, self.heard = stream, []

    def write(self, text: str) -> int:
        if "Traceback" in text or "Error:" in text:
            self.heard.append(text)
        return self.stream.write(text)

    def flush(self) -> None:
        self.stream.flush()


def test_a_random_walk(driver: window.Window) -> Steps:
    """Without Cycles: its rendered view aborts (in Embree: ray.valid()) where an object is scaled by 0, in a Blender
    that has no add-on, too. The walk comes there by a sample's engine, Z, a move in the pie menu, and a resize."""
    addon_utils.disable("cycles")
    walker = steps.Walker(SEED, str(Path(tempfile.mkdtemp()) / "walk.blend"))
    sys.stderr = Listener(sys.stderr)
    yield from steps.new_panel(walker)
    yield from steps.save(walker)
    for number in range(LENGTH):
        step = walker.dice.choices(list(STEPS), list(STEPS.values()))[0]
        ob = walker.active()
        print(f"{number}: {step.__name__} ({ob.name if ob else '-'}, {ob.mode if ob else '-'})", flush=True)
        yield from step(walker)
        assert not sys.stderr.heard, f"step {number} of seed {SEED}: {step.__name__}"
    sys.stderr = sys.stderr.stream
