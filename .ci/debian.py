"""Debian's archive as this machine's apt reaches it, asked for any suite by a private apt beside the machine's own."""
import os
import re
import subprocess
from dataclasses import dataclass
from pathlib import Path

KEYS = "/usr/share/keyrings/debian-archive-keyring.gpg"
CACHE = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "reflection_lines"
BUILT_WITH = "bookworm"  # the suite whose libraries go into the package


class Unavailable(Exception):
    """The archive, or one suite of it, cannot be had. The text says why."""


def output(*command: str | Path, cwd: Path | None = None) -> str:
    result = subprocess.run(command, cwd=cwd, text=True, capture_output=True)
    if result.returncode != 0:
        raise Unavailable(f"{' '.join(map(str, command[:3]))} ...: {result.stderr.strip()[-400:]}")
    return result.stdout


def mirror() -> str:
    """The address from which this machine installs Debian's main component."""
    wanted = ["--format", "$(ORIGIN) $(LABEL) $(COMPONENT) $(SITE)", "Identifier: Packages"]
    for line in output("apt-get", "indextargets", *wanted).splitlines():
        origin, label, component, site = line.split(maxsplit=3)
        if (origin, label, component) == ("Debian", "Debian", "main"):
            return site
    raise Unavailable("no source of Debian's main component in this machine's apt; apt-get update may be missing")


@dataclass(frozen=True)
class Suite:
    """One suite (bookworm, trixie, sid) and the folder in which its private apt lives."""
    name: str

    @property
    def folder(self) -> Path:
        return CACHE / "apt" / self.name

    def options(self) -> list[str]:
        state = {"Dir::Etc::sourcelist": "sources.list", "Dir::Etc::sourceparts": "none", "Dir::State": "state",
                 "Dir::State::status": "status", "Dir::Cache": "cache"}
        places = [f"-o{key}={self.folder / path}" for key, path in state.items()]
        return [*places, "-oAPT::Sandbox::User=root", "-oAcquire::Check-Valid-Until=false", "-oAcquire::Languages=none"]

    def update(self) -> None:
        for part in ("state/lists/partial", "cache/archives/partial", "none"):
            (self.folder / part).mkdir(parents=True, exist_ok=True)
        (self.folder / "status").touch()
        source = f"[signed-by={KEYS}] {mirror()} {self.name} main\n"
        (self.folder / "sources.list").write_text(f"deb {source}deb-src {source}")
        output("apt-get", *self.options(), "update", "-q")

    def unpack(self, packages: list[str], into: Path) -> None:
        """Unpacks binary packages into a folder, installing nothing."""
        into.mkdir(parents=True, exist_ok=True)
        output("apt-get", *self.options(), "download", "-q", *packages, cwd=self.folder)
        for package in packages:
            for archive in self.folder.glob(f"{package}_*.deb"):
                output("dpkg-deb", "-x", archive, into)
                archive.unlink()

    def source(self, package: str, into: Path) -> Path:
        """Unpacks a source package without Debian's patches; returns its folder."""
        into.mkdir(parents=True, exist_ok=True)
        output("apt-get", *self.options(), "source", "-q", "--download-only", package, cwd=into)
        description = next(into.glob(f"{package}_*.dsc"))
        output("dpkg-source", "--no-check", "--skip-patches", "-x", description, into / package)
        return into / package

    def unpack_pybind11(self, into: Path) -> Path:
        """Unpacks pybind11's headers for the suite's Python; returns the folder with them.

        Those of bookworm, 2.10, would read numpy 2's arrays as numpy 1's; trixie's serve both.
        """
        suite = Suite("trixie") if self.name == "bookworm" else self
        suite.update()
        suite.unpack(["pybind11-dev"], into)
        return into / "usr/include"

    def python(self) -> str:
        """The version of the suite's Python: "3.13"."""
        depends = output("apt-cache", *self.options(), "depends", "python3-dev")
        return re.search(r"Depends: python(3\.\d+)-dev", depends)[1]
