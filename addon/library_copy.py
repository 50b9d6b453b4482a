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


def compute_digest(library: Path) -> str:
    """Computes the name of a library's copy: a hash of its content."""
    return hashlib.blake2b(library.read_bytes(), digest_size=16).hexdigest()


def find_copies(library: Path, digest: str) -> Iterator[Path]:
    """Yields the files from which the library may be loaded, best first: its copies, made on demand, and itself.

    A folder that cannot be written, or into which other users can write, is skipped.
    """
    for base in find_cache_folders():
        with suppress(OSError):
            make_private(base)
            delete_old(base, digest)
            yield ensure_copy(library, base / digest)
    yield library


def find_cache_folders() -> tuple[Path, Path]:
    """Returns the folders of copies, which hold nothing else: in the user's cache, and in the temporary folder."""
    if sys.platform == "win32":
        cache = Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData/Local")
    elif sys.platform == "darwin":
        cache = Path.home() / "Library/Caches"
    else:
        cache = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    user = os.getuid() if hasattr(os, "getuid") else "user"
    return cache / "reflection_lines" / "library", Path(tempfile.gettempdir()) / f"reflection_lines-{user}"


def make_private(folder: Path) -> None:
    """Makes a folder of the user; raises OSError where it is a link, belongs to another user or can be written by one.

    Other users could put code there.
    """
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    state = folder.lstat()
    if not stat.S_ISDIR(state.st_mode):
        raise NotADirectoryError(folder)
    if hasattr(os, "getuid") and (state.st_uid != os.getuid() or state.st_mode & 0o022):
        raise PermissionError(folder)


def ensure_copy(library: Path, folder: Path) -> Path:
    """Returns the copy in a folder, which is compared at every use and written where it differs.

    It is written beside its place and moved there, so that another Blender never finds half of it.
    """
    make_private(folder)
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
    """Deletes copies unused for long. One that another Blender has loaded goes on working; Windows keeps it."""
    for folder in base.iterdir():
        if folder.name != used and folder.lstat().st_mtime < time.time() - KEPT:
            shutil.rmtree(folder, ignore_errors=True)
