"""Makes build/repository, which any static host serves as a repository of Blender extensions, of what package.py made.

In it: a zip for each platform, the listing that Blender reads (index.json) and one for people (index.html), the zips
for Blender 3.4 to 4.1 in a folder of their own, and the hashes of all. Blender's own command line makes zips and
listing, that of the oldest Blender here that knows extensions; this one and the newest validate. Needs root, as the
matrix does.

    .ci/release.py [--test]

--test: then in a window of both Blenders the repository is added by an address on this machine; the add-on is installed
from it, used, updated to a version 0.2.0 that is made for it, which asks for a new session, and removed. Blender 3.4
installs and enables the zip for older ones.
"""
import argparse
import hashlib
import os
import shutil
import sys
import zipfile
from pathlib import Path

from debian import Unavailable, output
from matrix import NAME, ROOT, inside, install, ready_root
from matrix import USER as LEGACY_USER
from wheel import version, write_wheel

sys.path.insert(0, str(ROOT / "tests"))

from suites import NO_ARCHIVE, Counts, crashed, run_reporting, window_command  # noqa: E402  (found through the line above)

BUILD = ROOT / "build/package"
REPOSITORY = ROOT / "build/repository"
SUITES = ("trixie", "sid")  # Blender 4.3, 5.2
LEGACY_SUITE = "bookworm"   # Blender 3.4, which takes a zip, but no repository
ENABLES = f"import bpy; bpy.ops.preferences.addon_enable(module='{NAME}'); bpy.ops.reflines.smooth.get_rna_type()"
PLACE = "release"  # of all this in a root
USER = f"/{PLACE}/blender_user"
NEXT = "0.2.0"
TEST = "tests/repository/test_repository.py"


def extension_command(root: Path, *arguments: str) -> str:
    """What Blender's command line for extensions prints; its output tells of a failure."""
    return output(*inside(root, "blender", "--command", "extension", *arguments))


def make_repository(root: Path, extension: Path, name: str) -> Path:
    """Makes the zips of an extension's folder and their listing, in a folder of the root."""
    source, repository = root / PLACE / "extension", root / PLACE / name
    shutil.rmtree(source, ignore_errors=True)
    shutil.copytree(extension, source)
    repository.mkdir(parents=True)
    extension_command(root, "build", "--split-platforms", "--source-dir", f"/{PLACE}/extension",
                      "--output-dir", f"/{PLACE}/{name}")
    extension_command(root, "server-generate", "--html", "--repo-dir", f"/{PLACE}/{name}")
    return repository


def validate(repository: Path) -> None:
    for suite in SUITES:
        root = ready_root(suite)
        for package in sorted(repository.glob("*.zip")):
            (root / PLACE).mkdir(exist_ok=True)
            shutil.copy(package, root / PLACE)
            said = extension_command(root, "validate", f"/{PLACE}/{package.name}")
            print(f"{package.name}, by the Blender of {suite}: {said.strip().splitlines()[-1]}")


def write_hashes(folder: Path) -> None:
    """In the form that `sha256sum --check` reads."""
    files = sorted(path for path in folder.rglob("*.zip"))
    lines = [f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.relative_to(folder)}" for path in files]
    (folder / "SHA256SUMS").write_text("\n".join([*lines, ""]))


def release() -> None:
    root = ready_root(SUITES[0])
    shutil.rmtree(root / PLACE, ignore_errors=True)
    made = make_repository(root, BUILD / "extension", "repository")
    validate(made)
    shutil.rmtree(REPOSITORY, ignore_errors=True)
    shutil.copytree(made, REPOSITORY)
    (REPOSITORY / "legacy").mkdir()
    for package in BUILD.glob(f"{NAME}-{version()}*.zip"):
        shutil.copy(package, REPOSITORY / "legacy")
    write_hashes(REPOSITORY)
    for path in sorted(path for path in REPOSITORY.rglob("*") if path.is_file()):
        print(f"{path.relative_to(ROOT)}: {path.stat().st_size / 1e6:.2f} MB")


