"""Presets of the stripes' look, and what the manifest tells of the add-on."""
import tomllib
from pathlib import Path

import bpy
import pytest
from reflection_lines.model.looks import LOOKS

import installation

KEPT = ("mode", "count", "width", "eye", "scope")


def stripes() -> bpy.types.PropertyGroup:
    return bpy.context.scene.reflection_lines.stripes


def test_a_preset_brings_the_look_back_to_other_files(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(bpy.utils, "user_resource", lambda *_, path="", **__: str(made(tmp_path / path)))
    look = {"mode": 'ISOPHOTE', "count": 17, "width": 0.25, "eye": 'VIEWPORT', "scope": 'VISIBLE'}
    for name, value in look.items():
        setattr(stripes(), name, value)
    stripes().color = (0.25, 0.5, 0.75, 1.0)
    assert bpy.ops.reflines.save_stripes_preset(name="Narrow Isophotes") == {'FINISHED'}
    saved = next(tmp_path.rglob("*.py"))
    for name in (*look, "color"):
        stripes().property_unset(name)
    assert stripes().mode == 'REFLECTION'
    bpy.ops.script.execute_preset(filepath=str(saved), menu_idname="VIEW3D_PT_reflines_stripe_presets")
    assert {name: getattr(stripes(), name) for name in KEPT} == look
    assert tuple(stripes().color) == (0.25, 0.5, 0.75, 1.0)
    assert not stripes().show  # the switch is no part of it


def made(folder: Path) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def test_a_preset_has_every_setting_of_the_look() -> None:
    own = {each.identifier for each in stripes().bl_rna.properties}
    left_out = {"rna_type", "name", "show", "before", "side_by_side", "cage_on_top", "look", "collection", "image",
                "frozen_eye"}
    operator = bpy.types.REFLINES_OT_save_stripes_preset
    paths = {f"bpy.context.scene.reflection_lines.stripes.{name}" for name in own - left_out}
    assert paths == set(operator.preset_values)


@pytest.mark.parametrize("look", LOOKS)
def test_a_look_that_comes_with_the_add_on_sets_what_it_says_and_no_more(look: str) -> None:
    stripes().eye, stripes().scope, stripes().count = 'VIEWPORT', 'VISIBLE', 7
    stripes().look = look
    assert stripes().look == look
    for name, value in LOOKS[look][2].items():
        now = getattr(stripes(), name)
        assert tuple(now) == pytest.approx(value) if isinstance(value, tuple) else now == pytest.approx(value) \
            if isinstance(value, float) else now == value
    assert (stripes().eye, stripes().scope, stripes().show) == ('VIEWPORT', 'VISIBLE', False)


def test_a_look_that_was_changed_is_the_artists_own() -> None:
    stripes().look = 'TUBES'
    stripes().count += 1
    assert stripes().look == 'OWN'
    stripes().look = 'OWN'
    assert stripes().count == LOOKS['TUBES'][2]["count"] + 1


def test_the_first_look_is_what_the_settings_begin_with() -> None:
    about = stripes().bl_rna.properties
    for name, value in LOOKS['ZEBRA'][2].items():
        begins = tuple(about[name].default_array) if isinstance(value, tuple) else about[name].default
        assert begins == (pytest.approx(value) if not isinstance(value, str) else value), name


def test_the_manifest_names_the_permission_and_tags_that_blender_knows() -> None:
    manifest = tomllib.loads((installation.FOLDER / "blender_manifest.toml").read_text())
    assert set(manifest["permissions"]) == {"files"}
    reason = manifest["permissions"]["files"]
    assert 0 < len(reason) <= 64 and not reason.endswith(".")  # Blender's own limits
    assert set(manifest["tags"]) <= {"3D View", "Mesh", "Modeling"}
