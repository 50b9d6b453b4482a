"""Lengths in the scene's units, which may make a Blender unit a millimetre."""
import math

import bpy

# What a number without a unit means, by the scene's unit of length; Adaptive means the first of its system.
SHORT_NAMES = {'KILOMETERS': "km", 'METERS': "m", 'CENTIMETERS': "cm", 'MILLIMETERS': "mm", 'MICROMETERS': "\u00b5m",
               'MILES': "mi", 'FEET': "ft", 'INCHES': "in", 'THOU': "thou"}
DEFAULT_UNITS = {'METRIC': "m", 'IMPERIAL': "ft"}


def read_unit_length(scene: bpy.types.Scene) -> float:
    """Returns how many metres a Blender unit is; 1 in a scene without units."""
    units = scene.unit_settings
    return 1.0 if units.system == 'NONE' else units.scale_length


def format_length(value: float, scene: bpy.types.Scene, precision: int = 4) -> str:
    """Formats a length in Blender units by the scene's unit settings."""
    units = scene.unit_settings
    if units.system == 'NONE':
        return f"{value:.{precision}g}"
    return bpy.utils.units.to_string(units.system, 'LENGTH', value * units.scale_length, precision=precision)


def parse_number(text: str, unit: str, scene: bpy.types.Scene) -> float | None:
    """Returns the number that a typed text stands for, as Blender's own fields read it: with units and expressions, in
    Blender units or radians; None where it cannot be read. `unit` is as in interactive/drag_handles.py.
    """
    if not looks_complete(text):
        return None
    settings = scene.unit_settings
    try:
        if unit == 'LENGTH' and settings.system != 'NONE':
            reference = SHORT_NAMES.get(settings.length_unit, DEFAULT_UNITS[settings.system])
            value = bpy.utils.units.to_value(settings.system, 'LENGTH', text, str_ref_unit=reference)
            return finite(value / settings.scale_length)
        if unit == 'ANGLE' and settings.system_rotation == 'DEGREES':
            return finite(bpy.utils.units.to_value('METRIC', 'ROTATION', text))
        return finite(bpy.utils.units.to_value('NONE', 'NONE', text.rstrip('%')))
    except ValueError:
        return None


def looks_complete(text: str) -> bool:
    """Returns whether a text can be a number: Blender prints an error for each that is not, while it is typed."""
    return bool(text) and text[-1] not in "+-*/(." + " " and text.count('(') == text.count(')') or is_number(text)


def is_number(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


def finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
