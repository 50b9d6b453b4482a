"""Settings of each tool. The scene holds one set for the sidebar, operators another for the redo panel.

Operators do not remember values from run to run (SKIP_SAVE): what is not given is taken from the scene.
"""
from collections.abc import Callable

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty, PointerProperty

from ..model.border import AUTOMATIC, NAMES
from ..read import falloff_curve
from .automatic_values import switch_property
from .rows import draw_switch

CENTRES = (
    ('EVERYWHERE', "Everywhere", "The tool acts on the whole region alike"),
    ('CURSOR', "3D Cursor", "Fully at the 3D cursor, less with the distance from it"),
    ('ACTIVE', "Active Vertex", "Fully at the vertex selected last, less with the distance from it"),
    ('REGION', "Region Centre", "Fully at the middle of the region, less with the distance from it"),
)
SHAPES = (
    ('SMOOTH', "Smooth", "Flat at the centre and at the radius"),
    ('LINEAR', "Linear", "Evenly down from the centre to the radius"),
    ('SPHERE', "Sphere", "Full for long, then steeply down"),
    ('SHARP', "Sharp", "Steeply down at the centre, then flat"),
    ('CURVE', "Curve", "Your own curve, from the centre on the left to the radius on the right"),
)
# With the numbers that files hold: a new direction gets a new one.
DIRECTIONS = (
    ('PRESENT', "As They Run", "The lines keep their course, turned by the angle; by 0 nothing changes", 'NONE', 3),
    ('MEAN', "Straight", "Straight lines in the mean direction of those that are there", 'NONE', 0),
    ('ANGLE', "At an Angle", "Straight lines at an angle in the view camera's picture", 'NONE', 1),
)
AXES = (
    ('NONE', "Constant", "The same density everywhere"),
    ('ALONG', "Along Lines", "From one end of the lines to the other"),
    ('ACROSS', "Across Lines", "From the first line to the last"),
)
SPLINES = (
    ('KEY_LINEAR', "Linear", "Straight between control points"),
    ('KEY_CARDINAL', "Cardinal", "Through the control points"),
    ('KEY_CATMULL_ROM', "Catmull-Rom", "Through the control points, softly"),
    ('KEY_BSPLINE', "BSpline", "Near the control points, smoothest"),
)
FITS = (
    ('GRADIENT', "How Lines Run", "The lines run as wanted, wherever each of them lies"),
    ('VALUE', "Where Each Line Lies", "Each line lies where it is wanted. A border limits that: clamped, the two "
     "outermost rows of vertices stay, fixed the outermost one, and the lines there too; only a free border follows"),
)
LIGHTS = (
    ('CROSSED', "Crossed", "The light and the same turned by 90 degrees in the camera's picture: what one of them does "
     "not show cannot pay for the other"),
    ('SINGLE', "This Light", "Only the light as it is"),
    ('SET', "The Set", "In Smooth the set's lights, each with its own view, but for Along the Lines; other tools keep "
     "the crossed lines, and the set judges what they make"),
)
SAVED = {'options': {'SKIP_SAVE'}}
# With the numbers that files hold: a new border gets a new one.
BORDERS = (
    ('follow', NAMES["follow"], "Panels in Edit Mode that face each other over a gap move as one. Smooth with the "
     "automatic length: border vertices beside what stays keep their place, and take its slope: of other objects, and "
     "of faces that are not joined. Tangent elsewhere", 'NONE', 5),
    ('flow', NAMES["flow"], "As Curvature, and the curvature changes across the border as it does in the faces beside "
     "the region, where they tell it", 'NONE', 4),
    ('curvature', NAMES["curvature"], "As Tangent, and the lines run on from the faces beside the region without a "
     "kink: their curvature is continued", 'NONE', 3),
    ('clamped', NAMES["clamped"], "Border vertices stay, and so does the slope there: the panel joins on smoothly",
     'NONE', 0),
    ('fixed', NAMES["fixed"], "Border vertices stay; the slope across the border may change", 'NONE', 1),
    ('free', NAMES["free"], "Border vertices may move along the view, as the rest does", 'NONE', 2),
)

