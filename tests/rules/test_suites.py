"""The suites name each failed test, also where tests print their counts themselves."""
import os
import sys
from pathlib import Path

import suites

JUNIT = """<testsuites><testsuite><testcase classname="a" name="good"/>
<testcase classname="a" name="bad"><failure message="1 is not 2&#10;more"/></testcase>
<testcase classname="a" name="idle"><skipped/></testcase></testsuite></testsuites>"""


def reported(text: str, code: int = 0, mark: str = "") -> suites.Counts:
    """What is read of a program that prints a text and ends with a code."""
    command = [sys.executable, "-c", f"import sys; print({text!r}); sys.exit({code})"]
    return suites.run_reporting(command, os.environ, 60, mark)


def test_a_junit_file_names_what_failed(tmp_path: Path, capsys) -> None:
    (tmp_path / "report.xml").write_text(JUNIT)
    assert suites.junit_counts(tmp_path / "report.xml") == suites.Counts(1, 1, 1, ("a.bad: 1 is not 2",))
    assert capsys.readouterr().out == "FAILED a.bad: 1 is not 2\n"


def test_printed_failures_are_named_with_the_marks_of_their_suites() -> None:
    printed = "FAILED first: why\nbeside: FAILED second: why\nnot FAILED here: no\n3 passed, 2 failed, 0 skipped"
    counts = reported(printed, code=1, mark="suite: ")
    assert counts == suites.Counts(3, 2, 0, ("suite: first: why", "suite: beside: second: why"))


def test_lanes_at_once_are_added_up_with_what_failed_in_each(monkeypatch, capsys) -> None:
    """Each runs in a process of its own, which says at its end what failed in it."""
    printed = ("shown before: FAILED first: why\n1 passed, 1 failed, 0 skipped\n== failed: {}: why\n"
               "3 passed, 1 failed, 0 skipped")
    monkeypatch.setattr(suites, "run_beside", lambda name: suites.run_reporting(
        [sys.executable, "-c", f"print({printed.format(name)!r})"], os.environ, 60, f"{name}: ", suites.FAILED_BEFORE))
    counts = suites.run_suites(["native", "bindings"], built=True)
    assert counts == suites.Counts(6, 2, 0, ("bindings: bindings: why", "native: native: why"))
    assert "native: shown before" in capsys.readouterr().out


def test_a_crash_is_a_failure_with_a_name() -> None:
    for counts in (reported("no counts", code=3), reported("1 passed, 0 failed, 0 skipped", code=3)):
        assert counts.failed == 1 and len(counts.failures) == 1 and "exit code 3" in counts.failures[0]
    assert reported("FAILED first: why", code=3).failures[0] == "first: why"


def test_every_file_of_window_tests_runs_once() -> None:
    files = [path for group in suites.group_window_tests() for path in group]
    assert sorted(files) == sorted((suites.ROOT / "tests/ui").glob("test_*.py"))


def test_sums_keep_the_names() -> None:
    total = sum([suites.Counts(1, 1, 0, ("a",)), suites.Counts(), suites.Counts(0, 1, 0, ("b",))], suites.Counts())
    assert total == suites.Counts(1, 2, 0, ("a", "b")) and str(total) == "1 passed, 2 failed, 0 skipped"


def test_few_failures_are_tried_again_and_named(capsys) -> None:
    green, red = suites.Counts(2), suites.Counts(1, 1, 0, ("a: slow",))
    assert suites.try_again([green, red], lambda index: suites.Counts(index + 1)) == [green, green]
    assert "unsteady, green alone: a: slow" in capsys.readouterr().out
    assert suites.try_again([red, green], lambda index: red) == [red, green]
    many = [red] * (suites.SECOND_TRIES + 1)
    assert suites.try_again(many, lambda index: green) == many
