"""What a careless hand selects on real bodies is not harmed by a press of Smooth, or is refused in a sentence."""
import pytest
from careless import SELECTIONS, Selection, press, press_by_default, read_around


@pytest.mark.parametrize("selection", SELECTIONS, ids=lambda each: each.name)
def test_nothing_is_harmed_or_it_is_refused(selection: Selection) -> None:
    """Nothing moves beyond the limit, no triangle turns by more than 45 degrees, no light becomes visibly worse."""
    outcome = press_by_default(selection)
    assert outcome.is_harmless, outcome
    assert "\n" not in outcome.refusal
    assert outcome.triangles > 100


def test_most_become_visibly_better() -> None:
    """Flaws on at least 3 % of the area are healed in 19 of the 25, and nowhere is the worst place worse."""
    outcomes = [press_by_default(selection) for selection in SELECTIONS]
    assert sum(outcome.healed > 0.03 for outcome in outcomes) >= 16
    assert all(outcome.worst[1] <= outcome.worst[0] for outcome in outcomes)


@pytest.mark.parametrize(("name", "border"), [
    ("door and sill", "flow"), ("mirror and door glass", "curvature"), ("windscreen and bonnet", "flow"),
    ("boot", "curvature")])
def test_a_border_that_continues_the_curvature_harms_no_more_than_a_clamped_one(name: str, border: str) -> None:
    """Hems and gaps lie across and beside these borders: no light ends less even by a hundredth, and none moves far.
    Without creases and strong bends as ends of the pull, all four moved to the limit, in 6 to 30 s."""
    selection = next(each for each in SELECTIONS if each.name == name)
    clamped, outcome = press_by_default(selection), press(selection, border=border, around=read_around(selection))
    assert not outcome.refusal and outcome.turned == 0
    assert outcome.move < 0.5 * outcome.limit
    for late, early in zip((*outcome.shift, *outcome.after), (*clamped.shift, *clamped.after), strict=True):
        assert late <= max(1.01 * early, early + 0.05)
