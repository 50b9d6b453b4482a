"""Loads the native module `reflines`, which other modules take from here, and describes why it cannot be loaded."""
import sys
import sysconfig
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.machinery import EXTENSION_SUFFIXES, ExtensionFileLoader
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

from . import library_copy

if TYPE_CHECKING:
    from .reflines import CageOptimizer as CageOptimizer
    from .reflines import Handle as Handle
    from .reflines import HandleReach as HandleReach
    from .reflines import LineHandles as LineHandles
    from .reflines import NormalFit as NormalFit
    from .reflines import Progress as Progress
    from .reflines import Report as Report
    from .reflines import ShapeOptimizer as ShapeOptimizer
    from .reflines import SmoothPanelReport as SmoothPanelReport
    from .reflines import Subdivision as Subdivision
    from .reflines import Target as Target

HERE = Path(__file__).resolve().parent


def load_library() -> ModuleType:
    """Loads the module from a copy that no installation overwrites.

    Each content is loaded once in a process, under a name of its own that survives reloads of the add-on.
    """
    library = next((HERE / f"reflines{suffix}" for suffix in EXTENSION_SUFFIXES
                    if (HERE / f"reflines{suffix}").is_file()), None)
    if library is None:
        raise ImportError("there is none for this Python")
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
    reflines, _import_error = load_library(), ""
except (ImportError, OSError) as error:
    reflines, _import_error = None, str(error)


@dataclass(frozen=True)
class State:
    """The state of the solver: `problem` and `remedy` are one sentence each, empty where it can be used."""
    problem: str = ""
    remedy: str = ""

    @property
    def usable(self) -> bool:
        return not self.problem


def describe_state() -> State:
    """Describes whether the module is loaded, and if not, why."""
    if reflines is not None:
        return State()
    python = sysconfig.get_python_version()
    built = sorted(path.name for path in HERE.glob("reflines.*") if path.suffix in {".so", ".pyd"})
    if not built:
        return State("The native solver is missing from the add-on's folder.",
                     f"Install the add-on from its zip package, which has the solver for Python {python}.")
    if not any(name == "reflines" + suffix for name in built for suffix in EXTENSION_SUFFIXES):
        return State(f"The native solver ({', '.join(built)}) is for another Python than this Blender's {python}.",
                     f"Install the package of the add-on that has the solver for Python {python}.")
    return State(f"The native solver cannot be loaded: {_import_error}.",
                 "Install the missing library it names, or install the add-on's zip package again.")


STATE = describe_state()
if STATE.usable:
    InvalidInput = reflines.InvalidInput
    SolverFailure = reflines.SolverFailure
    Cancelled = reflines.Cancelled