AUTOMATIC_BORDER = (AUTOMATIC, NAMES[AUTOMATIC], "Neighbours towards panels in Edit Mode that face this one over a "
                    "gap, and Tangent elsewhere. In Smooth with the automatic length Tangent", 'NONE', 6)


def border_property() -> object:
    """Defines the setting of a tool's border. A tool that changes the mean of the lines over the region does more with
    a free one, and bends the rim: of a turn by 0.2 rad on a crowned panel 10 % and 65 %, with 0 and 6 to 12 degrees of
    a crease against the faces beside the region. So it is asked for, by a button.
    """
    return EnumProperty(name="Border", items=(AUTOMATIC_BORDER, *BORDERS), default=AUTOMATIC, **SAVED,
                        description="What happens at the border of the region")


def lights_property() -> object:
    """Defines whose lines a tool has regard to."""
    return EnumProperty(name="Lights", items=LIGHTS, default='CROSSED', **SAVED,
                        description="Whose lines count: Smooth smooths both, other tools keep the crossed ones as far "
                        "as the wanted ones allow")


def limit_property() -> object:
    """Defines the largest move of a vertex."""
    return FloatProperty(name="Limit", unit='LENGTH', min=0.0, soft_max=1.0, precision=5, **SAVED,
                         description="No vertex moves further along the view than this. 0, automatic: a twentieth of "
                         "the length of what changes, for tools other than Smooth the region's diagonal")


def object_property(kind: str, **about: str) -> object:
    """Defines a setting that names an object of a kind."""
    return PointerProperty(type=bpy.types.Object, poll=lambda _, ob: ob.type == kind, **about)


def ensure_curve(settings: "FalloffSettings", context: bpy.types.Context) -> None:
    if settings.shape == 'CURVE':
        context.scene.reflection_lines.curve = falloff_curve.ensure_curve()


class FalloffSettings:
    centre: EnumProperty(name="Acts", items=CENTRES, default='REGION', **SAVED)
    radius: FloatProperty(name="Radius", unit='LENGTH', min=0.0, soft_max=10.0, precision=4, **SAVED,
                          description="How far the tool reaches from its centre; 0: a third of the region's diagonal, "
                          "at most half its width")
    shape: EnumProperty(name="Fall-off", items=SHAPES, default='SMOOTH', update=ensure_curve, **SAVED)


class SmoothSettings:
    border: border_property()
    length: FloatProperty(name="Length", unit='LENGTH', min=0.0, soft_max=10.0, precision=4, **SAVED,
                          description="Detail of the lines finer than this is removed. 0, automatic: noise, ripples, "
                          "round dents and differences of the halves go, and the design stays")
    strength: FloatProperty(name="Strength", default=1.0, min=0.0, max=1.0, subtype='FACTOR', **SAVED,
                            description="How much of that detail is removed: 0 leaves the panel as it is")
    directional: BoolProperty(name="Along the Lines", **SAVED,
                              description="Smooth only along the lines: they become straight, their spacing stays")
    lights: lights_property()
    symmetric: BoolProperty(name="Symmetric", default=True, **SAVED,
                            description="With the automatic length, what one half of the panel has and the other has "
                            "not is a flaw, where they are alike otherwise")
    flaw_size: FloatProperty(name="Flaw Size", default=1.0, min=0.1, soft_min=0.5, soft_max=4.0, max=16.0,
                             precision=2, **SAVED, description="Of the automatic length: with 2, waves twice as long "
                             "count as flaws, and so may designs of that size")
    fair_border: BoolProperty(name="Fair Border", **SAVED,
                              description="With the automatic length, move the border of the region, too, to where the "
                              "faces beside it tell that it should run: a border that is held keeps its flaws")
    even_flush: BoolProperty(name="Even Flush", **SAVED,
                             description="With the border Neighbours, make the step between panels pressed together "
                             "run straight along each shut line, and be constant around a flap. The gap keeps its "
                             "width, as seen from the view")
    limit: limit_property()

    def draw_smooth(self, layout: bpy.types.UILayout, draw_value: Callable) -> None:
        """Draws the settings but strength and border, for the sidebar and the redo panel, which draw automatic values
        apart.
        """
        draw_value(layout, self, "length")
        draw_switch(layout, self, "directional")
        automatic = layout.column()
        automatic.active = not self.length and not self.directional
        automatic.prop(self, "flaw_size")
        draw_switch(automatic, self, "symmetric")
        draw_switch(automatic, self, "fair_border")
        draw_switch(automatic, self, "even_flush")


