"""Tests the package in the Blender of each Debian: 3.4 in bookworm, 4.3 in trixie, 5.2 in sid.

Each suite of Debian gets a root of its own by debootstrap, kept in the cache folder, with Blender and what the tests
need, but without the libraries that the solver is made of. There the package is installed as a user would, and the
tests run against what was installed; the add-on's source is not there at all. A suite whose archive cannot be had
counts as skipped. Needs root.

    .ci/matrix.py [SUITE...]
"""
import argparse
import hashlib
import os
import shutil
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from debian import CACHE, Unavailable, mirror, output
from wheel import version

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests"))

from suites import Counts, crashed, run_reporting  # noqa: E402  (found through the line above)

NAME = "reflection_lines"
TESTS = ("bindings", "addon", "ui")
USER = "/root/blender_user"
APT = ["env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "-q", "-y", "-oAcquire::Check-Valid-Until=false"]
# What Blender's own Python scripts need in sid although the package does not ask for it.
ALSO = {"sid": ["python3-cattr", "python3-requests"]}


@dataclass(frozen=True)
class Installation:
    """How Blender knows the add-on that was installed from the package, and where it lies in the root."""
    module: str
    folder: str


def packages(suite: str, sections: tuple[str, ...]) -> list[str]:
    """The packages of sections of the list; with Blender, also what it needs in a suite."""
    wanted, found = False, []
    for line in (ROOT / ".ci/packages").read_text().splitlines():
        if line.startswith("["):
            wanted = line.strip("[]") in sections
        elif wanted and line:
            found.append(line.split()[0])
    return found + (ALSO.get(suite, []) if "blender" in sections else [])


def inside(root: Path, *command: str, env: dict[str, str] | None = None) -> list[str]:
    """The command line that runs a command in a root, in name spaces of its own, which end with it."""
    settings = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "LANG": "C.UTF-8", **(env or {})}
    given = [f"{name}={value}" for name, value in settings.items()]
    mounted = 'mount --rbind /dev "$0/dev" && exec chroot "$0" "$@"'
    return ["unshare", "--mount", "--pid", "--fork", "--kill-child", f"--mount-proc={root / 'proc'}",
            "sh", "-c", mounted, str(root), "env", "-i", *given, *command]


def ready_root(suite: str, purpose: str = "matrix", sections: tuple[str, ...] = ("arrays", "blender", "window"),
               single: tuple[str, ...] = ()) -> Path:
    """The root of a suite for a purpose; made where the cache has none for these sections and single packages."""
    root = CACHE / purpose / suite
    stamp = root.with_suffix(".packages")
    wanted = [*packages(suite, sections), *single]
    recipe = hashlib.sha256(" ".join(wanted).encode()).hexdigest()
    if not (root / "etc/debian_version").exists():
        print(f"{suite}: debootstrap", flush=True)
        shutil.rmtree(root, ignore_errors=True)
        fresh = root.with_name(suite + ".part")
        shutil.rmtree(fresh, ignore_errors=True)
        fresh.mkdir(parents=True)
        output("debootstrap", "--variant=minbase", suite, fresh, mirror())
        fresh.rename(root)
    output(*inside(root, "true"))  # raises where this machine allows no name spaces
    if not stamp.exists() or stamp.read_text() != recipe:
        print(f"{suite}: installing {wanted[0]} and others", flush=True)
        output(*inside(root, *APT, "update"))
        output(*inside(root, *APT, "install", "--no-install-recommends", *wanted))
        output(*inside(root, *APT, "clean"))
        stamp.write_text(recipe)
    return root


def copy_tests(root: Path) -> None:
    """Everything but the add-on's and the solver's source."""
    shutil.rmtree(root / "src", ignore_errors=True)
    names = output("git", "ls-files", "--cached", "--others", "--exclude-standard", cwd=ROOT).splitlines()
    for name in [name for name in names if not name.startswith(("addon/", "native/")) and (ROOT / name).is_file()]:
        target = root / "src" / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, target)


def blender_version(root: Path) -> tuple[int, int]:
    major, minor = output(*inside(root, "blender", "--version")).split()[1].split(".")[:2]
    return int(major), int(minor)


def install(root: Path, package: Path) -> Installation:
    """Installs the package as a user does: from the file, by the preferences or, from 4.2 on, as an extension."""
    shutil.rmtree(root / USER[1:], ignore_errors=True)
    shutil.copy(package, root / "src" / package.name)
    env = {"BLENDER_USER_RESOURCES": USER}
    if blender_version(root) >= (4, 2):
        options = ["--command", "extension", "install-file", "-r", "user_default", "-e", f"/src/{package.name}"]
        installed = Installation(f"bl_ext.user_default.{NAME}", f"{USER}/extensions/user_default/{NAME}")
    else:
        script = f"import bpy; bpy.ops.preferences.addon_install(filepath='/src/{package.name}')"
        options = ["-b", "--factory-startup", "--python-exit-code", "1", "--python-expr", script]
        installed = Installation(NAME, f"{USER}/scripts/addons/{NAME}")
    said = output(*inside(root, "blender", *options, env=env))
    if not (root / installed.folder[1:] / "__init__.py").exists():
        raise RuntimeError(f"the package was not installed: {said[-500:]}")
    return installed


def run_tests(root: Path, installed: Installation) -> Counts:
    env = {"REFLINES_ADDON": installed.module, "REFLINES_FOLDER": installed.folder, "BLENDER_USER_RESOURCES": USER}
    return run_reporting(inside(root, "/usr/bin/python3", "/src/tests/suites.py", *TESTS, env=env), os.environ, 1800)


def test_suite(suite: str, package: Path) -> Counts:
    start = time.monotonic()
    try:
        root = ready_root(suite)
    except Unavailable as reason:
        print(f"{suite}: skipped, its archive cannot be had: {reason}")
        return Counts(skipped=1)
    prepared = time.monotonic()
    copy_tests(root)
    try:
        counts = run_tests(root, install(root, package))
    except (RuntimeError, Unavailable) as error:
        counts = crashed(f"{suite}: {error}")
    print(f"{suite}: {counts} (root {prepared - start:.0f} s, tests {time.monotonic() - prepared:.0f} s)", flush=True)
    return counts


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("suites", nargs="*", default=["bookworm", "trixie", "sid"])
    arguments = parser.parse_args()
    package = ROOT / "build/package" / f"{NAME}-{version()}.zip"
    if not package.is_file():
        sys.exit("no package in build/package: ./run package")
    total = Counts()
    for suite in arguments.suites:
        total += test_suite(suite, package)
    print(total)
    return 0 if total.failed == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
