"""What is typed during a drag: numbers, units and expressions, in the units of the scene, within the limits."""
import bpy
import pytest
from reflection_lines.blender import units
from reflection_lines.interactive.drag_handles import DragValues, Handle

LENGTH = Handle("length", "Length", per_pixel=0.01, low=1e-9, high=1e9, doubles=True, unit='LENGTH')
STRENGTH = Handle("strength", "Strength", per_pixel=0.01, low=0.0, high=1.0)


@pytest.mark.parametrize(("unit", "text", "wanted"), [
    ('LENGTH', "0.5", 0.5), ('LENGTH', "1cm", 0.01), ('LENGTH', "1 m + 5cm", 1.05), ('LENGTH', "2*(3+1)", 8.0),
    ('LENGTH', "1'", 0.3048), ('ANGLE', "90", 1.5707963), ('ANGLE', "2*45", 1.5707963), ('NONE', "1/4", 0.25),
    ('PERCENT', "50%", 50.0), ('NONE', "-.5", -0.5)])
def test_numbers_units_and_expressions_are_read(unit: str, text: str, wanted: float) -> None:
    assert units.parse_number(text, unit, bpy.context.scene) == pytest.approx(wanted)


@pytest.mark.parametrize("text", ["", "-", "1+", "2*(3", "1/0", "abc", "1cm +"])
def test_what_is_no_number_yet_is_none_and_prints_nothing(text: str, capfd: pytest.CaptureFixture) -> None:
    assert units.parse_number(text, 'LENGTH', bpy.context.scene) is None
    if text not in {"abc", "1/0"}:  # of whole texts only the evaluation can tell
        assert capfd.readouterr() == ("", "")


def test_a_bare_number_has_the_scenes_unit() -> None:
    scene = bpy.context.scene
    scene.unit_settings.length_unit = 'MILLIMETERS'
    assert units.parse_number("3", 'LENGTH', scene) == pytest.approx(0.003)
    assert units.parse_number("3cm", 'LENGTH', scene) == pytest.approx(0.03)
    scene.unit_settings.scale_length = 0.001  # a Blender unit is a millimetre
    assert units.parse_number("3", 'LENGTH', scene) == pytest.approx(3.0)
    scene.unit_settings.system = 'NONE'
    assert units.parse_number("2*3", 'LENGTH', scene) == pytest.approx(6.0)


def test_radians_are_taken_where_the_scene_has_them() -> None:
    bpy.context.scene.unit_settings.system_rotation = 'RADIANS'
    assert units.parse_number("1.5", 'ANGLE', bpy.context.scene) == pytest.approx(1.5)


def typed(handle: Handle, keys: str) -> DragValues:
    values = DragValues([handle], [0.7], lambda of, text: units.parse_number(text, of.unit, bpy.context.scene))
    for key in keys:
        values.type(key)
    return values


def test_the_limits_are_applied_to_what_is_typed() -> None:
    assert typed(STRENGTH, "3").value(0) == 1.0
    assert typed(STRENGTH, "5-").value(0) == 0.0
    assert typed(LENGTH, "5mm").value(0) == pytest.approx(0.005)


def test_keys_before_a_number_are_not_typed_and_a_text_that_is_no_number_changes_nothing() -> None:
    values = typed(STRENGTH, "mx)")
    assert values.typed == [""] and not values.is_touched(0)
    values = typed(STRENGTH, "=1+")
    assert values.typed == ["=1+"] and not values.is_touched(0) and values.value(0) == 0.7


def test_minus_toggles_the_sign_of_a_number_and_is_a_character_of_an_expression() -> None:
    assert typed(STRENGTH, "12-").typed == ["-12"] and typed(STRENGTH, "12--").typed == ["12"]
    assert typed(STRENGTH, "=1-.75").value(0) == pytest.approx(0.25)
    values = typed(STRENGTH, "1*.5")
    values.erase()
    values.erase()
    assert values.typed == ["1*"] and not values.is_touched(0)
