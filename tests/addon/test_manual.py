"""The manual says what the operators are: F1 opens the section of each, and its tables have their settings."""
import math
import webbrowser
from collections.abc import Callable, Iterator
from html.parser import HTMLParser
from urllib.parse import unquote, urlsplit

import bpy
import pytest

import installation

PAGE = installation.FOLDER / "manual" / "index.html"
SHARED = ("region", "falloff")  # sections with settings that several tools have
UNLIMITED = 1e30                # what Blender has for a number without a limit is larger
NOT_IN_TABLES = {"frozen_eye", "color", "gap_color", "name"}  # of the stripes: hidden, or told of below the table


class Manual(HTMLParser):
    """The sections of the page, and for each the rows of its tables of settings: name, default, range."""

    def __init__(self) -> None:
        super().__init__()
        self.sections: set[str] = set()
        self.rows: dict[str, set[tuple[str, ...]]] = {}
        self.section, self.row, self.in_settings = "", [], False

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        given = dict(attributes)
        if "id" in given:
            self.section = given["id"]
            self.sections.add(self.section)
        if tag == "table":
            self.in_settings = given.get("class") == "settings"
        elif tag == "tr":
            self.row = []
        elif tag == "td":
            self.row.append("")

    def handle_endtag(self, tag: str) -> None:
        if tag == "tr" and self.in_settings and self.row:
            self.rows.setdefault(self.section, set()).add(tuple(" ".join(cell.split()) for cell in self.row[:3]))

    def handle_data(self, data: str) -> None:
        if self.row:
            self.row[-1] += data


@pytest.fixture
def manual() -> Manual:
    read = Manual()
    read.feed(PAGE.read_text())
    return read


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Addresses that Blender hands to the browser."""
    found: list[str] = []
    monkeypatch.setattr(webbrowser, "open", lambda url, *_, **__: found.append(url) or True)
    return found


def operators() -> list[str]:
    return sorted(dir(bpy.ops.reflines))


@pytest.mark.parametrize("name", operators())
def test_f1_over_an_operator_opens_its_section(name: str, manual: Manual, opened: list[str]) -> None:
    bpy.ops.wm.doc_view_manual(doc_id=f"reflines.{name}")
    address = urlsplit(opened[0])
    assert address.scheme == "file" and PAGE.samefile(unquote(address.path))
    assert address.fragment == f"reflines.{name}" and address.fragment in manual.sections


@pytest.mark.parametrize(("setting", "section"), [
    ("REFLINES_OT_smooth.strength", "reflines.smooth"), ("ReflinesScene.length", "reflines.smooth"),
    ("ReflinesScene.camera", "view-and-light"), ("ReflinesScene.border", "region"),
    ("ReflinesDirection.angle", "reflines.direction"), ("ReflinesDirection.radius", "falloff"),
    ("ReflinesWarp.lattice", "reflines.warp"), ("ReflinesStripes.count", "stripes"),
    ("VIEW3D_MT_reflines", "tools")])
def test_f1_over_a_setting_opens_the_section_that_describes_it(setting: str, section: str, manual: Manual,
                                                              opened: list[str]) -> None:
    bpy.ops.wm.doc_view_manual(doc_id=setting)
    assert urlsplit(opened[0]).fragment == section and section in manual.sections


def test_blenders_own_manual_still_opens(opened: list[str]) -> None:
    bpy.ops.wm.doc_view_manual(doc_id="mesh.subdivide")
    assert "docs.blender.org" in opened[0]


def number(about: bpy.types.Property) -> Callable[[float], str]:
    """How the manual writes a value of the setting."""
    factor, unit = {'ROTATION': (180.0 / math.pi, "\u00b0")}.get(about.unit, (1.0, ""))
    unit = " %" if about.subtype == 'PERCENTAGE' else unit
    return lambda value: f"{value * factor:.3f}".rstrip("0").rstrip(".") + unit


def row_of_number(about: bpy.types.Property) -> tuple[str, str, str]:
    write = number(about)
    values = about.default_array if about.is_array else [about.default]
    low, high = about.hard_min, about.hard_max
    limits = (f"{write(low).split(' ')[0]} to {write(high)}" if high < UNLIMITED else
              "any" if low < -UNLIMITED else f"{write(low)} or more")
    return about.name, ", ".join(map(write, values)), limits


def row(about: bpy.types.Property) -> tuple[str, str, str]:
    """What the first three cells of the setting's row have to say."""
    if about.type == 'ENUM':
        return about.name, about.enum_items[about.default].name, ", ".join(item.name for item in about.enum_items)
    if about.type == 'BOOLEAN':
        return about.name, "on" if about.default else "off", "on, off"
    return (about.name, about.default or "empty", "a name") if about.type == 'STRING' else row_of_number(about)


def settings(about: bpy.types.Struct) -> Iterator[bpy.types.Property]:
    """Those that the artist can see and that are plain values; a file is chosen in Blender's own browser."""
    for each in about.properties:
        plain = not each.is_hidden and each.type not in {'POINTER', 'COLLECTION'}
        if plain and each.identifier not in {"rna_type", "filepath"}:
            yield each


@pytest.mark.parametrize("name", operators())
def test_the_tables_have_every_setting_of_an_operator(name: str, manual: Manual) -> None:
    told = set().union(*(manual.rows.get(section, set()) for section in (f"reflines.{name}", *SHARED)))
    about = getattr(bpy.ops.reflines, name).get_rna_type()
    missing = {row(each) for each in settings(about)} - told
    assert not missing, f"section reflines.{name} of the manual lacks {missing}; it has {told}"


@pytest.mark.parametrize("name", operators())
def test_the_tables_have_no_setting_that_is_not_there(name: str, manual: Manual) -> None:
    about = getattr(bpy.ops.reflines, name).get_rna_type()
    gone = manual.rows.get(f"reflines.{name}", set()) - {row(each) for each in settings(about)}
    assert not gone, f"section reflines.{name} of the manual tells of {gone}"


def test_the_table_has_every_setting_of_the_stripes(manual: Manual) -> None:
    about = bpy.context.scene.reflection_lines.stripes.bl_rna
    wanted = {row(each) for each in settings(about) if each.identifier not in NOT_IN_TABLES}
    assert manual.rows["stripes"] == wanted
