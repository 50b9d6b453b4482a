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


def needs_surroundings(codes: np.ndarray) -> bool:
    """Returns whether one of the codes takes its curvature, or more, from the faces around the region."""
    return bool(np.isin(codes, (CODES["curvature"], CODES["flow"])).any())
