"""The points that stripes on objects are seen from while panels are dragged as one: such are solved for one view."""
import numpy as np

_middles: dict[str, np.ndarray] = {}  # 3, world space, by the names of the objects


def show_from(middles: dict[str, np.ndarray]) -> None:
    """Shows the stripes on objects, given by their names, as seen from these points, and on all others as always."""
    _middles.clear()
    _middles.update(middles)


def find_shown_middle(name: str, otherwise: np.ndarray) -> np.ndarray:
    """Returns the point that the stripes on an object are seen from."""
    return _middles.get(name, otherwise)
