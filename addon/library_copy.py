"""Copies of the native library that nothing overwrites, named by their content, in the user's cache folder.

A library that a process has mapped must not change, yet an installation over itself writes into it (Windows refuses).
"""
import hashlib
import os
import shutil
import stat
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

KEPT = 30.0 * 24.0 * 3600.0  # seconds since its last use after which a copy is deleted


def digest_of(library: Path) -> str:
    return hashlib.blake2b(library.read_bytes(), digest_size=16).hexdigest()


def copies(library: Path, digest: str) -> Iterator[Path]:
    """Where the library may be loaded from, best first: its copies, made when they are asked for, and itself. A folder
    that cannot be written, or into which others can, gives none."""
    for base in cache_folders():
        with suppress(OSError):
            private(base)
            delete_old(base, digest)
            yield copied(library, base / digest)
    yield library


def cache_folders() -> tuple[Path, Path]:
    """The user's own, and one that lasts until the next start of the machine. Nothing else is in them."""
    if sys.platform == "win32":
        cache = Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData/Local")
    elif sys.platform == "darwin":
        cache = Path.home() / "Library/Caches"
    else:
        cache = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    user = os.getuid() if hasattr(os, "getuid") else "user"
    return cache / "reflection_lines" / "library", Path(tempfile.gettempdir()) / f"reflection_lines-{user}"


def private(folder: Path) -> None:
    """Makes it; raises where it is a link, somebody else's, or may be written by others: they could put code there."""
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    state = folder.lstat()
    if not stat.S_ISDIR(state.st_mode):
        raise NotADirectoryError(folder)
    if hasattr(os, "getuid") and (state.st_uid != os.getuid() or state.st_mode & 0o022):
        raise PermissionError(folder)


def copied(library: Path, folder: Path) -> Path:
    """Written beside its place and moved there: another Blender never finds half of it. Checked at every use."""
    private(folder)
    os.utime(folder)
    copy, content = folder / library.name, library.read_bytes()
    if not copy.is_symlink() and copy.is_file() and copy.read_bytes() == content:
        return copy
    handle, name = tempfile.mkstemp(dir=folder)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        os.replace(name, copy)
    finally:
        Path(name).unlink(missing_ok=True)
    return copy


def delete_old(base: Path, used: str) -> None:
    """Those that another Blender has loaded go on working; Windows keeps them."""
    for folder in base.iterdir():
        if folder.name != used and folder.lstat().st_mtime < time.time() - KEPT:
            shutil.rmtree(folder, ignore_errors=True)
