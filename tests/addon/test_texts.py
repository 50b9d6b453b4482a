"""What the artist reads: names, tooltips, and the words of a result."""
import bpy
import pytest

import scenes

LONGEST_TOOLTIP = 200  # characters; Blender shows a tooltip beside the mouse, over what it is about
TOOLS = ("smooth", "direction", "untwist", "warp", "pattern")


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
    ob = scenes.panel()
    scenes.look_from_above()
    scenes.edit_inner(ob)
    scenes.smooth(**settings)
    return ob.reflection_lines.report


def test_a_smoothing_tells_first_how_much_smoother_the_lines_are(capfd: pytest.CaptureFixture) -> None:
    report = solved(length=0.414)
    ratio = report.score_before / report.score_after
    assert report.headline().startswith(f"Lines {ratio:.1f} x smoother, moved at most 1.9 mm")
    assert f"Info: Panel: {report.headline()}; converged after" in capfd.readouterr().out


def test_nothing_moved_is_said_plainly() -> None:
    assert solved(strength=0.0).headline() == "Nothing moved"


def test_another_tool_tells_how_much_of_the_wish_was_reached() -> None:
    solved()
    bpy.ops.reflines.untwist(border='free', centre='EVERYWHERE')
    report = bpy.context.view_layer.objects.active.reflection_lines.report
    share = 1.0 - report.residual_after / report.residual_before
    assert report.headline().startswith(f"{share:.0%} of the wish reached, moved at most ")


def test_the_automatic_length_is_told() -> None:
    report = solved()
    assert report.automatic() == "0: automatic, 18 cm"
    assert solved(length=0.5).automatic() == "0: automatic"
    assert solved(directional=True).automatic() == "0: automatic, 41 cm"
