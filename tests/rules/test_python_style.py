"""ruff on every Python file, by the rules in pyproject.toml.

Debian 12 has no package of ruff; npm has it as WebAssembly. An installed ruff is used where there is one.
"""
import json
import shutil
import subprocess
import tomllib
from pathlib import Path

import pytest
from tree import ROOT, python_files

RUFF_FOR_NODE = "@astral-sh/ruff-wasm-nodejs@0.17.3"
MODULES = ROOT / "build/rules/node_modules"


def fetched() -> Path:
    """The folder of node modules with ruff in it; fetched once."""
    if shutil.which("node") is None or shutil.which("npm") is None:
        pytest.skip("neither ruff nor node with npm is installed")
    if not (MODULES / "@astral-sh/ruff-wasm-nodejs").is_dir():
        command = ["npm", "install", "--silent", "--no-save", "--no-audit", "--no-fund", "--prefix",
                   str(MODULES.parent), RUFF_FOR_NODE]
        result = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300)
        if result.returncode != 0:
            pytest.skip(f"npm could not fetch ruff: {result.stdout.strip()[-300:]}")
    return MODULES


def complaints_from_node() -> list[str]:
    options = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["ruff"]
    texts = {str(file): (ROOT / file).read_text() for file in python_files()}
    command = ["node", str(ROOT / "tests/rules/ruff.js"), str(fetched())]
    request = json.dumps({"options": options, "files": texts})
    return json.loads(subprocess.run(command, check=True, text=True, input=request, stdout=subprocess.PIPE).stdout)


def complaints_from_ruff(ruff: str) -> list[str]:
    command = [ruff, "check", "--no-cache", "--output-format=concise", *map(str, python_files())]
    result = subprocess.run(command, cwd=ROOT, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return result.stdout.splitlines() if result.returncode else []


def test_ruff() -> None:
    installed = shutil.which("ruff")
    complaints = complaints_from_ruff(installed) if installed else complaints_from_node()
    assert not complaints, "\n".join(complaints)
