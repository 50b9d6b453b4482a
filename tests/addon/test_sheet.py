"""The sheet of an inspection: a picture that others can open, with stripes and marks where they belong."""
from pathlib import Path

import bpy
import numpy as np
import pytest

import scenes
from reflection_lines.model import panel_picture, sheet
from reflection_lines.model.panel_picture import Looked
from reflection_lines.model.steps import finish
from reflection_lines.operators import export_sheet
from test_inspect import inspect, make_panel

RED = np.array(sheet.RED)


def read_picture(file: Path) -> np.ndarray:
    """Reads it as Blender does: height x width x 3 from the top, as in the file."""
    image = bpy.data.images.load(str(file))
    image.colorspace_settings.name = 'Non-Color'
    pixels = scenes.pixels(image)[::-1, :, :3]
    bpy.data.images.remove(image)
    return pixels


def export(file: Path) -> np.ndarray:
    assert bpy.ops.reflines.export_sheet('EXEC_DEFAULT', filepath=str(file)) == {'FINISHED'}
    return read_picture(file)


@pytest.mark.parametrize("lights", ['WALK', 'SET'])
def test_spots_are_ringed_where_they_are(lights: str, tmp_path: Path) -> None:
    ob = make_panel()
    bpy.ops.reflines.light_set(action='WALK')
    found = inspect(ob, lights=lights)
    before = scenes.fingerprint(ob), len(bpy.data.objects), len(bpy.data.curves)
    pixels = export(tmp_path / "sheet.png")
    assert (scenes.fingerprint(ob), len(bpy.data.objects), len(bpy.data.curves)) == before
    assert pixels.shape == (sheet.HEIGHT, sheet.WIDTH, 3)
    told = finish(export_sheet.build_sheet(bpy.context, ob))
    assert len(told.spots) == 2
    red = np.abs(pixels - RED).max(axis=2) < 0.02
    for spot in found.spots:
        place = told.looked.find_pixels(np.array([spot.find_place()]), *sheet.PICTURE)[0] + (sheet.MARGIN, 200)
        x, y = np.round(place).astype(int)
        ring = round(0.5 * sheet.PICTURE[0] / told.looked.width * spot.size)
        assert red[y + ring - 2:y + ring + 2, x].any() and red[y, x - ring - 1:x - ring + 3].any() and not red[y, x]


def test_stripes_run_as_theta_says() -> None:
    """On a crown, whose normals are known; what lies beside the region has none."""
    ob = make_panel(scenes.crown)
    inspect(ob)
    told = finish(export_sheet.build_sheet(bpy.context, ob))
    size = np.array([300, 200])
    grey = panel_picture.draw_panel(told.shown, told.looked, *size)[..., 0]
    row, column = np.mgrid[20:180, 80:220]
    xy = (np.stack([column, -row], axis=-1) + 0.5 + (-0.5, 0.5) * size - (0.0, 1.0)) * told.looked.width / size[0]
    x, y = (xy @ np.stack([told.looked.right[:2], told.looked.up[:2]])).transpose(2, 0, 1)
    step = 1e-4
    crown = np.vectorize(scenes.crown)
    slopes = [(crown(x + step * a, y + step * b) - crown(x - step * a, y - step * b)) / (2 * step)
              for a, b in ((1, 0), (0, 1))]
    normals = np.stack([-slopes[0], -slopes[1], np.ones_like(x)], axis=-1).reshape(-1, 3)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    wanted = panel_picture.stripe(normals, told.looked).reshape(x.shape)
    drawn = grey[row, column]
    assert 0.2 < (wanted == panel_picture.DARK).mean() < 0.8
    assert np.mean(np.abs(drawn - wanted) < 0.01) > 0.9


def test_another_eye_turns_the_picture_no_further_than_needed() -> None:
    x, y, z = np.eye(3)
    looked = Looked(x, y, z, np.zeros(3), 1.0, x, 10.0)
    eye = np.array([0.6, 0.0, 0.8])
    right, up = panel_picture.turn_to(looked, eye)
    assert np.allclose(up, y) and np.allclose(right, (0.8, 0.0, -0.6))
    right, up = panel_picture.turn_to(looked, -z)
    assert np.allclose(np.cross(right, up), -z)


def test_vertices_nowhere_and_faces_beside_keep_no_panel_from_its_sheet() -> None:
    far, loose = (1e3, 0.0, 0.0), (np.nan,) * 3
    V = np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), far, loose])
    shown = finish(panel_picture.cut_surface(V, np.array([[0, 1, 2], [0, 2, 3], [0, 1, 4]]),
                                             np.array([True, False, False])))
    assert shown.region.tolist() == [True, False] and np.isfinite(shown.V).all() and np.isfinite(shown.normals).all()


def test_a_clean_panel_has_a_sheet_and_what_cannot_be_written_is_told(tmp_path: Path) -> None:
    ob = make_panel(scenes.crown)
    assert not bpy.ops.reflines.export_sheet.poll()
    inspect(ob)
    assert not (np.abs(export(tmp_path / "clean.png") - RED).max(axis=2) < 0.02).any()
    with pytest.raises(RuntimeError, match="No such file"):
        bpy.ops.reflines.export_sheet('EXEC_DEFAULT', filepath=str(tmp_path / "nowhere" / "sheet.png"))
