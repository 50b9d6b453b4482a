"""Places beside a region of a mesh in a 3D view, for gizmos: always within what toolbar and sidebar leave free."""
import bpy
import numpy as np
from bpy_extras import view3d_utils
from mathutils import Vector

from . import view_region


def measure_corners(points: np.ndarray) -> np.ndarray:
    """Returns the corners of the bounding box of points: 8 x 3."""
    low, high = points.min(axis=0), points.max(axis=0)
    chosen = np.indices((2, 2, 2)).reshape(3, 8).T
    return np.where(chosen, high, low)


def find_place(area: bpy.types.Area, region: bpy.types.Region, region_3d: bpy.types.RegionView3D,
               corners: np.ndarray, *, aside: float, margin: float) -> Vector:
    """Finds the place right of a box, in pixels of the region, which is one of the area's 3D views.

    Args:
        corners: of the box, 8 x 3, in world space.
        aside: distance from the box, pixels.
        margin: least distance from what covers the view, pixels; where the box fills the view, the place is over it.
    """
    seen = [place for corner in corners
            if (place := view3d_utils.location_3d_to_region_2d(region, region_3d, corner)) is not None]
    free_low, free_high = view_region.find_free_width(area, region)
    low, high = max(free_low - region.x, 0), min(free_high - region.x, region.width)
    x, y = high, 0.5 * region.height
    if seen:
        heights = [place.y for place in seen]
        x, y = max(place.x for place in seen) + aside, 0.5 * (min(heights) + max(heights))
    return Vector((clamp(x, low + margin, high - margin), clamp(y, margin, region.height - margin)))


def find_span(area: bpy.types.Area, region: bpy.types.Region, region_3d: bpy.types.RegionView3D,
              corners: np.ndarray) -> tuple[float, float] | None:
    """Finds from where to where a view shows boxes (#corners x 3, world space), in pixels of the region, within what
    toolbar and sidebar leave free; None where they lie beside it.
    """
    seen = [place.x for corner in corners
            if (place := view3d_utils.location_3d_to_region_2d(region, region_3d, corner)) is not None]
    free_low, free_high = view_region.find_free_width(area, region)
    low, high = max(free_low - region.x, 0), min(free_high - region.x, region.width)
    if len(seen) == len(corners):  # else the view is within the box
        low, high = max(low, min(seen)), min(high, max(seen))
    return (float(low), float(high)) if low < high else None


def find_point(region: bpy.types.Region, region_3d: bpy.types.RegionView3D, place: Vector,
               corners: np.ndarray) -> Vector:
    """Returns the point in space at a place of a 3D view's region, as far away as the middle of a box."""
    return view3d_utils.region_2d_to_location_3d(region, region_3d, place, Vector(corners.mean(axis=0)))


def clamp(value: float, low: float, high: float) -> float:
    """Returns the value within limits; the middle of them where they exclude each other."""
    return min(max(value, low), high) if low <= high else 0.5 * (low + high)
