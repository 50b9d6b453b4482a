"""Enabling, disabling, reloading; and an add-on whose native module is missing or does not fit."""
import re
import shutil
import sys
from collections.abc import Iterator
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path
from types import SimpleNamespace

import bpy
import pytest

import installation
import scenes

COPY = "reflection_lines_copy"


def enable(name: str = installation.NAME) -> None:
    assert bpy.ops.preferences.addon_enable(module=name) == {'FINISHED'}


def disable(name: str = installation.NAME) -> None:
    assert bpy.ops.preferences.addon_disable(module=name) == {'FINISHED'}


def works() -> bool:
    scenes.edited_panel()
    return scenes.smooth() == {'FINISHED'}


def test_disabled_it_leaves_nothing_behind() -> None:
    disable()
    try:
        assert not hasattr(bpy.types.Scene, "reflection_lines")
        assert not hasattr(bpy.types.Object, "reflection_lines")
        assert not [name for name in dir(bpy.types) if "reflines" in name.lower()]
        assert not [handler for kind in (bpy.app.handlers.load_pre, bpy.app.handlers.depsgraph_update_post)
                    for handler in kind if handler.__module__.startswith(installation.NAME)]
    finally:
        enable()


def test_it_can_be_disabled_and_enabled_again_and_again() -> None:
    for _ in range(3):
        disable()
        enable()
    assert works()


def test_it_works_after_all_scripts_were_reloaded() -> None:
    for _ in range(2):
        bpy.ops.script.reload()
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        assert works()


def test_a_changed_file_is_read_again(monkeypatch) -> None:
    """As after an update of the add-on while Blender runs: Blender itself reloads __init__.py only."""
    operator = sys.modules[installation.NAME + ".operators.smooth"].REFLINES_OT_smooth
    disable()
    monkeypatch.setattr(sys.modules[installation.NAME], "__time__", 0.0)  # as if the file were newer
    enable()
    assert sys.modules[installation.NAME + ".operators.smooth"].REFLINES_OT_smooth is not operator
    assert works()


def test_settings_survive_disabling() -> None:
    bpy.context.scene.reflection_lines.length = 0.25
    disable()
    enable()
    assert bpy.context.scene.reflection_lines.length == 0.25


@pytest.fixture
def copy(tmp_path) -> Iterator[Path]:
    """A copy of the add-on without its native module, which the test may put back in some other form, then enable."""
    folder = tmp_path / COPY
    shutil.copytree(installation.FOLDER, folder, ignore=shutil.ignore_patterns("*.so", "__pycache__"))
    sys.path.append(str(tmp_path))
    disable()
    yield folder
    disable(COPY)
    sys.path.remove(str(tmp_path))
    for name in [name for name in sys.modules if name.split(".")[0] == COPY]:
        del sys.modules[name]
    enable()


def native_module() -> Path:
    return next(path for suffix in EXTENSION_SUFFIXES for path in installation.FOLDER.glob("reflines" + suffix))


def stays_enabled_and_says(problem: str, remedy: str) -> None:
    enable(COPY)
    session = bpy.context.window_manager.reflection_lines
    assert problem in session.problem
    assert remedy in session.remedy
    scenes.edited_panel()
    with pytest.raises(RuntimeError, match="The native solver"):
        scenes.smooth()


def test_a_missing_module(copy) -> None:
    stays_enabled_and_says("The native solver is missing", "Install the add-on from its zip package")


def test_a_module_for_another_python(copy) -> None:
    shutil.copy(native_module(), copy / "reflines.cpython-399-x86_64-linux-gnu.so")
    stays_enabled_and_says("is for another Python than this Blender's", "Install the package of the add-on")


def test_a_module_for_another_system(copy) -> None:
    shutil.copy(native_module(), copy / "reflines.cp313-win_amd64.pyd")
    shutil.copy(native_module(), copy / "reflines.cpython-313-darwin.so")
    stays_enabled_and_says("is for Windows and macOS, and this Blender runs on Linux", "add-on for Linux")


