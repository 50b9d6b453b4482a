"""The manual's table of Smooth Lines and Blender's own tools, from the numbers that are kept beside this file."""
import json
from pathlib import Path

KEPT = Path(__file__).with_name("blender_tools.json")
PANELS = {"hood": "sample hood: dents and ripples", "faucet": "sample faucet: dents",
          "door": "sample door: long wiggles", "subaru_hood": "Subaru bonnet: dents planted",
          "drivaer_hood_wide": "DrivAer bonnet: ripples planted"}
SHAPES = {"flawed": "before", "smooth": "Smooth Lines", "length": "Smooth Lines, length set", "fair": "Fair Tangency",
          "vertices": "Smooth Vertices", "relax": "Relax", "clean": "the clean panel"}
MILLIMETRES = 1000.0

Numbers = dict[str, float]


def write_pair(numbers: Numbers, name: str, digits: int) -> str:
    """Returns a number in the light given and in the crossed one."""
    return f"{numbers[name]:.{digits}f}, {numbers[f'{name}_crossed']:.{digits}f}"


def write_length(numbers: Numbers, name: str) -> str:
    return f"{MILLIMETRES * numbers[name]:.2f}"


def write_row(shape: str, numbers: Numbers) -> list[str]:
    """Returns the cells of one shape of a panel."""
    title = f"{SHAPES[shape]} × {numbers['repeats']}" if "repeats" in numbers else SHAPES[shape]
    cells = [title, write_pair(numbers, "wobble", 2), write_pair(numbers, "turn", 1),
             write_pair(numbers, "lines_off", 2), write_length(numbers, "off")]
    if "moved" not in numbers:
        return cells + [""] * 5
    return [*cells, write_length(numbers, "moved"), write_length(numbers, "border_moved"),
            f"{numbers['border_kink']:.2f}", f"{write_pair(numbers, 'harm', 2)}; {write_length(numbers, 'harm_moved')}",
            f"{1000.0 * numbers['seconds']:.0f}" if "seconds" in numbers else ""]


def list_rows() -> list[list[str]]:
    """Returns the rows of the table: each panel's title alone, then the cells of its shapes."""
    rows = []
    for panel, shapes in json.loads(KEPT.read_text())["panels"].items():
        rows += [[PANELS[panel]], *(write_row(shape, shapes[shape]) for shape in SHAPES)]
    return rows


def write_html() -> str:
    """Returns the rows as they stand in the manual."""
    cells = [[f'<th colspan="10">{row[0]}</th>'] if len(row) == 1 else [f"<td>{cell}</td>" for cell in row]
             for row in list_rows()]
    return "\n".join(f"<tr>{''.join(row)}</tr>" for row in cells)


if __name__ == "__main__":
    print(write_html())
