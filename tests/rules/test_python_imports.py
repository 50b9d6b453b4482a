"""Who may import whom in addon/, and what no Python file here does."""
import ast
from pathlib import Path

from tree import ROOT, files, python_files

# Module or package of addon/ -> what of addon/ it may import. A package may import itself, `operators` excepted.
MAY_IMPORT = {
    "native": set(),
    "worker": {"native"},
    "targets": {"native"},
    "bridge": {"targets"},
    "tool_settings": {"bridge"},
    "stripe_settings": set(),
    "properties": {"bridge", "tool_settings", "stripe_settings"},
    "panels": {"properties"},
    "stripes_panel": {"panels", "properties"},
    "menus": {"properties"},
    "keymaps": {"properties"},
    "preferences": {"native", "keymaps"},
    "solving": {"native", "bridge", "targets"},
    "session": {"native", "bridge", "solving"},
    "saved": {"session", "solving", "bridge"},
    "tool": {"session", "solving", "bridge", "properties", "targets"},
    "drag.motion": set(),
    "drag.pursuit": {"native", "session", "solving", "bridge"},
    "drag.modal": {"drag.motion", "drag.pursuit", "worker", "overlay.circle", "tool", "session", "solving",
                   "bridge", "targets"},
    "overlay.circle": set(),
    "live": {"drag.pursuit", "worker", "session", "solving", "bridge", "targets"},
    "operators": {"live", "drag.modal", "drag.motion", "tool", "tool_settings", "session", "solving", "bridge",
                  "properties", "targets"},
    "overlay.stripes": set(),
    "overlay.shader": {"overlay.stripes"},
    "overlay.normals": {"overlay.stripes", "native", "worker"},
    "overlay.last_solve": set(),
    "overlay.limit": {"native", "bridge"},
    "overlay.seen": {"overlay.stripes", "bridge", "session", "properties"},
    "overlay.draw": {"overlay.stripes", "overlay.shader", "overlay.normals", "overlay.last_solve", "overlay.limit",
                     "overlay.seen", "native", "bridge", "session", "solving", "properties"},
}
# Registration sees everything; the index of a package sees the package.
INDEXES = {"__init__", "drag.__init__", "live.__init__", "operators.__init__", "overlay.__init__"}

# Module from elsewhere -> the only modules of addon/ that may import it.
WALLS = {"reflines": ("native",), "bmesh": ("bridge",), "gpu": ("overlay",), "gpu_extras": ("overlay",)}
PURE = {"drag.motion": {"bpy", "mathutils"}, "drag.pursuit": {"bpy", "mathutils"},
        "targets": {"bpy", "gpu", "mathutils", "bmesh"}, "overlay.stripes": {"bpy", "gpu", "mathutils", "bmesh"},
        "overlay.shader": {"bpy", "bmesh"}}

FORBIDDEN_NAMES = {"utils", "util", "helpers", "helper", "common", "misc"}
CACHES = {"session", "overlay.draw", "worker"}


def module_name(file: Path) -> str:
    """`addon/overlay/draw.py` -> `overlay.draw`."""
    return ".".join(file.relative_to("addon").with_suffix("").parts)


def parsed(file: Path) -> ast.Module:
    return ast.parse((ROOT / file).read_text(), str(file))


def addon_modules() -> dict[str, ast.Module]:
    return {module_name(file): parsed(file) for file in python_files("addon/")}


