"""Properties of the scene's set of lights: each light with the view that sees it."""
import bpy
from bpy.props import (BoolProperty, CollectionProperty, FloatProperty, FloatVectorProperty, IntProperty,
                       PointerProperty)


class ReflinesSetLight(bpy.types.PropertyGroup):
    """One light of the set: of a camera and a light that are followed, or of two directions that it keeps."""
    muted: BoolProperty(name="Mute", description="Leave this light out")
    weight: FloatProperty(name="Weight", default=1.0, min=0.0, soft_max=10.0, max=1e6, description="How much the light "
                          "counts where a limit or a cage keeps a press from the shape without flaws")
    camera: PointerProperty(type=bpy.types.Object, name="View Camera", description="The camera that sees the light",
                            poll=lambda _, ob: ob.type == 'CAMERA')
    light: PointerProperty(type=bpy.types.Object, name="Light Direction",
                           description="An object whose local Z axis is the direction of the line lights")
    keeps_directions: BoolProperty(description="Made by Walk Around: view and light are directions")
    eye: FloatVectorProperty(name="View", subtype='XYZ', description="Direction from the panel to the viewer")
    line: FloatVectorProperty(name="Light", subtype='XYZ', description="Direction of the line lights")

    def find_problem(self) -> str:
        """Returns why the light cannot be used, as a sentence; empty where it can."""
        if self.keeps_directions:
            return "" if any(self.eye) and any(self.line) else "It has no direction: remove it"
        present = self.id_data.reflection_lines.present
        if not present(self.camera) or self.camera.type != 'CAMERA':
            return "Its camera is gone: remove it"
        return "" if present(self.light) else "Its light is gone: remove it"

    def is_used(self) -> bool:
        return not self.muted and self.weight > 0.0 and not self.find_problem()


class ReflinesLightSet(bpy.types.PropertyGroup):
    """The lights of the set."""
    entries: CollectionProperty(type=ReflinesSetLight)
    active: IntProperty(name="Light", options=set(), description="That is shown below the list")

    def find_active(self) -> ReflinesSetLight | None:
        """Returns the light that is shown; None where there is none."""
        return self.entries[min(max(self.active, 0), len(self.entries) - 1)] if len(self.entries) else None

    def describe_problems(self) -> tuple[str, ...]:
        """Returns a sentence for each light that cannot be used, but for muted ones."""
        return tuple(f"{entry.name}: {entry.find_problem()[0].lower()}{entry.find_problem()[1:]}"
                     for entry in self.entries if not entry.muted and entry.find_problem())
