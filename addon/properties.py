"""What is saved in the .blend file: settings on the scene, the last result on the object."""
import json

import bpy
from bpy.props import EnumProperty, FloatProperty, FloatVectorProperty, IntProperty, PointerProperty, StringProperty

from .bridge import contents, modifiers, units
from .stripe_settings import ReflinesSetups, ReflinesStripes
from .tool_settings import ReflinesDirection, ReflinesPattern, ReflinesUntwist, ReflinesWarp, SmoothSettings

BORDERS = (
    ('clamped', "Clamped", "Border vertices stay, and so does the slope there: the panel joins on smoothly"),
    ('fixed', "Fixed", "Border vertices stay; the slope across the border may change"),
    ('free', "Free", "Border vertices may move along the view, as the rest does"),
)

KINDS = (
    ('CAGE', "Cage", "Below a Subdivision Surface: move the cage so that the subdivided surface reflects well"),
    ('MESH', "Mesh", "Move the mesh's own faces, as if it were not subdivided"),
)


RESULTS = (
    ('MESH', "Mesh", "The vertices themselves move"),
    ('SHAPE_KEY', "Shape Key", "Into the shape key Reflection Lines, whose value says how much of it is seen; the mesh "
     "and its other keys stay as they are. Rename the key to keep it and begin another"),
)


def result_property(**options: object) -> object:
    return EnumProperty(name="Result", items=RESULTS, default='MESH', **options,
                        description="Where the moved vertices go")


def solve_for_property(**options: object) -> object:
    return EnumProperty(name="Solve for", items=KINDS, default='CAGE', **options,
                        description="What moves where the object's last modifier that is shown is Subdivision Surface")


def border_property(**options: object) -> object:
    return EnumProperty(name="Border", items=BORDERS, default='clamped', **options,
                        description="What happens at the border of the region")


class ReflinesReport(bpy.types.PropertyGroup):
    """How the last solve of an object ended."""
    termination: StringProperty(name="Termination")
    message: StringProperty(name="Message")
    notes: StringProperty(name="Notes", description="What was held fixed or left out, one sentence a line")
    fit: StringProperty(name="Fit", description="How far a fitted cage is from the other mesh")
    iterations: IntProperty(name="Iterations")
    seconds: FloatProperty(name="Time", unit='NONE')
    unknowns: IntProperty(name="Free Vertices")
    length: FloatProperty(name="Length", unit='LENGTH', precision=4)
    score_before: FloatProperty(name="Wobble Before", description="Wobble of the reflection lines, in degrees")
    score_after: FloatProperty(name="Wobble After", description="Wobble of the reflection lines, in degrees")
    largest_move: FloatProperty(name="Largest Move", unit='LENGTH', precision=6)
    residual_before: FloatProperty(name="Residual Before", description="What the lines' gradient lacked of the "
                                   "wanted one: root mean square, radians per unit of length")
    residual_after: FloatProperty(name="Residual After", description="What it still lacks")

    def fill(self, solution: object, notes: tuple[str, ...]) -> None:
        """Takes over a finished `solving.Solution`."""
        for name in ("termination", "message", "iterations", "seconds", "unknowns", "largest_move"):
            setattr(self, name, getattr(solution.report, name))
        for name in ("length", "score_before", "score_after", "residual_before", "residual_after"):
            setattr(self, name, getattr(solution, name))
        self.notes, self.fit = "\n".join(notes), ""

    def summary(self) -> str:
        return (f"{self.termination.replace('_', ' ')} after {self.iterations} iterations in {self.seconds:.2f} s, "
                f"wobble {self.score_before:.4g} -> {self.score_after:.4g} degrees "
                f"at length {units.length_text(self.length, bpy.context.scene)}, "
                f"residual {self.residual_before:.4g} -> {self.residual_after:.4g}, largest move {self.moved()}")

    def moved(self) -> str:
        return units.length_text(self.largest_move, bpy.context.scene, precision=5)


def is_mesh(_: object, ob: bpy.types.Object) -> bool:
    return ob.type == 'MESH'


def plain(value: object) -> object:
    """As JSON takes it: a vector as a list."""
    return value if isinstance(value, str) or not hasattr(value, "__len__") else list(value)


