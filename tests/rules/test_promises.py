"""What the manual promises of the add-on, where reading the code decides it; and that every test it names is there."""
import ast
import re

from tree import ROOT, python_files

# Modules that reach a network, start programs, or make objects of bytes in a file.
FOREIGN = {"socket", "ssl", "http", "urllib", "ftplib", "smtplib", "requests", "asyncio", "xmlrpc", "subprocess",
           "multiprocessing", "ctypes", "pickle", "shelve", "marshal", "dill", "runpy", "code"}
RUNS_TEXT = {"eval", "exec", "compile", "__import__"}
# Who may write files: name of the module -> how.
WRITERS = {"addon/library_copy.py", "addon/operators/export_table.py", "addon/operators/export_sheet.py",
           "addon/operators/export_film.py"}
WRITES = {"write_bytes", "write_text", "mkstemp", "makedirs", "save_render", "savez", "tofile", "copyfile"}


def calls(tree: ast.Module) -> set[str]:
    """Names of what is called: `eval`, and of `path.write_bytes` its last part."""
    functions = [node.func for node in ast.walk(tree) if isinstance(node, ast.Call)]
    return {function.id if isinstance(function, ast.Name) else function.attr for function in functions
            if isinstance(function, ast.Name | ast.Attribute)}


def imports(tree: ast.Module) -> set[str]:
    names = [alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names]
    names += [node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.level == 0]
    return {name.split(".")[0] for name in names}


def addon() -> dict[str, ast.Module]:
    return {file.as_posix(): ast.parse((ROOT / file).read_text()) for file in python_files("addon/")}


def test_the_addon_reaches_no_network_and_starts_no_program() -> None:
    wrong = {file: imports(tree) & FOREIGN for file, tree in addon().items() if imports(tree) & FOREIGN}
    assert not wrong


def test_no_text_is_run_and_no_object_is_unpickled() -> None:
    built_in = {file: {node.func.id for node in ast.walk(tree) if isinstance(node, ast.Call)
                       and isinstance(node.func, ast.Name)} & RUNS_TEXT for file, tree in addon().items()}
    assert not {file: names for file, names in built_in.items() if names}
    assert not [file for file, tree in addon().items() for node in ast.walk(tree)
                if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name)
                and (node.value.id, node.attr) == ("np", "load")]


def test_only_the_copy_and_exports_are_written() -> None:
    wrong = {file: calls(tree) & WRITES for file, tree in addon().items()
             if file not in WRITERS and calls(tree) & WRITES}
    assert not wrong


def promises() -> list[str]:
    """The rows of the manual's table of promises."""
    page = (ROOT / "addon/manual/index.html").read_text()
    return re.findall(r"<tr><td>.*?</tr>", page[page.index('id="promises"'):], re.DOTALL)


def is_run(name: str) -> bool:
    """Whether a suite of `./run test` runs a test of this name: FILE, or FILE::FUNCTION of Python."""
    path, _, function = name.partition("::")
    if not (ROOT / path).is_file() or path.split("/")[1] not in {"native", "bindings", "addon", "ui", "rules"}:
        return False
    if not function:
        return True
    return function.startswith("test_") and any(isinstance(node, ast.FunctionDef) and node.name == function
                                                for node in ast.parse((ROOT / path).read_text()).body)


def test_every_promise_names_tests_that_are_there_and_run() -> None:
    assert len(promises()) >= 11
    for row in promises():
        named = re.findall(r"<code>(tests/[^<]+)</code>", row)
        assert named and not [name for name in named if not is_run(name)], row


def test_a_test_that_is_not_there_holds_no_promise() -> None:
    here = "tests/rules/test_promises.py"
    assert is_run(here) and is_run(f"{here}::test_a_test_that_is_not_there_holds_no_promise")
    for name in (f"{here}::test_nothing", "tests/bench/report.py", "tests/bindings/test_nothing.py",
                 "tests/ui/test_long_press.py::prepare"):
        assert not is_run(name)
