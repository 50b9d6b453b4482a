"""What is packed says what it is for: the zip, the extension's folder and the wheels, of modules that are no libraries.
"""
import shutil
import subprocess
import sys
import tomllib
import zipfile
from email.parser import Parser
from pathlib import Path

import pytest
from tree import ROOT, files

READ = {"LICENSE", "README.md", "CMakeLists.txt", "pyproject.toml", "native/python/reflines.pyi"}
MODULES = ("reflines.cpython-311-x86_64-linux-gnu.so", "reflines.cp313-win_amd64.pyd")
PACK = """
import sys
from pathlib import Path
sys.path.insert(0, ".ci")
import package
modules = [Path(name) for name in sys.argv[1:]]
package.BUILD.mkdir(parents=True)
package.make_zip(package.BUILD / "addon.zip", modules)
package.make_extension(modules, package.make_wheels(modules))
"""


@pytest.fixture(scope="module")
def packed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What the packing of a copy of the checkout writes."""
    folder = tmp_path_factory.mktemp("project")
    for file in files():
        if file.parts[0] in (".ci", "addon") or file.as_posix() in READ:
            (folder / file).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / file, folder / file)
    for name in MODULES:
        (folder / name).write_bytes(b"no library")
    subprocess.run(["git", "init", "--quiet"], cwd=folder, check=True)
    subprocess.run([sys.executable, "-B", "-c", PACK, *MODULES], cwd=folder, check=True)
    return folder / "build/package"


def test_the_manifest_is_that_of_the_checkout_for_the_platforms_of_the_modules(packed: Path) -> None:
    with zipfile.ZipFile(packed / "addon.zip") as archive:
        inside = {name: archive.read(f"reflection_lines/{name}") for name in ("blender_manifest.toml", "__init__.py")}
    own = tomllib.loads((ROOT / "addon/blender_manifest.toml").read_text())
    extension = tomllib.loads((packed / "extension/blender_manifest.toml").read_text())
    wheels = extension.pop("wheels")
    assert tomllib.loads(inside["blender_manifest.toml"].decode()) == extension
    assert set(extension.pop("platforms")) == {"linux-x64", "windows-x64"}
    assert extension == {key: value for key, value in own.items() if key != "platforms"}
    assert len(wheels) == len(MODULES) and all((packed / "extension" / wheel).is_file() for wheel in wheels)
    start = (ROOT / "addon/__init__.py").read_bytes()
    assert inside["__init__.py"] == (packed / "extension/__init__.py").read_bytes() == start


def test_a_wheel_says_what_it_is(packed: Path) -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    for wheel in (packed / "extension/wheels").iterdir():
        with zipfile.ZipFile(wheel) as archive:
            name, = (name for name in archive.namelist() if name.endswith("/METADATA"))
            about = Parser().parsestr(archive.read(name).decode())
        assert (about["Name"], about["Summary"]) == (project["name"], project["description"])
        assert about.get_all("Requires-Dist") == project["dependencies"]
        assert about.get_payload() == (ROOT / "README.md").read_text()
