"""Who may include whom in native/: the order of the rooms, and one wall around each third-party library."""
import re
from pathlib import Path

from tree import ROOT, cpp_files

# Room -> the rooms it may include besides itself. `geometry` and `optimization` meet only above the three.
BASE = {"types", "errors"}
SOLVER = BASE | {"geometry", "reflection", "optimization"}
MAY_INCLUDE = {
    "types": set(),
    "errors": set(),
    "geometry": BASE,
    "optimization": BASE,
    "reflection": BASE | {"geometry"},
    "motion": SOLVER,
    "coarse_piece": SOLVER,
    "piece_problem": SOLVER | {"motion", "coarse_piece"},
    "piece_targets": SOLVER | {"piece_problem"},
    "region": SOLVER,
    "shape_optimizer": SOLVER | {"motion", "piece_problem", "region"},
    "shape_fields": SOLVER | {"piece_problem", "shape_optimizer"},
    "cage_surface": SOLVER | {"motion", "shape_optimizer"},
    "cage_optimizer": SOLVER | {"motion", "shape_optimizer", "cage_surface"},
    "bindings": SOLVER | {"shape_optimizer", "cage_optimizer"},
}

# Third-party headers -> the only files of native/ that may see them.
WALLS = {
    r"opensubdiv/": r"native/geometry/subdivision\.cpp",
    r"(suitesparse/|umfpack|cholmod|amd\.h|colamd|SuiteSparse|cblas|openblas|lapack|Eigen/(Cholmod|UmfPack))":
        r"native/optimization/linear_solver\.cpp",
    r"(pybind11/|Python\.h|numpy/)": r"native/bindings/.*",
    r"(gtest|gmock|benchmark)/": r"(?!)",
}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def room_of(path: str) -> str:
    """`native/geometry/mesh.h` -> `geometry`, `native/types.h` -> `types`."""
    return Path(path).parts[1].split(".")[0]


def native_includes() -> list[tuple[str, str, str]]:
    """(file, bracket, included) of every include in native/."""
    return [(file.as_posix(), bracket, included) for file in cpp_files() if file.parts[0] == "native"
            for bracket, included in INCLUDE.findall((ROOT / file).read_text())]


def test_every_room_has_a_row() -> None:
    unknown = {room_of(file.as_posix()) for file in cpp_files() if file.parts[0] == "native"} - set(MAY_INCLUDE)
    assert not unknown, f"say in MAY_INCLUDE what these may include: {unknown}"


def test_rooms_include_only_what_stands_below_them() -> None:
    wrong = []
    for file, _, included in native_includes():
        if included.startswith("native/"):
            room, other = room_of(file), room_of(included)
            if other != room and other not in MAY_INCLUDE.get(room, set()):
                wrong.append(f"{file} includes {included}")
    assert not wrong, "\n".join(wrong)


def test_own_headers_are_named_from_the_root() -> None:
    wrong = [f"{file} includes \"{included}\"" for file, bracket, included in native_includes()
             if (bracket == '"') != included.startswith("native/")]
    assert not wrong, "\n".join(wrong)


def test_third_party_libraries_stay_behind_their_walls() -> None:
    wrong = [f"{file} includes {included}" for file, _, included in native_includes()
             for library, home in WALLS.items() if re.match(library, included) and not re.fullmatch(home, file)]
    assert not wrong, "\n".join(wrong)


def test_headers_have_include_guards() -> None:
    wrong = [str(file) for file in cpp_files(".h") if "#pragma once" not in (ROOT / file).read_text()]
    assert not wrong, f"no #pragma once in {wrong}"
