"""Follow Edge in a real window: the line under the mouse runs parallel to the selected edge loop."""
import bmesh
import bpy
import numpy as np

import window
from dragging import applied, is_running, panel, shown, struck, taken_back, undone_and_redone
from pulling import Steps, begin, missed, move, picture, session

CELLS, MARGIN, ROW = 48, 6, 45  # of the panel; rings of faces around its region; the loop, beyond the region
SLOPE = 0.12  # of the loop against the border
MOUSE = (330, 270)


def slanted_panel(driver: window.Window) -> Steps:
    """A panel with its inner faces selected, and beyond them an edge loop that runs aslant. A session that a failed
    test left is ended."""
    if is_running():
        yield from taken_back(driver)
    ob = panel(driver, cells=CELLS)
    with driver.override():
        bpy.context.tool_settings.mesh_select_mode = (False, True, True)
    mesh = bmesh.from_edit_mesh(ob.data)
    mesh.verts.ensure_lookup_table()
    row = mesh.verts[ROW * (CELLS + 1):(ROW + 1) * (CELLS + 1)]
    for face in mesh.faces:
        face.select_set(all(MARGIN <= k < CELLS - MARGIN for k in divmod(face.index, CELLS)))
    for vertex in row:
        vertex.co.y += SLOPE * vertex.co.x
    for edge in mesh.edges:
        if all(vertex in row for vertex in edge.verts):
            edge.select_set(True)
    bmesh.update_edit_mesh(ob.data)
    with driver.override():
        bpy.ops.ed.undo_push(message="Edges")
    assert ob.data.total_face_sel == (CELLS - 2 * MARGIN)**2 and ob.data.total_edge_sel > CELLS


def find_dots() -> np.ndarray:
    """The dots of the only handle, in pixels."""
    own, = session().handles
    return session().screen.find_pixels(np.array([session().find_dot(dot) for dot in own.dots]))


def measure_slope(points: np.ndarray) -> float:
    return float(np.polyfit(*points.T, 1)[0])


def test_the_line_runs_parallel_to_the_selected_loop_and_keeps_its_place_under_the_mouse(
        driver: window.Window) -> Steps:
    yield from slanted_panel(driver)
    before = shown(driver)
    yield from begin(driver)
    yield from move(driver, *MOUSE)
    yield 0.2
    mouse = np.array([driver.x, driver.y])
    old = session().screen.find_pixels(session().marks.curves[0].points)
    yield from struck(driver, 'E')
    dots = find_dots()
    inner = dots[3:-3]  # before these the line leaves its ends, which the border holds
    assert len(dots) == 9 and abs(measure_slope(inner) - SLOPE) < 0.01, (measure_slope(inner), dots)
    assert abs(measure_slope(old) - SLOPE) > 0.05  # it ran otherwise
    assert np.abs(inner[:, 1] - mouse[1] - SLOPE * (inner[:, 0] - mouse[0])).max() < 3.0, (dots, mouse)
    line = session().screen.find_pixels(session().tracing.trace_handle(0)[-1].points)
    assert max(np.linalg.norm(line - dot, axis=1).min() for dot in dots) < 3.0, session().texts
    assert missed() < 0.02, session().texts
    yield from picture("follow_selected_edges")
    yield from applied(driver)
    after = shown(driver)
    outside = np.abs(before[:, :2]).max(axis=1) > 1.0 - 2.0 * (MARGIN - 0.5) / CELLS
    assert np.abs(after - before).max() > 1e-4 and np.array_equal(after[outside], before[outside])
    yield from undone_and_redone(driver, before, after)


def test_without_selected_edges_it_follows_the_border(driver: window.Window) -> Steps:
    yield from slanted_panel(driver)
    mesh = bmesh.from_edit_mesh(bpy.data.objects["Panel"].data)
    for edge in mesh.edges:
        edge.select_set(False)
    for face in mesh.faces:
        face.select_set(all(MARGIN <= k < CELLS - MARGIN for k in divmod(face.index, CELLS)))
    bmesh.update_edit_mesh(bpy.data.objects["Panel"].data)
    yield from begin(driver)
    yield from move(driver, *MOUSE)
    yield from struck(driver, 'E')
    assert abs(measure_slope(find_dots()[3:-3])) < 0.01, find_dots()
    yield from taken_back(driver)
