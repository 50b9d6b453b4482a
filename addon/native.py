"""Loads the native module `reflines`, which other modules take from here, and describes why it cannot be loaded.

In an extension it is the wheel's, imported as any module; a zip for older Blenders has it beside this file.
"""
import re
import sys
import sysconfig
from collections.abc import Iterator
from dataclasses import dataclass
from importlib import import_module, invalidate_caches
from importlib.machinery import EXTENSION_SUFFIXES, ExtensionFileLoader
from importlib.util import find_spec, module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

from . import bl_info, library_copy

if TYPE_CHECKING:
    from .reflines import CageOptimizer as CageOptimizer
    from .reflines import Handle as Handle
    from .reflines import HandleFollower as HandleFollower
    from .reflines import HandleResidual as HandleResidual
    from .reflines import LineHandles as LineHandles
    from .reflines import NormalFit as NormalFit
    from .reflines import Note as Note
    from .reflines import PanelCheck as PanelCheck
    from .reflines import PanelInspection as PanelInspection
    from .reflines import PanelSmoother as PanelSmoother
    from .reflines import Progress as Progress
    from .reflines import Report as Report
    from .reflines import ShapeOptimizer as ShapeOptimizer
    from .reflines import SmoothPanelReport as SmoothPanelReport
    from .reflines import SolvePanelReport as SolvePanelReport
    from .reflines import Subdivision as Subdivision
    from .reflines import Target as Target
    from .reflines import Task as Task

HERE = Path(__file__).resolve().parent
VERSION = ".".join(map(str, bl_info["version"]))
SYSTEMS = {"win32": "Windows", "darwin": "macOS"}
SYSTEM = SYSTEMS.get(sys.platform, "Linux")
# Words of Windows, macOS and Linux for a library that may not be loaded.
BLOCKED = re.compile(r"Access is denied|Application Control|virus|system policy|code signature|not valid for use|"
                     r"Operation not permitted|Permission denied")


class OtherVersion(ImportError):
    """The module of another version, which a session goes on using after an update of the extension."""


def find_library() -> Path | None:
    """Returns the file of the module beside this one, None where there is none for this Python."""
    beside = (HERE / f"reflines{suffix}" for suffix in EXTENSION_SUFFIXES)
    return next((path for path in beside if path.is_file()), None)


def is_there() -> bool:
    """Returns whether there is a module to load, beside this file or in a wheel."""
    invalidate_caches()  # the wheel may have come in this session
    return find_library() is not None or find_spec("reflines") is not None


def load_module() -> ModuleType:
    """Loads the module: that of the wheel as any other, one beside this file from a copy.

    Blender knows how to replace a wheel whose library is in use; one of an older version is used until it ends.
    """
    library = find_library()
    if library is not None:
        return load_copy(library)
    if not is_there():
        raise ImportError("there is none for this Python")
    module = import_module("reflines")
    if module.__version__ != VERSION:
        raise OtherVersion(module.__version__)
    return module


def load_copy(library: Path) -> ModuleType:
    """Loads a library from a copy that no installation overwrites.

    Each content is loaded once in a process, under a name of its own that survives reloads of the add-on.
    """
    digest = library_copy.compute_digest(library)
    name = f"reflines_{digest}.reflines"
    if name in sys.modules:
        return sys.modules[name]
    sys.modules[name] = load_first(library_copy.find_copies(library, digest), name)
    return sys.modules[name]


def load_first(paths: Iterator[Path], name: str) -> ModuleType:
    """Loads the first file that can be loaded: from some cache folders no code may be run."""
    failure = ImportError(name)
    for path in paths:
        try:
            return load_file(path, name)
        except ImportError as error:
            failure = error
    raise failure


def load_file(path: Path, name: str) -> ModuleType:
    spec = spec_from_file_location(name, path, loader=ExtensionFileLoader(name, str(path)))
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


try:
    reflines, _failure = load_module(), None
except (ImportError, OSError) as error:
    reflines, _failure = None, error


@dataclass(frozen=True)
class State:
    """The state of the solver: `problem` and `remedy` are one sentence each, empty where it can be used."""
    problem: str = ""
    remedy: str = ""

    @property
    def usable(self) -> bool:
        return not self.problem


def find_system(name: str) -> str:
    """Returns the system for which a library of this name is built."""
    if name.endswith(".pyd"):
        return "Windows"
    return "macOS" if "darwin" in name else "Linux"


def describe_state() -> State:
    """Describes whether the module is loaded, and if not, why."""
    if reflines is not None:
        return State()
    if isinstance(_failure, OtherVersion):
        return State(f"The native solver is that of version {_failure} and the add-on's is {VERSION}.",
                     "Start Blender again.")
    if is_there():
        return describe_failure(str(_failure))
    python = sysconfig.get_python_version()
    built = sorted(path.name for path in HERE.glob("reflines.*") if path.suffix in {".so", ".pyd"})
    if not built:
        return State("The native solver is missing from the add-on's folder.",
                     f"Install the add-on from its zip package, which has the solver for Python {python}.")
    systems = sorted({find_system(name) for name in built})
    if SYSTEM not in systems:
        return State(f"The native solver is for {' and '.join(systems)}, and this Blender runs on {SYSTEM}.",
                     f"Install the package of the add-on for {SYSTEM}.")
    return State(f"The native solver ({', '.join(built)}) is for another Python than this Blender's {python}.",
                 f"Install the package of the add-on that has the solver for Python {python}.")


def describe_failure(error: str) -> State:
    """Describes why the system did not load a library that is there and fits."""
    if BLOCKED.search(error):
        remedies = {"Windows": "Allow it in the antivirus program, or ask who looks after this computer.",
                    "macOS": "Allow it in System Settings > Privacy & Security, then start Blender again."}
        return State(f"{SYSTEM} blocks the native solver: {error}.",
                     remedies.get(SYSTEM, "Install the add-on in a folder from which programs may run."))
    if "libgomp" in error:
        return State("The native solver needs the library libgomp, which this system does not have.",
                     "Install its package: libgomp1 in Debian and Ubuntu, libgomp in Fedora, gcc-libs in Arch.")
    return State(f"The native solver cannot be loaded: {error}.",
                 "Install the missing library it names, or install the add-on's zip package again.")


STATE = describe_state()
if STATE.usable:
    InvalidInput = reflines.InvalidInput
    SolverFailure = reflines.SolverFailure
    Cancelled = reflines.Cancelled
