"""Curves along which a line is laid: through a few points that can be moved, fitted to a stroke or made from a line."""
import numpy as np

POINTS = 5          # of a new curve
MORE_POINTS = 9     # of one that leaves the line's held ends
SAMPLES_BETWEEN = 8  # of a curve, from point to point
ALONG = 0.7         # cosine of the angle between a line and the edges that it can follow


def sample_curve(points: np.ndarray, each: int = SAMPLES_BETWEEN) -> np.ndarray:
    """Samples the Catmull-Rom curve through points (#P x d), which goes straight on at both ends."""
    return weigh_points(len(points), np.linspace(0.0, len(points) - 1.0, each * (len(points) - 1) + 1)) @ points


def weigh_points(count: int, at: np.ndarray) -> np.ndarray:
    """Returns the weights of a curve's points (#at x count) at parameters from 0 to count - 1."""
    first = np.clip(np.floor(at).astype(int), 0, count - 2)
    t = (at - first)[:, None]
    cubic = 0.5 * np.hstack([-t + 2.0 * t**2 - t**3, 2.0 - 5.0 * t**2 + 3.0 * t**3, t + 4.0 * t**2 - 3.0 * t**3,
                             -t**2 + t**3])
    weights = np.zeros((len(at), count + 2))  # with a point before the first and one after the last
    for k in range(4):
        np.add.at(weights, (np.arange(len(at)), first + k), cubic[:, k])
    inner = weights[:, 1:-1]
    inner[:, 0] += 2.0 * weights[:, 0]
    inner[:, 1] -= weights[:, 0]
    inner[:, -1] += 2.0 * weights[:, -1]
    inner[:, -2] -= weights[:, -1]
    return inner


def fit_curve(stroke: np.ndarray, count: int = POINTS) -> np.ndarray:
    """Fits a curve to a stroke (#S x d) by least squares over its length, with the stroke's ends: #P x d."""
    even = space_evenly(stroke, 8 * count)
    weights = weigh_points(count, np.linspace(0.0, count - 1.0, len(even)))
    ends = weights[:, [0, -1]] @ even[[0, -1]]
    inner = np.linalg.lstsq(weights[:, 1:-1], even - ends, rcond=None)[0]
    return np.concatenate([even[:1], inner, even[-1:]])


def space_evenly(line: np.ndarray, count: int = MORE_POINTS) -> np.ndarray:
    """Returns points at equal steps along a line (#P x d), its ends among them: #count x d."""
    passed = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1)))
    at = np.linspace(0.0, passed[-1], count)
    return np.column_stack([np.interp(at, passed, column) for column in line.T])


def straighten(line: np.ndarray, count: int = POINTS) -> np.ndarray:
    """Returns points on the straight way from one end of a line to the other."""
    return np.linspace(line[0], line[-1], count)


def run_parallel(line: np.ndarray, edges: np.ndarray, place: np.ndarray) -> np.ndarray:
    """Moves the points of a line (#P x 2) to the distance from edges (#E x 2 x 2) that a place on it has (2)."""
    nearest = find_nearest(line, edges)
    own = np.linalg.norm(place - find_nearest(place[None], edges)[0])
    way = line - nearest
    apart = np.linalg.norm(way, axis=1, keepdims=True)
    return nearest + way * (own / np.maximum(apart, 1e-12 * max(own, 1.0)))


def keep_ends(line: np.ndarray, moved: np.ndarray, movable: np.ndarray, length: float) -> np.ndarray:
    """Returns the moved points of a line (#P x 2), but for ends that are not movable (#P), which stay: within a length
    of these the moved course is shifted, less and less, so that it begins there.
    """
    if not movable.any():
        return line
    passed = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1)))
    first, last = np.flatnonzero(movable)[[0, -1]]
    result = moved.copy()
    for end, is_held in ((first, first > 0), (last, last < len(line) - 1)):
        if is_held:
            t = np.clip(np.abs(passed - passed[end]) / length, 0.0, 1.0)
            result -= (1.0 - t * t * (3.0 - 2.0 * t))[:, None] * (moved[end] - line[end])
    result[:first], result[last + 1:] = line[:first], line[last + 1:]
    return result


def find_nearest(points: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Returns the nearest point of all edges to each point: #P x 2."""
    feet = find_feet(points, edges)
    return feet[np.arange(len(points)), ((feet - points[:, None])**2).sum(axis=2).argmin(axis=1)]


def choose_loop(edges: np.ndarray, place: np.ndarray, way: np.ndarray) -> np.ndarray:
    """Chooses those edges (#E x 2 x 2) that run along a way (2), in one chain with the nearest of them to a place."""
    along = edges[:, 1] - edges[:, 0]
    edges = edges[np.abs(along @ way) > ALONG * np.linalg.norm(along, axis=1) * np.linalg.norm(way)]
    if not len(edges):
        return edges
    ends = np.unique(edges.reshape(-1, 2), axis=0, return_inverse=True)[1].reshape(-1, 2)
    chosen = np.zeros(len(edges), dtype=bool)
    chosen[((find_feet(place[None], edges)[0] - place)**2).sum(axis=1).argmin()] = True
    while True:
        touching = np.isin(ends, ends[chosen]).any(axis=1)
        if np.array_equal(touching, chosen):
            return edges[chosen]
        chosen = touching


def find_feet(points: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Returns the nearest point of each edge to each point: #P x #E x 2."""
    a, way = edges[:, 0], edges[:, 1] - edges[:, 0]
    square = np.maximum((way**2).sum(axis=1), 1e-300)
    t = np.clip(((points[:, None] - a) * way).sum(axis=2) / square, 0.0, 1.0)
    return a + t[:, :, None] * way
