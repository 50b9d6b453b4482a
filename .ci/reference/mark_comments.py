"""Doxygen's input filter: prints a C++ header or a Python stub with its plain comments marked as documentation.

A comment line documents what follows it, one behind a declaration documents that, and so do the lines that go on below
it in the same column. The first comment of a header describes the file.
"""
import re
import sys
from collections.abc import Iterator

CPP_LINE = re.compile(r"^(?P<code>\s*)//+ ?(?P<text>.*)$")
CPP_TRAILING = re.compile(r"^(?P<code>\s*[^\s/#}].*?\s)//+ (?P<text>.*)$")
STUB_TRAILING = re.compile(r"^(?P<code>(?P<indent>\s*)(?:def .*\.\.\.|\w+: [^#]*?))\s+# (?P<text>.*)$")
SPECIAL = re.compile(r"([#<@\\])")  # what Doxygen reads as a command, a link or a tag


def escaped(text: str) -> str:
    """Code in backticks is taken as it is."""
    parts = text.split("`")
    return "`".join(part if number % 2 else SPECIAL.sub(r"\\\1", part) for number, part in enumerate(parts))


def marked_header(lines: list[str]) -> Iterator[str]:
    column, at_start = None, True  # column: of a comment behind code that the next line may go on
    for number, line in enumerate(lines):
        alone = CPP_LINE.match(line)
        behind = None if alone else CPP_TRAILING.match(line)
        if alone:
            if number == 0:
                yield r"/// \file"
            goes_on = column is not None and len(alone["code"]) == column
            yield f"{alone['code']}///{'<' if goes_on else ''} {escaped(alone['text'])}"
            continue
        if at_start:
            yield ""
        at_start = False
        column = len(behind["code"]) if behind else None
        yield f"{behind['code']}///< {escaped(behind['text'])}" if behind else line


def marked_stub(lines: list[str]) -> Iterator[str]:
    inside = False  # a docstring
    for line in lines:
        quotes = line.count('"""')
        behind = None if inside or quotes else STUB_TRAILING.match(line)
        if behind:
            yield f"{behind['indent']}## {escaped(behind['text'])}"
        yield behind["code"] if behind else escaped(line) if inside or quotes else line
        inside ^= quotes == 1


def main() -> None:
    with open(sys.argv[1]) as file:
        lines = file.read().splitlines()
    print("\n".join(marked_stub(lines) if sys.argv[1].endswith(".pyi") else marked_header(lines)))


if __name__ == "__main__":
    main()
