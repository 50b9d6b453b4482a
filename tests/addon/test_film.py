"""Films of a panel: one picture a frame, whose stripes slide, and which begins again where it ends."""
from dataclasses import replace
from pathlib import Path

import bpy
import numpy as np
import pytest

import scenes
from reflection_lines.interactive import read_picture
from reflection_lines.model import panel_picture
from reflection_lines.model.film import Film
from reflection_lines.model.steps import finish
from test_inspect import make_panel
from test_sheet import read_picture as read_file

SIZE = {"width": 160, "height": 90}


def export(folder: Path, **settings: object) -> list[np.ndarray]:
    ob, scene = bpy.context.object, bpy.context.scene
    scene.frame_start, scene.frame_end = 11, 14
    before, render = scenes.fingerprint(ob), scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = 320, 180, 50
    assert bpy.ops.reflines.export_film('EXEC_DEFAULT', filepath=str(folder / "film_.png"), **settings) == {'FINISHED'}
    assert scenes.fingerprint(ob) == before
    files = sorted(folder.iterdir())
    assert [file.name for file in files] == [f"film_{k:04d}.png" for k in range(1, len(files) + 1)]
    return [read_file(file) for file in files]


def read_film(**settings: object) -> Film:
    shown, looked = finish(read_picture.read_picture(bpy.context, bpy.context.object))
    return Film(shown, replace(looked, width=3.0), **{"kind": 'LIGHT', "swing": 0.5, "frames": 8, **SIZE, **settings})


def test_the_light_turns_and_the_panel_stays(tmp_path: Path) -> None:
    make_panel()
    frames = export(tmp_path, kind='LIGHT')
    assert len(frames) == 4 and frames[0].shape == (90, 160, 3)
    ground = [np.abs(frame - panel_picture.GROUND).max(axis=2) < 0.01 for frame in frames]
    assert all((each == ground[0]).mean() > 0.99 for each in ground) and 0.2 < ground[0].mean() < 0.8
    assert all(np.abs(one - other).mean() > 0.05 for one, other in zip(frames, frames[1:], strict=False))


def test_the_view_walks_around_the_panel(tmp_path: Path) -> None:
    """Seen from above it turns like a wheel: to one side, and to the other."""
    make_panel()
    frames = export(tmp_path, kind='VIEW')
    assert np.array_equal(frames[0], frames[2])
    assert np.abs(frames[1] - frames[3]).mean() > 0.05 < np.abs(frames[0] - frames[1]).mean()


@pytest.mark.parametrize("kind", ['LIGHT', 'VIEW'])
def test_a_film_goes_on_where_it_ends(kind: str) -> None:
    make_panel()
    told = read_film(kind=kind)
    first, again = told.look(0), told.look(8)
    assert np.allclose(np.abs(first.line @ again.line), 1.0) and np.allclose(first.eye, again.eye)
    shots = [panel_picture.draw_panel(told.shown, each, 160, 90) for each in (first, again, told.look(3))]
    assert np.abs(shots[0] - shots[1]).mean() < 0.01 < np.abs(shots[0] - shots[2]).mean()


def test_the_bands_of_a_frame_are_the_frame() -> None:
    make_panel()
    told = read_film(width=400, height=250)
    whole = panel_picture.draw_panel(told.shown, told.look(3), 400, 250)
    bands = finish(told.draw_frame(3))
    assert len(list(told.draw_frame(3))) == 4  # steps
    assert bands.shape == whole.shape and np.mean(np.abs(bands / 255.0 - whole) < 0.01) > 0.99


@pytest.mark.parametrize(("kind", "wanted"), [('LIGHT', 2.0 * 16 / 9), ('VIEW', 2.0 * 1.36 * 16 / 9)])
def test_the_panel_is_whole_in_every_frame(kind: str, wanted: float) -> None:
    """A square from above, which needs 1.36 times the room where it is turned by half a radian."""
    make_panel()
    assert read_film(kind=kind).measure_width() == pytest.approx(wanted, rel=0.01)


def test_what_cannot_be_written_is_told(tmp_path: Path) -> None:
    make_panel()
    with pytest.raises(RuntimeError, match="No such file"):
        bpy.ops.reflines.export_film('EXEC_DEFAULT', filepath=str(tmp_path / "nowhere" / "a.png"))
