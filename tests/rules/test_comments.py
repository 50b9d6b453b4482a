"""Comments and docstrings are plain technical English: full sentences that name the thing, functions by a verb."""
import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from tree import ROOT, files

# Folders of C++ whose comments are judged; headers and sources.
CPP_FOLDERS = ("native/include/", "native/src/", "native/python/", "native/examples/")
PYTHON_FOLDERS = (*(f"addon/{folder}/" for folder in (
    "animation", "blender", "interactive", "model", "operators", "overlay", "read", "solver", "state", "targets", "ui",
    "view", "write")), "addon/native.py", "addon/background_work.py", "addon/library_copy.py",
                "native/python/reflines.pyi")

# A sentence that begins so has no subject: "Of one worker thread.", "Whether it holds.".
FRAGMENT = re.compile(r"(Of|For|Whether|What|Who|Where|How|Those|That|By|From|Within|At|As|Like|Likewise|Also|So|Not|"
                      r"All|Unlike|Then|Else|The same)\b")
# Words of private idiom -> the word of the field.
IDIOM = {
    r"wish(es)?": "target", r"blamed?": "reject, discard", r"believed?": "trust weight", r"headless": "",
    r"whose turn": "GIL hand-over", r"asks? for": "needs, selects, wants", r"by no bit": "to the last bit",
    r"(?<!last )to the bit": "to the last bit", r"nobody sees": "invisible", r"speaks? for": "stands for, weight",
    r"what is left": "residual, remainder", r"Python's lock": "GIL", r"a hand\b(?!-)": "a drag", r"a stand-in": "model",
}
FUNCTIONS = ast.FunctionDef | ast.AsyncFunctionDef
IDIOMS = re.compile(r"\b(" + "|".join(IDIOM) + r")\b")

COMMENT_LINE = re.compile(r"^\s*//(?: (.*))?$")
TRAILING = re.compile(r"^[^\"]*\S\s+// (.*)$")
FUNCTION = re.compile(r"^\s*(?!class|struct|enum|using|constexpr|inline constexpr|return|if|for|#|\}|\w+_?\()"
                      r"[\w:<>,&*~ ]*?[\w>&*] [&*]?[\w:]+\(")
VERB = re.compile(r"[A-Z][a-z-]*s\b|(Return|Compute|Evaluate|Implement|These)\b")  # the latter for several functions


def blocks(text: str) -> Iterator[tuple[int, str, str]]:
    """Yields the comments on lines of their own: line number, text, and the line of code after them."""
    lines, start = text.splitlines(), None
    for number, line in enumerate(lines):
        if COMMENT_LINE.match(line):
            goes_on = number > 0 and TRAILING.match(lines[number - 1]) and line.startswith(" " * 8)
            start = number if start is None and not goes_on else start
            continue
        if start is not None:
            words = [COMMENT_LINE.match(part)[1] or "\n" for part in lines[start:number]]
            yield start + 1, " ".join(words), line
            start = None


def files_below(prefixes: tuple[str, ...], *suffixes: str) -> list[Path]:
    return [file for file in files() if file.as_posix().startswith(prefixes) and file.suffix in suffixes]


def judge_block(text: str, code: str) -> str:
    """Returns what is wrong with a comment above a line of code; empty where nothing is."""
    if not text.rstrip().endswith((".", ":", ".)", '."', "LENGTH")):
        return "ends without a full stop"
    if FRAGMENT.match(text):
        return "begins with a fragment"
    if FUNCTION.match(code) and not VERB.match(text):
        return "describes a function without a verb in front"
    return ""


@pytest.mark.parametrize("file", files_below(CPP_FOLDERS, ".h", ".cpp"), ids=str)
def test_cpp_comments_are_sentences(file: Path) -> None:
    wrong = [f"{file}:{line} {why}: {text[:80]}" for line, text, code in blocks((ROOT / file).read_text())
             if (why := judge_block(text, code))]
    assert not wrong, "\n".join(wrong)


def docstrings(file: Path) -> Iterator[tuple[int, str, bool]]:
    """Yields line, text, and whether it is that of a function, for each docstring of a Python file; but not those of
    operators, which are tooltips: Blender's own end without a full stop.
    """
    for node in ast.walk(ast.parse((ROOT / file).read_text())):
        if isinstance(node, ast.ClassDef) and "_OT_" in node.name:
            continue
        if isinstance(node, ast.Module | ast.ClassDef | FUNCTIONS) and (text := ast.get_docstring(node)):
            names = [ast.unparse(decorator) for decorator in getattr(node, "decorator_list", [])]
            is_function = isinstance(node, FUNCTIONS) and not any("property" in name for name in names)
            yield node.body[0].lineno, text, is_function


def judge_docstring(text: str, is_function: bool) -> str:
    """Returns what is wrong with a docstring; empty where nothing is."""
    first = re.split(r"(?<=[.:])\s", text.replace("\n", " "))[0]
    if not first.endswith((".", ":")):
        return "has no full stop after its first sentence"
    if FRAGMENT.match(text):
        return "begins with a fragment"
    return "" if not is_function or VERB.match(text) else "describes a function without a verb in front"


@pytest.mark.parametrize("file", files_below(PYTHON_FOLDERS, ".py", ".pyi"), ids=str)
def test_docstrings_are_sentences(file: Path) -> None:
    wrong = [f"{file}:{line} {why}: {text[:80]}" for line, text, is_function in docstrings(file)
             if (why := judge_docstring(text, is_function))]
    assert not wrong, "\n".join(wrong)


def remarks(file: Path) -> Iterator[tuple[int, str]]:
    """Yields comments and docstrings of a file, with their lines."""
    text = (ROOT / file).read_text()
    if file.suffix in (".h", ".cpp"):
        yield from ((line, block) for line, block, _ in blocks(text))
        for number, line in enumerate(text.splitlines(), 1):
            if (found := TRAILING.match(line)) and not COMMENT_LINE.match(line):
                yield number, found[1]
        return
    yield from ((line, docstring) for line, docstring, _ in docstrings(file))
    yield from ((number, line.partition("# ")[2]) for number, line in enumerate(text.splitlines(), 1)
                if re.match(r"^[^\"']*# ", line))


@pytest.mark.parametrize("file", files_below(CPP_FOLDERS, ".h", ".cpp")
                         + files_below(PYTHON_FOLDERS, ".py", ".pyi"), ids=str)
def test_no_private_idiom(file: Path) -> None:
    wrong = [f"{file}:{line} {found[0]!r}: {text[:80]}" for line, text in remarks(file)
             if (found := IDIOMS.search(text))]
    assert not wrong, "\n".join(wrong)
