"""Compares bundles of arrays."""
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np


def are_same(one: Any, other: Any) -> bool:
    """Returns whether two values are the same: arrays by their numbers, bundles and tuples part by part."""
    if type(one) is not type(other):
        return False
    if isinstance(one, np.ndarray):
        return np.array_equal(one, other)
    if isinstance(one, tuple):
        return len(one) == len(other) and all(map(are_same, one, other))
    if is_dataclass(one):
        return all(are_same(getattr(one, each.name), getattr(other, each.name)) for each in fields(one) if each.compare)
    return one == other
