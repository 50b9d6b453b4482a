"""The files of the project, as the rules look at them: what git tracks or would track."""
import subprocess
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


@cache
def files() -> tuple[Path, ...]:
    """Every file of the project, relative to its root."""
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard", "-z"]
    listing = subprocess.run(command, cwd=ROOT, check=True, text=True, stdout=subprocess.PIPE).stdout
    return tuple(sorted(Path(name) for name in set(listing.split("\0")) if name and (ROOT / name).is_file()))


def cpp_files(*suffixes: str) -> list[Path]:
    """C++ files of native and tests; all of them, or those with the suffixes."""
    wanted = suffixes or (".h", ".cpp")
    return [file for file in files() if file.parts[0] in ("native", "tests") and file.suffix in wanted]


def python_files(folder: str = "") -> list[Path]:
    """Python files below a folder."""
    return [file for file in files() if file.suffix == ".py" and file.as_posix().startswith(folder)]
