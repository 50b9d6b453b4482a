"""Packs a built module `reflines` as a wheel: the library, its types, and what a wheel says of itself."""
import base64
import hashlib
import re
import tomllib
import zipfile
from collections.abc import Mapping
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def version() -> str:
    return re.search(r"VERSION (\d+\.\d+\.\d+)", (ROOT / "CMakeLists.txt").read_text())[1]


def metadata(number: str) -> str:
    """What the table [project] of pyproject.toml says, in the words of a wheel."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {number}",
             f"Summary: {project['description']}", f"License: {project['license']['text']}",
             f"Requires-Python: {project['requires-python']}"]
    lines += [f"Requires-Dist: {name}" for name in project["dependencies"]]
    lines += [f"Project-URL: {name}, {address}" for name, address in project.get("urls", {}).items()]
    return "\n".join([*lines, "Description-Content-Type: text/markdown", "", (ROOT / project["readme"]).read_text()])


def write_zip(path: Path, inside: Mapping[str, bytes]) -> None:
    """The same content gives the same bytes: names sorted, one date."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, content in sorted(inside.items()):
            entry = zipfile.ZipInfo(name, (2000, 1, 1, 0, 0, 0))
            entry.external_attr = (0o100755 if name.endswith((".so", ".pyd")) else 0o100644) << 16
            archive.writestr(entry, content, zipfile.ZIP_DEFLATED, 9)


def record_line(name: str, content: bytes) -> str:
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(content)}"


def about_files(tag: str, number: str) -> dict[str, bytes]:
    """The files of the folder reflines-VERSION.dist-info but the record."""
    wheel = f"Wheel-Version: 1.0\nGenerator: reflines\nRoot-Is-Purelib: false\nTag: {tag}\n"
    return {"METADATA": metadata(number).encode(), "WHEEL": wheel.encode(), "LICENSE": (ROOT / "LICENSE").read_bytes()}


def write_wheel(folder: Path, library: Path, python: str, platform: str, number: str = "") -> Path:
    """Writes the wheel of a library for one Python, "cp313", and one platform, "linux_x86_64"; returns its path.

    The number is the version, this project's if there is none."""
    number = number or version()
    about, tag = f"reflines-{number}.dist-info", f"{python}-{python}-{platform}"
    inside = {f"{about}/{name}": content for name, content in about_files(tag, number).items()}
    inside |= {library.name: library.read_bytes(),
               "reflines-stubs/__init__.pyi": (ROOT / "native/python/reflines.pyi").read_bytes()}
    lines = [record_line(name, content) for name, content in sorted(inside.items())]
    inside[f"{about}/RECORD"] = "\n".join([*lines, f"{about}/RECORD,,", ""]).encode()
    path = folder / f"reflines-{number}-{tag}.whl"
    write_zip(path, inside)
    return path
