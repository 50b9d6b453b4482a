"""Tooltips of buttons that press one operator in several ways."""
from collections.abc import Mapping

import bpy


def tell_by(name: str, tips: Mapping[str | bool, str]) -> classmethod:
    """Makes the method `description` of an operator: the tooltip by the value of a property; empty for other values,
    for which the docstring holds.
    """
    def description(_cls: type, _context: bpy.types.Context, properties: bpy.types.OperatorProperties) -> str:
        return tips.get(getattr(properties, name), "")

    return classmethod(description)