class DirectionSettings:
    direction: EnumProperty(name="Direction", items=DIRECTIONS, default='PRESENT', **SAVED)
    angle: FloatProperty(name="Angle", subtype='ANGLE', **SAVED,
                         description="Counter-clockwise in the camera's picture: how far lines that keep their course "
                         "are turned, and of straight ones from the horizontal")
    density: FloatProperty(name="Density", default=1.0, min=0.0, soft_max=10.0, precision=3, **SAVED,
                           description="How close together the lines are: a factor of what they are, of straight ones "
                           "of their mean")
    axis: EnumProperty(name="Varies", items=AXES, default='NONE', **SAVED)
    density_end: FloatProperty(name="At the End", default=1.0, min=0.0, soft_max=10.0, precision=3, **SAVED,
                               description="Density at the far end")
    strength: FloatProperty(name="Strength", default=1.0, min=0.0, max=1.0, subtype='FACTOR', **SAVED,
                            description="0 leaves the panel as it is")


class FitSettings:
    fit: EnumProperty(name="Fit", items=FITS, default='GRADIENT', **SAVED)


class WarpSettings(FitSettings):
    amount: FloatProperty(name="Amount", default=100.0, min=0.0, soft_max=100.0, max=1000.0, subtype='PERCENTAGE',
                          precision=1, **SAVED, description="How far of the way that the lattice's control points went "
                          "the lines go")


class PatternSettings(FitSettings):
    strength: FloatProperty(name="Strength", subtype='ANGLE', default=0.1, soft_min=-1.0, soft_max=1.0, **SAVED,
                            description="Turn of the reflected light from black to white; 0 leaves the panel as it is")
    blur: FloatProperty(name="Blur", default=2.0, min=0.0, soft_max=50.0, subtype='PIXEL', **SAVED,
                        description="Standard deviation in pixels; edges too sharp for any surface are not reached")
    width: FloatProperty(name="Width", unit='LENGTH', min=0.0, soft_max=10.0, precision=4, **SAVED,
                         description="Of the picture; 0 covers the region")
    angle: FloatProperty(name="Rotation", subtype='ANGLE', **SAVED,
                         description="Counter-clockwise in the camera's picture")
    offset: FloatVectorProperty(name="Offset", size=2, subtype='XYZ', unit='LENGTH', **SAVED,
                                description="Of the picture's middle from the region's, right and up for the camera")


class PullSettings:
    radius: FloatProperty(name="Radius", unit='LENGTH', min=0.0, soft_max=10.0, precision=4, **SAVED,
                          description="How far from a new handle lines may move; 0: a third of the region's diagonal, "
                          "at most half its width")


class BrushSettings:
    size: IntProperty(name="Size", default=60, min=2, soft_max=500, max=5000, subtype='PIXEL', **SAVED,
                      description="Radius of the brush on the screen")
    strength: FloatProperty(name="Strength", default=0.5, min=0.0, max=1.0, subtype='FACTOR', **SAVED,
                            description="How far one dab brings the lines in its middle to smooth ones")


class ReflinesDirection(FalloffSettings, DirectionSettings, bpy.types.PropertyGroup):
    """The scene's settings of Direction and Density."""
    radius_automatic: switch_property("radius", "Radius")


class ReflinesPull(PullSettings, bpy.types.PropertyGroup):
    """The scene's settings of Pull Line."""
    radius_automatic: switch_property("radius", "Radius")


class ReflinesBrush(BrushSettings, bpy.types.PropertyGroup):
    """The scene's settings of Fair Brush."""


class ReflinesWarp(WarpSettings, bpy.types.PropertyGroup):
    """The scene's settings of Warp."""
    lattice: object_property('LATTICE', name="Lattice", description="Its control points say where the lines go")


class ReflinesPattern(PatternSettings, bpy.types.PropertyGroup):
    """The scene's settings of Image Pattern."""
    width_automatic: switch_property("width", "Width")
    image: PointerProperty(name="Image", type=bpy.types.Image, description="Its grey values say how the lines bend")
