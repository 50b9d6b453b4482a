"""Makes what a user installs, in build/package: zips for Linux and Windows, wheels, and the folder of the extension.

    .ci/package.py [linux]

linux: leaves Windows out. Modules for Windows are those that .ci/windows.py has linked into build/package/windows.

A zip has one top-level folder, so that Blender 3.4 takes it as a legacy add-on and 4.2 and later as an extension,
with the native module once for each Python side by side. The folder of the extension has the module as wheels instead,
as Blender wants it from 4.2 on; `./run release` makes a repository of it. Headers of the Pythons come from the Debian
suites that have them: 3.11 and 3.13 are those of Blender 4.1 to 5.0 and of 5.1 and later from blender.org, too
(Blender's manual, "Python Wheels"). No suite has those of 3.10, which Blender 3.4 to 4.0 from there embed: they are
taken from a python3.10 of this machine where there is one.

One compiler and one C library, those of this machine, serve all. SuiteSparse, METIS, OpenBLAS, OpenSubdiv and libstdc++
are inside the module and show no symbol outside, so that they cannot meet Blender's own copies. libgomp stays outside:
two OpenMP runtimes in one process fight over the cores, and Blender's own libraries bring it.
"""
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

from debian import CACHE, Suite, Unavailable, output
from static_libraries import static_libraries
from wheel import version, write_wheel, write_zip

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build/package"
NAME = "reflection_lines"
SUITES = ("bookworm", "trixie", "sid")  # Blender 3.4, 4.3, 5.2
NEWEST_GLIBC = 28  # 2.28, which Blender's own builds need
PLATFORMS = {".so": f"manylinux_2_{NEWEST_GLIBC}_x86_64", ".pyd": "win_amd64"}  # of wheels
BLENDER_PLATFORMS = {".so": "linux-x64", ".pyd": "windows-x64"}
NO_ARCHIVE = 75  # the exit code that says so, "try again later"
ALLOWED = {"libm.so.6", "libc.so.6", "libgomp.so.1", "ld-linux-x86-64.so.2"}


def headers(suite: Suite) -> str:
    """"TAG|folder|folder...": the tag of the suite's Python, and where its headers and pybind11's are."""
    folder = CACHE / "python" / suite.name
    stamp = folder / "version"
    if not (folder / "pybind11").exists():
        shutil.rmtree(folder, ignore_errors=True)
        suite.update()
        version = suite.python()
        suite.unpack([f"libpython{version}-dev"], folder)
        suite.unpack_pybind11(folder / "pybind11")
        stamp.write_text(version)
    version = stamp.read_text()
    include = folder / "usr/include"
    own = [include / f"python{version}", folder / "pybind11/usr/include", include, include / "x86_64-linux-gnu"]
    return "|".join([version.replace(".", ""), *map(str, own)])


def headers_of_python_3_10() -> list[str]:
    """The same of a python3.10 of this machine; none where there is none."""
    try:
        folder = output("python3.10", "-c", "import sysconfig; print(sysconfig.get_path('include'))").strip()
    except (OSError, Unavailable):
        print("no python3.10 on this machine: Blender 3.4 to 4.0 from blender.org are left out")
        return []
    return ["|".join(["310", folder, str(CACHE / "python" / SUITES[0] / "pybind11/usr/include")])]


def configure(pythons: list[str], prefix: Path) -> None:
    given = {"CMAKE_PREFIX_PATH": prefix, "REFLINES_PACKAGE_PYTHONS": ";".join(pythons)}
    output("cmake", "--preset", "package-linux", *(f"-D{name}={value}" for name, value in given.items()), cwd=ROOT)


def modules(pythons: list[str]) -> list[Path]:
    """Builds the module for each set of headers; one of an earlier run for another Python is left out."""
    subprocess.run(["cmake", "--build", BUILD / "cmake"], check=True)
    tags = {python.split("|")[0] for python in pythons}
    built = sorted((BUILD / "cmake").rglob("reflines.cpython-*.so"))
    return [path for path in built if path.name.split("-")[1] in tags]


