"""The sidebar's tab: the order of its panels, what a result moves, and that no name is cut at the default width."""
import json
import sys
from collections.abc import Callable, Generator
from types import FunctionType

import blf
import bpy

import scenes
import sidebar
import window
from dragging import ended, panel

Steps = Generator[float, None, None]

ORDER = ("smooth", "result", "stripes", "setup", "region", "pull", "brush", "design")
FOLDED = ("design", "smooth_settings", "stripes", "setup", "region", "direction", "warp", "pattern", "look",
          "numbers")
PREFIX = "VIEW3D_PT_reflines_"
BESIDE_CONTENT = 57  # pixels of the sidebar's width that tabs, scroll bar and margins take in Blender 3.4
LABEL_SHARE = 0.4    # of a row that Blender gives to the label
ICON, MARGIN = 20, 6  # pixels
DIAL = 45            # pixels of the ball that turns the light
POINTS = 11          # of Blender's widget font


class Recorder:
    """A layout that draws, and notes what was drawn where, to compare texts with the room that they have."""

    def __init__(self, layout: bpy.types.UILayout, kind: str, columns: int = 1) -> None:
        vars(self).update(layout=layout, kind=kind, columns=columns, items=[])

    def __getattr__(self, name: str) -> object:
        made = getattr(self.layout, name)
        if name in {"row", "column", "box", "grid_flow"}:
            return lambda **options: self.nest(made(**options), name, options.get("columns", 1))
        return self.noting(name, made) if name in {"prop", "prop_search", "label", "operator"} else made

    def __setattr__(self, name: str, value: object) -> None:
        setattr(self.layout, name, value)

    def nest(self, layout: bpy.types.UILayout, kind: str, columns: int) -> "Recorder":
        child = Recorder(layout, "row" if kind == "row" else "column", columns)
        self.items.append(child)
        return child

    def noting(self, name: str, made: Callable) -> Callable:
        def draw(*given: object, **options: object) -> object:
            self.items.append((name, given, options, self.layout.use_property_split))
            return made(*given, **options)
        return draw

    def find_cut(self, width: float) -> list[str]:
        """Returns the texts that are wider than their room."""
        icons = [item for item in self.items if self.kind == "row" and is_icon(item)]
        fixed = sum(DIAL if "icon" not in item[2] else ICON for item in icons)
        share = (width - fixed) / max(len(self.items) - len(icons), 1) if self.kind == "row" else width / self.columns
        cut = []
        for item in self.items:
            if isinstance(item, Recorder):
                cut += item.find_cut(share)
            elif item not in icons:
                cut += [f"{text}: {measure(text):.0f} of {room:.0f}" for text, room in list_texts(*item, share)
                        if measure(text) > room]
        return cut


    def find_titles(self) -> set[str]:
        """Returns the given texts of all buttons."""
        nested = [item.find_titles() for item in self.items if isinstance(item, Recorder)]
        return {item[2].get("text", item[1][0]) for item in self.items
                if not isinstance(item, Recorder) and item[0] == "operator"}.union(*nested)


def is_icon(item: object) -> bool:
    if isinstance(item, Recorder):
        return False
    name, given, options, _ = item
    if name == "prop_search":
        return False
    if options.get("text") != "":
        return False
    kept = find_property(*given) if name == "prop" else None
    return "icon" in options if kept is None else kept.type == 'BOOLEAN' or kept.subtype == 'DIRECTION'


def find_property(data: object, name: str) -> bpy.types.Property:
    return data.bl_rna.properties[name]


def measure(text: str) -> float:
    return blf.dimensions(0, text)[0]


def list_texts(name: str, given: tuple, options: dict, split: bool, width: float) -> list[tuple[str, float]]:
    """Returns the texts of one thing drawn, and the room of each in pixels."""
    if name == "operator":
        family, short = given[0].split(".")
        title = options.get("text", getattr(getattr(bpy.ops, family), short).get_rna_type().name)
        return [(title, width - MARGIN - ICON * ("icon" in options))]
    if name == "label":
        return [(options.get("text", ""), width - ICON * ("icon" in options))]
    return list_property_texts(find_property(*given[:2]), options, split, width)


def list_property_texts(about: bpy.types.Property, options: dict, split: bool, width: float) -> list[tuple[str, float]]:
    title = options.get("text", about.name)
    if options.get("expand"):
        return [(item.name, width / len(about.enum_items) - MARGIN) for item in about.enum_items]
    if about.type == 'BOOLEAN':
        return [(title, (1.0 - LABEL_SHARE if split else 1.0) * width - ICON)]
    labelled = split and title
    values = [item.name for item in about.enum_items] if about.type == 'ENUM' else []
    room = ((1.0 - LABEL_SHARE) * width if labelled else width) - ICON
    return [(title, LABEL_SHARE * width if split else width - MARGIN), *((value, room) for value in values)]


class Stand:
    """A panel of a class, drawn into a recorded layout."""

    def __init__(self, kind: type, layout: bpy.types.UILayout) -> None:
        self.kind, self.layout = kind, Recorder(layout, "column")

    def __getattr__(self, name: str) -> object:
        found = getattr(self.kind, name)
        return found.__get__(self) if isinstance(found, FunctionType) else found


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


window.run(test_nothing_is_cut_at_the_default_width, test_the_panels_are_in_the_order_of_the_work_and_tools_are_folded,
           test_a_result_does_not_move_the_button, test_nothing_is_cut_in_what_tools_leave_behind)
