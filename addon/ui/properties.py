"""Properties saved in the .blend file: settings on the scene, the last result on the object."""
import json

import bpy
from bpy.props import (BoolProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty, PointerProperty,
                       StringProperty)
from mathutils import Vector

from ..blender import units
from ..model.gain import Gain, Healed, describe_stroke
from ..model.solution import Solution
from ..read import modifiers, scene_objects
from ..view import light_angles
from .automatic_values import shown_property, switch_property
from .check_properties import ReflinesCheck, ReflinesMarks
from .handle_properties import ReflinesHandles
from .inspection_properties import ReflinesInspection, ReflinesSpot
from .light_set_properties import ReflinesLightSet
from .stripe_properties import ReflinesStripes
from .tool_properties import (ReflinesBrush, ReflinesDirection, ReflinesPattern, ReflinesPull, ReflinesWarp,
                              SmoothSettings, object_property)

LONGEST = 1e15  # length that is read from a file
FLOAT_EPSILON = 2.0**-23  # of the coordinates of a mesh

CREASES = (
    ('AUTOMATIC', "Automatic", "Edges that bend far more than the surface beside them, and marked ones"),
    ('MARKED', "Marked", "Only edges that are marked as sharp, or have a crease for the Subdivision Surface"),
    ('NONE', "None", "No edge: the lines run across all of them"),
)

LIMIT_SIDES = (
    ('BOTH', "Both Ways", "Up to the limit towards the view and away from it"),
    ('OUTWARD', "Only Outward", "Only towards the view: material is added, none is taken away"),
    ('INWARD', "Only Inward", "Only away from the view: material is taken away, none is added"),
)

RESULTS = (
    ('MESH', "Mesh", "The vertices themselves move"),
    ('SHAPE_KEY', "Shape Key", "Into the shape key Reflection Lines, whose value says how much of it is seen; the mesh "
     "and its other keys stay as they are. Rename the key to keep it and begin another"),
)


def result_property(**options: object) -> object:
    return EnumProperty(name="Result", items=RESULTS, default='MESH', **options,
                        description="Where the moved vertices go")


