"""The condition at a region's border: one for all vertices, or each segment's own."""
import numpy as np

# The numbers by which the native module knows them.
CODES = {"free": 0, "fixed": 1, "clamped": 2, "curvature": 3, "flow": 4, "follow": 5}
AUTOMATIC = "automatic"  # stands for one of them, see settle_border
NAMES = {AUTOMATIC: "Automatic", "free": "Free", "fixed": "Position (G0)", "clamped": "Tangent (G1)",
         "curvature": "Curvature (G2)", "flow": "Flow (G3)", "follow": "Neighbours"}  # by which the artist knows them
UNSET = -1  # of a vertex without a condition of its own
WRONG = -2  # of one whose stored value stands for none


def name_border(border: str) -> str:
    """Returns the name by which the artist knows a border; what is none, as a file may hold, as it is."""
    return NAMES.get(border, border)


def settle_border(border: str, *, joined: bool) -> str:
    """Returns the border that a solve takes: the automatic one follows panels that are solved as one with this one, and
    is clamped elsewhere.
    """
    return border if border != AUTOMATIC else "follow" if joined else "clamped"


def needs_surroundings(border: str | np.ndarray) -> bool:
    """Returns whether a border, or one of its codes, takes its curvature, or more, from the faces around the region."""
    codes = CODES[border] if isinstance(border, str) else border
    return bool(np.isin(codes, (CODES["curvature"], CODES["flow"])).any())


def fill_border(own: np.ndarray, border: str) -> str | np.ndarray:
    """Returns the border as the native module takes it: the name where no vertex has a code of its own (#V), else the
    codes, with the name's for the others.
    """
    return np.where(own == UNSET, CODES[border], own) if (own != UNSET).any() else border


def clamp_instead(border: str | np.ndarray) -> str | np.ndarray:
    """Returns the border, or its codes, clamped where it would follow its neighbours."""
    if isinstance(border, str):
        return "clamped" if border == "follow" else border
    return np.where(border == CODES["follow"], CODES["clamped"], border)
