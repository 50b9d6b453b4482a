"""Who may import whom in addon/, and what no Python file here does."""
import ast
import re
from pathlib import Path

from tree import ROOT, files, python_files

# What stands between Blender and arrays.
SCENE = ("animation", "blender", "read", "view", "write")
# Module or package of addon/ -> what of addon/ it may import. A package may import itself, `operators` excepted.
MAY_IMPORT = {
    "bl_info": set(),  # of addon/__init__.py
    "library_copy": set(),
    "native": {"bl_info", "library_copy"},
    "native_call": set(),
    "background_work": {"native", "native_call"},
    "model": {"native"},
    "targets": {"native", "native_call", "model.line_curve", "model.line_handle", "model.solution"},
    "blender": set(),
    "animation": {"blender", "model"},
    "read": {"blender", "animation", "native", "model", "targets"},
    "view": {"blender", "read", "native", "model"},
    "write": {"blender", "read", "view", "native", "model", "targets"},
    "solver": {"native", "native_call", "model", "targets"},
    "state": {"native", "native_call", *SCENE, "model", "solver"},
    "interactive": {"native", "native_call", "background_work", "model", "targets", *SCENE, "solver", "state",
                    "overlay.handle_marks", "overlay.tool_circle"},
    "operators": {"native_call", "background_work", "model", "targets", *SCENE, "solver", "state", "interactive",
                  "ui.properties", "ui.automatic_values", "ui.tool_properties"},
    "overlay.tool_circle": {"overlay.handle_marks"},
    "overlay.handle_marks": set(),
    "overlay.stripes": set(),
    "overlay.shader": {"overlay.stripes"},
    "overlay.fitted_normals": {"native", "native_call", "background_work", "model"},
    "overlay.solve_maps": {"model"},
    "overlay.legend": {"overlay.handle_marks", "overlay.stripes", "overlay.solve_maps", "overlay.stripe_scene",
                       "overlay.shown_objects", *SCENE, "state"},
    "overlay.limit_surface": {"native", "model"},
    "overlay.stripe_scene": {"overlay.stripes", *SCENE},
    "overlay.shown_objects": {"overlay.stripes", "overlay.stripe_scene", *SCENE, "model", "state"},
    "overlay.draw_cage": {"overlay.stripes", "overlay.stripe_scene", *SCENE, "model"},
    "overlay.surface_lines": {"overlay.draw_cage"},
    "overlay.draw_borders": {"overlay.surface_lines", *SCENE, "model"},
    "overlay.draw_check": {"overlay.surface_lines", "overlay.handle_marks", *SCENE, "state"},
    "overlay.draw": {"overlay.stripes", "overlay.draw_cage", "overlay.legend",
                     "overlay.shader", "overlay.fitted_normals", "overlay.solve_maps",
                     "overlay.limit_surface", "overlay.stripe_scene", "overlay.shown_objects", "native", *SCENE,
                     "model", "state"},
    "ui.stripe_properties": {"model"},
    "ui.rows": set(),
    "ui.automatic_values": {*SCENE},
    "ui.tool_properties": {*SCENE, "model", "ui.automatic_values", "ui.rows"},
    "ui.handle_properties": {*SCENE, "model"},
    "ui.handles_panel": {"model", "ui.panels"},
    "ui.check_properties": {*SCENE, "model"},
    "ui.check_panel": {"ui.panels"},
    "ui.inspection_properties": {*SCENE, "model"},
    "ui.inspection_panel": {"ui.panels"},
    "ui.light_set_properties": set(),
    "ui.light_set_panel": {"ui.panels"},
    "ui.properties": {*SCENE, "model", "ui.check_properties", "ui.inspection_properties", "ui.automatic_values",
                      "ui.handle_properties", "ui.light_set_properties", "ui.tool_properties", "ui.stripe_properties"},
    "ui.session_properties": {"native", *SCENE, "state", "interactive", "overlay.shown_objects"},
    "ui.panels": {"model", "ui.automatic_values", "ui.rows"},
    "ui.stripe_presets": set(),
    "ui.stripes_panel": {"ui.panels", "ui.rows", "ui.stripe_presets"},
    "ui.divider_gizmo": {*SCENE, "state.compared", "overlay.legend"},
    "ui.gizmos": {*SCENE, "interactive.drag", "state.last_panels"},
    "ui.handle_gizmos": {"model", "interactive.drag", "interactive.handle_tracing"},
    "ui.menus": {"ui.rows"},
    "ui.keymaps": set(),
    "ui.manual_links": set(),
    "ui.toolbar": {"ui.automatic_values", "ui.gizmos", "ui.handle_gizmos", "overlay.tool_circle"},
    "ui.preferences": {"bl_info", "native", "ui.keymaps", "ui.manual_links"},
}
# Registration sees everything.
INDEXES = {"__init__"} | {f"{package}.__init__" for package in (
    "model", "targets", *SCENE, "solver", "state", "interactive", "operators", "overlay", "ui")}
# What the operators that solve are made of; no operator imports another one.
OPERATOR_BASES = {"operators.solve_tool", "operators.dragged_tool"}

# Module from elsewhere -> the only modules of addon/ that may import it.
WALLS = {"reflines": ("native",), "bmesh": ("blender.compat", "read", "write"),
         "gpu": ("overlay",), "gpu_extras": ("overlay",)}
