"""The other samples as analytic functions, each clean and with what is wrong with it. Metres; x to the left of the car,
y to its rear, z up, as in hood_shape. numpy only.

A panel is V (#V x 3) and quads (#Q x 4), their front sides towards the viewer.
"""
import numpy as np

from hood_shape import ramp, window


def grid(columns: int, rows: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """s and t in [0, 1] at the vertices (flat), and the quads, s to the right and t up."""
    s, t = np.meshgrid(np.linspace(0.0, 1.0, columns + 1), np.linspace(0.0, 1.0, rows + 1))
    corner = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    quads = np.stack([corner, corner + 1, corner + columns + 2, corner + columns + 1], axis=1)
    return s.ravel(), t.ravel(), quads


def waves(a: np.ndarray, b: np.ndarray, shortest: float, longest: float, seed: int, count: int = 9) -> np.ndarray:
    """A sum of plane waves of lengths between the two, as high as one thousandth of their lengths."""
    random = np.random.RandomState(seed)
    result = np.zeros_like(a)
    for share, heading, phase in random.uniform(size=(count, 3)):
        length = shortest + share * (longest - shortest)
        across = np.cos(2.0 * np.pi * heading) * a + np.sin(2.0 * np.pi * heading) * b
        result += 1e-3 / count * length * np.sin(2.0 * np.pi * (across / length + phase))
    return result


# --- Door: a skin with a shoulder, a waist line and wavy lines below it

def door_clean(y: np.ndarray, z: np.ndarray) -> np.ndarray:
    """x of the skin: crowned, with a soft crease at the waist line, z = 0.16."""
    return -0.16 * z**2 - 0.05 * y**2 - 0.16 * ramp(z - 0.16 - 0.04 * y, 0.014) - 0.10 * ramp(-0.26 - z, 0.03)


def door_inside(y: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Where its lines are wavy: below the waist line."""
    return (np.abs(y) < 0.47) & (z > -0.22) & (z < 0.10 + 0.04 * y)


def door(columns: int = 130, rows: int = 90) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The wavy door, its quads, and the x of the clean one."""
    s, t, quads = grid(columns, rows)
    y, z = 1.1 * (s - 0.5), 0.76 * (t - 0.5)
    fade = window(0.47 - np.abs(y), 0.10) * window(z + 0.22, 0.07) * window(0.10 + 0.04 * y - z, 0.07)
    clean = door_clean(y, z)
    wavy = 0.9 * waves(y, 0.35 * z, 0.10, 0.22, seed=11) + 0.12 * waves(y, z, 0.03, 0.05, seed=12)
    return np.column_stack([clean + 3.2 * fade * wavy, y, z]), quads, clean


# --- Fender: over a wheel arch, its lines twisted about a point

TWIST_CENTRE = (0.0, 0.62)   # y, z
TWIST_RADIUS = 0.30
TWIST = 0.5                  # radians at the centre
ARCH = 0.32


def fender_clean(y: np.ndarray, z: np.ndarray) -> np.ndarray:
    return -0.55 * (z - 0.40)**2 - 0.10 * y**2


def fender(columns: int = 130, rows: int = 70) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The twisted fender, its quads, and the x of the clean one.

    Lamps along y see theta as twice the slope along z, so its gradient turns by as much as the mixed derivative says.
    """
    s, t, quads = grid(columns, rows)
    y = 1.16 * (s - 0.5)
    low = 0.04 + ARCH * window(0.50 - np.abs(y), 0.48)
    z = low + t * (0.86 - 0.10 * y**2 - low)
    clean = fender_clean(y, z)
    dy, dz = y - TWIST_CENTRE[0], z - TWIST_CENTRE[1]
    near = np.exp(-0.5 * (dy**2 + dz**2) / TWIST_RADIUS**2)
    return np.column_stack([clean + TWIST * -1.1 * dy * dz * near, y, z]), quads, clean


# --- Faucet: a bent spout with dents from casting

def spine(s: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """x and z of the spout's middle and its heading (radians from up), s in [0, 1]: up, over, and down a little."""
    heading = 2.5 * window(s - 0.18, 0.85)
    step = 0.34 * np.diff(s, prepend=s[:1])
    middle = heading - 0.5 * np.diff(heading, prepend=heading[:1])
    return np.cumsum(np.sin(middle) * step), np.cumsum(np.cos(middle) * step), heading


def faucet(columns: int = 64, rows: int = 240) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The dented spout (half a tube, open at the back), its quads, and the clean V."""
    s, t, quads = grid(columns, rows)
    turn = np.pi * (1.05 * s - 0.025)      # from one silhouette seen from -y to the other, and a little beyond
    along = np.linspace(0.0, 1.0, rows + 1)
    x, z, heading = (np.repeat(values, columns + 1) for values in spine(along))
    radius = 0.024 - 0.009 * window(t, 0.9) + 0.004 * window(0.12 - t, 0.12)
    outward = np.column_stack([np.cos(turn) * -np.cos(heading), -np.sin(turn), np.cos(turn) * np.sin(heading)])
    middle = np.column_stack([x, np.zeros_like(x), z])
    fade = window(0.20 - np.abs(s - 0.5), 0.10) * window(0.40 - np.abs(t - 0.5), 0.08)
    dents = 30.0 * waves(0.075 * s, 0.34 * t, 0.012, 0.022, seed=21)
    clean = middle + radius[:, None] * outward
    return clean + (fade * dents)[:, None] * outward, quads, clean


def faucet_inside(columns: int = 64, rows: int = 240) -> np.ndarray:
    """#V bool: what faces a viewer at -y, without the ends."""
    s, t, _ = grid(columns, rows)
    return (np.abs(s - 0.5) < 0.22) & (np.abs(t - 0.5) < 0.42)


# --- Plate: a crowned panel that takes a picture

def plate(columns: int = 80, rows: int = 80) -> tuple[np.ndarray, np.ndarray]:
    s, t, quads = grid(columns, rows)
    x, y = s - 0.5, t - 0.5
    return np.column_stack([x, y, -0.16 * y**2 - 0.10 * x**2]), quads


def star(size: int = 256) -> np.ndarray:
    """A grey image (size x size): a white star of five rounded points on black, with sharp edges."""
    at = (np.arange(size) + 0.5) / size - 0.5
    x, y = at[None, :], at[:, None]
    reach = 0.27 + 0.09 * np.cos(5.0 * (np.arctan2(y, x) - 0.5 * np.pi))
    return (np.hypot(x, y) < reach).astype(float)
