"""Rows of panels whose names would be cut where the layout leaves them half of the sidebar's default width."""
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
