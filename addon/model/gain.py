"""The gain of a solve, in an artist's words."""
from dataclasses import dataclass


@dataclass(frozen=True)
class Gain:
    """The measures of a solve, before and after. Scores are degrees, residuals radians / length."""
    score_before: float
    score_after: float
    residual_before: float
    residual_after: float

    def describe(self, *, smoothed: bool) -> str:
        """Says how much smoother a smoothing made the lines; of other tools, how much of the target was reached."""
        if smoothed and min(self.score_before, self.score_after) > 0.0:
            ratio = self.score_before / self.score_after
            times, word = (ratio, "smoother") if ratio >= 1.0 else (1.0 / ratio, "rougher")
            return f"Lines {times:.{1 if times < 10.0 else 0}f} x {word}"
        share = 1.0 - self.residual_after / self.residual_before if self.residual_before else 1.0
        return f"{max(share, 0.0):.0%} of the target reached"
