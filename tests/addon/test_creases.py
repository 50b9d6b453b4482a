"""Creases in Blender: the edges that an artist marked hold and part the lines, and the rule can be chosen."""
import bmesh
import bpy
import numpy as np
import pytest

import scenes

COLUMN = [8 + 17 * k for k in range(17)]  # vertices of the panel's middle


def marked_panel(mark: str) -> bpy.types.Object:
    """The rippled panel, its middle column marked, ready for a tool."""
    ob = scenes.edited_panel()
    mesh = bmesh.from_edit_mesh(ob.data)
    crease = mesh.edges.layers.float.get("crease_edge") or getattr(mesh.edges.layers, "crease", None)
    if mark == 'CREASE' and not isinstance(crease, bmesh.types.BMLayerItem):
        crease = crease.verify() if crease is not None else mesh.edges.layers.float.new("crease_edge")
    for edge in mesh.edges:
        if not {vertex.index for vertex in edge.verts} <= set(COLUMN):
            continue
        if mark == 'CREASE':
            edge[crease] = 1.0
        elif mark == 'SEAM':
            edge.seam = True
        else:
            edge.smooth = False
    bmesh.update_edit_mesh(ob.data)
    return ob


def has_moved(ob: bpy.types.Object, before: np.ndarray) -> bool:
    """Whether a vertex of the middle column moved; others have."""
    now = scenes.positions(ob)
    assert not np.array_equal(now, before)
    return not np.array_equal(now[COLUMN], before[COLUMN])


@pytest.mark.parametrize("mark", ['SHARP', 'CREASE'])
@pytest.mark.parametrize("rule", ['AUTOMATIC', 'MARKED'])
def test_marked_edges_stay(mark: str, rule: str) -> None:
    ob = marked_panel(mark)
    ob.reflection_lines.creases = rule
    before = scenes.positions(ob)
    assert scenes.smooth() == {'FINISHED'}
    assert not has_moved(ob, before)
    assert "14 edges are marked as creases" in ob.reflection_lines.report.kept


@pytest.mark.parametrize(("rule", "mark"), [('NONE', 'SHARP'), ('AUTOMATIC', 'SEAM'), ('MARKED', 'SEAM')])
def test_marks_that_are_not_asked_for_and_seams_hold_nothing(rule: str, mark: str) -> None:
    ob = marked_panel(mark)
    ob.reflection_lines.creases = rule
    before = scenes.positions(ob)
    assert scenes.smooth() == {'FINISHED'}
    assert has_moved(ob, before)


def test_another_rule_builds_another_optimizer() -> None:
    """A cached optimizer of other creases would hold what is no longer marked."""
    ob = marked_panel('SHARP')
    assert scenes.smooth() == {'FINISHED'}
    ob.reflection_lines.creases = 'NONE'
    before = scenes.positions(ob)
    assert scenes.smooth() == {'FINISHED'}
    assert has_moved(ob, before)
