"""The gain of a solve, in an artist's words."""
from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees

SEEN = 0.005  # fraction of a panel below which nothing is said of its area


def format_change(before: float, after: float) -> str:
    """Formats degrees before and after a solve, with two digits each: short enough for the header of a drag."""
    return f"{before:.2g}\u00b0 \u2192 {after:.2g}\u00b0"


def describe_stroke(before: float, after: float) -> str:
    """Says how far lines were and are off their course, degrees, where a stroke of the brush moved most; 0 before where
    that is not known.
    """
    return f"Brushed, lines there off by {format_change(before, after)}" if before else "Brushed"


@dataclass(frozen=True)
class Worse:
    """The place where a solve made lines worse by most, in one light from one view, in world space."""
    light: str           # its name, as in "worse in ..."
    line: tuple[float, float, float]   # direction of its lines
    place: tuple[float, float, float]
    size: float          # of the flaws that were looked for
    before: float        # degrees that lines are off their course there
    after: float
    eye: tuple[float, float, float] | None = None  # direction to the viewer; None: along the view camera

    def describe(self) -> str:
        """Says how much worse lines became, and in which light."""
        return f"one place worse in {self.light}: {format_change(self.before, self.after)}"


@dataclass(frozen=True)
class Healed:
    """The account of what an automatic press of Smooth healed: native.HealedFlaws."""
    area: float          # fraction of the region, 0 to 1
    worst_before: float  # degrees that lines are off their course at the worst place
    worst_after: float

    def describe(self) -> str:
        """Says where flaws went, and how far the worst lines were and are off their course."""
        where = f"Flaws healed on {self.area:.0%} of the panel" if self.area >= SEEN else "Lines evened out a little"
        return f"{where}: worst {format_change(self.worst_before, self.worst_after)}"

    def describe_shortly(self, **_: bool) -> str:
        """Says the latter alone, for the header of a drag."""
        return f"Lines off by {format_change(self.worst_before, self.worst_after)} at worst"


def join_healed(every: Sequence[Healed], areas: Sequence[float]) -> Healed:
    """Joins the accounts of panels with these areas as if they were one: the healed fraction and the worst place.
    """
    healed = sum(each.area * area for each, area in zip(every, areas, strict=True))
    return Healed(healed / max(sum(areas), 1e-300), max(each.worst_before for each in every),
                  max(each.worst_after for each in every))


@dataclass(frozen=True)
class Gain:
    """The measures of a solve, before and after. Scores are degrees, residuals radians / length; the length is that at
    which the scores were measured.
    """
    score_before: float
    score_after: float
    residual_before: float
    residual_after: float
    length: float

    def describe(self, *, smoothed: bool) -> str:
        """Says how far lines that were smoothed are off their course; of other tools, how far they are off the wanted
        ones within one length, in the same degrees.
        """
        if smoothed:
            return f"Lines off by {format_change(self.score_before, self.score_after)}"
        off = (degrees(residual * self.length) for residual in (self.residual_before, self.residual_after))
        return f"Off the wanted lines by {format_change(*off)}"

    describe_shortly = describe
