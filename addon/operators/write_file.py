"""The operator Write File, which goes on with what Export Sheet or Export Film has begun."""
import bpy

from ..interactive import running_operators
from ..model.refusal import Refusal

TICK_INTERVAL = 0.01  # seconds between two steps


class REFLINES_OT_write_file(bpy.types.Operator):
    """Go on writing a sheet or a film beside Blender. Esc ends it"""
    bl_idname = "reflines.write_file"
    bl_label = "Write File"
    bl_options = {'INTERNAL'}

    @classmethod
    def poll(cls, _context: bpy.types.Context) -> bool:
        cls.poll_message_set("Export Sheet and Export Film run this")
        return running_operators.has_begun_work()

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        self.work, self.steps = running_operators.take_begun_work()
        return running_operators.begin(self, context, TICK_INTERVAL)

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type == 'ESC' and event.value == 'PRESS':
            return self.tell(context, {'CANCELLED'})
        if event.type != 'TIMER':
            return {'PASS_THROUGH'}
        try:
            next(self.steps)
        except StopIteration:
            return self.tell(context, {'FINISHED'})
        except (Refusal, OSError) as error:
            self.take_back(context)
            self.report({'ERROR'}, str(error))
            return {'CANCELLED'}
        context.workspace.status_text_set(self.work.describe_progress())
        return {'RUNNING_MODAL'}

    def tell(self, context: bpy.types.Context, how: set[str]) -> set[str]:
        """Ends, and says what was written."""
        self.take_back(context)
        self.report({'INFO'}, self.work.describe_written())
        return how

    def take_back(self, context: bpy.types.Context) -> None:
        """Ends the work; files that are written stay."""
        self.steps.close()
        running_operators.end(self, context)

    def cancel(self, context: bpy.types.Context) -> None:
        """Ends the work when Blender exits or opens another file."""
        self.take_back(context)


register, unregister = running_operators.make_registration(REFLINES_OT_write_file)