def imported_by(module: str, tree: ast.Module) -> tuple[set[str], set[str]]:
    """(modules of the add-on, modules from elsewhere) that a module of the add-on imports, as dotted names."""
    own, foreign = set(), set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            foreign |= {alias.name.split(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            foreign.add(node.module.split(".")[0])
        elif isinstance(node, ast.ImportFrom):
            package = module.split(".")[:-node.level]
            own |= {".".join([*package, *filter(None, [node.module]), alias.name]) for alias in node.names}
    return own, foreign


def row_of(name: str) -> str | None:
    """The row of MAY_IMPORT that a dotted name falls under: `bridge.gather.gather` -> `bridge`."""
    rows = [row for row in MAY_IMPORT if name == row or name.startswith(row + ".")]
    return rows[0] if rows else None


def may_import(module: str, name: str) -> bool:
    row, other = row_of(module), row_of(name)
    if other is None:
        return name.startswith("__") or name == "reflines" and module == "native"
    if row == other:
        return row != "operators" or name.split(".")[:2] == module.split(".")[:2]
    return other in MAY_IMPORT[row]


def test_every_module_of_the_addon_has_a_row() -> None:
    unknown = [module for module in addon_modules() if module not in INDEXES and row_of(module) is None]
    assert not unknown, f"say in MAY_IMPORT what these may import: {unknown}"


def test_modules_import_only_what_stands_below_them() -> None:
    wrong = [f"{module} imports {name}" for module, tree in addon_modules().items() if module not in INDEXES
             for name in sorted(imported_by(module, tree)[0]) if not may_import(module, name)]
    assert not wrong, "\n".join(wrong)


def test_third_party_modules_stay_behind_their_walls() -> None:
    wrong = []
    for module, tree in addon_modules().items():
        own, foreign = imported_by(module, tree)
        for name in sorted(foreign | ({"reflines"} & own)):
            if name in WALLS and not module.startswith(WALLS[name]) or name in PURE.get(row_of(module), ()):
                wrong.append(f"{module} imports {name}")
    assert not wrong, "\n".join(wrong)


def test_no_import_inside_a_function() -> None:
    wrong = [f"{file}:{node.lineno}" for file in python_files() for function in ast.walk(parsed(file))
             if isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef)
             for node in ast.walk(function) if isinstance(node, ast.Import | ast.ImportFrom)]
    assert not wrong, f"imports inside functions: {wrong}"


def test_no_catch_all() -> None:
    wrong = []
    for file in python_files():
        caught = [node for node in ast.walk(parsed(file)) if isinstance(node, ast.ExceptHandler)]
        for node in caught:
            names = {name.id for name in ast.walk(node.type) if isinstance(name, ast.Name)} if node.type else {"all"}
            everything = {"all", "Exception"} | ({"BaseException"} if file.parts[0] == "addon" else set())
            if names & everything:
                wrong.append(f"{file}:{node.lineno}")
    assert not wrong, f"name the errors that are meant: {wrong}"


def test_no_module_is_called_after_nothing() -> None:
    wrong = [str(file) for file in files() if {part.split(".")[0] for part in file.parts} & FORBIDDEN_NAMES]
    assert not wrong, f"say what is inside: {wrong}"


def is_empty_container(value: ast.expr | None) -> bool:
    if isinstance(value, ast.List | ast.Set | ast.Tuple):
        return not value.elts and not isinstance(value, ast.Tuple)
    if isinstance(value, ast.Dict):
        return not value.keys
    return isinstance(value, ast.Call) and isinstance(value.func, ast.Name) and value.func.id in ("list", "dict", "set")


def test_no_mutable_state_at_module_level() -> None:
    """The session, the draw cache and the threads have some; an empty container elsewhere is there to be filled."""
    wrong = []
    for module, tree in addon_modules().items():
        if module in CACHES:
            continue
        wrong += [f"{module}:{node.lineno}" for node in tree.body
                  if isinstance(node, ast.Assign | ast.AnnAssign) and is_empty_container(node.value)]
        wrong += [f"{module}:{node.lineno}" for node in ast.walk(tree) if isinstance(node, ast.Global)]
    assert not wrong, f"state belongs into properties, the session or the draw cache: {wrong}"


def test_the_addon_is_annotated() -> None:
    wrong = []
    for file in python_files("addon/"):
        for node in ast.walk(parsed(file)):
            if isinstance(node, ast.FunctionDef):
                arguments = [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs]
                bare = [a.arg for a in arguments if a.annotation is None and a.arg not in ("self", "cls", "_")]
                wrong += [f"{file}:{node.lineno} {node.name}({', '.join(bare)})"] if bare else []
    assert not wrong, "\n".join(wrong)
