"""The sentences for the native module's notes: one for each kind, without the library's own words."""
import re
from pathlib import Path
from types import SimpleNamespace

import pytest

from reflection_lines.model.border import NAMES
from reflection_lines.solver.native_notes import SENTENCES, word_note

HEADER = Path(__file__).resolve().parents[2] / "native/src/base/note.cpp"


def note(kind: str, count: int = 0, before: float = 0.0, after: float = 0.0) -> SimpleNamespace:
    return SimpleNamespace(kind=kind, count=count, before=before, after=after)


@pytest.mark.skipif(not HEADER.exists(), reason="the library's source is not beside the installed package")
def test_every_kind_has_a_sentence() -> None:
    names = re.search(r"kNames = \{(.*?)\};", HEADER.read_text(), re.DOTALL).group(1)
    assert set(re.findall(r'"(\w+)"', names)) == set(SENTENCES)


@pytest.mark.parametrize("kind", SENTENCES)
def test_a_sentence_is_whole_for_one_and_for_many(kind: str) -> None:
    for count in (1, 3):
        said = word_note(note(kind, count, 1.0, 2.0))
        assert said[0].isupper() or said[0] == str(count)
        assert said.endswith(".") and not set("{}[]|") & set(said)
        assert not re.search("clamp|Fixed", said)


def test_counts_numbers_and_borders_are_as_the_sidebar_has_them() -> None:
    assert word_note(note("held_faces", 1)).startswith("1 face was left alone")
    assert word_note(note("held_faces", 2)).startswith("2 faces were left alone")
    assert "(1.234 to 1.235 degrees)" in word_note(note("light_would_worsen", 0, 1.2341, 1.2349))
    assert NAMES["clamped"] in word_note(note("following_worsens"))
