"""Packages of an add-on's folder, and their installation as the preferences do it."""
import os
import sys
import zipfile
from pathlib import Path

import bpy

EXTENSION = bpy.app.version >= (4, 2)
MODULE = "bl_ext.user_default.reflection_lines" if EXTENSION else "reflection_lines"
NATIVE = (".so", ".pyd")


def packed(source: Path, name: str, tail: bytes) -> Path:
    """As .ci/package.py packs; a tail makes another library of the same code."""
    path = Path(os.environ["BLENDER_USER_RESOURCES"]) / name
    with zipfile.ZipFile(path, "w") as archive:
        for file in sorted(source.rglob("*")):
            if file.is_file() and "__pycache__" not in file.parts:
                content = file.read_bytes() + (tail if file.suffix in NATIVE else b"")
                archive.writestr(f"reflection_lines/{file.relative_to(source).as_posix()}", content)
    return path


def install(package: Path) -> None:
    if EXTENSION:
        bpy.ops.extensions.package_install_files(filepath=str(package), repo="user_default", enable_on_install=True)
    else:
        bpy.ops.preferences.addon_install(filepath=str(package), overwrite=True)
    assert bpy.ops.preferences.addon_enable(module=MODULE) == {'FINISHED'}


def folder() -> Path:
    """Where the installed add-on is."""
    return Path(sys.modules[MODULE].__file__).parent
