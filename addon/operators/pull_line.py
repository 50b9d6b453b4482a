"""Pull Line."""
from contextlib import suppress
from dataclasses import replace

import bpy
import numpy as np
from bpy.props import BoolProperty, IntProperty, IntVectorProperty, StringProperty

from ..blender.tooltips import tell_by
from ..interactive import drag_input, drawn_lines
from ..interactive.drag_handles import Handle
from ..interactive.line_build import LineBuild
from ..interactive.line_drag import LineDrag
from ..interactive.solve_job import SolveOutcome
from ..model import line_handle
from ..model.line_handle import Handles
from ..model.patch import Patch
from ..model.refusal import Refusal, report_refusals
from ..model.solution import Solution
from ..model.view import View
from ..read import scene_objects
from ..solver.live_optimizer import BuildTarget
from ..state import solve_history
from ..targets.falloff import Falloff
from ..view import screen_surface
from ..view.screen_surface import ScreenSurface
from ..ui.tool_properties import PullSettings
from .dragged_tool import DraggedTool
from .solve_tool import FOLLOWING

APPLY_KEYS, DELETE_KEYS = {'RET', 'NUMPAD_ENTER'}, {'X', 'DEL'}
LAID = {'S': drawn_lines.straighten_line, 'E': drawn_lines.follow_edge}  # how a key lays the line under the mouse


