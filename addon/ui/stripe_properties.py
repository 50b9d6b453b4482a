"""Properties of the stripes' look."""
import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty, PointerProperty

from ..model.looks import BLACK, LOOKS, WHITE

MODES = (
    ('REFLECTION', "Reflection Lines", "Parallel line lights as the panel mirrors them: what the solver optimizes"),
    ('HIGHLIGHT', "Highlight Lines", "Where the surface's normals meet the line lights: they stay as you look around"),
    ('ISOPHOTE', "Isophotes", "Lines of equal angle between the surface's normals and the light direction"),
    ('IMAGE', "Environment Image", "An image all around the panel (as a World's Environment Texture), mirrored by it"),
    ('RESIDUAL', "Residual Map", "Where the last solve could not give the lines the wanted direction and density"),
    ('VERDICT', "Verdict Map", "What the last press of Smooth Lines healed, and what it kept as design"),
    ('DEVIATION', "Deviation Map", "How far the last solve moved the panel, with its sign: outwards or inwards"),
)
EYES = (
    ('CAMERA', "View Camera", "Stripes as the solver sees them: from the view camera's direction"),
    ('VIEWPORT', "This View", "The lights stand in the world; stripes slide over the panel as you orbit around it"),
    ('FROZEN', "Frozen Eye", "From where this view stood when it was frozen"),
)
SCOPES = (
    ('OBJECT', "Active Object", "On the active mesh; they stay on it while the light or camera is active"),
    ('SELECTION', "Selection", "On the selected faces in Edit Mode, on the selected objects in Object Mode"),
    ('COLLECTION', "Collection", "On all meshes of a collection"),
    ('VISIBLE', "All Visible", "On all visible meshes"),
)


NAMED_LOOKS = [*((key, name, about) for key, (name, about, _) in LOOKS.items()),
               ('OWN', "Own", "As the settings below are now")]
TOLERANCE = 1e-6  # of settings that Blender keeps in single precision


def color_property(name: str, default: tuple[float, float, float, float]) -> object:
    return FloatVectorProperty(name=name, subtype='COLOR', size=4, min=0.0, max=1.0, default=default)


def is_same(now: object, value: object) -> bool:
    """Returns whether a setting has a value, as Blender keeps it."""
    if isinstance(value, tuple):
        return all(map(is_same, now, value))
    return now == value if isinstance(value, str) else abs(now - value) <= TOLERANCE


class ReflinesStripes(bpy.types.PropertyGroup):
    show: BoolProperty(name="Show Stripes (Zebra)", description="Draw the reflection of line lights over the mesh")
    before: BoolProperty(name="Compare with Before",
                         description="Show the reflections that the panel had before its last solve")
    side_by_side: BoolProperty(name="Side by Side", default=True, options={'HIDDEN'},
                               description="For pictures. Left of a line the reflections before the last solve, "
                               "right of it those after; drag the line with the mouse")
    look: EnumProperty(name="Look", items=NAMED_LOOKS, options=set(), get=lambda self: self.find_look(),
                       set=lambda self, value: self.use_look(value),
                       description="Looks that come with the add-on; on what and from where the stripes are seen stays")
    mode: EnumProperty(name="Mode", items=MODES, default='REFLECTION')
    eye: EnumProperty(name="Seen From", items=EYES, default='CAMERA',
                      update=lambda self, context: self.freeze_if_asked(context))
    frozen_eye: FloatVectorProperty(name="Frozen Eye", size=4,
                                    description="Place, and 1; of a view without perspective the direction, and 0")
    scope: EnumProperty(name="On", items=SCOPES, default='OBJECT')
    collection: PointerProperty(name="Collection", type=bpy.types.Collection)
    image: PointerProperty(name="Image", type=bpy.types.Image,
                           description="Equirectangular, like the images of World environments")
    image_rotation: FloatProperty(name="Rotation", subtype='ANGLE', description="Turns the image around the world's Z")
    cage_on_top: BoolProperty(name="Cage on Top", default=True, options={'HIDDEN'},
                              description="For pictures. In Edit Mode, draw edges and what is selected over the "
                              "stripes; edges of a few pixels fade away, unless few are selected")
    count: IntProperty(name="Count", default=60, min=1, soft_max=200, max=2000,
                       description="Line lights in a full turn around the light direction")
    width: FloatProperty(name="Width", default=0.5, min=0.0, max=1.0, subtype='FACTOR',
                         description="Fraction of the distance between two line lights that is light")
    softness: FloatProperty(name="Soft Edge", default=0.1, min=0.0, max=1.0, subtype='FACTOR', options={'HIDDEN'},
                            description="Blur of the edges of the stripes, as a fraction of their width")
    color: color_property("Light", WHITE)
    gap_color: color_property("Gap", BLACK)

    def find_look(self) -> int:
        """Returns the number of the look that the settings are those of; the last one is the artist's own."""
        return next((number for number, (_, _, values) in enumerate(LOOKS.values())
                     if all(is_same(getattr(self, name), value) for name, value in values.items())), len(LOOKS))

    def use_look(self, number: int) -> None:
        """Takes the settings of a look; the artist's own are there already."""
        for name, value in (list(LOOKS.values())[number][2] if number < len(LOOKS) else {}).items():
            setattr(self, name, value)

    def freeze_if_asked(self, context: bpy.types.Context) -> None:
        region_3d = getattr(context.space_data, "region_3d", None)
        if self.eye == 'FROZEN' and region_3d is not None:
            back, perspective = region_3d.view_matrix.inverted_safe(), region_3d.is_perspective
            self.frozen_eye = (*(back.translation if perspective else back.col[2].to_3d()), float(perspective))
