"""Notes and refusals count faces as the artist has them: a quad once, whatever it is cut into, and with its image."""
import bpy
import numpy as np
import pytest

import scenes

CELLS = 16


def arch(first: float, last: float) -> bpy.types.Object:
    """An arch of quads from one angle (degrees from the view) to another; those at 74 to 85 are seen edge on."""
    ob = scenes.panel("Arch", lambda x, y: 0.0, cells=CELLS)
    for vertex in ob.data.vertices:
        angle = np.radians(first + 0.5 * (vertex.co.x + 1.0) * (last - first))
        vertex.co = (np.sin(angle), vertex.co.y, np.cos(angle))
    return ob


def edit_all(ob: bpy.types.Object) -> None:
    scenes.look_from_above()
    scenes.edit(ob)
    bpy.ops.mesh.select_all(action='SELECT')


@pytest.mark.parametrize("is_cage", [False, True])
def test_a_quad_seen_edge_on_is_one_face(is_cage: bool) -> None:
    ob = arch(-85.0, 85.0)
    if is_cage:
        ob.modifiers.new("Subdivision", 'SUBSURF').levels = 2
    edit_all(ob)
    scenes.smooth(length=0.3)
    assert f"{2 * CELLS} faces seen nearly edge on" in ob.reflection_lines.report.kept


@pytest.mark.parametrize("is_cage", [False, True])
def test_a_quad_and_its_image_are_one_face(is_cage: bool) -> None:
    ob = arch(0.0, 85.0)
    ob.modifiers.new("Mirror", 'MIRROR')
    if is_cage:
        ob.modifiers.new("Subdivision", 'SUBSURF').levels = 2
    edit_all(ob)
    scenes.smooth(length=0.3)
    columns = 2  # of 5.3 degrees: 74.4 to 79.7, of which the view sees a part at less than 12, and 79.7 to 85
    assert f"{(columns if is_cage else 1) * CELLS} faces seen nearly edge on" in ob.reflection_lines.report.kept


def test_all_faces_that_turn_away_are_counted_as_faces() -> None:
    ob = arch(-30.0, 30.0)
    edit_all(ob)
    bpy.ops.mesh.flip_normals()
    with pytest.raises(RuntimeError, match=f"All {CELLS * CELLS} faces of the region turn away"):
        scenes.smooth()


def test_a_region_that_cannot_move_is_counted_as_faces() -> None:
    ob = arch(-30.0, 30.0)
    scenes.look_from_above()
    scenes.edit(ob)
    scenes.select_faces(ob, lambda face: face in {0, 1})
    with pytest.raises(RuntimeError, match="2 faces: all vertices are held"):
        scenes.smooth(length=0.3)