@pytest.mark.parametrize(("error", "blocked"), [
    ("DLL load failed while importing reflines: Access is denied", True),
    ("DLL load failed while importing reflines: An Application Control policy has blocked this file", True),
    ("DLL load failed while importing reflines: The specified module could not be found", False),
    ("dlopen(/x/reflines.so, 2): library load disallowed by system policy", True),
    ("/x/reflines.so: failed to map segment from shared object: Operation not permitted", True),
    ("libother.so.1: cannot open shared object file: No such file or directory", False),
])
def test_a_module_that_the_system_blocks(error: str, blocked: bool) -> None:
    """The sentences are those of Windows, macOS and Linux."""
    state = sys.modules[installation.NAME + ".native"].describe_failure(error)
    assert ("blocks the native solver" in state.problem) == blocked
    assert error in state.problem
    assert ("may run" in state.remedy) == blocked


def test_a_module_without_its_one_library() -> None:
    error = "libgomp.so.1: cannot open shared object file: No such file or directory"
    state = sys.modules[installation.NAME + ".native"].describe_failure(error)
    assert "needs the library libgomp" in state.problem
    assert "libgomp1 in Debian" in state.remedy


def test_a_module_that_a_wheel_brought(copy, tmp_path, monkeypatch) -> None:
    """Blender unpacks the wheels of an extension into a folder of Python modules."""
    place = tmp_path / "site-packages"
    place.mkdir()
    shutil.copy(native_module(), place)
    monkeypatch.syspath_prepend(str(place))
    monkeypatch.delitem(sys.modules, "reflines", raising=False)
    enable(COPY)
    assert not bpy.context.window_manager.reflection_lines.problem
    module = sys.modules[COPY + ".native"].reflines
    assert module is sys.modules["reflines"] and Path(module.__file__).parent == place  # no copy, under its own name
    assert works()


def test_a_wheel_of_an_older_version_that_is_in_use(copy, tmp_path, monkeypatch) -> None:
    (tmp_path / "reflines.py").write_text('__version__ = "0.0.9"\n')
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.delitem(sys.modules, "reflines", raising=False)
    stays_enabled_and_says("is that of version 0.0.9 and the add-on's is 0.1.0", "Start Blender again")


class Layout(list):
    """A stand-in for Blender's layout that keeps its buttons."""

    def operator(self, _name: str, **about: str) -> SimpleNamespace:
        self.append(SimpleNamespace(**about))
        return self[-1]


def drawn_links() -> dict[str, str]:
    """The texts of the buttons in the preferences of the copy, and the addresses that they open."""
    layout = Layout()
    sys.modules[COPY + ".ui.preferences"].draw_links(layout)
    return {button.text: button.url for button in layout}


@pytest.mark.parametrize("links", [
    {"Website": "https://example.org/", "Report a Problem": "https://example.org/issues"},
    {"Report a Problem": "https://example.org/issues"}, {}], ids=["both", "one", "none"])
def test_the_preferences_have_the_links_of_the_package(copy, links: dict[str, str]) -> None:
    """As .ci/package.py writes them into bl_info, which Blender takes away from an extension before it registers it."""
    keys = {"Website": "website", "Report a Problem": "tracker_url"}
    start = copy / "__init__.py"
    rows = "".join(f'    "{keys[text]}": "{address}",\n' for text, address in links.items())
    head, tail = start.read_text().split("bl_info = {\n")
    lines = [line for line in tail.splitlines(keepends=True) if not re.match(r' +"(website|tracker_url)"', line)]
    start.write_text(f"{head}bl_info = {{\n{rows}{''.join(lines)}")
    enable(COPY)
    if hasattr(sys.modules[COPY], "bl_info"):
        del sys.modules[COPY].bl_info
    assert drawn_links() == links


def test_a_module_that_does_not_load(copy) -> None:
    (copy / native_module().name).write_bytes(b"this is no library")
    stays_enabled_and_says("The native solver cannot be loaded", "install the add-on's zip package again")
