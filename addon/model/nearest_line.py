"""The line that has to change least to run along a stroke."""
import numpy as np


def compute_mean_theta(theta: np.ndarray, points: np.ndarray) -> float:
    """Computes the mean of theta (#S, radians, in any turn) over the length of a stroke (#S x 3). Of all lines that of
    this value differs least from the stroke, by the mean of squares.
    """
    passed = np.linalg.norm(np.diff(points, axis=0), axis=1)
    turned = np.unwrap(theta)
    return float(passed @ (turned[1:] + turned[:-1]) / (2.0 * passed.sum()))
