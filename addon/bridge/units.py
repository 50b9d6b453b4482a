"""Lengths as the scene's unit settings write them, which may make a Blender unit a millimetre."""
import bpy


def length_text(value: float, scene: bpy.types.Scene, precision: int = 4) -> str:
    """Of a length in Blender units."""
    units = scene.unit_settings
    if units.system == 'NONE':
        return f"{value:.{precision}g}"
    return bpy.utils.units.to_string(units.system, 'LENGTH', value * units.scale_length, precision=precision)


def typed_length(scene: bpy.types.Scene) -> float:
    """What a typed 1 is in Blender units."""
    units = scene.unit_settings
    return 1.0 if units.system == 'NONE' else bpy.utils.units.to_value(units.system, 'LENGTH', "1") / units.scale_length