class ReflinesRun(bpy.types.PropertyGroup):
    """The last run of a tool on an object, to run it again."""
    operator: StringProperty(name="Operator", description="Its identifier")
    settings: StringProperty(name="Settings", description="As JSON")
    key: StringProperty(name="Shape Key", description="That the result went to; empty for the mesh")
    vertices: IntProperty(name="Vertices")
    faces: IntProperty(name="Faces")

    def fill(self, operator: bpy.types.Operator, mesh: bpy.types.Mesh, key: str) -> None:
        self.note(operator.bl_idname, {name: plain(getattr(operator, name))
                                       for name, about in operator.properties.bl_rna.properties.items()
                                       if not about.is_readonly and not about.is_hidden}, mesh, key)

    def note(self, operator: str, settings: dict[str, object], mesh: bpy.types.Mesh, key: str) -> None:
        self.operator, self.settings, self.key = operator, json.dumps(settings), key
        self.vertices, self.faces = len(mesh.vertices), len(mesh.polygons)

    def difference(self, mesh: bpy.types.Mesh) -> str:
        """What the mesh has more or less than after the run, as a sentence; empty where its faces are the same."""
        vertices, faces = len(mesh.vertices) - self.vertices, len(mesh.polygons) - self.faces
        if not vertices and not faces:
            return ""
        return (f"The mesh has changed since the last run: {vertices:+} vertices, {faces:+} faces; Re-solve takes the "
                "faces of that run as they are now")


class ReflinesObject(bpy.types.PropertyGroup):
    report: PointerProperty(type=ReflinesReport)
    panel: PointerProperty(name="Panel", type=bpy.types.Object, poll=is_mesh,
                           description="The mesh that this lattice warps")
    center: FloatVectorProperty(name="Panel Centre", subtype='XYZ', description="Of the last region, in object space")
    run: PointerProperty(type=ReflinesRun)
    last: StringProperty(name="Last Solve", description="As saved with the file, see bridge/record.py",
                         options={'HIDDEN'})

    def is_cage(self) -> bool:
        """Whether the tools can solve for a cage."""
        return modifiers.is_cage(self.id_data)


class ReflinesLive(bpy.types.PropertyGroup):
    """The scene's live warp, none where `panel` is empty. Where it began is kept with the mesh, see bridge/start.py."""
    panel: PointerProperty(type=bpy.types.Object, poll=is_mesh)
    solve_for: solve_for_property()
    result: result_property()

    def panel_name(self) -> str:
        """Of the panel; empty where there is no live warp."""
        return self.panel.name if self.panel is not None else ""

    def obstacle(self, ob: bpy.types.Object) -> str:
        """Why no other tool can run on an object, as a sentence; empty where they can."""
        return f"{ob.name} follows its warp lattice: apply or discard the live warp first" if self.panel == ob else ""


def is_camera(_: object, ob: bpy.types.Object) -> bool:
    return ob.type == 'CAMERA'


def is_empty(_: object, ob: bpy.types.Object) -> bool:
    return ob.type == 'EMPTY'


class ReflinesScene(SmoothSettings, bpy.types.PropertyGroup):
    camera: PointerProperty(name="View Camera", type=bpy.types.Object, poll=is_camera,
                            description="The view that the reflection lines are judged from")
    light: PointerProperty(name="Light Direction", type=bpy.types.Object, poll=is_empty,
                           description="An empty whose local Z axis is the direction of the line lights")
    border: border_property()
    solve_for: solve_for_property()
    result: result_property()
    direction: PointerProperty(type=ReflinesDirection)
    untwist: PointerProperty(type=ReflinesUntwist)
    warp: PointerProperty(type=ReflinesWarp)
    live: PointerProperty(type=ReflinesLive)
    pattern: PointerProperty(type=ReflinesPattern)
    curve: PointerProperty(type=bpy.types.NodeTree, description="Holds the artist's own fall-off curve")
    stripes: PointerProperty(type=ReflinesStripes)
    setups: PointerProperty(type=ReflinesSetups)

    def missing(self) -> str:
        """What must be there before any tool can run, as a sentence; empty where nothing is missing."""
        if not self.present(self.camera):
            return "No view camera: press Add View Camera, or pick one in the sidebar's Reflection tab"
        if not self.present(self.light):
            return "No light direction: press Add Light Direction, or pick an empty in the sidebar's Reflection tab"
        return ""

    def present(self, ob: bpy.types.Object | None) -> bool:
        """A deleted object can still be pointed at; it is no longer in the scene."""
        return ob is not None and contents.holds(self.id_data.objects, ob)

    def is_perspective(self) -> bool:
        return self.present(self.camera) and self.camera.data.type != 'ORTHO'


CLASSES = (ReflinesReport, ReflinesRun, ReflinesObject, ReflinesLive, ReflinesScene)


def register() -> None:
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.reflection_lines = PointerProperty(type=ReflinesScene)
    bpy.types.Object.reflection_lines = PointerProperty(type=ReflinesObject)


def unregister() -> None:
    del bpy.types.Object.reflection_lines
    del bpy.types.Scene.reflection_lines
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
