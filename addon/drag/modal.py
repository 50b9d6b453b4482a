"""Tools that start under the mouse: drag, and the panel follows; Enter keeps, Esc takes all back.

Blender's side of a drag: events, the header, the timer, and the mesh. What is solved is in pursuit.py, in a thread.
"""
import time
from contextlib import suppress

import bpy
import numpy as np

from .. import session, solving
from ..bridge import apply, gather, units
from ..bridge.gather import Panel
from ..bridge.refusal import Refusal
from ..overlay import circle
from ..targets.falloff import Falloff
from ..tool import AUTOMATIC_RADIUS, Tool
from ..worker import Worker
from .motion import Handle, Motion
from .pursuit import Outcome, Pursuit, Request

TICK = 0.01          # seconds between looks at what the thread has
SAYS_BUSY = 0.3      # seconds of solving after which the status bar tells of it
DIGITS = {name: str(digit) for digit, word in enumerate(
    ("ZERO", "ONE", "TWO", "THREE", "FOUR", "FIVE", "SIX", "SEVEN", "EIGHT", "NINE"))
    for name in (word, f"NUMPAD_{digit}")}
CHARACTERS = DIGITS | {'PERIOD': '.', 'NUMPAD_PERIOD': '.', 'COMMA': '.', 'MINUS': '-', 'NUMPAD_MINUS': '-'}
NOTCHES = {'WHEELUPMOUSE': 1, 'WHEELDOWNMOUSE': -1}
KEEP, LEAVE = {'LEFTMOUSE', 'RET', 'NUMPAD_ENTER'}, {'ESC', 'RIGHTMOUSE'}
NAVIGATION = {'MIDDLEMOUSE', 'TRACKPADPAN', 'TRACKPADZOOM', 'NDOF_MOTION'}
KEYS = "LMB, Enter: keep   RMB, Esc: cancel   Shift: precision   0-9: type   MMB: turn the view"


