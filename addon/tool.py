"""What the operators that solve share: when they can run, gathering, applying, and telling the artist what happened."""
import bpy
import numpy as np
from bpy.props import BoolProperty

from . import session, solving
from .bridge import apply, curve, gather, keys, modifiers, panels, place, region
from .bridge.gather import Panel
from .bridge.refusal import Refusal
from .properties import border_property, result_property, solve_for_property
from .solving import BuildTarget
from .targets import falloff
from .targets.falloff import Falloff

LOST_START = ("The run began with the mesh as it is now: the shape before the last run is not known, since the mesh "
              "was changed, undone, renamed or duplicated after it")
AUTOMATIC_RADIUS = 1.0 / 3.0  # of the region's diagonal


class Tool:
    """A tool adds its settings, says where the scene keeps them, and how a target is built from them."""
    bl_options = {'REGISTER', 'UNDO'}

    border: border_property(options={'SKIP_SAVE'})
    solve_for: solve_for_property(options={'SKIP_SAVE'})
    result: result_property(options={'SKIP_SAVE'})
    anew: BoolProperty(options={'HIDDEN', 'SKIP_SAVE'}, description="Begin with the shape before the last run")

    def scene_settings(self, scene: bpy.types.Scene) -> bpy.types.PropertyGroup:
        """The set of settings that stands for those not given."""
        raise NotImplementedError

    def build_target(self, context: bpy.types.Context, ob: bpy.types.Object, panel: Panel) -> BuildTarget:
        raise NotImplementedError

    def remarks(self, _solution: solving.Solution) -> tuple[str, ...]:
        """Sentences about a finished solve beside the solver's own."""
        return ()

    def detail(self, scene: bpy.types.Scene) -> float:
        """Detail finer than this counts as wobble in the score; 0 is a share of the panel's size."""
        return scene.reflection_lines.length

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        ob = gather.active(context)
        if ob is None or ob.type != 'MESH' or ob.mode not in {'EDIT', 'OBJECT'}:
            cls.poll_message_set("Make the panel's mesh the active object, in Edit Mode or Object Mode")
            return False
        obstacle = session.obstacle(context.scene) or context.scene.reflection_lines.live.obstacle(ob)
        cls.poll_message_set(obstacle)
        return not obstacle

    def execute(self, context: bpy.types.Context) -> set[str]:
        context.view_layer.update()  # transforms set by a script a moment ago
        self.take_settings(context.scene)
        subjects = []
        try:
            subjects = self.subjects(context)
            solutions = [self.solved(context, ob) for ob in subjects]
        except Refusal as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        finally:
            session.keep_few({ob.name for ob in subjects})
        for solution in solutions:  # a result in a shape key ends Edit Mode, for all
            apply.keep_region(bpy.data.objects[solution.panel.name], solution.panel)
        for solution in solutions:
            ob = bpy.data.objects[solution.panel.name]
            apply.apply(ob, solution.panel, solution.positions)
            self.keep(ob, solution)
        return {'FINISHED'}

    def subjects(self, context: bpy.types.Context) -> list[bpy.types.Object]:
        return gather.subjects(context)

    def take_settings(self, scene: bpy.types.Scene) -> None:
        own = self.scene_settings(scene)
        for name, _ in self.properties.bl_rna.properties.items():
            holder = scene.reflection_lines if name in {"border", "solve_for", "result"} else own
            taken = holder.bl_rna.properties.get(name)
            if taken is not None and taken.type != 'POINTER' and not self.properties.is_property_set(name):
                setattr(self, name, getattr(holder, name))

    def solved(self, context: bpy.types.Context, ob: bpy.types.Object) -> solving.Solution:
        panel = self.panel_of(ob)
        build = self.build_target(context, ob, panel)
        settings = solving.Settings(self.border, self.detail(context.scene))
        return session.solve(panel, session.view_of(context.scene, panel.center), settings, build)

    def panel_of(self, ob: bpy.types.Object) -> Panel:
        return panels.gathered(ob, self.solve_for, self.result, self.begins_with(ob))

    def begins_with(self, ob: bpy.types.Object) -> np.ndarray | None:
        """#vertices x 3 to begin with; None for those of the mesh."""
        found = self.original(ob) if self.anew else None
        self.lost_start = self.anew and found is None
        self.region_stored = ob.mode != 'EDIT' and region.is_stored(ob.data)
        return found

    def original(self, ob: bpy.types.Object) -> np.ndarray | None:
        """#vertices x 3: the shape before the last run; None where the mesh has been changed since. In Object Mode."""
        if self.result == 'SHAPE_KEY':
            return keys.original(ob)
        last = session.last_solution(ob.name)
        return None if last is None else apply.before(ob, last.panel, last.positions)

    def keep(self, ob: bpy.types.Object, solution: solving.Solution) -> None:
        """All that is remembered of a solution beside the positions."""
        apply.keep_region(ob, solution.panel)
        session.remember(solution.last())
        stored = ob.reflection_lines
        stored.center = solution.panel.local_center
        stored.run.fill(self, ob.data, solution.panel.key)
        lost = (LOST_START,) if self.lost_start else ()
        shown = (*keys.remarks(ob, solution.panel.key), *modifiers.remarks(ob, self.solve_for))
        stored.report.fill(solution, (*solution.notes, *self.remarks(solution), *shown, *lost))
        for note in stored.report.notes.splitlines():
            self.report({'WARNING'}, f"{ob.name}: {note}")
        faces = f" ({solution.panel.faces.sum()} faces kept as the region; in Edit Mode the selected ones are taken)"
        # The status bar shows the last report.
        self.report({'INFO'}, f"{ob.name}: {stored.report.summary()}{faces if self.region_stored else ''}")


def placed_falloff(settings: Tool, scene: bpy.types.Scene, ob: bpy.types.Object, panel: Panel) -> Falloff | None:
    """Of a tool with tool_settings.FalloffSettings; None where it acts everywhere alike."""
    if settings.centre == 'EVERYWHERE':
        return None
    own = settings.shape == 'CURVE'
    values = curve.table(scene.reflection_lines.curve or curve.ensure()) if own else falloff.preset(settings.shape)
    centre = place.centre_of(settings.centre, scene, ob, panel)
    return Falloff(centre, settings.radius or AUTOMATIC_RADIUS * panel.diagonal, values)
