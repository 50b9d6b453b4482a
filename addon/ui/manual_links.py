"""The add-on's part of Blender's manual mapping: F1 over a button or a setting opens its section of the manual.

The manual is one HTML page inside the add-on. Blender hands a web browser the address of the page and the section, so
it has to be HTML, and it is written as HTML so that a checkout and an installed zip open the same file without a
converter. Where the system's opener drops the section of a file address, the page opens at its table of contents.
"""
from pathlib import Path

import bpy

PAGE = Path(__file__).resolve().parents[1] / "manual" / "index.html"

# Pattern of a setting's lower-case RNA identifier, and its section. Blender takes the first pattern that matches.
SETTINGS = (
    *((f"bpy.types.reflinesdirection.{name}", "#falloff") for name in ("centre", "radius", "shape")),
    *((f"bpy.types.reflines{tool}.*", f"#reflines.{tool}") for tool in ("direction", "warp", "pattern")),
    ("bpy.types.reflinesscene.camera", "#view-and-light"),
    ("bpy.types.reflinesscene.light*", "#view-and-light"),
    *((f"bpy.types.reflinesscene.{name}", "#region") for name in ("border", "show_borders", "result")),
    ("bpy.types.reflinesobject.crease*", "#region"),
    ("bpy.types.reflinesobject.limit*", "#region"),
    ("bpy.types.reflinespull.*", "#reflines.pull_line"),
    ("bpy.types.reflinesbrush.*", "#reflines.fair_brush"),
    ("bpy.types.reflineshandle*", "#kept-handles"),
    ("bpy.types.reflinesmarks.*", "#reflines.check"),
    ("bpy.types.reflinesinspection.*", "#reflines.inspect"),
    ("bpy.types.reflinesspot.*", "#reflines.inspect"),
    ("bpy.types.reflinessetlight.*", "#light-set"),
    ("bpy.types.reflineslightset.*", "#light-set"),
    ("bpy.types.reflinesscene.*", "#reflines.smooth"),
    ("bpy.types.reflinesstripes.*", "#stripes"),
    ("bpy.types.view3d_mt_reflines*", "#tools"),
)


def manual_map() -> tuple[str, tuple[tuple[str, str], ...]]:
    """Returns the page's address, and pairs of an identifier's pattern and the section appended to the address."""
    operators = ((f"bpy.ops.reflines.{name}", f"#reflines.{name}") for name in dir(bpy.ops.reflines))
    return PAGE.as_uri(), (*operators, *SETTINGS)


def register() -> None:
    bpy.utils.register_manual_map(manual_map)


def unregister() -> None:
    bpy.utils.unregister_manual_map(manual_map)
