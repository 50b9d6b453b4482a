"""The sidebar's tab: the order of its panels, what a result moves, and that no name is cut at the default width."""
import json
import sys
from collections.abc import Generator

import blf
import bpy

import scenes
import sidebar
import window
from dragging import ended, panel
from recording import Stand
from window import Steps


ORDER = ("smooth", "result", "stripes", "setup", "region", "pull", "brush", "design")
FOLDED = ("design", "smooth_settings", "stripes", "setup", "region", "direction", "warp", "pattern", "look",
          "numbers")
PREFIX = "VIEW3D_PT_reflines_"
BESIDE_CONTENT = 57  # pixels of the sidebar's width that tabs, scroll bar and margins take in Blender 3.4
POINTS = 11          # of Blender's widget font


class SidebarContext:
    """Blender's context, with the sidebar in the place of the popover, for panels that wrap sentences to its width."""

    def __init__(self, context: bpy.types.Context, region: bpy.types.Region) -> None:
        self.context, self.region = context, region

    def __getattr__(self, name: str) -> object:
        return getattr(self.context, name)


def panels() -> dict[str, type]:
    return {name.removeprefix(PREFIX): getattr(bpy.types, name) for name in dir(bpy.types)
            if name.startswith("VIEW3D_PT_reflines") and not name.endswith("presets")}


def record_panels(driver: window.Window, drawn: dict[str, list[str]]) -> Generator[float, None, set[str]]:
    """Draws every panel into a popover, whose rows are those of the sidebar, and notes the cut texts of each. Returns
    the texts of buttons, or their commands where they are named by these."""
    titles: set[str] = set()
    width = driver.region('UI').width - BESIDE_CONTENT

    def draw(popover: bpy.types.UIPopover, context: bpy.types.Context) -> None:
        for name, kind in panels().items():
            stand = Stand(kind, popover.layout.column())
            kind.draw(stand, SidebarContext(context, driver.region('UI')))
            drawn[name] = stand.layout.find_cut(width)
            titles.update(stand.layout.find_titles())

    with driver.override():
        bpy.context.window_manager.popover(draw)
    yield 0.5
    driver.key('ESC')
    yield 0.2
    return titles


def choose_largest(settings: bpy.types.PropertyGroup) -> None:
    """The settings with which the panels show the most."""
    settings.direction.direction, settings.direction.axis = 'ANGLE', 'ALONG'
    settings.direction.centre = 'REGION'


def test_nothing_is_cut_at_the_default_width(driver: window.Window) -> Steps:
    blf.size(0, POINTS)
    panel(driver)
    choose_largest(bpy.context.scene.reflection_lines)
    yield from sidebar.open_tab(driver)
    driver.move(300, 300)
    yield 0.2
    with driver.override():
        scenes.smooth()
        bpy.ops.ed.undo_push(message="Start")
    drawn: dict[str, list[str]] = {}
    yield from record_panels(driver, drawn)
    bpy.context.scene.reflection_lines.stripes.mode = 'DEVIATION'
    yield from record_panels(driver, drawn)
    assert len(drawn) == len(panels())
    assert not any(drawn.values()), {name: cut for name, cut in drawn.items() if cut}
    bpy.context.scene.reflection_lines.stripes.mode = 'REFLECTION'


def pull(driver: window.Window, start: float, end: float, limit: float) -> None:
    """Pulls a line upwards from one place to another."""
    handle = {"start": (0.1, start, 0.0), "end": (0.1, end, 0.0), "radius": 0.5, "pinned": [], "muted": False}
    with driver.override():
        assert bpy.ops.reflines.pull_line('EXEC_DEFAULT', True, handles=json.dumps([handle]),
                                          limit=limit) == {'FINISHED'}


def nothing_is_cut(driver: window.Window, *titles: str) -> Steps:
    """Nothing is cut in the panels as they are now, which have these buttons among others."""
    drawn: dict[str, list[str]] = {}
    found = yield from record_panels(driver, drawn)
    assert all(any(shown.startswith(title) for shown in found) for title in titles), found
    assert not any(drawn.values()), {name: cut for name, cut in drawn.items() if cut}


def test_the_panels_are_in_the_order_of_the_work_and_tools_are_folded(driver: window.Window) -> Steps:
    """Blender looks at a panel's functions when it is registered: headers that note their panels are there then."""
    addon, order = sys.modules["reflection_lines"], []
    base, own = sys.modules["reflection_lines.ui.panels"].ReflinesPanel, bpy.types.VIEW3D_PT_reflines_stripes
    kept = own.draw_header_preset
    addon.unregister()
    base.draw_header_preset = lambda self, _context: order.append(type(self).__name__.removeprefix(PREFIX))
    del own.draw_header_preset
    addon.register()
    yield from sidebar.open_tab(driver)
    driver.redraw()
    yield 0.5
    addon.unregister()
    del base.draw_header_preset
    own.draw_header_preset = kept
    addon.register()
    yield 0.3
    shown = [name for name in dict.fromkeys(order) if name in ORDER]
    assert tuple(shown) == ORDER, shown
    kinds = panels()
    assert all('DEFAULT_CLOSED' in kinds[name].bl_options for name in FOLDED)


def test_a_result_does_not_move_the_button(driver: window.Window) -> Steps:
    panel(driver)
    yield from sidebar.open_tab(driver)
    place = yield from sidebar.find_button(driver, "bpy.ops.reflines.smooth()")
    yield from sidebar.press(driver, *place)
    yield from ended(driver)
    sidebar.point(driver, *place)
    yield 0.2
    assert (yield from sidebar.read_button(driver)) == "bpy.ops.reflines.smooth()"


def test_nothing_is_cut_in_what_tools_leave_behind(driver: window.Window) -> Steps:
    """What is offered after a pull, its handles, a table of a check, a cage, and a panel that follows a lattice."""
    blf.size(0, POINTS)
    ob = panel(driver, cells=32)
    yield from sidebar.open_tab(driver)
    driver.move(300, 300)
    yield 0.2
    pull(driver, 0.6, 0.8, limit=1.0)
    with driver.override():
        bpy.context.scene.reflection_lines.marks.angle = 0.0
        bpy.ops.reflines.check('EXEC_DEFAULT', True)
    ob.reflection_lines.report.merge_distance = 1e-4
    other = bpy.data.objects.new("Other", ob.data)
    yield from nothing_is_cut(driver, "Solve with Border", "reflines.delete_handles", "reflines.bake_handles",
                              "reflines.export_table", "Make Single User", "Merge by Distance")
    bpy.data.objects.remove(other)
    pull(driver, 0.0, 0.1, limit=2e-3)
    ob.modifiers.new("Subdivision", 'SUBSURF').levels = 2
    yield from nothing_is_cut(driver, "Solve with Limit", "reflines.fit", "Curvature (G2)", "Tangent (G1)")
    panel(driver)
    with driver.override():
        bpy.ops.reflines.add_warp_lattice()
        bpy.ops.object.mode_set(mode='OBJECT')
        bpy.ops.reflines.live_warp('EXEC_DEFAULT', True)
    yield from nothing_is_cut(driver, "Apply", "Discard")
    with driver.override():
        bpy.ops.reflines.live_warp('EXEC_DEFAULT', True, action='DISCARD')
