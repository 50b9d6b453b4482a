"""The sheet of an inspection: one page that tells somebody else where a panel is not even, with pictures."""
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from .canvas import Canvas, Color
from .inspection import Spot
from .panel_picture import Looked, Pictured, count_bands, draw_in_bands, measure_turn, turn_to
from .steps import Steps

WIDTH, HEIGHT = 1754, 1240  # pixels: an A4 page across at 150 dots an inch
MARGIN = 60
PICTURE = (1010, 690)
ROWS = 12      # spots that the table has room for
CLOSE = 6      # spots that are shown from near
CLOSE_SIZE = (254, 190)
FRAMED = 5.0   # sizes of a spot that its picture shows
PERIOD = 2.5   # degrees from one stripe to the next, for one that lines are off by: 0.4 of a stripe is well seen
LEAST_STRIPES, MOST_STRIPES = 7, 22  # in such a picture: fewer tell no course, more are too narrow to be followed
INK: Color = (0.10, 0.11, 0.13)
FAINT: Color = (0.42, 0.44, 0.48)
RULE: Color = (0.80, 0.81, 0.83)
RED: Color = (0.83, 0.11, 0.09)
PAPER: Color = (1.0, 1.0, 1.0)
COLUMNS = (0, 52, 138, 258, 368, 448)  # of the table, pixels from its left
LETTERS = 19   # that the last column has room for
HEADS = ("", "Flaw", "Height", "Width", "Lines", "Seen best")


@dataclass(frozen=True)
class Sheet:
    """The content of the sheet."""
    title: str
    summary: str            # of the inspection, as one sentence
    unseen: str             # views that do not see the panel, as a sentence, or empty
    spots: Sequence[Spot]   # the worst first
    shown: Pictured
    looked: Looked          # the view along which the panel was inspected
    format_length: Callable[[float], str]


def draw_sheet(sheet: Sheet, canvas: Canvas) -> Steps[None]:
    """Draws all of the sheet."""
    canvas.write(sheet.title, MARGIN, 104, 46, INK)
    canvas.write(f"Inspection of its reflection lines. {sheet.summary}", MARGIN, 148, 22, FAINT)
    canvas.fill_box(MARGIN, 172, WIDTH - 2 * MARGIN, 2, RULE)
    yield from draw_whole(sheet, canvas, 200)
    draw_table(sheet, canvas, MARGIN + PICTURE[0] + 46, 200)
    yield
    yield from draw_close_ups(sheet, canvas, 200 + PICTURE[1] + 26)
    foot = ("Lines: how far, in degrees of the light's turn, they are off the course that they would have without the "
            "flaw. Height: over the surface without it.")
    canvas.write(foot, MARGIN, HEIGHT - 34, 16, FAINT)
    canvas.write("Reflection Lines for Blender", WIDTH - MARGIN, HEIGHT - 34, 16, FAINT, align=1.0)


def count_steps(sheet: Sheet) -> int:
    """Counts the steps in which it is drawn."""
    return count_bands(*PICTURE) + 1 + len(sheet.spots[:CLOSE]) * count_bands(*CLOSE_SIZE)


def draw_whole(sheet: Sheet, canvas: Canvas, top: int) -> Steps[None]:
    """Draws the whole panel, with the number of each spot."""
    looked = sheet.looked
    canvas.paste((yield from draw_in_bands(sheet.shown, looked, *PICTURE)), MARGIN, top)
    places = looked.find_pixels(np.array([spot.place for spot in sheet.spots]).reshape(-1, 3), *PICTURE)
    scale = PICTURE[0] / looked.width
    for number, (spot, place) in enumerate(list(zip(sheet.spots, places, strict=True))[:ROWS], 1):
        ring = max(0.5 * scale * spot.size, 12.0)
        center = place + (MARGIN, top)
        canvas.draw_ring(center, ring + 2.5, 7.0, PAPER)
        canvas.draw_ring(center, ring + 1.0, 4.0, RED)
        label = center + 0.72 * (ring + 17.0) * np.array([1.0, -1.0])
        draw_number(canvas, label, number)


