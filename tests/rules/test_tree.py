"""The shape of the repository, and a README that tells the truth about it."""
import re
import subprocess
import tomllib

from tree import ROOT, files

TOP_LEVEL = {"addon", "native", "CMakeLists.txt", "tests", "blend_samples", "README.md", "run", ".ci", "LICENSE",
             "CMakePresets.json", "CHANGELOG.md", "pyproject.toml"}

# In the README: [text](target), and `code` that looks like a path of the project.
LINK = re.compile(r"\]\(([^)#]+)(?:#[^)]*)?\)")
CODE = re.compile(r"`([^`\n]+)`")
VERB = re.compile(r"^  ([a-z]+)\b", re.MULTILINE)


def readme() -> str:
    return (ROOT / "README.md").read_text()


def verbs() -> list[str]:
    listing = subprocess.run([ROOT / "run", "help"], check=True, text=True, stdout=subprocess.PIPE).stdout
    return sorted(set(VERB.findall(listing)))


def test_top_level_names() -> None:
    names = {file.parts[0] for file in files()}
    wrong = {name for name in names - TOP_LEVEL if not name.startswith(".")}
    assert not wrong, f"not among the top-level names: {wrong}"


def named_paths() -> set[str]:
    """Paths of the project that the README names; what a build makes is not there before it."""
    links = {target for target in LINK.findall(readme()) if "://" not in target}
    tops = "|".join(re.escape(name) for name in TOP_LEVEL)
    path = re.compile(rf"(?:\./)?((?:{tops})(?:/[\w./-]*)?)")
    return links | {found[1] for found in map(path.fullmatch, CODE.findall(readme())) if found}


def test_paths_in_the_readme_exist() -> None:
    wrong = [path for path in sorted(named_paths()) if not (ROOT / path).exists()]
    assert not wrong, f"README.md names what does not exist: {wrong}"


def test_the_readme_names_five_verbs_and_the_list_of_all() -> None:
    named = set(re.findall(r"\./run ([a-z]+)", readme()))
    assert named <= set(verbs()), f"README.md names {named - set(verbs())}"
    assert "help" in named and len(named) == 6


def test_one_version() -> None:
    """CMake's, the extension's and the legacy add-on's."""
    cmake = re.search(r"VERSION (\d+\.\d+\.\d+)", (ROOT / "CMakeLists.txt").read_text())[1]
    manifest = tomllib.loads((ROOT / "addon/blender_manifest.toml").read_text())["version"]
    legacy = re.search(r'"version": \((\d+), (\d+), (\d+)\)', (ROOT / "addon/__init__.py").read_text())
    assert cmake == manifest == ".".join(legacy.groups())


def test_every_package_has_a_reason() -> None:
    lines = [line for line in (ROOT / ".ci/packages").read_text().splitlines() if line and line[0] not in "#["]
    assert all(len(line.split(maxsplit=1)) == 2 for line in lines)
    assert len({line.split()[0] for line in lines}) == len(lines)
