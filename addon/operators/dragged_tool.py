"""The base of tools that can be dragged: pressed they solve at once, asked to follow the mouse they are dragged.

In a drag Enter keeps the result and its values, Esc takes all back.
"""
from collections.abc import Iterable

import bpy
from bpy.props import BoolProperty

from ..animation import baked_keys
from ..interactive import drag_input
from ..interactive.drag import Drag
from ..interactive.drag_handles import Handle
from ..interactive.solve_job import SolveOutcome
from ..model.patch import Patch
from ..model.refusal import Refusal
from ..model.solution import BuildCrossed, SolveSettings
from ..read import modifiers
from ..read.read_falloff import choose_radius
from ..solver import solve
from ..solver.automatic_smooth import AutomaticSmooth
from ..targets import crossed
from ..targets.falloff import Falloff
from ..ui.tool_properties import lights_property, limit_property
from .solve_tool import SolveTool

# Selected faces that a press of Smooth takes a third of a second for.
MANY_FACES = 2500
CAGE_FACES = 16  # of the surface that a face of a cage stands for, at two levels


def build_radius_handle(centre: str) -> tuple[Handle, ...]:
    """Returns the handle of the radius for a tool with tool_properties.FalloffSettings; none where it acts everywhere.
    """
    if centre == 'EVERYWHERE':
        return ()
    return (Handle("radius", "Radius", per_pixel=1.0 / 150.0, low=1e-9, high=1e9, doubles=True, unit='LENGTH',
                   wheel=True),)


def takes_long(context: bpy.types.Context) -> bool:
    """Returns whether a press is solved beside Blender, which goes on drawing and hears Esc. Shorter ones block it."""
    edited = [ob for ob in context.objects_in_mode if ob.type == 'MESH'] if context.mode == 'EDIT_MESH' else []
    return sum(ob.data.total_face_sel * (CAGE_FACES if modifiers.is_cage(ob) else 1) for ob in edited) > MANY_FACES


