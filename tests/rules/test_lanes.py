"""The lanes name each failed test, also where tests print their counts themselves."""
import os
import sys
from pathlib import Path

import lanes

JUNIT = """<testsuites><testsuite><testcase classname="a" name="good"/>
<testcase classname="a" name="bad"><failure message="1 is not 2&#10;more"/></testcase>
<testcase classname="a" name="idle"><skipped/></testcase></testsuite></testsuites>"""


def reported(text: str, code: int = 0, mark: str = "") -> lanes.Counts:
    """What is read of a program that prints a text and ends with a code."""
    command = [sys.executable, "-c", f"import sys; print({text!r}); sys.exit({code})"]
    return lanes.run_reporting(command, os.environ, 60, mark)


def test_a_junit_file_names_what_failed(tmp_path: Path, capsys) -> None:
    (tmp_path / "report.xml").write_text(JUNIT)
    assert lanes.junit_counts(tmp_path / "report.xml") == lanes.Counts(1, 1, 1, ("a.bad: 1 is not 2",))
    assert capsys.readouterr().out == "FAILED a.bad: 1 is not 2\n"


def test_printed_failures_are_named_with_the_marks_of_their_lanes() -> None:
    printed = "FAILED first: why\nbeside: FAILED second: why\nnot FAILED here: no\n3 passed, 2 failed, 0 skipped"
    counts = reported(printed, code=1, mark="lane: ")
    assert counts == lanes.Counts(3, 2, 0, ("lane: first: why", "lane: beside: second: why"))


def test_lanes_at_once_are_added_up_with_what_failed_in_each(monkeypatch, capsys) -> None:
    """Each runs in a process of its own, which says at its end what failed in it."""
    printed = ("shown before: FAILED first: why\n1 passed, 1 failed, 0 skipped\n== failed: {}: why\n"
               "3 passed, 1 failed, 0 skipped")
    monkeypatch.setattr(lanes, "run_beside", lambda name: lanes.run_reporting(
        [sys.executable, "-c", f"print({printed.format(name)!r})"], os.environ, 60, f"{name}: ", lanes.FAILED_BEFORE))
    counts = lanes.run_lanes(["native", "bindings"], built=True)
    assert counts == lanes.Counts(6, 2, 0, ("bindings: bindings: why", "native: native: why"))
    assert "native: shown before" in capsys.readouterr().out


def test_a_crash_is_a_failure_with_a_name() -> None:
    for counts in (reported("no counts", code=3), reported("1 passed, 0 failed, 0 skipped", code=3)):
        assert counts.failed == 1 and len(counts.failures) == 1 and "exit code 3" in counts.failures[0]
    assert reported("FAILED first: why", code=3).failures[0] == "first: why"


def test_every_file_of_window_tests_runs_once() -> None:
    files = [path for group in lanes.group_window_tests() for path in group]
    assert sorted(files) == sorted((lanes.ROOT / "tests/ui").glob("test_*.py"))


def test_sums_keep_the_names() -> None:
    total = sum([lanes.Counts(1, 1, 0, ("a",)), lanes.Counts(), lanes.Counts(0, 1, 0, ("b",))], lanes.Counts())
    assert total == lanes.Counts(1, 2, 0, ("a", "b")) and str(total) == "1 passed, 2 failed, 0 skipped"


def test_few_failures_are_tried_again_and_named(capsys) -> None:
    green, red = lanes.Counts(2), lanes.Counts(1, 1, 0, ("a: slow",))
    assert lanes.try_again([green, red], lambda index: lanes.Counts(index + 1)) == [green, green]
    assert "unsteady, green alone: a: slow" in capsys.readouterr().out
    assert lanes.try_again([red, green], lambda index: red) == [red, green]
    many = [red] * (lanes.SECOND_TRIES + 1)
    assert lanes.try_again(many, lambda index: green) == many
