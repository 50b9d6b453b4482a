"""Lengths in the scene's units, which may make a Blender unit a millimetre."""
import bpy


def format_length(value: float, scene: bpy.types.Scene, precision: int = 4) -> str:
    """Formats a length in Blender units by the scene's unit settings."""
    units = scene.unit_settings
    if units.system == 'NONE':
        return f"{value:.{precision}g}"
    return bpy.utils.units.to_string(units.system, 'LENGTH', value * units.scale_length, precision=precision)


def read_typed_length(scene: bpy.types.Scene) -> float:
    """Returns the length in Blender units that a typed 1 means."""
    units = scene.unit_settings
    return 1.0 if units.system == 'NONE' else bpy.utils.units.to_value(units.system, 'LENGTH', "1") / units.scale_length
