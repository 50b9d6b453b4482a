"""The bonnet as analytic functions of the plan: x to the left of the car, y to its rear, z up, metres. numpy only.

`clean_height` is the panel the designer wanted, exactly symmetric about x = 0; `wobble` is what the press and the car
park added. Tests compare a smoothed panel with the clean one, so both stand alone and know nothing of Blender.
"""
import numpy as np

CHARACTER_LINE = 0.5   # the character line runs along this column parameter, so edges follow it
BADGE_CENTRE = (0.0, -0.475)
BADGE_RADIUS = 0.055

# x, y, radius, depth: shallow dents, 11 to 21 cm across and 0.7 to 1.8 mm deep.
DENTS = np.array([
    (-0.140, 0.300, 0.095, 0.0014),
    (0.135, 0.345, 0.070, 0.0011),
    (0.055, 0.110, 0.105, 0.0018),
    (-0.120, 0.040, 0.060, 0.0009),
    (0.090, -0.130, 0.075, 0.0012),
    (-0.065, -0.185, 0.055, 0.0007),
])
RIPPLE_SEED = 20070704
RIPPLE_WAVES = 7


def half_width(t: np.ndarray) -> np.ndarray:
    """Half the width of the panel; t runs from 0 at the front edge to 1 at the windscreen."""
    return 0.655 + 0.115 * t - 0.030 * t * t


def front_edge(r: np.ndarray) -> np.ndarray:
    """y of the front edge; r is x over the half width. The corners are drawn back, as over head lamps."""
    return -0.60 + 0.070 * r**2 + 0.100 * r**6


def rear_edge(r: np.ndarray) -> np.ndarray:
    """y of the rear edge, which follows the foot of the windscreen."""
    return 0.555 + 0.055 * r**2


def character_line(y: np.ndarray) -> np.ndarray:
    """Distance of the character line from the centre plane: it opens towards the windscreen."""
    return 0.355 + 0.115 * y


def plan(s: np.ndarray, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """x, y of the parameters s in [-1, 1] across and t in [0, 1] from front to rear."""
    width = half_width(t)
    bend = (character_line(1.155 * t - 0.57) / (CHARACTER_LINE * width) - 1.0) / (1.0 - CHARACTER_LINE**2)
    ratio = s * (1.0 + bend * (1.0 - s * s))
    front, rear = front_edge(ratio), rear_edge(ratio)
    return ratio * width, front + t * (rear - front)


def ramp(distance: np.ndarray, width: float) -> np.ndarray:
    """0 before 0, distance behind it, rounded over about four widths: a crease as a fast but smooth turn."""
    return width * np.logaddexp(0.0, distance / width)


def _shoulder(distance: np.ndarray) -> np.ndarray:
    """Height lost behind a character line: a crisp turn down, and a wide hollow that takes most of it back."""
    return 0.115 * ramp(distance, 0.011) - 0.095 * ramp(distance - 0.110, 0.045)


def clean_height(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """The wanted panel."""
    length = 0.135 * y - 0.055 * y**2 - 0.30 * ramp(-0.50 - y, 0.055)
    crown = -0.130 * x**2 - 0.140 * x**4
    line = character_line(y)
    shoulders = -_shoulder(np.abs(x) - line) - _shoulder(-np.abs(x) - line)
    rim = (np.hypot(x - BADGE_CENTRE[0], 1.15 * (y - BADGE_CENTRE[1])) - BADGE_RADIUS) / 0.0075
    badge = -0.0040 / (1.0 + np.exp(np.minimum(rim, 60.0)))
    return length + crown + shoulders + badge


def window(distance: np.ndarray, width: float) -> np.ndarray:
    """0 before 0, 1 behind `width`, twice differentiable between."""
    q = np.clip(distance / width, 0.0, 1.0)
    return q**3 * (q * (6.0 * q - 15.0) + 10.0)


def bad_area(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """1 well inside the area between the character lines where the panel wobbles, 0 outside it."""
    sides = window(character_line(y) - 0.075 - np.abs(x), 0.08)
    return sides * window(y + 0.30, 0.08) * window(0.47 - y, 0.08)


def ripples(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Waves 4 to 10 cm long in random directions, 14 to 35 micrometres each: together up to 0.2 mm."""
    random = np.random.RandomState(RIPPLE_SEED)   # its stream is frozen by numpy's policy: the same in every version
    length, heading, phase = random.uniform(size=(3, RIPPLE_WAVES))
    result = np.zeros_like(x)
    for k in range(RIPPLE_WAVES):
        wave = 0.04 + 0.06 * length[k]
        across = np.cos(2.0 * np.pi * heading[k]) * x + np.sin(2.0 * np.pi * heading[k]) * y
        result += 0.00035 * wave * np.sin(2.0 * np.pi * (across / wave + phase[k]))
    return result


def dents(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """The sum of the dents; each is 0 outside its own circle and three times differentiable."""
    result = np.zeros_like(x)
    for cx, cy, radius, depth in DENTS:
        inside = np.clip(1.0 - ((x - cx)**2 + (y - cy)**2) / radius**2, 0.0, None)
        result -= depth * inside**3
    return result


def wobble(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """What is wrong with the panel: height above the clean one."""
    return bad_area(x, y) * ripples(x, y) + dents(x, y)


def panel(columns: int, rows: int) -> tuple[np.ndarray, np.ndarray]:
    """The clean panel as V (#V x 3) and quads (#Q x 4, facing up): a grid of columns (even) x rows.

    The right half is computed and mirrored, so the halves agree to the last bit on any machine.
    """
    s, t = np.meshgrid(np.linspace(0.0, 1.0, columns // 2 + 1), np.linspace(0.0, 1.0, rows + 1))
    x, y = plan(s, t)
    half = np.stack([x, y, clean_height(x, y)], axis=2)
    V = np.concatenate([half[:, :0:-1] * (-1.0, 1.0, 1.0), half], axis=1)
    corner = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    quads = np.stack([corner, corner + 1, corner + columns + 2, corner + columns + 1], axis=1)
    return V.reshape(-1, 3), quads


def job(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Where the panel is to be smoothed: between the character lines, all dents in, the badge out."""
    return (np.abs(x) < character_line(y) - 0.045) & (y > -0.345) & (y < 0.515)
