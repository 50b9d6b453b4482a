"""Who may include whom in native/: the order of the folders, and one wall around each third-party library."""
import re
from pathlib import Path

from tree import ROOT, cpp_files

# Where an include is looked for: public headers as "reflines/mesh.h", private ones as "geometry/mesh.h".
ROOTS = ("native/include", "native/src", "native")

# The folder whose words a public header states; the others of native/include are words that every folder uses.
PUBLIC = {
    "image_plane": "geometry", "cage": "geometry", "subdivision": "geometry",
    "gap_continuation": "geometry", "rasterize": "geometry",
    "mirror_pairs": "geometry",
    "line_score": "reflection", "target": "reflection", "region_field": "reflection", "smooth_target": "reflection",
    "uniform_target": "targets", "kept_target": "targets", "warp_target": "targets", "pattern_target": "targets",
    "line_handles": "targets",
    "minimizer_options": "optimization", "report": "optimization",
    "shape_optimizer": "solver", "cage_optimizer": "solver", "solve_panel": "solver",
    "smooth_panel": "restoration", "panel_smoother": "restoration", "joint_smoother": "restoration",
    "check_panel": "inspection", "shut_lines": "inspection", "inspect_panel": "inspection",
    "judge_change": "inspection", "handle_follower": "following",
}

# Folder -> the folders it may include besides itself. `geometry` and `optimization` meet only in `solver`.
BASE = {"base"}
LINES = BASE | {"geometry", "reflection"}
SOLVER = LINES | {"threads", "optimization", "optimization/linear"}
MAY_INCLUDE = {
    "base": set(),
    "threads": BASE,
    "geometry": BASE,
    "reflection": BASE | {"geometry"},
    "targets": LINES,
    "optimization/linear": BASE | {"threads"},
    "optimization": BASE | {"optimization/linear"},
    "solver/coarse": SOLVER,
    "solver": SOLVER | {"solver/coarse"},
    "restoration": SOLVER | {"solver"},
    "inspection": SOLVER | {"solver", "restoration"},
    "following": SOLVER | {"solver", "solver/coarse", "targets"},
    "python": SOLVER | {"targets", "solver", "restoration", "inspection", "following"},
    "examples": BASE | {"restoration"},
}

# Third-party headers -> the only files of native/ that may see them.
WALLS = {
    r"opensubdiv/": r"native/src/geometry/subdivision\.cpp",
    r"(suitesparse/|umfpack|cholmod|amd\.h|colamd|SuiteSparse|cblas|openblas|lapack|Eigen/(Cholmod|UmfPack))":
        r"native/src/optimization/linear/(linear_solver|cholmod_backend|umfpack_backend)\.cpp",
    r"pybind11/eigen\.h": r"native/python/array_arguments\.h",
    r"(pybind11/|Python\.h|numpy/)": r"native/python/.*",
    r"(gtest|gmock|benchmark)/": r"(?!)",
}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def folder_of(path: str) -> str:
    """`native/src/geometry/mesh.h` or `geometry/mesh.h` -> `geometry`, `reflines/target.h` -> `reflection`."""
    for root in ROOTS:
        path = path.removeprefix(root + "/")
    if path.startswith("reflines/"):
        return PUBLIC.get(Path(path).stem, "base")
    return Path(path).parent.as_posix()


def native_includes() -> list[tuple[str, str, str]]:
    """(file, bracket, included) of every include in native/."""
    return [(file.as_posix(), bracket, included) for file in cpp_files() if file.parts[0] == "native"
            for bracket, included in INCLUDE.findall((ROOT / file).read_text())]


def test_every_folder_has_a_row() -> None:
    unknown = {folder_of(file.as_posix()) for file in cpp_files() if file.parts[0] == "native"} - set(MAY_INCLUDE)
    assert not unknown, f"say in MAY_INCLUDE what these may include: {unknown}"


def test_folders_include_only_what_stands_below_them() -> None:
    wrong = []
    for file, bracket, included in native_includes():
        folder, other = folder_of(file), folder_of(included)
        if bracket == '"' and other != folder and other not in MAY_INCLUDE.get(folder, set()):
            wrong.append(f"{file} includes {included}")
    assert not wrong, "\n".join(wrong)


def test_public_headers_include_only_public_ones() -> None:
    wrong = [f"{file} includes {included}" for file, bracket, included in native_includes()
             if file.startswith(("native/include/", "native/examples/"))
             and bracket == '"' and not included.startswith("reflines/")]
    assert not wrong, "\n".join(wrong)


def test_own_headers_are_named_from_the_roots() -> None:
    wrong = [f"{file} includes {bracket}{included}" for file, bracket, included in native_includes()
             if (bracket == '"') != any((ROOT / root / included).is_file() for root in ROOTS)]
    assert not wrong, "\n".join(wrong)


def test_third_party_libraries_stay_behind_their_walls() -> None:
    wrong = [f"{file} includes {included}" for file, _, included in native_includes()
             for library, home in WALLS.items() if re.match(library, included) and not re.fullmatch(home, file)]
    assert not wrong, "\n".join(wrong)


def test_headers_have_include_guards() -> None:
    wrong = [str(file) for file in cpp_files(".h") if "#pragma once" not in (ROOT / file).read_text()]
    assert not wrong, f"no #pragma once in {wrong}"
