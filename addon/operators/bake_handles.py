"""The operator Bake Handles."""
import bpy
from bpy.props import IntProperty

from ..background_work import BackgroundWork
from ..interactive import running_operators
from ..interactive.handle_bake import HandleBake
from ..model.refusal import Refusal
from ..native_call import run_now
from ..read import scene_objects
from ..state import optimizer_cache
from ..view import view_and_light

TICK_INTERVAL = 0.01  # seconds between two looks at the background work
CANCEL_KEYS = {'ESC', 'RIGHTMOUSE'}


class REFLINES_OT_bake_handles(bpy.types.Operator):
    """Solve the keyed handles frame by frame, and keep each as a shape key that comes and goes with its frame: played,
the scene moves the panel"""
    bl_idname = "reflines.bake_handles"
    bl_label = "Bake Handles"
    bl_options = {'UNDO'}  # no redo panel: Blender would stand still for all frames

    step: IntProperty(default=5, min=1, max=10000, options={'HIDDEN', 'SKIP_SAVE'},
                      description="Frames from one solve to the next")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = scene_objects.find_active_object(context)
        if ob is None or ob.type != 'MESH' or not ob.reflection_lines.handles.text:
            return scene_objects.allow(cls, "Make a panel active that has handles")
        return scene_objects.allow(
            cls, view_and_light.find_obstacle(context.scene) or context.scene.reflection_lines.live.obstacle(ob))

    def begin(self, context: bpy.types.Context) -> None:
        context.view_layer.update()
        self.bake = HandleBake(context.scene, scene_objects.find_active_object(context))
        self.bake.begin(self.step)

    def execute(self, context: bpy.types.Context) -> set[str]:
        try:
            self.begin(context)
            while not self.bake.is_done():
                self.bake.take(run_now(self.bake.solve(self.bake.gather_next())))
            return self.finish()
        except Refusal as refusal:
            return self.give_up(refusal)

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        """Begins, and solves frame by frame in the background."""
        if context.area is None:
            return self.execute(context)
        try:
            self.begin(context)
            request = self.bake.gather_next()
        except Refusal as refusal:
            return self.give_up(refusal)
        self.work = BackgroundWork(self.bake.solve, self.bake.progress.cancel)
        self.work.submit(request)
        self.area = context.area
        self.show_progress(context)
        return running_operators.begin(self, context, TICK_INTERVAL)

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Takes a frame and begins with the next, or ends. Other events are swallowed: an undo would meet a scene at
        another frame.
        """
        result = {'CANCELLED'}
        try:
            if event.type == 'TIMER':
                result = self.go_on(context)
            elif event.type not in CANCEL_KEYS or event.value != 'PRESS':
                result = {'RUNNING_MODAL'}
        except Refusal as refusal:
            self.report({'ERROR'}, str(refusal))
        finally:  # Blender drops the operator after an error that nobody expected, too
            if result == {'CANCELLED'}:
                self.take_back(context)
        return result

    def go_on(self, context: bpy.types.Context) -> set[str]:
        """Takes a frame, where it is done, and begins with the next; raises a refusal."""
        solution = self.work.take()
        if solution is None and self.work.is_alive():
            return {'RUNNING_MODAL'}
        self.bake.take(solution or Refusal("The solver stopped: the mesh is as it was before"))
        if not self.bake.is_done():
            self.work.submit(self.bake.gather_next())
            self.show_progress(context)
            return {'RUNNING_MODAL'}
        result = self.finish()
        self.end_modal(context)
        return result

    def finish(self) -> set[str]:
        self.bake.write()
        for note in self.bake.describe_notes():
            self.report({'WARNING'}, f"{self.bake.name}: {note}")
        self.report({'INFO'}, self.bake.describe_result())
        return self.drop({'FINISHED'})

    def give_up(self, refusal: Refusal) -> set[str]:
        """Says why nothing is kept of the bake."""
        self.bake.cancel()
        self.report({'ERROR'}, str(refusal))
        return self.drop({'CANCELLED'})

    def drop(self, result: set[str]) -> set[str]:
        """Drops the bake, which holds a shape for each frame; returns the result."""
        optimizer_cache.drop_surplus({self.bake.name})
        self.bake = None
        return result

    def show_progress(self, context: bpy.types.Context) -> None:
        self.area.header_text_set(self.bake.describe())
        context.workspace.status_text_set("Esc: cancel")

    def end_modal(self, context: bpy.types.Context) -> None:
        running_operators.end(self, context)
        self.work.stop()
        self.work = None
        self.area.header_text_set(None)

    def take_back(self, context: bpy.types.Context) -> None:
        """Goes back to the frame and the mode before, where the bake does not go on, or the add-on is disabled."""
        self.end_modal(context)
        self.bake.cancel()
        self.drop(set())

    def cancel(self, context: bpy.types.Context) -> None:
        """Goes back to the frame before, when Blender exits or opens another file."""
        self.end_modal(context)
        self.bake.leave()
        self.drop(set())
