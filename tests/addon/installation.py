"""Installs and enables the add-on as a user has it: in the scripts folder, by its name, through the preferences.

Where REFLINES_ADDON names an add-on that was installed from the package, and REFLINES_FOLDER its place, that one is
enabled.
"""
import os
import sys
from contextlib import suppress
from pathlib import Path

import addon_utils
import bpy

ROOT = Path(__file__).resolve().parents[2]
INSTALLED = "REFLINES_ADDON" in os.environ
NAME = os.environ.get("REFLINES_ADDON", "reflection_lines")
FOLDER = Path(os.environ.get("REFLINES_FOLDER", ROOT / "addon"))


def scripts_folder(where: Path) -> Path:
    """Makes `where` the user's scripts folder of this Blender; returns its folder of add-ons."""
    addons = where / "addons"
    addons.mkdir(parents=True, exist_ok=True)
    os.environ["BLENDER_USER_SCRIPTS"] = str(where)
    sys.path.append(str(addons))
    return addons


def link_checkout() -> None:
    link = scripts_folder(ROOT / "build" / "blender" / "scripts") / NAME
    with suppress(FileExistsError):  # from before, or of a Blender that runs beside this one
        link.symlink_to(FOLDER, target_is_directory=True)
    addon_utils.modules_refresh()


def install() -> None:
    if not INSTALLED:
        link_checkout()
    if bpy.ops.preferences.addon_enable(module=NAME) != {'FINISHED'}:
        raise SystemExit(f"{NAME} could not be enabled")
    # An extension goes by a longer name; tests import by this one.
    parts = [name for name in sys.modules if name == NAME or name.startswith(NAME + ".")]
    sys.modules.update({"reflection_lines" + name.removeprefix(NAME): sys.modules[name] for name in parts})