BLENDER = {"bpy", "bmesh", "gpu", "gpu_extras", "mathutils", "bpy_extras"}
# These never meet Blender, neither by themselves nor by what they import.
PURE = {"native", "native_call", "model", "targets", "solver", "interactive.drag_handles", "overlay.stripes",
        "overlay.solve_maps", "overlay.limit_surface"}

FORBIDDEN_NAMES = {"utils", "util", "helpers", "helper", "common", "misc"}
OWNERS_OF_STATE = {"state.last_looks", "state.last_panels", "state.optimizer_cache", "state.press_cache",
                   "state.solve_history", "interactive.drag",
                   "interactive.live_warp_handlers", "background_work", "interactive.running_operators",
                   "overlay.draw",
                   "overlay.draw_borders", "overlay.draw_check", "state.last_checks", "view.shown_middles"}


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
    """The row of MAY_IMPORT that a dotted name falls under: `read.gather.gather` -> `read`."""
    rows = [row for row in MAY_IMPORT if name == row or name.startswith(row + ".")]
    return rows[0] if rows else None


def may_import(module: str, name: str) -> bool:
    row, other = row_of(module), row_of(name)
    if other is None:
        return name.startswith("__") or name.split(".")[0] == "reflines" and module == "native"
    if row == other:
        return row != "operators" or ".".join(name.split(".")[:2]) in OPERATOR_BASES
    return any(name == allowed or name.startswith(allowed + ".") for allowed in MAY_IMPORT[row])


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
            if name in WALLS and not module.startswith(WALLS[name]):
                wrong.append(f"{module} imports {name}")
    assert not wrong, "\n".join(wrong)


def modules_behind(names: set[str], modules: dict[str, ast.Module]) -> set[str]:
    """The modules of the add-on that imported names stand in."""
    return {module for module in modules for name in names if name == module or name.startswith(module + ".")}


def test_pure_modules_never_meet_blender() -> None:
    modules = addon_modules()
    wrong = []
    for start in [module for module in modules if module.startswith(tuple(PURE)) and module not in INDEXES]:
        seen, left = set(), {start}
        while left:
            module = left.pop()
            seen.add(module)
            own, foreign = imported_by(module, modules[module])
            wrong += [f"{start} imports {name} by way of {module}" for name in sorted(foreign & BLENDER)]
            left |= modules_behind(own, modules) - seen
    assert not wrong, "\n".join(wrong)


def test_every_module_is_registered_once_after_what_it_imports() -> None:
    """So that all of them are reloaded with the add-on, none with a part that is still the old one."""
    modules = addon_modules()
    listed = next(node.value for node in modules["__init__"].body
                  if isinstance(node, ast.Assign) and node.targets[0].id == "NAMES")
    names = [element.value for element in listed.elts]
    assert sorted(names) == sorted(set(modules) - INDEXES)
    late = [f"{name} stands before {other}, which it imports" for at, name in enumerate(names)
            for other in sorted(modules_behind(imported_by(name, modules[name])[0], modules))
            if other in names[at + 1:]]
    assert not late, "\n".join(late)


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
    """Caches, histories and registries of what runs have some; an empty container elsewhere is there to be filled."""
    wrong = []
    for module, tree in addon_modules().items():
        if module in OWNERS_OF_STATE:
            continue
        wrong += [f"{module}:{node.lineno}" for node in tree.body
                  if isinstance(node, ast.Assign | ast.AnnAssign) and is_empty_container(node.value)]
        wrong += [f"{module}:{node.lineno}" for node in ast.walk(tree) if isinstance(node, ast.Global)]
    assert not wrong, f"state belongs into properties, or to one of its owners: {wrong}"


def test_the_addon_is_annotated() -> None:
    wrong = []
    for file in python_files("addon/"):
        for node in ast.walk(parsed(file)):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                arguments = [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs]
                bare = [a.arg for a in arguments if a.annotation is None and a.arg not in ("self", "cls", "_")]
                wrong += [f"{file}:{node.lineno} {node.name}({', '.join(bare)})"] if bare else []
    assert not wrong, "\n".join(wrong)


def named_types(annotation: ast.expr | None) -> set[str]:
    """The names in an annotation, those in a string among them."""
    if annotation is None:
        return set()
    if isinstance(annotation, ast.Constant) and isinstance(annotation.value, str):
        annotation = ast.parse(annotation.value, mode="eval")
    return {node.id for node in ast.walk(annotation) if isinstance(node, ast.Name)}


def test_numbers_and_optimizers_have_types() -> None:
    """Beside operators and properties no annotation is `object`: reflines.pyi and numpy have the type. A handler's `*_`
    takes what Blender passes."""
    wrong = []
    for module, tree in addon_modules().items():
        if module.startswith(("operators.", "ui.", "overlay.")):
            continue
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                arguments = [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs]
                annotations = [node.returns, *(argument.annotation for argument in arguments)]
            else:
                annotations = [node.annotation] if isinstance(node, ast.AnnAssign) else []
            wrong += [f"{module}:{node.lineno}" for annotation in annotations if "object" in named_types(annotation)]
    assert not wrong, f"name the type: {wrong}"


def test_vertices_are_moved_where_the_developers_page_says() -> None:
    moves = re.compile(r"foreach_set\(\"co\"|\.co = ")
    found = {file.as_posix() for file in python_files("addon/") if moves.search((ROOT / file).read_text())}
    rows = (ROOT / "tests/README.md").read_text().splitlines()
    row = next(row for row in rows if row.startswith("| what moves a vertex"))
    assert found == set(re.findall(r"addon/[\w/]+\.py", row))