def next_version(folder: Path) -> Path:
    """A copy of the extension's folder as of a later version: another number, other libraries of the same code."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(BUILD / "extension", folder)
    for wheel in sorted((folder / "wheels").iterdir()):
        _, _, python, _, platform = wheel.stem.split("-")
        with zipfile.ZipFile(wheel) as archive:
            name = next(name for name in archive.namelist() if name.startswith("reflines."))
            library = folder / name
            library.write_bytes(archive.read(name) + b"another build")
        write_wheel(wheel.parent, library, python, platform, NEXT)
        library.unlink()
        wheel.unlink()
    manifest = folder / "blender_manifest.toml"
    manifest.write_text(manifest.read_text().replace(version(), NEXT))
    start = folder / "__init__.py"
    start.write_text(start.read_text().replace(*(str(tuple(map(int, each.split(".")))) for each in (version(), NEXT))))
    return folder


def copy_tests(root: Path) -> None:
    for name in ("tests", "pyproject.toml", "blend_samples"):
        shutil.rmtree(root / PLACE / name, ignore_errors=True)
        (shutil.copytree if (ROOT / name).is_dir() else shutil.copy)(ROOT / name, root / PLACE / name)


def test_in(suite: str, older: Path, newer: Path) -> Counts:
    """Runs the test in a window of a suite's Blender, with both repositories beside it."""
    root = ready_root(suite)
    copy_tests(root)
    for repository, name in ((older, "older"), (newer, "newer")):
        shutil.rmtree(root / PLACE / name, ignore_errors=True)
        shutil.copytree(repository, root / PLACE / name)
    shutil.rmtree(root / USER[1:], ignore_errors=True)
    # The X server does not tell a parent that is process 1 of its name space when it is ready.
    shell = ["sh", "-c", '"$@"; exit $?', "sh"]
    script = [f"/{PLACE}/tests/in_blender.py", "--", TEST, f"/{PLACE}/older", f"/{PLACE}/newer"]
    command = [*shell, *window_command(800, 600, 60), "--python-exit-code", "1", "--python", *script]
    env = {"BLENDER_USER_RESOURCES": USER, "LIBGL_ALWAYS_SOFTWARE": "1"}
    counts = run_reporting(inside(root, *command, env=env), os.environ, 600, f"{suite}: ")
    print(f"{suite}: {counts}", flush=True)
    return counts


def test_legacy_zip() -> Counts:
    """Installs and enables the repository's zip for older Blenders in one of these."""
    root = ready_root(LEGACY_SUITE)
    (root / "src").mkdir(exist_ok=True)
    options = ["-b", "--factory-startup", "--python-exit-code", "1", "--python-expr", ENABLES]
    try:
        install(root, REPOSITORY / f"legacy/{NAME}-{version()}.zip")
        output(*inside(root, "blender", *options, env={"BLENDER_USER_RESOURCES": LEGACY_USER}))
    except (RuntimeError, Unavailable) as error:
        return crashed(f"{LEGACY_SUITE}: {error}")
    print(f"{LEGACY_SUITE}: installed from {REPOSITORY.name}/legacy and enabled", flush=True)
    return Counts(passed=1)


def test() -> Counts:
    root = ready_root(SUITES[0])
    newer = make_repository(root, next_version(root / PLACE / "next"), "repository-next")
    return sum((test_in(suite, REPOSITORY, newer) for suite in SUITES), test_legacy_zip())


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--test", action="store_true")
    wanted = parser.parse_args()
    try:
        release()
        counts = test() if wanted.test else Counts()
    except Unavailable as reason:
        print(f"release: {reason}")
        return NO_ARCHIVE if not wanted.test else 1
    if wanted.test:
        print(counts)
    return 0 if counts.failed == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
