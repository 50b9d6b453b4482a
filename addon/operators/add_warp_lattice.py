"""The operator Add Warp Lattice."""
import bpy

from ..model import meeting
from ..model.refusal import report_refusals
from ..read import gather, scene_objects
from ..solver import live_optimizer
from ..ui.tool_properties import SPLINES
from ..view import facing
from ..write import keep_region, warp_lattice
from .solve_tool import is_ready


class REFLINES_OT_add_warp_lattice(bpy.types.Operator):
    """Add a lattice over the selected faces, in the plane that the view camera sees.

Move its control points in the lattice's Edit Mode, then press Warp: the lines go where the lattice takes them"""
    bl_idname = "reflines.add_warp_lattice"
    bl_label = "Add Warp Lattice"
    bl_options = {'REGISTER', 'UNDO'}

    # Hidden: in Edit Mode undo does not take the lattice away, so a redo would add a second one.
    columns: bpy.props.IntProperty(name="Columns", default=5, min=2, max=64, options={'HIDDEN'})
    rows: bpy.props.IntProperty(name="Rows", default=5, min=2, max=64, options={'HIDDEN'})
    interpolation: bpy.props.EnumProperty(name="Interpolation", items=SPLINES, default='KEY_BSPLINE',
                                          options={'HIDDEN'})

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return is_ready(cls, context)

    @report_refusals
    def execute(self, context: bpy.types.Context) -> set[str]:
        context.view_layer.update()
        settings = context.scene.reflection_lines
        ob, *others = sorted(scene_objects.find_subjects(context),
                             key=lambda each: each != scene_objects.find_active_object(context))
        patch, *beside = [gather.gather_patch(each, as_mesh=True) for each in (ob, *others)]
        seen = facing.read_patch_view(context.scene, patch)
        frame = live_optimizer.compute_image_frame(patch, seen)
        keep_region.keep_region(ob, patch)
        added = warp_lattice.add_lattice(meeting.find_meeting(patch, beside), frame, columns=self.columns,
                                         rows=self.rows, kind=self.interpolation,
                                         collection=scene_objects.find_editable_collection(context))
        settings.warp.lattice = added
        added.reflection_lines.panel = ob
        return {'FINISHED'}
