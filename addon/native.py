"""The one door to the native module `reflines`, and what to tell the user where it does not open."""
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
    from .reflines import NormalFit as NormalFit
    from .reflines import Progress as Progress
    from .reflines import Report as Report
    from .reflines import ShapeOptimizer as ShapeOptimizer
    from .reflines import SmoothPanelReport as SmoothPanelReport
    from .reflines import Subdivision as Subdivision
    from .reflines import Target as Target

HERE = Path(__file__).resolve().parent


def loaded() -> ModuleType:
    """From a copy that no installation overwrites. Each content once in a process, under a name of its own that no
    reload of the add-on forgets."""
    library = next((HERE / f"reflines{suffix}" for suffix in EXTENSION_SUFFIXES
                    if (HERE / f"reflines{suffix}").is_file()), None)
    if library is None:
        raise ImportError("there is none for this Python")
    digest = library_copy.digest_of(library)
    name = f"reflines_{digest}.reflines"
    if name in sys.modules:
        return sys.modules[name]
    sys.modules[name] = first_loaded(library_copy.copies(library, digest), name)
    return sys.modules[name]


def first_loaded(paths: Iterator[Path], name: str) -> ModuleType:
    """No code may be run from some cache folders."""
    failure = ImportError(name)
    for path in paths:
        try:
            return loaded_from(path, name)
        except ImportError as error:
            failure = error
    raise failure


def loaded_from(path: Path, name: str) -> ModuleType:
    spec = spec_from_file_location(name, path, loader=ExtensionFileLoader(name, str(path)))
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


try:
    reflines, _import_error = loaded(), ""
except (ImportError, OSError) as error:
    reflines, _import_error = None, str(error)


@dataclass(frozen=True)
class State:
    """Whether the solver can be used. `problem` and `remedy` are one sentence each, empty where all is well."""
    problem: str = ""
    remedy: str = ""

    @property
    def usable(self) -> bool:
        return not self.problem


def state() -> State:
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


STATE = state()
if STATE.usable:
    InvalidInput = reflines.InvalidInput
    SolverFailure = reflines.SolverFailure
    Cancelled = reflines.Cancelled
