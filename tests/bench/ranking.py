"""The rows of what a press says of its result: how well it ranks twelve results by how far they are off the design.

    PYTHONPATH=addon:tests python3 -m bench.ranking    prints the rows
"""
from bench.row import Row
from bindings import dented_dome

NOTES = {"height": "by the height off it", "given": "by the lines in the light given",
         "crossed": "by those in the crossed light"}


def rows() -> list[Row]:
    """Returns the correlations of the ranks; 1 where a result nearer to the design never has the worse number."""
    results = f"rank correlation over {len(dented_dome.PRESSES)} results"
    return [Row(f"ranking_{name}", value, "", f"{results}, {NOTES[name]}")
            for name, value in dented_dome.correlate_ranks().items()]


if __name__ == "__main__":
    for row in rows():
        print(f"{row.name:18} {row.value:6.3f} {row.note}")
