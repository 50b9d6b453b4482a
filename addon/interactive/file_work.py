"""Files that are written in short steps beside Blender, which goes on meanwhile, with progress and Esc."""
import bpy

from ..model.steps import finish
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