class Drag:
    """From the press of the button to its end."""

    def __init__(self, tool: "DraggedTool", context: bpy.types.Context) -> None:
        scene = context.scene
        self.tool, self.area = tool, context.area
        subjects = gather.subjects(context)
        self.panels, self.counts = [tool.panel_of(ob) for ob in subjects], [apply.counts(ob) for ob in subjects]
        views = [session.view_of(scene, panel.center) for panel in self.panels]
        self.shown = [apply.start(panel) for panel in self.panels]
        self.vertices = [apply.EditVertices(panel.index) for panel in self.panels]
        self.motion = self.motion_of(scene)
        self.frame = solving.frame_of(self.panels[0], views[0])
        self.request(context)  # refuses before anything is begun
        self.pursuit = Pursuit(self.panels, views, tool.border)
        self.circle = circle.add(lambda: self.reach)
        self.worker = Worker(self.pursuit.run, self.pursuit.end)
        self.worker.submit(self.wanted)
        self.keeping, self.busy_since, self.problem, self.said = False, time.monotonic(), "", ("", "")
        self.moved = False  # the mouse, since the thread was asked
        self.timer = context.window_manager.event_timer_add(TICK, window=context.window)
        session.drags.append(self)

    def motion_of(self, scene: bpy.types.Scene) -> Motion:
        handles = self.tool.handles()
        starts = [getattr(self.tool, handle.name) or self.tool.automatic(handle.name, self.panels[0])
                  for handle in handles]
        return Motion(handles, starts, [typed_unit(handle, scene) for handle in handles])

    def objects(self) -> list[bpy.types.Object]:
        """Refuses where somebody else changed what is dragged."""
        found = [bpy.data.objects.get(panel.name) for panel in self.panels]
        for ob, panel, shown, counts in zip(found, self.panels, self.shown, self.counts, strict=True):
            same = ob is not None and ob.type == 'MESH' and apply.counts(ob) == counts
            if not same or not apply.still_has(ob, panel, shown):
                raise Refusal(f"{panel.name} was changed while it was dragged: it is left as it is now")
        return found

    def request(self, context: bpy.types.Context, *, final: bool = False) -> None:
        """Puts the mouse's values into the tool's properties, and what they ask for into `wanted`."""
        for index, handle in enumerate(self.motion.handles):
            if self.motion.touched(index):
                setattr(self.tool, handle.name, self.motion.value(index))
        builds = tuple(self.tool.build_target(context, ob, panel)
                       for ob, panel in zip(self.objects(), self.panels, strict=True))
        self.wanted = Request(builds, solving.Settings(self.tool.border, self.tool.detail(context.scene)), final)
        falloff = self.tool.falloff(context, self.objects()[0], self.panels[0])
        self.reach = circle.around(falloff.centre, falloff.radius, self.frame) if falloff else None

    def ask(self, context: bpy.types.Context, *, final: bool = False) -> None:
        self.moved = False
        try:
            self.request(context, final=final)
        except Refusal as refusal:
            self.problem = str(refusal)
            return
        self.keeping = final
        if self.worker.idle():
            self.busy_since = time.monotonic()
        self.worker.submit(self.wanted)

    def show(self, positions: tuple[np.ndarray, ...]) -> None:
        new = [apply.local(panel, wanted) for panel, wanted in zip(self.panels, positions, strict=True)]
        self.write(new)

    def write(self, new: list[np.ndarray]) -> None:
        every = zip(self.objects(), self.panels, new, self.shown, self.vertices, strict=True)
        for ob, panel, to, now, vertices in every:
            apply.show(ob, panel, to, now, vertices)
        self.shown = new

    def land(self, solutions: tuple[solving.Solution, ...]) -> None:
        """What was shown so far in the mesh goes into a shape key where that is wanted."""
        if not any(panel.key for panel in self.panels):
            return
        self.restore()
        for ob, solution in zip(self.objects(), solutions, strict=True):
            apply.keep_region(ob, solution.panel)
        for ob, solution in zip(self.objects(), solutions, strict=True):
            apply.apply(ob, solution.panel, solution.positions)
        self.shown = [apply.local(solution.panel, solution.positions) for solution in solutions]

    def restore(self) -> None:
        self.write([apply.start(panel) for panel in self.panels])

    def say(self, context: bpy.types.Context) -> None:
        values = "   ".join(self.text_of(context, index) for index in range(len(self.motion.handles)))
        header = f"{self.tool.bl_label}   {values}" + (f"   {self.problem}" if self.problem else "")
        working = not self.worker.idle() and time.monotonic() - self.busy_since > SAYS_BUSY
        more = "   Tab: next value" if len(self.motion.handles) > 1 else ""
        turned = self.motion.on_wheel()
        wheel = f"   Wheel: {turned.label.lower()}" if turned else ""
        status = f"{self.pursuit.doing()}   Esc: cancel" if working or self.keeping else KEYS + more + wheel
        if self.said != (header, status):  # each text that is set draws its bar again
            self.said = header, status
            self.area.header_text_set(header)
            context.workspace.status_text_set(status)

    def text_of(self, context: bpy.types.Context, index: int) -> str:
        handle, typed = self.motion.handles[index], self.motion.typed[index]
        held = index == self.motion.held and len(self.motion.handles) > 1
        shown = f"[{typed}|]" if typed else in_units(handle, self.motion.value(index), context.scene)
        return f"{'> ' if held else ''}{handle.label}: {shown}"

    def end(self, context: bpy.types.Context) -> None:
        """Leaves the window as it was. The thread ends after what it is doing now."""
        session.drags.remove(self)
        context.window_manager.event_timer_remove(self.timer)
        if self.worker.idle():
            self.pursuit.give_back()
        self.worker.stop()
        circle.remove(self.circle)
        self.area.header_text_set(None)
        context.workspace.status_text_set(None)

    def give_up(self, context: bpy.types.Context) -> None:
        """From outside: Blender ends, opens another file or disables the add-on."""
        with suppress(Refusal):  # the mesh is gone, or no longer as the drag left it
            self.restore()
        self.end(context)


def typed_unit(handle: Handle, scene: bpy.types.Scene) -> float:
    """What a typed 1 means to the property: degrees, and the scene's unit of length."""
    if handle.unit == 'ANGLE':
        return float(np.radians(1.0)) if scene.unit_settings.system_rotation == 'DEGREES' else 1.0
    return units.typed_length(scene) if handle.unit == 'LENGTH' else 1.0


def in_units(handle: Handle, value: float, scene: bpy.types.Scene) -> str:
    if handle.unit == 'ANGLE':
        degrees = scene.unit_settings.system_rotation == 'DEGREES'
        return f"{np.degrees(value):.2f}\u00b0" if degrees else f"{value:.4f}"
    if handle.unit == 'LENGTH':
        return units.length_text(value, scene)
    return f"{value:.1f} %" if handle.unit == 'PERCENT' else f"{value:.3f}"


def radius_handle(centre: str) -> tuple[Handle, ...]:
    """Of a tool with tool_settings.FalloffSettings."""
    if centre == 'EVERYWHERE':
        return ()
    return (Handle("radius", "Radius", per_pixel=1.0 / 150.0, low=1e-9, high=1e9, doubles=True, unit='LENGTH',
                   wheel=True),)