class ReflinesReport(bpy.types.PropertyGroup):
    """The report of the last solve of an object."""
    termination: StringProperty(name="Termination")
    message: StringProperty(name="Message")
    notes: StringProperty(name="Notes", description="What else there is to know or to do, one sentence a line")
    kept: StringProperty(name="Kept", description="What of the region was left as it is, one sentence a line")
    fit: StringProperty(name="Fit", description="How far a fitted cage is from the other mesh")
    iterations: IntProperty(name="Iterations")
    seconds: FloatProperty(name="Time", unit='NONE')
    unknowns: IntProperty(name="Free Vertices")
    length: FloatProperty(name="Length", unit='LENGTH', precision=4)
    automatic_length: FloatProperty(name="Automatic Length", unit='LENGTH', precision=4)
    automatic_limit: FloatProperty(name="Automatic Limit", unit='LENGTH', precision=5)
    limited: IntProperty(name="Limited", description="Vertices that the limit of the move held back")
    healed: BoolProperty(name="Healed", description="Whether it is known where flaws were healed")
    healed_area: FloatProperty(name="Healed Area", subtype='FACTOR', description="Fraction of the region's area whose "
                               "lines were visibly off their course and are so no more")
    worst_before: FloatProperty(name="Worst Before", description="Degrees that lines were off their course where they "
                                "were so most, without what counts as design")
    worst_after: FloatProperty(name="Worst After", description="The same after the solve")
    worse: StringProperty(name="Worse", description="What became worse, in which light; empty where nothing did")
    worse_spot: PointerProperty(type=ReflinesSpot, description="Where that is")
    longer_waves: BoolProperty(name="Longer Waves", description="Waves longer than the flaws were left, which may be "
                               "flaws, too")
    score_before: FloatProperty(name="Line Deviation Before", description="Mean sideways shift of the reflection lines "
                                "from their smooth course within one length, in degrees of the light's turn")
    score_after: FloatProperty(name="Line Deviation After", description="The same after the solve")
    turn_before: FloatProperty(name="Turn Before", description="Mean angle between the reflection lines and their "
                               "smooth course as they are drawn, in degrees")
    turn_after: FloatProperty(name="Turn After", description="The same after the solve")
    largest_move: FloatProperty(name="Largest Move", unit='LENGTH', precision=6)
    cage_move: FloatProperty(name="Largest Move of the Cage", unit='LENGTH', precision=6)
    residual_before: FloatProperty(name="Residual Before", description="What the lines' gradient lacked of the "
                                   "wanted one: root mean square, radians per unit of length")
    residual_after: FloatProperty(name="Residual After", description="What it still lacks")
    merge_distance: FloatProperty(name="Merge Distance", unit='LENGTH', precision=6,
                                  description="Distance that joins the border to faces of the mesh that lie on it; "
                                  "0: none do")
    rounding: FloatProperty(name="Rounding", description="Turn of the lines by the rounding of coordinates far from "
                            "the origin, radians; 0 where it is not seen")
    remedy: StringProperty(name="Remedy", description="The border that would serve better")

    def fill(self, solution: Solution, notes: tuple[str, ...]) -> None:
        """Copies the numbers of a finished solve."""
        for name in ("termination", "message", "iterations", "seconds", "unknowns", "largest_move", "limited"):
            setattr(self, name, getattr(solution.report, name))
        self.longer_waves, self.kept, healed = solution.longer_waves, "\n".join(solution.kept), solution.healed
        self.healed = healed is not None
        if healed is not None:
            self.healed_area, self.worst_before, self.worst_after = (healed.area, healed.worst_before,
                                                                     healed.worst_after)
        worse = solution.worse
        self.worse = worse.describe() if worse is not None else ""
        if worse is not None:
            self.worse_spot.keep_worse(worse)
        for name in ("length", "score_before", "score_after", "turn_before", "turn_after", "residual_before",
                     "residual_after", "remedy", "automatic_length", "automatic_limit", "cage_move"):
            setattr(self, name, getattr(solution, name))
        self.notes, self.fit = "\n".join(notes), solution.fit

    def headline(self) -> str:
        """Says what the solve did in an artist's words, the largest first."""
        if self.largest_move <= FLOAT_EPSILON * max(self.id_data.dimensions):  # no bit of a coordinate
            return "Nothing moved"
        held = f" (the limit held {self.limited} vertices back)" if self.limited else ""
        worse = f"; {self.worse}" if self.worse else ""
        moved = units.format_length(self.largest_move, bpy.context.scene, 2)
        return f"{self.gain()}, moved at most {moved}{self.moved_cage()}{held}{worse}"

    def moved_cage(self) -> str:
        """Says how far the cage's vertices moved, where that is more than their surface."""
        if self.cage_move <= self.largest_move:
            return ""
        return f", its cage {units.format_length(self.cage_move, bpy.context.scene, 2)}"

    def gain(self) -> str:
        """Says how far a fitted cage is from the other mesh, what was healed, how far lines are off their course, or
        how far they are off the wanted ones.
        """
        if self.fit:
            return self.fit
        if self.healed:
            return Healed(self.healed_area, self.worst_before, self.worst_after).describe()
        operator = self.id_data.reflection_lines.run.operator
        if operator == "REFLINES_OT_fair_brush":
            return describe_stroke(self.score_before, self.score_after)
        return Gain(self.score_before, self.score_after, self.residual_before, self.residual_after,
                    self.length).describe(smoothed=operator == "REFLINES_OT_smooth")

    def lines_off(self) -> tuple[float, float]:
        """Returns how far lines were and are off their course, degrees: at the worst place where that is known, else
        in the mean.
        """
        return (self.worst_before, self.worst_after) if self.healed else (self.score_before, self.score_after)

    def measured_length(self) -> str:
        """Says the length at which the line deviation was measured."""
        return units.format_length(self.length, bpy.context.scene, 3)


def to_json_value(value: object) -> object:
    """Converts a property's value for JSON: vectors become lists."""
    return value if isinstance(value, str) or not hasattr(value, "__len__") else list(value)


class ReflinesRun(bpy.types.PropertyGroup):
    """The last run of a tool on an object, for Re-solve."""
    operator: StringProperty(name="Operator", description="Its identifier")
    settings: StringProperty(name="Settings", description="As JSON")
    key: StringProperty(name="Shape Key", description="That the result went to; empty for the mesh")
    joined: StringProperty(name="Joined", description="Names of the objects that were solved as one, as JSON")
    vertices: IntProperty(name="Vertices")
    faces: IntProperty(name="Faces")

    def read_length(self, name: str) -> float:
        """Reads a length of the settings; 0 where there is none, as in a file that was changed."""
        try:
            value = json.loads(self.settings)[name]
            return value if isinstance(value, float) and 0.0 < value < LONGEST else 0.0
        except (ValueError, TypeError, KeyError, RecursionError):
            return 0.0

    def format_length(self, value: float) -> str:
        return units.format_length(value, bpy.context.scene, 2)

    def list_joined(self) -> tuple[str, ...]:
        """Returns the names of the objects that were solved as one; none for one alone, or where a file was changed.
        """
        try:
            names = json.loads(self.joined) if self.joined else ()
            return tuple(map(str, names)) if isinstance(names, list) else ()
        except (ValueError, RecursionError):
            return ()

    def fill(self, operator: bpy.types.Operator, mesh: bpy.types.Mesh, key: str) -> None:
        self.note(operator.bl_idname, {name: to_json_value(getattr(operator, name))
                                       for name, about in operator.properties.bl_rna.properties.items()
                                       if not about.is_readonly and not about.is_hidden}, mesh, key)

    def note(self, operator: str, settings: dict[str, object], mesh: bpy.types.Mesh, key: str) -> None:
        self.operator, self.settings, self.key = operator, json.dumps(settings), key
        self.vertices, self.faces = len(mesh.vertices), len(mesh.polygons)

    def difference(self, mesh: bpy.types.Mesh) -> str:
        """Describes how the mesh's size differs from that after the run, as a sentence; empty where it is the same."""
        vertices, faces = len(mesh.vertices) - self.vertices, len(mesh.polygons) - self.faces
        if not vertices and not faces:
            return ""
        return (f"The mesh has changed since the last run: {vertices:+} vertices, {faces:+} faces; Re-solve takes the "
                "faces of that run as they are now")


