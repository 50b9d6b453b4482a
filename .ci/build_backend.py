"""Builds the wheel of `reflines` where pip asks for it: `pip install .`, by the interfaces of PEP 517.

It is CMake that builds; compiler, Ninja, pybind11 and the solver's libraries are those of the machine (`.ci/packages`,
section `build`). Needs Python 3.11 to build, 3.10 to run.
"""
import subprocess
import sys
import sysconfig
import tarfile
from io import BytesIO
from pathlib import Path

from wheel import ROOT, about_files, metadata, version, write_wheel

Settings = dict[str, str] | None


def run(*command: str | Path) -> None:
    subprocess.run(command, cwd=ROOT, check=True)


def tag() -> tuple[str, str]:
    """The Python that runs this, and its platform: "cp311", "linux_x86_64"."""
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    return f"cp{sys.version_info.major}{sys.version_info.minor}", platform


def prepare_metadata_for_build_wheel(metadata_directory: str, config_settings: Settings = None) -> str:
    python, platform = tag()
    folder = Path(metadata_directory, f"reflines-{version()}.dist-info")
    folder.mkdir()
    for name, content in about_files(f"{python}-{python}-{platform}", version()).items():
        (folder / name).write_bytes(content)
    return folder.name


def build_wheel(wheel_directory: str, config_settings: Settings = None, metadata_directory: str | None = None) -> str:
    """Builds for the Python that runs this; config_settings={"cmake": "-DCHOLMOD=..."} reach CMake."""
    python, platform = tag()
    build = ROOT / "build" / f"wheel-{python}"
    given = (config_settings or {}).get("cmake", "").split()
    run("cmake", "--preset", "wheel", "-B", build, f"-DPython_EXECUTABLE={sys.executable}",
        f"-DREFLINES_MODULE_FOLDER={build / 'module'}", *given)
    run("cmake", "--build", build, "--target", "reflines_python")
    library = build / "module" / f"reflines{sysconfig.get_config_var('EXT_SUFFIX')}"
    return write_wheel(Path(wheel_directory), library, python, platform).name


def build_sdist(sdist_directory: str, config_settings: Settings = None) -> str:
    """Packs what git tracks."""
    listing = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, text=True, stdout=subprocess.PIPE).stdout
    folder = f"reflines-{version()}"
    with tarfile.open(Path(sdist_directory, f"{folder}.tar.gz"), "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for name in sorted(filter(None, listing.split("\0"))):
            archive.add(ROOT / name, f"{folder}/{name}")
        about = metadata(version()).encode()
        entry = tarfile.TarInfo(f"{folder}/PKG-INFO")
        entry.size = len(about)
        archive.addfile(entry, BytesIO(about))
    return f"{folder}.tar.gz"
