"""The project's addresses on the web are those of pyproject.toml: packages have the ones of its table, and no others.

A copy of what the packing reads is given other tables, and packs modules that are no libraries.
"""
import ast
import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from email.message import Message
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
package.make_zip(package.BUILD / "addon.zip", modules)
package.make_extension(modules, package.make_wheels(modules))
"""
ABOUT = "import sys; sys.path.insert(0, '.ci'); import build_backend as b; b.prepare_metadata_for_build_wheel('build')"
ALL = {"Homepage": "https://example.org", "Documentation": "https://docs.example.org/a/?b=1&c=2#d",
       "Issues": "https://example.org:8443/issues"}


@dataclass(frozen=True)
class Packed:
    """What Blender and pip read of the zip, of the extension's folder and of the wheels."""
    manifests: list[dict]
    infos: list[dict]
    metadata: list[Message]


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of what the packing reads, as a repository of its own."""
    folder = tmp_path_factory.mktemp("project")
    for file in files():
        if file.parts[0] in (".ci", "addon") or file.as_posix() in READ:
            (folder / file).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / file, folder / file)
    for name in MODULES:
        (folder / name).write_bytes(b"no library")
    subprocess.run(["git", "init", "--quiet"], cwd=folder, check=True)
    return folder


def give(project: Path, addresses: Mapping[str, object]) -> None:
    """Writes the table of addresses, and takes away what was packed with another."""
    rows = "".join(f"{name} = {json.dumps(address)}\n" for name, address in addresses.items())
    text, count = re.subn(r"^\[project\.urls\]\n[^\[]*", lambda _: f"[project.urls]\n{rows}\n",
                          (ROOT / "pyproject.toml").read_text(), flags=re.MULTILINE)
    assert count == 1
    (project / "pyproject.toml").write_text(text)
    shutil.rmtree(project / "build", ignore_errors=True)
    (project / "build/package").mkdir(parents=True)


def bl_info(source: str) -> dict:
    """As Blender reads it: from its first line to the first empty one, as a literal."""
    lines = source[source.index("\nbl_info") + 1:].split("\n\n", maxsplit=1)[0]
    return ast.literal_eval(ast.parse(lines).body[0].value)


def pack(project: Path, addresses: Mapping[str, object]) -> Packed:
    give(project, addresses)
    subprocess.run([sys.executable, "-B", "-c", PACK, *MODULES], cwd=project, check=True)
    folder = project / "build/package/extension"
    with zipfile.ZipFile(project / "build/package/addon.zip") as archive:
        inside = {name: archive.read(f"reflection_lines/{name}").decode()
                  for name in ("blender_manifest.toml", "__init__.py")}
    texts = [inside, {name: (folder / name).read_text() for name in inside}]
    metadata = []
    for wheel in sorted((folder / "wheels").iterdir()):
        with zipfile.ZipFile(wheel) as archive:
            name, = (name for name in archive.namelist() if name.endswith("/METADATA"))
            metadata.append(Parser().parsestr(archive.read(name).decode()))
    return Packed([tomllib.loads(each["blender_manifest.toml"]) for each in texts],
                  [bl_info(each["__init__.py"]) for each in texts], metadata)


def links(info: Mapping[str, object]) -> dict[str, object]:
    return {key: info[key] for key in ("website", "doc_url", "tracker_url") if key in info}


@pytest.mark.parametrize(("given", "website", "info"), [
    (ALL, ALL["Homepage"],
     {"website": ALL["Homepage"], "doc_url": ALL["Documentation"], "tracker_url": ALL["Issues"]}),
    ({"Homepage": "https://example.org/"}, "https://example.org/",
     {"website": "https://example.org/", "doc_url": "https://example.org/"}),
    ({"Issues": "https://example.org/issues"}, None, {"tracker_url": "https://example.org/issues"}),
    ({}, None, {}),
], ids=["all", "homepage", "issues", "none"])
def test_what_is_packed_has_the_addresses_of_the_table(project: Path, given: dict, website: str | None,
                                                       info: dict) -> None:
    packed = pack(project, given)
    assert [manifest.get("website") for manifest in packed.manifests] == [website, website]
    assert [links(each) for each in packed.infos] == [info, info]
    assert len(packed.metadata) == len(MODULES)
    for about in packed.metadata:
        assert about.get_all("Project-URL", []) == [f"{name}, {address}" for name, address in given.items()]
        assert about.get_payload() == (ROOT / "README.md").read_text()


def test_all_else_is_packed_as_it_is(project: Path) -> None:
    """The rest of the manifest and of bl_info is the same with addresses and without."""
    with_links, without = pack(project, ALL), pack(project, {})
    for some, none in zip(with_links.manifests, without.manifests, strict=True):
        assert {key: value for key, value in some.items() if key != "website"} == none
    for some, none in zip(with_links.infos, without.infos, strict=True):
        assert {key: value for key, value in some.items() if key not in links(some)} == none
    assert set(without.manifests[0]["platforms"]) == {"linux-x64", "windows-x64"}
    assert without.manifests[0]["permissions"] and len(without.manifests[1]["wheels"]) == len(MODULES)


def test_the_checkout_has_no_address() -> None:
    """So that only the packing writes them."""
    assert "website" not in tomllib.loads((ROOT / "addon/blender_manifest.toml").read_text())
    assert not links(bl_info((ROOT / "addon/__init__.py").read_text()))


@pytest.mark.parametrize("entry", [
    *({"Homepage": address} for address in (
        "http://example.org", "javascript:alert(1)", "file:///etc/passwd", "", "https://", "https://localhost",
        "https://user:secret@example.org", "https://example.org@other.org/", "https://example.org/a b",
        "https://example.org/\"", "https://example.org/'", "https://example.org/\\", "https://example.org/<b>",
        "https://example.org/\n", "https://example.org/\x07", "https://ex\u00e4mple.org", " https://example.org",
        "https://example.org/" + "a" * 200, 7, ["https://example.org"])),
    {"Hompage": "https://example.org"}, {"issues": "https://example.org"}], ids=lambda entry: ascii(entry)[:50])
@pytest.mark.parametrize("command", [(".ci/package.py", "linux"), ("-c", ABOUT)], ids=["package", "wheel"])
def test_a_bad_address_stops_the_packing_with_a_sentence(project: Path, command: tuple[str, ...],
                                                         entry: dict) -> None:
    give(project, entry)
    env = os.environ | {"XDG_CACHE_HOME": str(project / "build/cache")}  # where packing that goes on would build
    result = subprocess.run([sys.executable, "-B", *command], cwd=project, env=env, timeout=20, text=True,
                            capture_output=True)
    assert result.returncode == 1 and not result.stdout
    assert re.fullmatch(r"pyproject\.toml, \[project\.urls\], '\w+': [^\n]*\.\n", result.stderr), result.stderr
    assert not [path for path in (project / "build").rglob("*") if path.is_file()]
