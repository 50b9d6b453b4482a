"""Enables the add-on of this checkout, without installing it."""
import importlib.util
import pathlib
import sys
import types

ROOT = pathlib.Path(__file__).resolve().parent.parent
NAME = "reflection_lines"


def enable_add_on() -> types.ModuleType:
    """Registers the folder addon/ as the package `reflection_lines`; a second call finds it there."""
    if NAME in sys.modules:
        return sys.modules[NAME]
    folder = ROOT / "addon"
    main = folder / "__init__.py"
    place = importlib.util.spec_from_file_location(NAME, main, submodule_search_locations=[str(folder)])
    add_on = importlib.util.module_from_spec(place)
    sys.modules[NAME] = add_on
    place.loader.exec_module(add_on)
    add_on.register()
    return add_on