def draw_number(canvas: Canvas, center: np.ndarray, number: int) -> None:
    canvas.draw_ring(center, 17.0, 17.0, PAPER)
    canvas.draw_ring(center, 15.0, 15.0, RED)
    canvas.write(str(number), center[0], center[1] + 6.5, 19.0, PAPER, align=0.5)


def draw_table(sheet: Sheet, canvas: Canvas, left: int, top: int) -> None:
    """Draws the table of the worst spots."""
    for offset, head in zip(COLUMNS, HEADS, strict=True):
        canvas.write(head, left + offset, top + 20, 18, FAINT)
    canvas.fill_box(left, top + 32, WIDTH - MARGIN - left, 2, RULE)
    base = top + 66
    for number, spot in enumerate(sheet.spots[:ROWS], 1):
        draw_number(canvas, np.array([left + 15.0, base - 7.0]), number)
        for offset, text in zip(COLUMNS[1:], tell_spot(sheet, spot), strict=True):
            canvas.write(text, left + offset, base, 18, INK)
        base += 46
    left_over = len(sheet.spots) - ROWS
    closing = f"and {left_over} more" if left_over > 0 else "" if sheet.spots else "No spot is above the noise floor."
    for line in filter(None, (closing, sheet.unseen)):
        canvas.write(line, left, base, 18, FAINT)
        base += 30


def tell_spot(sheet: Sheet, spot: Spot) -> tuple[str, ...]:
    """Returns what the table tells of a spot; at borders the height is not known."""
    flaw = (("Dent" if spot.height < 0.0 else "Bump", sheet.format_length(abs(spot.height))) if spot.height
            else ("Uneven", "\u2013"))
    where = spot.tell_where()
    return (*flaw, sheet.format_length(spot.size), f"{spot.degrees:.2g}\u00b0",
            where if len(where) <= LETTERS else f"{where[:LETTERS - 1]}\u2026")


def draw_close_ups(sheet: Sheet, canvas: Canvas, top: int) -> Steps[None]:
    """Draws the first spots from near, each in the light and from where it shows, with stripes fine enough for it."""
    step = (WIDTH - 2 * MARGIN - CLOSE_SIZE[0]) / (CLOSE - 1)
    for index, spot in enumerate(sheet.spots[:CLOSE]):
        left = round(MARGIN + index * step)
        looked = look_at(sheet, spot)
        canvas.paste((yield from draw_in_bands(sheet.shown, looked, *CLOSE_SIZE)), left, top)
        canvas.draw_ring(np.array([left, top]) + 0.5 * np.array(CLOSE_SIZE), 0.5 * CLOSE_SIZE[0] / FRAMED, 2.0, RED)
        draw_number(canvas, np.array([left + 20.0, top + 20.0]), index + 1)
        apart = 360.0 / looked.count
        canvas.write(f"Stripes {apart:.2g}\u00b0 apart", left, top + CLOSE_SIZE[1] + 22, 16, FAINT)


def look_at(sheet: Sheet, spot: Spot) -> Looked:
    """Returns how a spot is looked at from near, with stripes that show how far its lines are off."""
    eye = sheet.looked.eye if spot.eye is None else np.array(spot.eye)
    right, up = turn_to(sheet.looked, eye)
    looked = replace(sheet.looked, right=right, up=up, eye=eye, center=np.array(spot.place), width=FRAMED * spot.size,
                     line=np.array(spot.line))
    turn = measure_turn(sheet.shown, looked, looked.width * CLOSE_SIZE[1] / CLOSE_SIZE[0])
    apart = float(np.clip(PERIOD * spot.degrees, turn / MOST_STRIPES, max(turn / LEAST_STRIPES, 0.01)))
    return replace(looked, count=360.0 / apart)
