"""Installs and enables the add-on as a user has it: in the scripts folder, by its name, through the preferences."""
import os
import sys
from pathlib import Path

import addon_utils
import bpy

ROOT = Path(__file__).resolve().parents[2]
NAME = "reflection_lines"


def scripts_folder(where: Path) -> Path:
    """Makes `where` the user's scripts folder of this Blender; returns its folder of add-ons."""
    addons = where / "addons"
    addons.mkdir(parents=True, exist_ok=True)
    os.environ["BLENDER_USER_SCRIPTS"] = str(where)
    sys.path.append(str(addons))
    return addons


def install() -> None:
    link = scripts_folder(ROOT / "build" / "blender" / "scripts") / NAME
    if not link.is_symlink():
        link.symlink_to(ROOT / "addon", target_is_directory=True)
    addon_utils.modules_refresh()
    if bpy.ops.preferences.addon_enable(module=NAME) != {'FINISHED'}:
        raise SystemExit(f"{NAME} could not be enabled")
