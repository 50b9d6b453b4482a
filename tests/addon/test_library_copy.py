"""Copies of the native library in the user's cache: what is loaded is what was installed, or is loaded in place."""
import os
import sys
import threading
import time
from pathlib import Path

import pytest

import installation

library_copy = sys.modules["reflection_lines.library_copy"]
CONTENT = b"\x7fELF" + bytes(range(256)) * 4000


@pytest.fixture
def library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A library, and a cache folder that is empty; none in the folder of temporary files."""
    monkeypatch.setattr(library_copy, "find_cache_folders", lambda: (tmp_path / "cache" / "library",))
    path = tmp_path / "reflines.so"
    path.write_bytes(CONTENT)
    return path


def places(library: Path) -> list[Path]:
    return list(library_copy.find_copies(library, library_copy.compute_digest(library)))


def cache(library: Path) -> Path:
    return library.parent / "cache" / "library"


def test_the_loaded_module_is_a_copy_of_the_installed_one() -> None:
    native = sys.modules["reflection_lines"].native
    path = Path(native.reflines.__file__)
    assert installation.FOLDER not in path.parents
    assert path.read_bytes() == (installation.FOLDER / path.name).read_bytes()
    assert library_copy.compute_digest(path) in path.parts


def test_the_copy_comes_first_and_is_made_once(library: Path) -> None:
    copy, last = places(library)
    assert last == library
    assert copy.read_bytes() == CONTENT
    state = copy.stat()
    assert places(library) == [copy, library]
    assert (copy.stat().st_ino, copy.stat().st_mtime_ns) == (state.st_ino, state.st_mtime_ns)
    assert [file.name for file in copy.parent.iterdir()] == [copy.name]


def test_another_content_leaves_the_first_copy_alone(library: Path) -> None:
    first = places(library)[0]
    library.write_bytes(CONTENT + b"more")
    second = places(library)[0]
    assert first.read_bytes() == CONTENT
    assert second.read_bytes() == CONTENT + b"more"


@pytest.mark.parametrize("wrong", [b"", CONTENT[:100], CONTENT[:-1] + b"!"])
def test_a_wrong_copy_is_replaced_not_written_into(library: Path, wrong: bytes) -> None:
    copy = places(library)[0]
    copy.write_bytes(wrong)
    with copy.open("rb") as mapped_by_another:
        assert places(library)[0].read_bytes() == CONTENT
        assert mapped_by_another.read() == wrong


def test_a_link_in_the_place_of_the_copy_is_replaced(library: Path) -> None:
    copy = places(library)[0]
    elsewhere = library.parent / "elsewhere"
    elsewhere.write_bytes(CONTENT)
    copy.unlink()
    copy.symlink_to(elsewhere)
    assert not places(library)[0].is_symlink()
    assert elsewhere.read_bytes() == CONTENT


def folder_is_a_link(folder: Path) -> None:
    (folder.parent / "other").mkdir(parents=True)
    folder.symlink_to(folder.parent / "other", target_is_directory=True)


def folder_is_a_file(folder: Path) -> None:
    folder.parent.mkdir()
    folder.write_bytes(b"")


def others_may_write(folder: Path) -> None:
    folder.mkdir(parents=True)
    folder.chmod(0o777)


@pytest.mark.parametrize("hostile", [folder_is_a_link, folder_is_a_file, others_may_write])
def test_where_the_cache_is_not_ours_alone_the_library_is_loaded_in_place(library: Path, hostile) -> None:
    hostile(cache(library))
    assert places(library) == [library]


def test_a_full_disk_leaves_no_half_copy(library: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise OSError("no space left on device")

    monkeypatch.setattr(os, "replace", full)
    assert places(library) == [library]
    assert not [path for path in cache(library).rglob("*") if path.is_file()]


def test_copies_that_nobody_used_for_long_are_deleted(library: Path) -> None:
    old = places(library)[0].parent
    library.write_bytes(CONTENT + b"more")
    recent = places(library)[0].parent
    library.write_bytes(CONTENT + b"most")
    os.utime(old, (time.time() - 1.1 * library_copy.KEPT,) * 2)
    os.utime(recent, (time.time() - 0.9 * library_copy.KEPT,) * 2)
    assert places(library)[0].is_file()
    assert recent.is_dir()
    assert not old.exists()


def test_many_at_once_all_get_a_whole_copy(library: Path) -> None:
    found = []
    threads = [threading.Thread(target=lambda: found.append(places(library)[0].read_bytes())) for _ in range(16)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [CONTENT] * 16
