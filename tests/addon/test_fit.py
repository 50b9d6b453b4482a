"""Fit Cage to Mesh: the cage below a Subdivision Surface takes over another mesh's surface and lines."""
import re

import bpy
import numpy as np
import pytest

import scenes

CELLS = 10


def cage(height: scenes.Height = scenes.crown, levels: int = 3) -> bpy.types.Object:
    ob = scenes.panel("Cage", height=height, cells=CELLS)
    modifier = ob.modifiers.new("Subdivision", 'SUBSURF')
    modifier.levels = levels
    return ob


def dense_of(ob: bpy.types.Object) -> bpy.types.Object:
    """What the viewport shows of it, as a mesh of its own, moved about in the file but not in the world."""
    mesh = bpy.data.meshes.new_from_object(ob.evaluated_get(bpy.context.evaluated_depsgraph_get()))
    dense = bpy.data.objects.new("Dense", mesh)
    bpy.context.collection.objects.link(dense)
    scenes.transformed(dense, scenes.TRANSFORMS["turned, scaled and mirrored"])
    return dense


def noise(x: float, y: float) -> float:
    return scenes.crown(x, y) + 0.004 * np.sin(9.0 * x + 1.0) * np.cos(8.0 * y)


def scene() -> tuple[bpy.types.Object, np.ndarray]:
    """A noisy cage, active, and the limit surface of the clean one, selected; the clean cage's positions."""
    clean = cage(levels=4)
    expected = scenes.positions(clean)
    dense = dense_of(clean)
    bpy.data.objects.remove(clean)
    noisy = cage(noise)
    scenes.look_from_above()
    dense.select_set(True)
    return noisy, expected


def fit(**settings: object) -> set[str]:
    return bpy.ops.reflines.fit('EXEC_DEFAULT', True, **settings)


def test_the_surface_of_a_cage_gives_that_cage_back_and_says_how_near() -> None:
    noisy, expected = scene()
    before = scenes.positions(noisy)
    assert np.abs(before - expected).max() > 0.003
    assert fit() == {'FINISHED'}
    assert np.abs(scenes.positions(noisy) - expected).max() < 1e-4
    report = noisy.reflection_lines.report
    assert report.termination == "converged"
    assert re.fullmatch(r"Distance from Dense \S+ mm \u2192 \S+ \S+ at most, lines off by \S+\u00b0 \u2192 \S+\u00b0",
                        report.fit)
    assert [modifier.type for modifier in noisy.modifiers] == ['SUBSURF']
    bpy.data.objects["Dense"].select_set(False)
    scenes.edit(noisy)
    bpy.ops.mesh.select_all(action='SELECT')
    scenes.smooth()
    assert report.fit == ""


def test_distances_are_told_in_the_scenes_unit() -> None:
    noisy, _ = scene()
    bpy.context.scene.unit_settings.scale_length = 0.01
    fit()
    assert "\u00b5m \u2192 " in noisy.reflection_lines.report.fit  # of a panel of 2 cm


def test_a_clamped_border_is_kept_when_asked_for() -> None:
    noisy, _ = scene()
    before = scenes.positions(noisy)
    bpy.ops.object.mode_set(mode='EDIT')  # of both
    bpy.ops.mesh.select_all(action='SELECT')
    fit(border='clamped')
    rim = np.abs(before[:, :2]).max(axis=1) > 1.0 - 1.5 / CELLS
    after = scenes.positions(noisy)
    assert np.array_equal(after[rim], before[rim])
    assert not np.array_equal(after, before)


def test_into_a_shape_key() -> None:
    noisy, expected = scene()
    before = scenes.positions(noisy)
    fit(result='SHAPE_KEY')
    basis, key = noisy.data.shape_keys.key_blocks
    for shape, wanted, apart in ((basis, before, 0.0), (key, expected, 1e-4)):
        values = np.array([point.co for point in shape.data], dtype=np.float32)
        assert np.abs(values - wanted).max() <= apart


def test_one_undo_step() -> None:
    noisy, _ = scene()
    bpy.ops.ed.undo_push(message="start")
    before = scenes.fingerprint(noisy)
    fit()
    assert scenes.fingerprint(noisy) != before
    bpy.ops.ed.undo()
    assert scenes.fingerprint(bpy.data.objects["Cage"]) == before


@pytest.mark.parametrize(("change", "said"), [
    (lambda dense, _: setattr(dense.location, "x", dense.location.x + 1.9), "covers [0-9]+% of the panel"),
    (lambda dense, _: dense.select_set(False), "0 other meshes"),
    (lambda _, ob: ob.modifiers.clear(), "is no cage")])
def test_what_cannot_be_fitted_is_refused_in_words(change: object, said: str) -> None:
    noisy, _ = scene()
    change(bpy.data.objects["Dense"], noisy)
    with scenes.refused(noisy, said):
        fit()
