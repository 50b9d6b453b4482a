"""Drives Blender in a real window: a test is a generator that types, moves the mouse and yields the seconds to wait."""
import os
import sys
import time
import traceback
from collections.abc import Callable, Generator

import bpy

import installation

Steps = Generator[float, None, None]
Test = Callable[["Window"], Steps]


class Window:
    """The one window, its 3D view, and the simulated mouse and keyboard."""

    def __init__(self) -> None:
        self.window = bpy.context.window_manager.windows[0]
        self.x = self.y = 0

    def area(self, kind: str = 'VIEW_3D') -> bpy.types.Area:
        return next(area for area in self.window.screen.areas if area.type == kind)

    def region(self, kind: str = 'WINDOW') -> bpy.types.Region:
        return next(region for region in self.area().regions if region.type == kind)

    def region_3d(self) -> bpy.types.RegionView3D:
        return self.area().spaces.active.region_3d

    def override(self) -> object:
        return bpy.context.temp_override(window=self.window, area=self.area(), region=self.region())

    def move(self, x: float, y: float) -> None:
        """In pixels of the 3D view's region."""
        self.x, self.y = self.region().x + int(x), self.region().y + int(y)
        self.event('MOUSEMOVE')

    def event(self, kind: str, value: str = 'NOTHING', **modifiers: bool) -> None:
        self.window.event_simulate(type=kind, value=value, x=self.x, y=self.y, **modifiers)

    def key(self, kind: str, **modifiers: bool) -> None:
        self.event(kind, 'PRESS', **modifiers)
        self.event(kind, 'RELEASE', **modifiers)

    def read_last_report(self) -> str:
        """The last line of what Blender's Info editor tells, which another editor is for a moment."""
        area = self.area('PROPERTIES')
        area.type = 'INFO'
        region = next(region for region in area.regions if region.type == 'WINDOW')
        with bpy.context.temp_override(window=self.window, area=area, region=region):
            bpy.ops.info.select_all(action='SELECT')
            bpy.ops.info.report_copy()
        area.type = 'PROPERTIES'
        return bpy.context.window_manager.clipboard.strip().rpartition("\n")[2]

    def redraw(self) -> None:
        for area in self.window.screen.areas:
            area.tag_redraw()


def take_picture(driver: Window, name: str) -> Steps:
    """Saves the window as NAME.png in the folder that REFLINES_PICTURES names; does nothing where it names none."""
    if "REFLINES_PICTURES" in os.environ:
        driver.redraw()
        yield 0.3
        bpy.ops.screen.screenshot(filepath=os.path.join(os.environ["REFLINES_PICTURES"], f"{name}.png"))
        yield 0.3


def find_tests(names: dict[str, object]) -> list[Test]:
    """Returns the tests among the names of a file that was run as the main one, in its order."""
    return [each for name, each in names.items()
            if name.startswith("test_") and getattr(each, "__module__", None) == "__main__"]


def draw_sparingly() -> None:
    """Leaves away what a processor draws for longer than all else: smooth edges, for which Blender draws a view at rest
    eight times, and the floor, which with smooth wires takes a third of the time of a view."""
    system = bpy.context.preferences.system
    system.viewport_aa, system.use_overlay_smooth_wire, system.use_edit_mode_smooth_wire = 'OFF', False, False
    for space in (area.spaces.active for area in bpy.context.window_manager.windows[0].screen.areas):
        if space.type == 'VIEW_3D':
            space.overlay.show_floor = space.overlay.show_axis_x = space.overlay.show_axis_y = False


def run(*tests: Test) -> None:
    """Runs the tests from a timer."""
    start(all_steps(tests))


def rest() -> float:
    """Leaves the processor to others for a moment; Blender turns in a loop while it waits for simulated events."""
    time.sleep(0.004)
    return 0.0


def start(steps: Steps) -> None:
    """From a timer, with the add-on enabled."""
    bpy.context.preferences.view.show_splash = False
    installation.install()
    bpy.app.timers.register(rest, persistent=True)
    bpy.app.timers.register(lambda: next(steps), first_interval=1.0, persistent=True)


def all_steps(tests: tuple[Test, ...]) -> Steps:
    """Runs them one after the other, prints the line of counts, and ends Blender."""
    passed = 0
    for test in tests:
        start = time.monotonic()
        draw_sparingly()
        try:
            yield from test(Window())
            passed += 1
            print(f"{time.monotonic() - start:6.1f} s {test.__name__}", flush=True)
        except BaseException as error:  # noqa: BLE001  (a Blender that is not ended waits for a user for ever)
            traceback.print_exc()
            print(f"FAILED {test.__name__}: {type(error).__name__}: {error}".partition("\n")[0])
    print(f"{passed} passed, {len(tests) - passed} failed, 0 skipped")
    sys.stdout.flush()
    os._exit(0 if passed == len(tests) else 1)
