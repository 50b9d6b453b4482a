"""What the artist reads: names, tooltips, and the words of a result."""
import json
from math import degrees

import bpy
import pytest

import scenes

LONGEST_TOOLTIP = 200  # characters; Blender shows a tooltip beside the mouse, over what it is about
TOOLS = ("smooth", "direction", "warp", "pattern")


@pytest.mark.parametrize("tool", TOOLS)
def test_button_and_panel_of_a_tool_have_one_name(tool: str) -> None:
    button = getattr(bpy.ops.reflines, tool).get_rna_type().name
    assert getattr(bpy.types, f"VIEW3D_PT_reflines_{tool}").bl_label == button


@pytest.mark.parametrize("name", sorted(dir(bpy.ops.reflines)))
def test_tooltips_are_short(name: str) -> None:
    about = getattr(bpy.ops.reflines, name).get_rna_type()
    texts = [about.description, *(each.description for each in about.properties)]
    assert max(map(len, texts)) < LONGEST_TOOLTIP, max(texts, key=len)


def solved(**settings: object) -> bpy.types.PropertyGroup:
    ob = scenes.edited_panel()
    scenes.smooth(**settings)
    return ob.reflection_lines.report


def test_a_smoothing_tells_first_how_far_lines_are_off_their_course(capfd: pytest.CaptureFixture) -> None:
    report = solved(length=0.414)
    change = f"{report.score_before:.2g}\u00b0 \u2192 {report.score_after:.2g}\u00b0"
    assert report.headline().startswith(f"Lines off by {change}, moved at most 1.4 mm")
    told = [line for line in capfd.readouterr().out.splitlines() if line.startswith("Info: Lines")]
    assert told == [f"Info: {report.headline()} (Panel)"]  # the solver's numbers are in the panel Numbers


def test_an_automatic_press_tells_first_where_flaws_went() -> None:
    report = solved()
    assert report.healed_area > 0.1 and report.worst_after < 0.5 * report.worst_before
    change = f"{report.worst_before:.2g}\u00b0 \u2192 {report.worst_after:.2g}\u00b0"
    where = f"Flaws healed on {report.healed_area:.0%} of the panel"
    assert report.headline().startswith(f"{where}: worst {change}, moved ")


def test_nothing_moved_is_said_plainly() -> None:
    assert solved(strength=0.0).headline() == "Nothing moved"
    report = solved(length=0.414)
    report.largest_move = 1e-8  # of a panel of 2 x 2: no bit of a coordinate
    assert report.headline() == "Nothing moved"


def test_another_tool_tells_how_far_lines_are_off_the_wanted_ones() -> None:
    solved()
    bpy.ops.reflines.direction(angle=0.2, border='free', centre='EVERYWHERE')
    report = bpy.context.view_layer.objects.active.reflection_lines.report
    off = [degrees(value * report.length) for value in (report.residual_before, report.residual_after)]
    assert off[0] > 2.0 * off[1] > 0.0
    assert report.headline().startswith(f"Off the wanted lines by {off[0]:.2g}\u00b0 \u2192 {off[1]:.2g}\u00b0, moved ")


def test_the_automatic_length_is_shown_as_its_value() -> None:
    settings = bpy.context.scene.reflection_lines
    report = solved()
    assert settings.length == 0.0 and settings.length_automatic
    assert settings.length_shown == pytest.approx(0.18) and settings.limit_shown == pytest.approx(0.0089)
    assert report.automatic_length == pytest.approx(0.1773, rel=1e-3)
    assert report.automatic_limit == pytest.approx(report.automatic_length / 20.0)
    solved(directional=True)
    assert settings.length_shown == pytest.approx(0.18)  # one automatic length, whatever it is for
    solved(length=0.5)
    assert settings.length_shown == 0.0  # the run told nothing of it


def test_a_value_given_to_what_is_shown_is_the_setting_and_the_switch_takes_it_back() -> None:
    settings = bpy.context.scene.reflection_lines
    solved()
    settings.length_shown, settings.limit_automatic = 0.3, False
    assert settings.length == pytest.approx(0.3) and not settings.length_automatic
    assert settings.limit == pytest.approx(0.0089)
    settings.length_automatic = settings.limit_automatic = True
    assert settings.length == settings.limit == 0.0


def test_a_run_with_automatic_values_leaves_them_automatic() -> None:
    solved()
    solved()
    run = json.loads(bpy.context.object.reflection_lines.run.settings)
    assert run["length"] == run["limit"] == 0.0
