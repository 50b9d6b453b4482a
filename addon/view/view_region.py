"""The 3D views: whether the mouse is over one itself, or over the sidebar, a header or a toolbar that covers it."""
import bpy

View = tuple[bpy.types.Region, bpy.types.RegionView3D]


def find_view_region(area: bpy.types.Area) -> bpy.types.Region:
    """Returns the region of a 3D view's area that shows the scene, the first of four in Quad View."""
    return next(region for region in area.regions if region.type == 'WINDOW')


def list_views(area: bpy.types.Area) -> list[View]:
    """Returns the regions of a 3D view's area that show the scene, each with its view: four in Quad View."""
    regions = [region for region in area.regions if region.type == 'WINDOW']
    space = area.spaces.active  # its region_3d is that of the last region
    return list(zip(regions, space.region_quadviews or [space.region_3d], strict=True))


def covers(region: bpy.types.Region, x: int, y: int) -> bool:
    """Returns whether a region lies at a place, in pixels of the window. Hidden regions are one pixel large."""
    return 0 <= x - region.x < region.width and 0 <= y - region.y < region.height and region.width > 1


def find_view_at(area: bpy.types.Area, x: int, y: int) -> View | None:
    """Returns what shows the scene at a place (pixels of the window), None where something else does. The view's region
    reaches below the sidebar where regions overlap.
    """
    if any(covers(region, x, y) for region in area.regions if region.type != 'WINDOW'):
        return None
    return next((view for view in list_views(area) if covers(view[0], x, y)), None)


def find_view_left(area: bpy.types.Area, view: bpy.types.Region) -> int:
    """Returns where one of the area's views begins beside the toolbar, in pixels of the window."""
    tools = [region for region in area.regions if region.type == 'TOOLS' and region.width > 1]
    return max([view.x, *(region.x + region.width for region in tools)])


def find_free_width(area: bpy.types.Area, view: bpy.types.Region) -> tuple[int, int]:
    """Returns where one of the area's views begins and ends between toolbar and sidebar, in pixels of the window."""
    sidebars = [region for region in area.regions if region.type == 'UI' and region.width > 1]
    return find_view_left(area, view), min([view.x + view.width, *(region.x for region in sidebars)])


def find_view_middle(area: bpy.types.Area) -> tuple[int, int]:
    """Returns the middle of the view between toolbar and sidebar, in pixels of the window."""
    view = find_view_region(area)
    return sum(find_free_width(area, view)) // 2, view.y + view.height // 2


def redraw_views(context: bpy.types.Context) -> None:
    """Redraws the 3D views of all windows, with their sidebars."""
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == 'VIEW_3D':
                area.tag_redraw()
