"""One word, one meaning: the developers' table of terms, and the words that code, comments and manual use instead.

What the native module names is free where the add-on reads it: its attributes and arguments.
"""
import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from test_comments import CPP_FOLDERS, PYTHON_FOLDERS, files_below, remarks
from tree import ROOT

PAGE = Path("tests/README.md")
MANUAL = Path("addon/manual/index.html")
FILES = [file for file in files_below(PYTHON_FOLDERS, ".py") if file.parts[0] == "addon"]
STUB = Path("native/python/reflines.pyi")
CPP_FILES = files_below(CPP_FOLDERS, ".h", ".cpp")
WORDS = re.compile(r"[a-z]+")
NO_NAME = re.compile(r'"(?:[^"\\]|\\.)*"|^\s*#include.*')
CAMEL_CASE = re.compile(r"(?<=[a-z])(?=[A-Z])")


def rows() -> list[tuple[str, list[str]]]:
    """The terms, and the words that each is used instead of."""
    text = (ROOT / PAGE).read_text()
    table = re.findall(r"^\| `([^`]+)` \|[^|]+\|([^|]*)\|", text[text.index("## Terms"):], re.MULTILINE)
    return [(term, re.findall(r"`([^`]+)`", replaced)) for term, replaced in table]


def replaced_words() -> set[str]:
    return {word.removesuffix("s") for _, replaced in rows() for word in replaced}


def split(text: str) -> set[str]:
    """The words of a text or a name in lower case, each in the singular."""
    return {word.removesuffix("s") for word in WORDS.findall(text.lower())}


def own_names(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Yields the names that a module gives, by their lines: of variables, arguments, functions and classes."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.lineno, node.id
        elif isinstance(node, ast.arg):
            yield node.lineno, node.arg
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            yield node.lineno, node.name


def test_every_word_stands_in_the_table_once() -> None:
    words = [word for term, replaced in rows() for word in (term, *replaced)]
    assert len(rows()) > 20 and not {word for word in words if words.count(word) > 1}


def test_every_term_is_used() -> None:
    text = " ".join((ROOT / file).read_text() for file in [*FILES, MANUAL]).replace("_", " ")
    assert not [term for term, _ in rows() if term not in text]


@pytest.mark.parametrize("file", CPP_FILES, ids=str)
def test_no_other_word_is_used_in_native_code(file: Path) -> None:
    lines = [NO_NAME.sub("", line) for line in (ROOT / file).read_text().splitlines()]
    wrong = [f"{file}:{number} {word}" for number, line in enumerate(lines, 1)
             for word in sorted(split(CAMEL_CASE.sub(" ", line)) & replaced_words())]
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize("file", FILES, ids=str)
def test_no_other_word_is_used_in_code(file: Path) -> None:
    found = [*remarks(file), *own_names(ast.parse((ROOT / file).read_text()))]
    wrong = [f"{file}:{line} {word}" for line, text in found for word in sorted(split(text) & replaced_words())]
    assert not wrong, "\n".join(wrong)


def test_no_other_word_is_used_in_what_the_module_says_of_itself() -> None:
    wrong = [f"{STUB}:{line} {word}" for line, text in remarks(STUB)
             for word in sorted(split(text) & replaced_words())]
    assert not wrong, "\n".join(wrong)


def test_no_other_word_is_used_in_the_manual() -> None:
    text = re.sub(r"<[^>]*>", " ", (ROOT / MANUAL).read_text())
    assert not split(text) & replaced_words()
