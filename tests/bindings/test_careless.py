"""What a careless hand selects on real bodies is not harmed by a press of Smooth, or is refused in a sentence."""
import pytest
from careless import SELECTIONS, Selection, press


@pytest.mark.parametrize("selection", SELECTIONS, ids=lambda each: each.name)
def test_nothing_is_harmed_or_it_is_refused(selection: Selection) -> None:
    """Nothing moves beyond the limit, no triangle turns by more than 45 degrees, no light becomes visibly worse."""
    outcome = press(selection)
    assert outcome.is_harmless, outcome
    assert "\n" not in outcome.refusal
    assert outcome.triangles > 100
