"""The documents tell the truth: links lead somewhere, every operator has its section, numbers are the last report's."""
import json
import re
from functools import cache
from html.parser import HTMLParser
from pathlib import Path

import pytest
from bench.report import KEPT, REACH
from figures import tool_table
from tree import ROOT, python_files

README = Path("README.md")
BENCHMARKS = Path("tests/bench/README.md")
MANUAL = Path("addon/manual/index.html")
DOCUMENTS = (README, BENCHMARKS, MANUAL, *map(Path, ("blend_samples/README.md", "CHANGELOG.md", "tests/README.md",
                                                     "tests/bench/trials.md")))
LONGEST_README = 950   # words; the models of this project have 40 to 1,000
LARGEST_PICTURES = 1.1e6  # bytes of all pictures that the package carries for the manual

MARKDOWN_LINK = re.compile(r"\]\(([^)\s]+)\)")
IDNAME = re.compile(r'bl_idname = "(reflines\.\w+)"')
ROW = re.compile(r"^\| `(\w+)` \|([^|\n]*)\|([^|\n]*)\|([^|\n]*)\|", re.MULTILINE)  # name, meaning, aim, measured
TOOLS = re.compile(r'<section id="blender-tools">(.*)<table class="measured">\n<tr>.*?</tr>\n(.*?)\n</table>',
                   re.DOTALL)  # the text above the table, its rows
NUMBER = re.compile(r"\d[\d,]*(?:\.\d+)?(?:e-?\d+)?")


class Page(HTMLParser):
    """Identifiers of sections, and the targets of links and pictures, of a page of HTML."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.sections: list[str] = []
        self.targets: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        given = dict(attributes)
        self.sections += [given["id"]] if "id" in given else []
        self.targets += [given[name] for name in ("href", "src") if name in given]


def text_of(document: Path) -> str:
    return (ROOT / document).read_text()


def targets(document: Path) -> list[str]:
    text = text_of(document)
    return Page(text).targets if document.suffix == ".html" else MARKDOWN_LINK.findall(text)


def leads_somewhere(document: Path, target: str) -> bool:
    """Of a link within the project: the file is there, and its section where the link names one."""
    path, _, section = target.partition("#")
    file = ROOT / document.parent / path if path else ROOT / document
    if not file.exists() or not section:
        return file.exists()
    return file.suffix == ".html" and section in Page(file.read_text()).sections


@pytest.mark.parametrize("document", DOCUMENTS, ids=str)
def test_links_and_pictures_are_there(document: Path) -> None:
    wrong = [target for target in targets(document) if "://" not in target and not leads_somewhere(document, target)]
    assert not wrong, f"{document} links to what is not there: {wrong}"


def operators() -> set[str]:
    return {name for file in python_files("addon/") for name in IDNAME.findall((ROOT / file).read_text())}


def test_every_operator_has_its_section_in_the_manual() -> None:
    sections = Page(text_of(MANUAL)).sections
    assert len(sections) == len(set(sections)), "a section's identifier is there twice"
    told = {name for name in sections if name.startswith("reflines.")}
    assert operators() == told, f"without a section: {operators() - told}; without an operator: {told - operators()}"


def test_every_operator_is_in_a_menu() -> None:
    """Blender's search finds no others."""
    menus = "".join((ROOT / f"addon/ui/{name}.py").read_text() for name in ("menus", "rows", "stripe_presets"))
    assert not {name for name in operators() if f'"{name}"' not in menus}


def test_the_manual_shows_all_pictures_that_the_package_carries() -> None:
    folder = ROOT / MANUAL.parent
    shown = {folder / target for target in targets(MANUAL)}
    pictures = [file for file in folder.rglob("*") if file.is_file() and file != ROOT / MANUAL]
    assert not [file for file in pictures if file not in shown]
    assert sum(file.stat().st_size for file in pictures) < LARGEST_PICTURES


def test_the_readme_is_for_the_first_ten_minutes() -> None:
    words = len(text_of(README).split())
    assert words < LONGEST_README, f"README.md has {words} words: move some to the manual or the benchmark report"


def test_the_manual_compares_tools_by_the_numbers_that_are_kept() -> None:
    """Its table is the kept file's, and the text above it quotes no decimal that the table lacks."""
    text, table = TOOLS.search(text_of(MANUAL)).groups()
    assert table == tool_table.write_html()
    quoted = set(re.findall(r"\d+\.\d+", text))
    assert len(quoted) > 5 and not quoted - set(re.findall(r"\d+\.\d+", table))


@cache
def report() -> dict[str, dict]:
    return {row["name"]: row for row in json.loads(KEPT.read_text())["rows"]}


def same(shown: str, value: float) -> bool:
    """Whether the number as written is the value rounded to as many digits."""
    plain = shown.replace(",", "")
    if "e" in plain:
        digits = len(plain.split("e")[0].partition(".")[2])
        return float(f"{value:.{digits}e}") == float(plain)
    return float(f"{value:.{len(plain.partition('.')[2])}f}") == float(plain)


def faults(name: str, aim: str, measured: str) -> list[str]:
    """What a row of a document says otherwise than the report."""
    if name not in report():
        return [f"{name}: not in the report"]
    row, (first, *others) = report()[name], NUMBER.findall(measured)
    found = [] if same(first, row["value"]) else [f"{name}: {first} instead of {row['value']:g}"]
    in_note = NUMBER.findall(row["note"])
    found += [f"{name}: {other} is not in the report's note" for other in others if other not in in_note]
    bound, below = REACH.get(name, (None, True))
    wanted = "" if bound is None else f"{'<=' if below else '>='} {bound:g}"
    return found + ([f"{name}: the aim is {wanted}"] if aim.replace("1e-6", "1e-06") != wanted else [])


@pytest.mark.parametrize(("document", "least"), [(README, 6), (BENCHMARKS, 30)], ids=str)
def test_numbers_are_those_of_the_last_report(document: Path, least: int) -> None:
    rows = [[cell.strip() for cell in row] for row in ROW.findall(text_of(document))]
    wrong = [fault for name, _, aim, measured in rows for fault in faults(name, aim, measured)]
    assert len(rows) >= least and not wrong, "\n".join(wrong)


@pytest.mark.parametrize("document", [README, BENCHMARKS], ids=str)
def test_a_missed_aim_is_called_missed(document: Path) -> None:
    for line in filter(ROW.match, text_of(document).splitlines()):
        name = ROW.match(line)[1]
        bound, below = REACH.get(name, (None, True))
        value = report()[name]["value"]
        missed = bound is not None and (value > bound if below else value < bound)
        assert ("missed" in line) == missed, f"{document}, {name}: {value:g} against {bound}"
