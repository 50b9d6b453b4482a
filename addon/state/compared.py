"""The divider between the shapes before and after the last solve, and where it can go in each 3D view.

It stands at a fraction of what a view shows of the panel, so that it stays over the panel as the view turns.
"""
from dataclasses import dataclass, field

import bpy

from ..blender.app_handlers import forget_at_load

MIDDLE = 0.5
Span = tuple[float, float]  # left and right end, in pixels of the region


@dataclass
class Comparison:
    """The state of the comparison, of the session only."""
    fraction: float = MIDDLE  # of the span, left of which is the shape before
    taken: bool = False    # whether the mouse is over the divider or drags it
    spans: dict[int, Span] = field(default_factory=dict)  # of the regions that show both shapes, by their addresses


NOW = Comparison()


def note_span(region: bpy.types.Region, span: Span | None) -> None:
    """Records from where to where a region shows both shapes, None where it does not."""
    NOW.spans.pop(region.as_pointer(), None)
    if span is not None:
        NOW.spans[region.as_pointer()] = span


def find_divider(region: bpy.types.Region) -> float | None:
    """Returns where the divider stands in a region, in its pixels; None where the region does not show both shapes."""
    span = NOW.spans.get(region.as_pointer())
    return None if span is None else span[0] + NOW.fraction * (span[1] - span[0])


def move_divider(region: bpy.types.Region, x: float) -> None:
    """Moves the divider to a place in a region, or to the end of the span that is nearer."""
    low, high = NOW.spans.get(region.as_pointer(), (0.0, 0.0))
    if high > low:
        NOW.fraction = min(max((x - low) / (high - low), 0.0), 1.0)


register, unregister = forget_at_load(NOW.spans.clear)