class DraggedTool(SolveTool):
    """A tool with handles. Pressed it runs at once with the sidebar's settings, which the redo panel can change; with
    `follow_mouse` it is dragged in the 3D view, and the values that are kept become the sidebar's.
    """
    bl_options = {'REGISTER', 'UNDO', 'BLOCKING', 'GRAB_CURSOR'}

    smooths = False  # whether the gain is reported by how smooth the lines are, not by how near the wanted ones

    lights: lights_property()
    limit: limit_property()
    follow_mouse: BoolProperty(options={'HIDDEN', 'SKIP_SAVE'}, description="Drag the tool's values in the 3D view")
    release_confirm: BoolProperty(options={'HIDDEN', 'SKIP_SAVE'}, description="Keep the values when the mouse button "
                                  "that began the drag is let go, as gizmos do")

    @classmethod
    def description(cls, _context: bpy.types.Context, properties: bpy.types.OperatorProperties) -> str:
        """Returns the tooltip of the handle beside a button; empty for the button itself, which has the docstring."""
        return f"Drag {cls.bl_label} in the 3D view, from the present settings" if properties.follow_mouse else ""

    def build_handles(self) -> tuple[Handle, ...]:
        """Returns the handles; the mouse moves the first, Tab switches to the next."""
        raise NotImplementedError

    def choose_automatic(self, name: str, patch: Patch) -> float:
        """Returns the value that 0 stands for in a property."""
        return {"length": solve.choose_length(patch, 0.0),
                "radius": choose_radius(self.find_meeting(patch))}.get(name, 0.0)

    def keeps_crossed(self) -> bool:
        """Returns whether the lines that cross the wanted ones count."""
        return self.lights != 'SINGLE'

    def choose_crossed(self) -> BuildCrossed:
        """Returns the builder of the target for the lines that cross the wanted ones."""
        return crossed.build_kept_target

    def read_solve_settings(self, scene: bpy.types.Scene) -> SolveSettings:
        return SolveSettings(self.settle_border(), self.read_detail_length(scene), self.limit,
                             build_crossed=self.choose_crossed() if self.keeps_crossed() else None)

    def read_falloff(self, _context: bpy.types.Context, _ob: bpy.types.Object, _patch: Patch) -> Falloff | None:
        """Returns the tool's fall-off, None where it acts everywhere alike."""
        return None

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        in_view = context.area is not None and context.area.type == 'VIEW_3D'
        if not in_view or not self.follow_mouse and not takes_long(context):
            return self.execute(context)
        self.known_set = ()
        context.view_layer.update()
        self.copy_settings(context.scene)
        try:
            if self.follow_mouse:
                self.refuse_hidden(context)
            self.drag = self.begin_drag(context) if self.follow_mouse else Drag(self, context, final=True)
        except Refusal as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        if self.follow_mouse:
            self.drag.begin_at(context, event.mouse_x, event.mouse_y)
        self.drag.update_texts(context)
        context.window_manager.modal_handler_add(self)
        return {'RUNNING_MODAL'}

    def choose_press(self) -> AutomaticSmooth | None:
        """Returns the settings of the automatic press that takes the place of a solve; None for most tools."""
        return None

    def hear_refused(self, refusals: Iterable[Refusal]) -> None:
        """Keeps why some of several objects have no result, until all is reported."""

    def refuse_hidden(self, context: bpy.types.Context) -> None:
        """Refuses a drag of which nothing would be seen."""
        for ob in self.find_subjects(context):
            if ob.mode == 'OBJECT' and baked_keys.are_seen(ob):
                raise Refusal(f"{ob.name} shows the shape keys {baked_keys.NAME}: drag in Edit Mode, or mute them")

    def begin_drag(self, context: bpy.types.Context) -> Drag:
        """Begins the drag; refuses what cannot be dragged."""
        return Drag(self, context)

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        result = {'CANCELLED'}
        try:
            result = self.handle_timer(context) if event.type == 'TIMER' else self.handle_event(context, event)
        except Refusal as refusal:
            self.report({'ERROR'}, str(refusal))
        finally:  # Blender drops the operator after an error that nobody expected, too
            if result == {'CANCELLED'} and self.drag is not None:
                self.cancel(context)
        return result

    def handle_timer(self, context: bpy.types.Context) -> set[str]:
        """Submits moved values, and takes what the work has finished."""
        drag = self.drag
        if drag.moved and drag.work.is_idle():
            drag.submit_request(context)  # not at each move: Blender redraws all windows when a property is set
        outcome = drag.work.take()
        if outcome is None and drag.is_to_measure():
            drag.submit_measurement()
        if outcome is None and not drag.work.is_alive():
            return self.cancel_drag(context, "The solver stopped: the mesh is as it was before")
        if outcome is not None and (outcome.refusal or outcome.solutions or not drag.keeping):
            return self.take_outcome(context, outcome)
        drag.update_texts(context)
        return {'RUNNING_MODAL'}

    def take_outcome(self, context: bpy.types.Context, outcome: SolveOutcome) -> set[str]:
        drag = self.drag
        drag.problem = outcome.refusal
        if outcome.refusal and (drag.keeping or not drag.job.ready):
            return self.cancel_drag(context, outcome.refusal)
        drag.take_gain(outcome)
        if outcome.refused:
            drag.leave_out(outcome.refused)
            self.hear_refused(outcome.refused.values())
        if outcome.positions:
            drag.show_positions(outcome.positions)
        if outcome.solutions:
            return self.finish_drag(context, outcome)
        drag.update_texts(context)
        return {'RUNNING_MODAL'}

    def handle_event(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Handles a key or mouse event. Others are swallowed: an undo or a change of mode would meet a half-written
        mesh.
        """
        drag = self.drag
        if drag_input.cancels(event):
            return self.cancel_drag(context)
        if drag_input.navigates(event, drag.values):
            return {'PASS_THROUGH'}
        if drag.keeping:
            return {'RUNNING_MODAL'}
        if drag_input.keeps(event, drag.values, held=self.release_confirm):
            drag.submit_request(context, final=True)
        elif self.update_values(event):
            drag.note_move()
        drag.update_texts(context)
        return {'RUNNING_MODAL'}

    def update_values(self, event: bpy.types.Event) -> bool:
        """Changes the values by an event; returns whether one has changed. Blender sends moves of a mouse that rests,
        after each redraw of a gizmo: solving again at each would never end.
        """
        values = self.drag.values
        before = values.values()
        if event.type == 'MOUSEMOVE':
            self.drag.move_mouse(event.mouse_x, event.mouse_y, precise=event.shift)
        else:
            drag_input.change_values(values, event)
        return values.values() != before

    def finish_drag(self, context: bpy.types.Context, outcome: SolveOutcome) -> set[str]:
        self.drag.write_solutions(outcome.solutions)
        for ob, solution in zip(self.drag.find_objects(), outcome.solutions, strict=True):
            self.record_solution(ob, solution)
        self.tell_of_all(outcome.solutions)
        self.drag.keep_values(self.find_scene_settings(context.scene))
        self.end_drag(context)
        return {'FINISHED'}

    def cancel_drag(self, context: bpy.types.Context, why: str = "") -> set[str]:
        self.drag.restore()
        self.end_drag(context)
        if why:
            self.report({'ERROR'}, why)
        return {'CANCELLED'}

    def end_drag(self, context: bpy.types.Context) -> None:
        """Ends the drag and drops it: Blender keeps the operator for its redo panel, and the drag holds large factors.
        """
        drag, self.drag = self.drag, None
        drag.end(context)

    def cancel(self, context: bpy.types.Context) -> None:
        """Restores the mesh when the drag cannot go on, and when Blender exits or opens another file."""
        drag, self.drag = self.drag, None
        drag.abort(context)