class DraggedTool(Tool):
    """A tool with handles: started by a key or a button it follows the mouse, by a script it runs at once."""
    bl_options = {'REGISTER', 'UNDO', 'BLOCKING', 'GRAB_CURSOR'}

    def handles(self) -> tuple[Handle, ...]:
        """The first is the mouse's; Tab goes to the next."""
        raise NotImplementedError

    def automatic(self, name: str, panel: Panel) -> float:
        """What 0 stands for in a property."""
        return {"length": solving.length_of(panel, 0.0), "radius": AUTOMATIC_RADIUS * panel.diagonal}.get(name, 0.0)

    def falloff(self, _context: bpy.types.Context, _ob: bpy.types.Object, _panel: Panel) -> Falloff | None:
        """None where the tool acts everywhere alike."""
        return None

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if context.area is None or context.area.type != 'VIEW_3D':
            return self.execute(context)
        context.view_layer.update()
        self.take_settings(context.scene)
        try:
            self.drag = Drag(self, context)
        except Refusal as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        self.drag.motion.move(event.mouse_x, precise=False)
        self.drag.say(context)
        context.window_manager.modal_handler_add(self)
        return {'RUNNING_MODAL'}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        try:
            return self.tick(context) if event.type == 'TIMER' else self.pressed(context, event)
        except Refusal as refusal:
            self.let_go(context)
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}

    def tick(self, context: bpy.types.Context) -> set[str]:
        drag = self.drag
        if drag.moved and drag.worker.idle():
            drag.ask(context)  # and not at each move: Blender draws all of its windows when a value is set
        outcome = drag.worker.take()
        if outcome is None and not drag.worker.alive():
            return self.leave(context, "The solver stopped: the mesh is as it was before")
        if outcome is not None and (outcome.refusal or outcome.solutions or not drag.keeping):
            return self.take(context, outcome)
        drag.say(context)
        return {'RUNNING_MODAL'}

    def take(self, context: bpy.types.Context, outcome: Outcome) -> set[str]:
        drag = self.drag
        drag.problem = outcome.refusal
        if outcome.refusal and (drag.keeping or not drag.pursuit.ready):
            return self.leave(context, outcome.refusal)
        if not outcome.refusal:
            drag.show(outcome.positions)
        if outcome.solutions:
            return self.finish(context, outcome)
        drag.say(context)
        return {'RUNNING_MODAL'}

    def pressed(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Keys of others are swallowed: an undo or a change of the mode now would meet a mesh between two states."""
        if event.type in LEAVE and event.value == 'PRESS':
            return self.leave(context)
        if event.type in NAVIGATION or event.type in NOTCHES and self.drag.motion.on_wheel() is None:
            return {'PASS_THROUGH'}
        if self.drag.keeping:
            return {'RUNNING_MODAL'}
        if event.type in KEEP and event.value == 'PRESS':
            self.drag.ask(context, final=True)
        elif self.moved(event):
            self.drag.moved = True
        self.drag.say(context)
        return {'RUNNING_MODAL'}

    def moved(self, event: bpy.types.Event) -> bool:
        """Whether the event may have changed a value."""
        motion = self.drag.motion
        if event.type == 'MOUSEMOVE':
            motion.move(event.mouse_x, precise=event.shift)
            return not motion.typed[motion.held]
        if event.type in NOTCHES:
            motion.wheel(NOTCHES[event.type], precise=event.shift)
            return True
        if event.value == 'PRESS':
            return self.typed(event.type)
        return False

    def typed(self, key: str) -> bool:
        motion = self.drag.motion
        if key in CHARACTERS:
            motion.type(CHARACTERS[key])
        elif key == 'BACK_SPACE':
            motion.erase()
        elif key == 'TAB':
            motion.hold_next()
            return False
        else:
            return False
        return True

    def finish(self, context: bpy.types.Context, outcome: Outcome) -> set[str]:
        self.drag.land(outcome.solutions)
        for ob, solution in zip(self.drag.objects(), outcome.solutions, strict=True):
            self.keep(ob, solution)
        self.let_go(context)
        return {'FINISHED'}

    def leave(self, context: bpy.types.Context, why: str = "") -> set[str]:
        self.drag.restore()
        self.let_go(context)
        if why:
            self.report({'ERROR'}, why)
        return {'CANCELLED'}

    def let_go(self, context: bpy.types.Context) -> None:
        """Blender keeps the operator for its redo panel; the drag holds factors of large matrices."""
        drag, self.drag = self.drag, None
        drag.end(context)

    def cancel(self, context: bpy.types.Context) -> None:
        """Blender ends, or opens another file."""
        drag, self.drag = self.drag, None
        drag.give_up(context)