def check(module: Path) -> str:
    """What the module asks of the machine it runs on; refuses one that asks for more than it may."""
    newest = max(int(minor) for minor in re.findall(r"GLIBC_2\.(\d+)", output("readelf", "-V", module)))
    needed = set(re.findall(r"NEEDED.*\[(.*)\]", output("readelf", "-d", module)))
    shown = {line.split()[-1] for line in output("nm", "-D", "--defined-only", module).splitlines()}
    if needed - ALLOWED or shown != {"PyInit_reflines"}:
        sys.exit(f"{module.name} needs {needed - ALLOWED} and shows {sorted(shown)[:5]}")
    if newest > NEWEST_GLIBC:
        newer = re.findall(rf"GLIBC_2\.{newest}\S* +\S+", output("objdump", "-T", module))
        sys.exit(f"{module.name} needs glibc 2.{newest}: {newer}; see .ci/package/older_glibc.c")
    size = module.stat().st_size / 1e6
    return f"{module.name}: {size:.1f} MB, glibc 2.{newest} or newer, {', '.join(sorted(needed))}"


def addon_files() -> list[Path]:
    listing = output("git", "ls-files", "--cached", "--others", "--exclude-standard", "addon", cwd=ROOT)
    return [ROOT / name for name in sorted(set(listing.splitlines())) if (ROOT / name).is_file()]


def addon_content() -> dict[Path, bytes]:
    """Returns the files that each package has, by their places in its folder; the manifest is that of the checkout."""
    inside = {file.relative_to(ROOT / "addon"): file.read_bytes() for file in addon_files()}
    return inside | {Path("LICENSE"): (ROOT / "LICENSE").read_bytes()}


def windows_modules() -> list[Path]:
    return sorted((BUILD / "windows").glob("reflines.cp*.pyd"))


def manifest(modules: list[Path], wheels: list[Path]) -> str:
    """The add-on's manifest, for the platforms of these modules, and with the names of wheels where there are any."""
    platforms = ", ".join(f'"{BLENDER_PLATFORMS[suffix]}"' for suffix in sorted({path.suffix for path in modules}))
    text = (ROOT / "addon/blender_manifest.toml").read_text()
    head, tables = re.sub(r"platforms = \[.*\]", f"platforms = [{platforms}]", text).split("\n[", maxsplit=1)
    rows = "".join(f'  "./wheels/{wheel.name}",\n' for wheel in wheels)
    return head + (f"wheels = [\n{rows}]\n" if wheels else "") + f"\n[{tables}"


def make_zip(path: Path, built: list[Path]) -> Path:
    inside = addon_content() | {Path("blender_manifest.toml"): manifest(built, []).encode()}
    inside |= {Path(module.name): module.read_bytes() for module in built}
    write_zip(path, {f"{NAME}/{name.as_posix()}": content for name, content in inside.items()})
    return path


def make_wheels(built: list[Path]) -> list[Path]:
    folder = BUILD / "wheels"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    pythons = [re.search(r"reflines\.(?:cpython-|cp)(\d+)-", module.name)[1] for module in built]
    return [write_wheel(folder, module, f"cp{python}", PLATFORMS[module.suffix])
            for module, python in zip(built, pythons, strict=True)]


def make_extension(built: list[Path], wheels: list[Path]) -> Path:
    """The folder that `blender --command extension build` takes: the add-on, the wheels, a manifest that names them."""
    folder = BUILD / "extension"
    shutil.rmtree(folder, ignore_errors=True)
    for name, content in addon_content().items():
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(content)
    (folder / "wheels").mkdir()
    for wheel in wheels:
        shutil.copy(wheel, folder / "wheels")
    (folder / "blender_manifest.toml").write_text(manifest(built, wheels))
    return folder


def main() -> None:
    start = time.monotonic()
    os.environ.setdefault("CCACHE_NOHASHDIR", "1")
    try:
        pythons = [headers(Suite(name)) for name in SUITES]
        pythons += headers_of_python_3_10()
        configure(pythons, static_libraries())
    except Unavailable as reason:
        print(f"no package, Debian's archive cannot be had: {reason}")
        sys.exit(NO_ARCHIVE)
    built = modules(pythons)
    for module in built:
        print(check(module))
    for older in BUILD.glob(f"{NAME}-*.zip"):
        older.unlink()
    zips = [make_zip(BUILD / f"{NAME}-{version()}.zip", built)]
    windows = windows_modules() if sys.argv[1:] != ["linux"] else []
    if windows:
        zips.append(make_zip(BUILD / f"{NAME}-{version()}-windows.zip", windows))
    print(f"{make_extension(built + windows, make_wheels(built + windows)).relative_to(ROOT)}: for ./run release")
    for path in zips:
        print(f"{path.relative_to(ROOT)}: {path.stat().st_size / 1e6:.1f} MB, {time.monotonic() - start:.0f} s")


if __name__ == "__main__":
    main()
