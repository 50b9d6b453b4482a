"""A repository of extensions on a static host, as `./run release` makes it: an artist adds its address to Blender,
installs the add-on from it, uses it, updates it and removes it, in one session. The solver is an ordinary module, which
a session keeps. Run by .ci/release.py with two folders: the repository and one of a later version."""
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Generator
from importlib import invalidate_caches
from importlib.util import find_spec
from pathlib import Path

import bpy

import scenes
import window

OLDER, NEWER = Path(sys.argv[1]), Path(sys.argv[2])
NAME = "reflection_lines"
TAIL = b"another build"  # of the later version's libraries


def served(folder: Path) -> tuple[subprocess.Popen, str]:
    """A static host of a folder; its address."""
    command = ["/usr/bin/python3", "-u", "-m", "http.server", "0", "--bind", "127.0.0.1", "--directory", str(folder)]
    host = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    return host, f"http://127.0.0.1:{host.stdout.readline().split(' port ')[1].split()[0]}/index.json"


def added(address: str) -> tuple[str, str]:
    """The folder in which Blender keeps the repository's extensions, and the module that ours will be."""
    for other in bpy.context.preferences.extensions.repos:
        other.enabled = not other.use_remote_url  # no other host is to be asked
    bpy.context.preferences.system.use_online_access = True
    bpy.ops.preferences.extension_repo_add(type='REMOTE', name="Lines", remote_url=address)
    ours = next(each for each in bpy.context.preferences.extensions.repos if each.remote_url == address)
    return ours.directory, f"bl_ext.{ours.module}.{NAME}"


def upload(repository: Path, host: Path) -> None:
    for path in host.iterdir():
        shutil.rmtree(path) if path.is_dir() else path.unlink()
    shutil.copytree(repository, host, dirs_exist_ok=True)


def library() -> bytes:
    """The library that a new session would load."""
    invalidate_caches()
    return Path(find_spec("reflines").origin).read_bytes()


def use() -> Generator[float, None, None]:
    """A solve with the stripes on."""
    for other in list(bpy.data.objects):
        bpy.data.objects.remove(other)
    panel = scenes.panel()
    scenes.look_from_above()
    bpy.context.scene.reflection_lines.stripes.show = True
    yield 0.3
    scenes.edit_inner(panel)
    assert scenes.smooth() == {'FINISHED'}
    scenes.object_mode()
    yield 0.3


def test_install_update_remove(driver: window.Window) -> Generator[float, None, None]:
    with tempfile.TemporaryDirectory() as name:
        upload(OLDER, Path(name))
        host, address = served(Path(name))
        try:
            yield from install_update_remove(driver, Path(name), *added(address))
        finally:
            host.kill()


def install_update_remove(driver: window.Window, host: Path, place: str, module: str) -> Generator[float, None, None]:
    assert bpy.ops.extensions.repo_sync(repo_directory=place) == {'FINISHED'}
    assert bpy.ops.extensions.package_install(repo_directory=place, pkg_id=NAME) == {'FINISHED'}
    assert module in bpy.context.preferences.addons
    assert not bpy.context.window_manager.reflection_lines.problem
    assert not library().endswith(TAIL)
    assert sys.modules[f"{module}.native"].reflines is sys.modules["reflines"]  # the wheel's, under its own name
    with driver.override():
        yield from use()
    upload(NEWER, host)
    assert bpy.ops.extensions.repo_sync(repo_directory=place) == {'FINISHED'}
    assert bpy.ops.extensions.package_upgrade_all() == {'FINISHED'}
    yield 0.3
    assert library().endswith(TAIL)
    session = bpy.context.window_manager.reflection_lines
    assert "that of version 0.1.0" in session.problem and session.remedy == "Start Blender again.", session.problem
    assert bpy.ops.extensions.package_uninstall(repo_directory=place, pkg_id=NAME) == {'FINISHED'}
    yield 0.5
    assert module not in bpy.context.preferences.addons
    assert not hasattr(bpy.types.Scene, NAME)
    assert not list(Path(os.environ["BLENDER_USER_RESOURCES"]).rglob("reflines*"))


bpy.context.preferences.view.show_splash = False
steps = window.all_steps((test_install_update_remove,))
bpy.app.timers.register(lambda: next(steps), first_interval=1.0, persistent=True)