class REFLINES_OT_pull_line(DraggedTool, PullSettings, bpy.types.Operator):
    """Take a reflection line with the mouse and pull it: the panel follows, with the lines around it. A handle stays
where a line was pulled to; Enter applies them all"""
    bl_idname = "reflines.pull_line"
    bl_label = "Pull Line"
    bl_options = {'REGISTER', 'UNDO', 'BLOCKING'}
    needs_faces = False  # a press in the view says what is missing

    handles: StringProperty(name="Handles", options={'HIDDEN', 'SKIP_SAVE'},
                            description="As JSON, see model/line_handle.py; empty in Re-solve: those of the object")

    draws: BoolProperty(options={'HIDDEN', 'SKIP_SAVE'}, description="Draw Highlight: a press draws a line")

    taken: IntVectorProperty(size=2, default=(-1, -1), options={'HIDDEN', 'SKIP_SAVE'},
                             description="Kept handle, and number of its dot, that the press takes; -1: what is there")

    description = tell_by("draws", {True: "Draw how a reflection line is to run: the line at the start of the stroke "
                                    "is laid along it. Its dots can be moved, Enter applies"})

    def draw(self, _context: bpy.types.Context) -> None:
        self.layout.use_property_split = True
        self.layout.prop(self, "border")

    def find_scene_settings(self, scene: bpy.types.Scene) -> bpy.types.PropertyGroup:
        return scene.reflection_lines.pull

    def find_subjects(self, context: bpy.types.Context) -> list[bpy.types.Object]:
        """Returns the active object, to which handles belong, and after it those that may follow it over a gap."""
        found = scene_objects.find_subjects(context)  # refuses where no face is selected
        active = scene_objects.find_active_object(context)
        if self.anew:
            return [active, *scene_objects.find_partners(context, active)]
        return [active, *(ob for ob in found if self.border in FOLLOWING and ob != active)]

    def gather_all(self, context: bpy.types.Context, subjects: list[bpy.types.Object]) -> list[tuple[Patch, View]]:
        """Gathers the patches; one that cannot be solved does not follow."""
        beside: list[tuple[Patch, View]] = []
        for ob in subjects[1:]:
            with suppress(Refusal):
                beside += super().gather_all(context, [ob])
        gathered = [*super().gather_all(context, subjects[:1]), *beside]
        self.panels = [patch for patch, _ in gathered]
        return gathered

    def join_panels(self, context: bpy.types.Context, gathered: list[tuple[Patch, View]]) -> list[tuple[Patch, View]]:
        """Returns the patch of the active object alone, which may be one with those that it meets."""
        own = gathered[0][0].name
        found = super().join_panels(context, gathered)
        return [(patch, seen) for patch, seen in found if own in {panel.name for panel in patch.panels}]

    def begin_run(self, ob: bpy.types.Object) -> np.ndarray | None:
        """Returns the shape to begin with; of an object that follows another one that before its last run only where
        that was such a run, too.
        """
        if ob != scene_objects.find_active_object(bpy.context) and ob.reflection_lines.run.operator != self.bl_idname:
            return None
        return super().begin_run(ob)

    def build_handles(self) -> tuple[Handle, ...]:
        return ()

    def read_falloff(self, _context: bpy.types.Context, _ob: bpy.types.Object, _patch: Patch) -> Falloff | None:
        """Returns the circle around the handle that the mouse works on, in a drag."""
        drag = getattr(self, "drag", None)
        index = drag.find_active() if drag is not None else None
        if index is None or drag.handles[index].is_pin:
            return None
        own = drag.handles[index]
        return Falloff(drag.own.to_world(np.array(own.start)), own.radius, np.zeros(2))

    def build_target(self, context: bpy.types.Context, ob: bpy.types.Object, patch: Patch) -> BuildTarget:
        if self.anew and not self.handles and not self.in_session:
            kept = ob.reflection_lines.handles
            self.handles, self.are_kept = line_handle.encode_handles(kept.read(ob.data)), bool(kept.kept)
        handles = line_handle.decode_handles(self.handles)
        if not handles and not self.in_session:
            raise Refusal(f"{patch.name}: no line is pulled; press Pull Line in a 3D view and drag a line")
        return self.lines.build(context.scene, ob, patch, handles)

    def begin(self, context: bpy.types.Context, *, in_session: bool) -> None:
        """Begins a run: what it keeps for itself, beside the properties."""
        self.lines = LineBuild(context.scene)
        self.builder, self.in_session = self.lines.builder, in_session
        self.gathered: dict[str, Patch] = {}  # by objects' names, at the beginning of a session
        self.are_kept = False            # whether the handles are those of the object, as it has them
        self.key_notes: tuple[str, ...] = ()  # of the keys of handles

    def execute(self, context: bpy.types.Context) -> set[str]:
        self.begin(context, in_session=False)
        try:
            return super().execute(context)
        finally:
            self.lines = self.builder = None

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        self.follow_mouse = True
        self.begin(context, in_session=True)
        presses = event.type == 'LEFTMOUSE' and event.value == 'PRESS'
        self.pressed = (event.mouse_x, event.mouse_y) if presses and self.taken[0] < 0 else None
        result = super().invoke(context, event)
        if 'RUNNING_MODAL' in result and presses:
            self.drag.take_dot(*self.taken)
            self.drag.press(event.mouse_x, event.mouse_y, pins=event.alt)
        return result

    def begin_drag(self, context: bpy.types.Context) -> LineDrag:
        others = self.choose_object(context)
        ob = self.find_subjects(context)[0]
        drag = LineDrag(self, context, self.find_stored_handles(ob), others)
        self.gathered.clear()
        return drag

    def choose_object(self, context: bpy.types.Context) -> dict[str, ScreenSurface]:
        """Makes that of several objects in Edit Mode active whose selected faces were pressed on, as Blender does with
        what is clicked; returns the others by their names, to tell of them.
        """
        subjects, found = scene_objects.find_subjects(context), {}
        for ob in subjects if len(subjects) > 1 else ():
            with suppress(Refusal):  # this one cannot be pulled
                self.gathered[ob.name] = self.gather_patch(ob)
                found[ob.name] = screen_surface.build_screen(self.gathered[ob.name], context.area)
        if self.pressed is not None and found:
            foremost = screen_surface.find_foremost(list(found.values()), *self.pressed)
            if foremost is not None:
                context.view_layer.objects.active = bpy.data.objects[list(found)[foremost[0]]]
        found.pop(scene_objects.find_active_object(context).name, None)
        return found

    def gather_patch(self, ob: bpy.types.Object) -> Patch:
        """Gathers a patch: once, where the session begins with the mesh as it is, which was seen then."""
        known = self.gathered.pop(ob.name, None)
        return super().gather_patch(ob) if known is None or self.anew else known

    def find_stored_handles(self, ob: bpy.types.Object) -> Handles:
        """Returns the handles that are kept with the object. Where the mesh is as they left it, the session begins with
        the shape before them; else they are at rest and hold the lines where they are.
        """
        stored = ob.reflection_lines
        if stored.handles.text and ob.mode == 'EDIT':
            ob.update_from_editmode()
        handles = stored.handles.read(ob.data)
        self.anew = (bool(handles) and stored.run.operator == self.bl_idname
                     and solve_history.read_original_shape(ob, self.result) is not None and has_partners(ob))
        return handles if self.anew else tuple(replace(each, start=each.end) for each in handles)

    def handle_event(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        drag = self.drag
        if event.type in drag_input.CANCEL_KEYS and event.value == 'PRESS':
            return self.take_back(context, event)
        if event.type in drag_input.NAVIGATION:
            drag.looked = False
            return {'PASS_THROUGH'}
        if drag.keeping:
            return {'RUNNING_MODAL'}
        if event.type in APPLY_KEYS and event.value == 'PRESS' and not drag.typed:
            return self.apply(context)
        self.change_handles(event)
        drag.update_texts(context)
        return {'RUNNING_MODAL'}

    def take_back(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Takes back a typed radius; at the right button the pull, the stroke or the radius that the mouse changes now;
        else the whole session.
        """
        drag = self.drag
        at_work = drag.held is not None or drag.sizing is not None or bool(drag.stroke)
        if drag.history and (drag.typed or (at_work and event.type != 'ESC')):
            drag.go_to(drag.history.drop())
            return {'RUNNING_MODAL'}
        return self.cancel_drag(context)

    def apply(self, context: bpy.types.Context) -> set[str]:
        """Solves for what is kept; where nothing was pulled the session ends."""
        if not self.drag.handles and not self.anew:
            return self.cancel_drag(context)
        self.drag.submit_request(context, final=True)
        self.drag.update_texts(context)
        return {'RUNNING_MODAL'}

    def take_outcome(self, context: bpy.types.Context, outcome: SolveOutcome) -> set[str]:
        """Takes an outcome; after a refusal of what is to be applied the session goes on: no handle is lost."""
        drag = self.drag
        if outcome.refusal and drag.keeping and drag.job.ready:
            drag.keeping, drag.problem = False, outcome.refusal
            drag.update_texts(context)
            return {'RUNNING_MODAL'}
        return super().take_outcome(context, outcome)

    def change_handles(self, event: bpy.types.Event) -> None:
        """Changes handles by the mouse, the wheel or a key."""
        drag = self.drag
        if event.type == 'MOUSEMOVE':
            drag.move_to(event.mouse_x, event.mouse_y, precise=event.shift, back=event.ctrl)
        elif event.type == 'LEFTMOUSE':
            self.click(event)
        elif event.type in drag_input.NOTCHES:
            drag.turn_wheel(drag_input.NOTCHES[event.type])
        elif event.value == 'PRESS':
            self.press_key(event)

    def click(self, event: bpy.types.Event) -> None:
        drag = self.drag
        if drag.sizing is not None:
            drag.sizing = None
        elif event.value == 'PRESS':
            drag.press(event.mouse_x, event.mouse_y, pins=event.alt)
        elif event.value == 'RELEASE':
            drag.pressed = None if drag.surface is None else drag.pressed
            drag.release()

    def press_key(self, event: bpy.types.Event) -> None:
        drag = self.drag
        plain = not (event.ctrl or event.alt or event.oskey)
        if drag.typed and event.type in APPLY_KEYS:
            drag.typed = ""
        elif drag.typed and event.type == 'BACK_SPACE':
            drag.set_typed(drag.typed[:-1])
        elif plain and drag.type_radius(drag_input.read_character(event)):
            return
        elif event.type in DELETE_KEYS:
            drag.delete_active()
        elif plain and event.type in LAID:
            drag.lay_line(LAID[event.type])
        elif event.type == 'D':
            drag.draws = not drag.draws
        elif event.type == 'N' and drag.draws:
            drag.nearest = not drag.nearest
        elif event.type == 'M':
            drag.mute_active()
        elif event.type == 'P':
            drag.press(*drag.last, pins=True)
            drag.release()
        elif event.type == 'F' and drag.sizing is None:
            drag.begin_sizing()
        elif event.type == 'Z' and (event.ctrl or event.oskey):
            (drag.step_forward if event.shift else drag.step_back)()

    def describe_solution(self, solution: Solution) -> tuple[str, ...]:
        if solution.patch.name != scene_objects.find_active_object(bpy.context).name:  # one that followed
            return ()
        return self.builder.conflicts + self.builder.missed + self.key_notes

    def record_solution(self, ob: bpy.types.Object, solution: Solution) -> None:
        if ob != scene_objects.find_active_object(bpy.context):  # one that followed
            super().record_solution(ob, solution)
            return
        held = self.builder.missed and not solution.report.limited and self.border != 'free'
        if not self.are_kept:
            self.keep_handles(ob)
        super().record_solution(ob, replace(solution, remedy="free") if held else solution)

    def keep_handles(self, ob: bpy.types.Object) -> None:
        """Keeps the handles with the object, and takes their numbers for the redo panel."""
        kept = ob.reflection_lines.handles
        self.key_notes = kept.keep(line_handle.decode_handles(self.handles), ob.data)
        self.handles = line_handle.encode_handles(kept.read(ob.data))

    def end_drag(self, context: bpy.types.Context) -> None:
        super().end_drag(context)
        self.lines = self.builder = None


def has_partners(ob: bpy.types.Object) -> bool:
    """Returns whether those that followed an object's last pull are at hand, so that it can be repeated."""
    with suppress(Refusal):
        scene_objects.find_partners(bpy.context, ob)
        return True
    return False


class REFLINES_OT_delete_handles(bpy.types.Operator):
    """Delete the handles that are kept with the active object, with their keys; its shape stays as it is"""
    bl_idname = "reflines.delete_handles"
    bl_label = "Delete Handles"
    bl_options = {'REGISTER', 'UNDO'}

    index: IntProperty(default=-1, options={'HIDDEN', 'SKIP_SAVE'}, description="The only one to delete; -1: all")

    @classmethod
    def description(cls, _context: bpy.types.Context, properties: bpy.types.OperatorProperties) -> str:
        """Returns the tooltip of the button for one handle; empty for the other, which has the docstring."""
        one = properties.index >= 0
        return "Delete this handle, with its keys; the shape stays as it is until Re-solve" if one else ""

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = scene_objects.find_active_object(context)
        cls.poll_message_set("Make a panel active that has handles")
        return ob is not None and bool(ob.reflection_lines.handles.text)

    @report_refusals
    def execute(self, context: bpy.types.Context) -> set[str]:
        ob = scene_objects.find_active_object(context)
        left = self.find_left(ob)
        for note in ob.reflection_lines.handles.keep(left, ob.data):
            self.report({'WARNING'}, f"{ob.name}: {note}")
        return {'FINISHED'}

    def find_left(self, ob: bpy.types.Object) -> Handles:
        """Returns the handles that stay; all go where they cannot be used."""
        if self.index < 0:
            return ()
        if ob.mode == 'EDIT':
            ob.update_from_editmode()
        handles = ob.reflection_lines.handles.read(ob.data)
        return tuple(each for index, each in enumerate(handles) if index != self.index)
