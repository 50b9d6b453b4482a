"""Rows of panels and menus: the tools for the hand, and settings whose names would be cut where the layout leaves them
half of the sidebar's default width.
"""
import bpy


def draw_switch(layout: bpy.types.UILayout, settings: object, name: str) -> None:
    """Draws a check box over the whole width."""
    row = layout.row()
    row.use_property_split = False
    row.prop(settings, name)


def draw_choice(layout: bpy.types.UILayout, settings: object, name: str) -> None:
    """Draws an enumeration as its value alone, over the whole width; its tooltip says what it is."""
    row = layout.row()
    row.use_property_split = False
    row.prop(settings, name, text="")


def draw_hands(layout: bpy.types.UILayout) -> None:
    """Draws the tools for the hand, in the order in which they stand everywhere: buttons, menus, toolbar and manual."""
    layout.operator("reflines.pull_line", icon='VIEW_PAN')
    layout.operator("reflines.pull_line", text="Draw Highlight", icon='GREASEPENCIL').draws = True
    layout.operator("reflines.fair_brush", icon='BRUSH_DATA')