class ReflinesObject(bpy.types.PropertyGroup):
    report: PointerProperty(type=ReflinesReport)
    limit_side: EnumProperty(name="Moves", items=LIMIT_SIDES, default='BOTH',
                             description="Which way this object's vertices may move along the view")
    limit_group: StringProperty(name="Limit By", description="Vertex group of this object whose weights are the "
                                "fractions of the limit: 0 holds a vertex, 1 lets it move as far as Limit says")
    follow_group: StringProperty(name="Follow By", description="Vertex group of this object that says where lines "
                                 "follow handles: its weight 0 holds them, 1 lets them go as far as the radius says")
    creases: EnumProperty(name="Creases", items=CREASES, default='AUTOMATIC',
                          description="Which edges of this object are held, with the lines solved on each side")
    panel: object_property('MESH', name="Panel", description="The mesh that this lattice warps")
    center: FloatVectorProperty(name="Panel Centre", subtype='XYZ', description="Of the last region, in object space")
    run: PointerProperty(type=ReflinesRun)
    check: PointerProperty(type=ReflinesCheck)
    inspection: PointerProperty(type=ReflinesInspection)
    handles: PointerProperty(type=ReflinesHandles)
    camera: PointerProperty(name="View Camera", type=bpy.types.Object,
                            description="That the panel was last worked on with")
    light: PointerProperty(name="Light Direction", type=bpy.types.Object,
                           description="That the panel was last worked on with")
    last: StringProperty(name="Last Solve", description="As saved with the file, see write/solve_record.py",
                         options={'HIDDEN'})

    def is_cage(self) -> bool:
        """Returns whether the tools can solve for a cage."""
        return modifiers.is_cage(self.id_data)

    def keep_view(self, scene: bpy.types.Scene) -> None:
        """Keeps the scene's view camera and light as those of this panel."""
        self.camera, self.light = scene.reflection_lines.camera, scene.reflection_lines.light

    def has_other_view(self, scene: bpy.types.Scene) -> bool:
        """Returns whether the panel was worked on with a view camera or light that the scene has but does not use."""
        now = scene.reflection_lines
        return any(now.present(kept) and kept != used for kept, used in
                   ((self.camera, now.camera), (self.light, now.light)))


class ReflinesLive(bpy.types.PropertyGroup):
    """The scene's live warp, none where `panel` is empty; write/live_warp_start.py keeps where it began with the mesh.
    """
    panel: object_property('MESH')
    result: result_property()

    def panel_name(self) -> str:
        """Returns the name of the warped mesh; empty where there is no live warp."""
        return self.panel.name if self.panel is not None else ""

    def obstacle(self, ob: bpy.types.Object) -> str:
        """Returns why no other tool can run on an object, as a sentence; empty where they can."""
        return f"{ob.name} follows its warp lattice: apply or discard the live warp first" if self.panel == ob else ""


