"""Properties of an object's last inspection: its worst spots, and what is reported of all lights and views."""
import bpy
import numpy as np
from bpy.props import CollectionProperty, FloatProperty, FloatVectorProperty, IntProperty, StringProperty
from mathutils import Vector

from ..blender import units
from ..model.gain import Worse
from ..model.inspection import Inspection, Spot


class ReflinesSpot(bpy.types.PropertyGroup):
    """One spot; its place is in object space, so that it stays on the panel where that is moved."""
    place: FloatVectorProperty(name="Place", subtype='XYZ')
    size: FloatProperty(name="Size", unit='LENGTH')
    degrees: FloatProperty(name="Degrees")
    height: FloatProperty(name="Height", unit='LENGTH')
    view: StringProperty(name="View")
    light: IntProperty(name="Light")
    line: FloatVectorProperty(name="Light Direction", subtype='XYZ')
    eye: FloatVectorProperty(name="Seen From", subtype='XYZ', description="Direction to the viewer; 0: along the view "
                             "camera")

    def keep_worse(self, worse: Worse) -> None:
        """Keeps the place that a solve made worse; what flaw is there is not known."""
        self.place = self.id_data.matrix_world.inverted() @ Vector(worse.place)
        self.size, self.degrees, self.height, self.view, self.line = worse.size, worse.after, 0.0, "", worse.line
        self.eye = worse.eye or (0.0, 0.0, 0.0)

    def find_place(self) -> np.ndarray:
        """Returns the place in world space."""
        return np.array(self.id_data.matrix_world @ Vector(self.place))

    def to_spot(self) -> Spot:
        return Spot(tuple(self.find_place().tolist()), self.size, self.degrees, self.height, self.view, self.light,
                    tuple(self.line), tuple(self.eye) if any(self.eye) else None)

    def describe(self) -> str:
        """Describes the spot in the scene's units."""
        size = units.format_length(self.size, bpy.context.scene, 2)
        return f"{self.describe_shortly()}, {size} wide"

    def describe_shortly(self) -> str:
        """Describes the spot for a button, which the sidebar's default width cuts beyond some 25 letters."""
        height = units.format_length(abs(self.height), bpy.context.scene, 2)
        return f"{'Dent' if self.height < 0.0 else 'Bump'} {height}: {self.degrees:.2g}\u00b0"


class ReflinesInspection(bpy.types.PropertyGroup):
    """The last inspection of an object; `summary` is empty where there was none."""
    spots: CollectionProperty(type=ReflinesSpot)
    active: IntProperty(name="Spot", default=-1, description="That is looked at; -1: none")
    summary: StringProperty(name="Summary")
    unseen: StringProperty(name="Unseen", description="Views that do not see the panel")

    def fill(self, found: Inspection, noise_floor: float) -> None:
        inverse = np.linalg.inv(np.array(self.id_data.matrix_world, dtype=np.float64))
        self.spots.clear()
        for spot in found.spots:
            stored = self.spots.add()
            for name in ("size", "degrees", "height", "view", "light", "line"):
                setattr(stored, name, getattr(spot, name))
            stored.place = inverse[:3, :3] @ spot.place + inverse[:3, 3]
            stored.eye = spot.eye or (0.0, 0.0, 0.0)
        self.active = -1
        count = f"{len(found.spots)} spots" if len(found.spots) != 1 else "1 spot"
        places = count if found.spots else f"No place deviates by {noise_floor:.2g}\u00b0"
        self.summary = f"{places}; mean {found.mean:.2g}\u00b0, most {found.worst}"
        self.unseen = f"Not seen from {', '.join(found.unseen)}: no weight there" if found.unseen else ""
