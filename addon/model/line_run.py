"""The settings of a run of Pull Line, as they are stored for Re-solve."""
import json
import math
from dataclasses import dataclass

from .refusal import Refusal

CHOICES = {"border": ("clamped", "automatic", "curvature", "flow", "fixed", "free", "follow"),
           "lights": ("CROSSED", "SINGLE", "SET"), "result": ("MESH", "SHAPE_KEY")}  # the defaults first


@dataclass(frozen=True)
class LineRun:
    """The settings of a solve for handles, by the names of the operator's properties."""
    border: str
    lights: str
    result: str
    limit: float  # world units; 0 is automatic


def decode_line_run(text: str) -> LineRun:
    """Decodes stored settings; refuses what a file may hold of another origin."""
    try:
        stored = json.loads(text)
        chosen = {name: stored.get(name, choices[0]) for name, choices in CHOICES.items()}
        limit = stored.get("limit", 0.0)
        if any(value not in CHOICES[name] for name, value in chosen.items()):
            raise ValueError("no choice")
        if isinstance(limit, bool) or not isinstance(limit, int | float) or not math.isfinite(limit) or limit < 0.0:
            raise ValueError("no limit")
        return LineRun(**chosen, limit=float(limit))
    except (ValueError, TypeError, AttributeError, RecursionError, OverflowError) as error:
        raise Refusal("the stored settings of Pull Line cannot be used: run it again") from error