class ReflinesScene(SmoothSettings, bpy.types.PropertyGroup):
    camera: object_property('CAMERA', name="View Camera",
                            description="The view that the reflection lines are judged from")
    light: object_property('EMPTY', name="Light Direction",
                           description="An empty whose local Z axis is the direction of the line lights")
    # The light's own rotation can be keyed; keys of what is read from it would be followed a frame late.
    light_turn: FloatProperty(name="Turn", subtype='ANGLE', options=set(),
                              get=lambda self: self.read_light_angles()[0],
                              set=lambda self, value: self.turn_light(value, self.light_tilt),
                              description="Of the light in the view camera's picture, counter-clockwise from the "
                              "horizontal")
    light_tilt: FloatProperty(name="Tilt", subtype='ANGLE', options=set(), min=-light_angles.TILT_LIMIT,
                              max=light_angles.TILT_LIMIT,
                              get=lambda self: self.read_light_angles()[1],
                              set=lambda self, value: self.turn_light(self.light_turn, value),
                              description="Of the light out of the picture, towards the viewer")
    light_dial: FloatVectorProperty(name="Light", subtype='DIRECTION', options=set(),
                                    get=lambda self: self.read_light_dial(),
                                    set=lambda self, value: self.point_light(value),
                                    description="Drag the ball to turn the light, in any mode: as the view camera sees "
                                    "it, right, up, and towards the viewer")
    length_shown: shown_property("length", "Length")
    length_automatic: switch_property("length", "Length")
    limit_shown: shown_property("limit", "Limit")
    limit_automatic: switch_property("limit", "Limit")
    result: result_property()
    show_borders: BoolProperty(name="Show Borders", default=True,
                               description="Draw the borders that were set by segment: green Free, orange Position, "
                               "blue Tangent, violet Curvature, red Flow, cyan Neighbours")
    direction: PointerProperty(type=ReflinesDirection)
    pull: PointerProperty(type=ReflinesPull)
    brush: PointerProperty(type=ReflinesBrush)
    warp: PointerProperty(type=ReflinesWarp)
    live: PointerProperty(type=ReflinesLive)
    pattern: PointerProperty(type=ReflinesPattern)
    curve: PointerProperty(type=bpy.types.NodeTree, description="Holds the artist's own fall-off curve")
    stripes: PointerProperty(type=ReflinesStripes)
    marks: PointerProperty(type=ReflinesMarks)
    light_set: PointerProperty(type=ReflinesLightSet)

    def missing(self) -> str:
        """Returns what is missing before any tool can run, as a sentence; empty where nothing is."""
        if self.picture_camera() is None:
            return self.describe_absent(self.camera) or (
                "No view camera: press Set Up from This View, or pick one in the sidebar's Reflection tab")
        return self.missing_light()

    def missing_light(self) -> str:
        """Returns that the light is missing, as a sentence; empty where it is there."""
        if self.present(self.light):
            return ""
        return self.describe_absent(self.light) or (
            "No light direction: press Add Light Direction in the sidebar's panel View and Light, or pick an empty")

    def describe_absent(self, ob: bpy.types.Object | None) -> str:
        """Returns which other scene an object is in, as a sentence; empty where it is in none."""
        scenes = ob.users_scene if ob is not None else ()
        if not scenes:
            return ""
        return (f"{ob.name} is in the scene {scenes[0].name}, not in this one: link it to this scene (Object > "
                "Link/Transfer Data), or pick another")

    def describe_unfollowed(self, ob: bpy.types.Object | None) -> str:
        """Returns, as a sentence, that Blender does not follow an object's transform; empty where it does."""
        if not self.present(ob) or not (ob.hide_viewport or all(each.hide_viewport for each in ob.users_collection)):
            return ""
        return (f"{ob.name} is disabled in viewports (the monitor icon in the Outliner), so Blender does not follow "
                "its transform: enable it, and hide it by the eye")

    def present(self, ob: bpy.types.Object | None) -> bool:
        """Returns whether the object is in the scene: properties may still point at deleted ones."""
        return ob is not None and scene_objects.contains_object(self.id_data.objects, ob)

    def picture_camera(self) -> bpy.types.Object | None:
        """Returns the view camera, None where there is none; a changed file may point at another kind of object."""
        return self.camera if self.present(self.camera) and self.camera.type == 'CAMERA' else None

    def explain_fixed_light(self) -> str:
        """Returns why the light cannot be turned, as a sentence; empty where it can."""
        missing = self.missing_light()
        if missing:
            return missing
        return f"{self.light.name} is linked from another file: make it local" if self.light.library else ""

    def read_light_angles(self) -> tuple[float, float]:
        """Returns turn and tilt of the light, radians; zeros where there is none."""
        present = self.present(self.light)
        return light_angles.read_light_angles(self.picture_camera(), self.light) if present else (0.0, 0.0)

    def read_light_dial(self) -> tuple[float, float, float]:
        """Returns the light direction as the view camera sees it."""
        if not self.present(self.light):
            return 1.0, 0.0, 0.0
        return tuple(light_angles.read_light_direction(self.picture_camera(), self.light))

    def turn_light(self, turn: float, tilt: float) -> None:
        if not self.explain_fixed_light():
            light_angles.turn_light(self.picture_camera(), self.light, turn, tilt)

    def point_light(self, direction: tuple[float, float, float]) -> None:
        if not self.explain_fixed_light():
            light_angles.point_light(self.picture_camera(), self.light, Vector(direction))

    def is_perspective(self) -> bool:
        camera = self.picture_camera()
        return camera is not None and camera.data.type != 'ORTHO'


def register() -> None:
    bpy.types.Scene.reflection_lines = PointerProperty(type=ReflinesScene)
    bpy.types.Object.reflection_lines = PointerProperty(type=ReflinesObject)


def unregister() -> None:
    del bpy.types.Object.reflection_lines
    del bpy.types.Scene.reflection_lines
