"""Finds the place of a surface under the mouse, and the pixels of points."""
from collections.abc import Sequence

import bpy
import numpy as np

from ..model.line_surface import LineState, LineSurface, Place, PlaneTriangles
from ..model.patch import Patch
from . import view_region
from .view_region import View


class ScreenSurface:
    """A surface at the start of a session as a 3D view shows it; projected anew when the view is turned, and where the
    mouse comes to another one of the four in Quad View.
    """

    def __init__(self, surface: LineSurface, area: bpy.types.Area) -> None:
        self.surface, self.area = surface, area
        self.last = (-1, -1)  # place over a view that was asked for, pixels of the window
        self.matrix = np.zeros((4, 4))  # of the last projection, to pixels of the region
        self.triangles: PlaneTriangles | None = None
        self.depth = np.empty(0)  # #V x 2: homogeneous w, and depth

    def find_place(self, x: float, y: float, *, stay: bool = False) -> Place | None:
        """Returns the foremost place at a pixel of the window; None beside the surface, over a sidebar, and, where it
        is to `stay` in the view of the last place, over another one.
        """
        view = view_region.find_view_at(self.area, int(x), int(y))
        if view is None or stay and view != self.find_view():
            return None
        self.last = int(x), int(y)
        self.project()
        region = view[0]
        found, weights = self.triangles.find(np.array([x - region.x, y - region.y]))
        if not len(found):
            return None
        corners = self.surface.F[found]
        weights = weights / self.depth[corners, 0]  # perspective
        weights /= weights.sum(axis=1, keepdims=True)
        front = int((weights * self.depth[corners, 1]).sum(axis=1).argmin())
        return Place(int(found[front]), weights[front])

    def find_view(self) -> View:
        """Returns the view of the last place."""
        return view_region.find_view_at(self.area, *self.last) or view_region.list_views(self.area)[0]

    def project(self) -> None:
        """Projects the surface, where the view has changed."""
        matrix = compute_pixel_matrix(self.find_view())
        if self.triangles is not None and np.array_equal(matrix, self.matrix):
            return
        self.matrix = matrix
        pixels, self.depth = project_points(matrix, self.surface.start.V)
        self.triangles = PlaneTriangles(pixels, self.surface.F)

    def measure_pixel(self, point: np.ndarray) -> float:
        """Returns the length of a pixel across the view at a point (3), world units."""
        matrix = compute_pixel_matrix(self.find_view())
        across = np.linalg.norm(matrix[:2, :3], axis=1).mean()
        return float(matrix[3] @ np.append(point, 1.0)) / across

    def measure_depth(self, point: np.ndarray) -> float:
        """Returns the depth of a point (3): less is nearer to the viewer."""
        return float(project_points(compute_pixel_matrix(self.find_view()), point[None])[1][0, 1])

    def find_pixels(self, points: np.ndarray) -> np.ndarray:
        """Returns where points (#P x 3) are seen, in pixels of the window: #P x 2, NaN behind the viewer."""
        view = self.find_view()
        return project_points(compute_pixel_matrix(view), points)[0] + [view[0].x, view[0].y]


def build_screen(patch: Patch, area: bpy.types.Area) -> ScreenSurface:
    """Builds what finds a patch under the mouse."""
    return ScreenSurface(LineSurface(LineState(patch.V, np.zeros(len(patch.V))), patch.F, np.eye(3)), area)


def find_foremost(surfaces: Sequence[ScreenSurface], x: float, y: float, *,
                  stay: bool = False) -> tuple[int, np.ndarray] | None:
    """Returns the foremost place of several surfaces at a pixel, as find_place does: the number of its surface, and the
    point (3, world space).
    """
    found = [(number, each.surface.read_point(place, each.surface.start)) for number, each in enumerate(surfaces)
             if (place := each.find_place(x, y, stay=stay)) is not None]
    return min(found, key=lambda each: surfaces[each[0]].measure_depth(each[1]), default=None)


def compute_pixel_matrix(view: View) -> np.ndarray:
    """Returns the matrix (4 x 4) from world space to homogeneous pixels of the view's region."""
    region, region_3d = view
    to_pixels = np.diag([0.5 * region.width, 0.5 * region.height, 1.0, 1.0])
    to_pixels[:2, 3] = 0.5 * region.width, 0.5 * region.height
    return to_pixels @ np.array(region_3d.perspective_matrix)


def project_points(matrix: np.ndarray, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the pixels of points, and for each its homogeneous w and its depth; NaN behind the viewer."""
    clip = points @ matrix[:, :3].T + matrix[:, 3]
    w = np.where(clip[:, 3] > 0.0, clip[:, 3], np.nan)
    return clip[:, :2] / w[:, None], np.column_stack([w, clip[:, 2] / w])
