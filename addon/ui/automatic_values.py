"""Lengths for which 0 means automatic: they are drawn as what 0 stood for in the last run, where that is known, beside
a switch.
"""
import bpy
from bpy.props import BoolProperty, FloatProperty

from ..blender import units

# Of the object's size: what the switch turned off begins with where no run gave a value.
UNKNOWN_FRACTIONS = {"length": 0.01, "limit": 0.01, "radius": 0.25, "width": 0.5}
HIDDEN = {'options': {'HIDDEN', 'SKIP_SAVE'}}  # they are other faces of a setting, which keeps the value


def find_automatic_value(name: str) -> float:
    """Returns what the 0 of a setting stood for in the active object's last run, world units, to two digits; 0 where it
    is not known.
    """
    ob = bpy.context.view_layer.objects.active
    found = getattr(ob.reflection_lines.report, f"automatic_{name}", 0.0) if ob is not None else 0.0
    return float(f"{found:.2g}")


def choose_own_value(name: str) -> float:
    """Returns the value that a setting begins with when it is automatic no longer."""
    ob = bpy.context.view_layer.objects.active
    unknown = UNKNOWN_FRACTIONS[name] * (ob.dimensions.length if ob is not None else 0.0)
    return find_automatic_value(name) or unknown or 1.0


def shown_property(name: str, label: str) -> object:
    """Defines the face of a setting that shows its automatic value; a value given to it is the setting's own."""
    return FloatProperty(name=label, unit='LENGTH', min=0.0, soft_max=10.0, precision=4, **HIDDEN,
                         description="The automatic value in the last region; type another, or drag, to set it",
                         get=lambda self: getattr(self, name) or find_automatic_value(name),
                         set=lambda self, value: setattr(self, name, value))


def switch_property(name: str, label: str) -> object:
    """Defines the switch between the automatic value of a setting and one of its own."""
    return BoolProperty(name=f"Automatic {label}", **HIDDEN, description="Choose the value by the panel's size",
                        get=lambda self: not getattr(self, name),
                        set=lambda self, on: setattr(self, name, 0.0 if on else choose_own_value(name)))


def draw_value(layout: bpy.types.UILayout, settings: object, name: str) -> None:
    """Draws a setting of the scene and its switch: the properties NAME, NAME_shown and NAME_automatic."""
    if not getattr(settings, name) and not find_automatic_value(name):  # no run has given it
        row = layout.row(heading=settings.bl_rna.properties[name].name)
        row.prop(settings, f"{name}_automatic", text="Automatic", toggle=True)
        return
    row = layout.row(align=True)
    row.prop(settings, name if getattr(settings, name) else f"{name}_shown")
    row.prop(settings, f"{name}_automatic", text="", icon='EVENT_A')


def draw_plain_value(layout: bpy.types.UILayout, settings: object, name: str) -> None:
    """Draws a setting of an operator, and below it what its 0 stands for, where that means automatic. An operator has
    no other faces of a setting: its command, which Blender shows and the artist copies, would set the value twice.
    """
    layout.prop(settings, name)
    if name not in UNKNOWN_FRACTIONS or getattr(settings, name):
        return
    value = find_automatic_value(name)
    length = f", {units.format_length(value, bpy.context.scene, precision=2)}" if value else ""
    row = layout.row()
    row.active, row.alignment = False, 'RIGHT'
    row.label(text=f"0: automatic{length}")
