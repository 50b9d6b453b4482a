"""The one door to the native module `reflines`, and what to tell the user where it does not open."""
import sysconfig
from dataclasses import dataclass
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path

try:
    from . import reflines
except ImportError as error:
    reflines = None
    _import_error = str(error)
else:
    _import_error = ""

HERE = Path(__file__).resolve().parent


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
