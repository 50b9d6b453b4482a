"""Files that are written in short steps beside Blender, which goes on meanwhile, with progress and Esc."""
import bpy

from ..model.steps import finish
from ..read import scene_objects
from ..view import view_and_light
from . import running_operators
from .running_operators import FileWork


def write_file(operator: bpy.types.Operator, context: bpy.types.Context, work: FileWork) -> set[str]:
    """Writes for an operator whose file was chosen: at once where there is no window. Raises Refusal and OSError."""
    steps = work.write(context)
    if bpy.app.background:
        finish(steps)
        operator.report({'INFO'}, work.describe_written())
    else:
        next(steps)
        running_operators.hand_over(work, steps)
        bpy.ops.reflines.write_file('INVOKE_DEFAULT')
    return {'FINISHED'}


def has_panel(operator: type[bpy.types.Operator], context: bpy.types.Context) -> bool:
    """Returns whether there is a panel to show; sets the message that says why not."""
    ob = scene_objects.read_active_object(context)
    if ob is None or ob.type != 'MESH' or ob.mode not in {'EDIT', 'OBJECT'}:
        operator.poll_message_set("Make a panel's mesh active, in Edit Mode or Object Mode")
        return False
    obstacle = view_and_light.find_obstacle(context.scene)
    operator.poll_message_set(obstacle)
    return not obstacle
