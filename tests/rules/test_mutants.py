"""The faults of the mutation suite can be put in, and name a test; the suite itself takes long and runs by hand."""
import tomllib

import pytest

from tree import ROOT

MUTANTS = tomllib.loads((ROOT / "tests/mutation/mutants.toml").read_text())["mutant"]


def test_there_are_enough_and_none_twice() -> None:
    assert len(MUTANTS) >= 30
    assert len({mutant["what"] for mutant in MUTANTS}) == len(MUTANTS)


@pytest.mark.parametrize("mutant", MUTANTS, ids=lambda mutant: mutant["what"])
def test_a_fault_can_be_put_in_and_names_its_test(mutant: dict[str, str]) -> None:
    assert (ROOT / mutant["file"]).read_text().count(mutant["old"]) == 1
    assert mutant["old"] != mutant["new"]
    assert (ROOT / mutant["test"]).exists()
