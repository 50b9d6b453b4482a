"""The frames at which keyed handles are baked."""
from collections.abc import Sequence

from .refusal import Refusal

MOST_FRAMES = 1000  # each is a shape key


def choose_frames(keyed: Sequence[float], first: float, last: float, step: int) -> tuple[float, ...]:
    """Returns the keyed frames of a range, its ends, and every `step` frames from its begin, in order."""
    if (last - first) / step > MOST_FRAMES:
        raise Refusal(f"There would be more than {MOST_FRAMES} frames to bake: take a shorter preview range")
    inner = {float(first), float(last), *(float(each) for each in keyed if first <= each <= last)}
    steps = {first + step * number for number in range(int((last - first) // step) + 1)}
    frames = tuple(sorted(inner | steps))
    if len(frames) > MOST_FRAMES:
        raise Refusal(f"There are {len(frames)} frames to bake, more than {MOST_FRAMES}: take fewer keys")
    return frames
