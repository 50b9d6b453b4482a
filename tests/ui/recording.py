"""A layout of Blender that draws, and notes what was drawn where: to count controls, and to find texts that are cut."""
from collections.abc import Callable
from types import FunctionType

import blf
import bpy

LABEL_SHARE = 0.4     # of a row that Blender gives to the label
ICON, MARGIN = 20, 6  # pixels
DIAL = 45             # pixels of the ball that turns the light
SILENT = {"separator"}  # draws nothing to read or to press


class Recorder:
    """A layout that draws, and notes what was drawn where, to compare texts with the room that they have."""

    def __init__(self, layout: bpy.types.UILayout, kind: str, columns: int = 1) -> None:
        vars(self).update(layout=layout, kind=kind, columns=columns, items=[])

    def __getattr__(self, name: str) -> object:
        made = getattr(self.layout, name)
        if name in {"row", "column", "box", "grid_flow"}:
            return lambda **options: self.nest(made(**options), name, options.get("columns", 1))
        return self.noting(name, made) if callable(made) and name not in SILENT else made

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

    def list_controls(self) -> list[str]:
        """Returns the names of buttons and values, in their order; texts are none."""
        found = []
        for item in self.items:
            if isinstance(item, Recorder):
                found += item.list_controls()
            elif item[0] != "label":
                found.append(item[1][0] if item[0] == "operator" else item[1][1] if item[0] == "prop" else item[0])
        return found

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
    if name not in {"prop", "prop_search"}:
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
