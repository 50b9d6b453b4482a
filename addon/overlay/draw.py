"""Draws the stripes over meshes. A batch is rebuilt when its surface changes, never when a setting does."""
import time
from dataclasses import dataclass, field

import bpy
import gpu
import numpy as np

from .. import native
from ..blender.app_handlers import draw_in_views
from ..model.solution import LastSolve
from ..model.surface import Surface, Topology
from ..read import image_pixels, read_mesh, shape_keys, viewport_cage, viewport_surface
from ..state import compared, last_panels, solve_history
from ..view import places_beside, view_region
from . import draw_cage, legend, shader, shown_objects, solve_maps, stripe_scene, stripes
from .fitted_normals import FIT_RINGS, FittedNormals
from .limit_surface import LimitTopology, update_surface

POLL_INTERVAL = 0.05  # seconds between two checks of the background fit
UNSEEN_TIME = 60.0  # seconds until objects that no viewport draws are dropped; several viewports draw different ones
KEPT_TEXTURES = 4  # environment images kept; one of 2,048 x 1,024 pixels takes 16 MB
NOTHING = (np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int32), np.zeros((0, 3)))
BEFORE = "before "  # prefix of the names of fits of the shape before the last solve
AFTER = "after "  # prefix of the names of uniforms of the shape beside it


@dataclass
class Uploaded:
    """A batch, and the arrays that it was built from."""
    arrays: tuple = ()
    batch: gpu.types.GPUBatch | None = None

    def take(self, arrays: tuple[np.ndarray, ...]) -> None:
        """Builds the batch anew where the arrays changed."""
        if len(arrays) != len(self.arrays) or not all(map(np.array_equal, arrays, self.arrays)):
            self.batch = build_batch(*arrays) if len(arrays[1]) else None
            self.arrays = arrays


@dataclass
class ShownObject:
    """The batches and the state of drawing of one object."""
    address: tuple[str, str | None]  # name and library, by which Blender finds it
    kind: tuple = ()              # mode, content, solve and kind of surface when it was read
    stale: bool = True            # the surface may have changed since it was uploaded
    topology: Topology | None = None
    surface: Uploaded = field(default_factory=Uploaded)
    after: Uploaded | None = None  # beside the shape before the last solve, that after it, where they differ
    corners: np.ndarray | None = None  # 8 x 3: of the box around what the last solve moved, object space
    cage: draw_cage.ShownCage | None = None   # of Edit Mode
    drawn: float = field(default_factory=time.monotonic)  # time of the last drawing


@dataclass
class DrawCache:
    """The data of all viewports. Shader and textures are kept: Blender 5.2 crashes when a texture dies after its
    shader.
    """
    shown: dict[str, ShownObject] = field(default_factory=dict)  # by full names, as fits, limits and uniforms
    fits: FittedNormals = field(default_factory=FittedNormals)
    limits: dict[str, LimitTopology] = field(default_factory=dict)
    shader: gpu.types.GPUShader | None = None
    dots: gpu.types.GPUShader | None = None
    uniforms: dict = field(default_factory=dict)  # one an object: the GPU reads it while the next is filled
    textures: dict = field(default_factory=dict)
    builds: int = 0               # batches made so far


_cache = DrawCache()


def is_waiting() -> bool:
    """Returns whether a fit of normals is pending."""
    return _cache.fits.is_waiting()


def draw_stripes() -> None:
    """Draws the stripes in a viewport (POST_VIEW)."""
    context = bpy.context
    settings = context.scene.reflection_lines.stripes
    compared.note_span(context.region, None)
    if settings.show and context.space_data.overlay.show_overlays:
        draw_objects(context, settings)
    if not stripe_scene.is_split(settings):
        compared.NOW.fraction = compared.MIDDLE
    drop_unseen_objects()
    if is_waiting() and not bpy.app.timers.is_registered(poll_fits):
        bpy.app.timers.register(poll_fits, first_interval=POLL_INTERVAL)


def draw_objects(context: bpy.types.Context, settings: bpy.types.PropertyGroup) -> None:
    last_panels.remember_panels(context.scene, shown_objects.find_panels(context, settings))
    drawn = []
    for ob in shown_objects.find_shown_objects(context, settings):
        values = stripe_scene.build_uniforms(context, ob)
        if values is None:
            continue
        shown = _cache.shown.setdefault(ob.name_full, ShownObject(find_address(ob)))
        shown.drawn = time.monotonic()
        refresh_object(shown, ob, settings, context.evaluated_depsgraph_get())
        drawn.append((ob, shown, values))
    note_comparison(context, [(ob, shown.corners) for ob, shown, _ in drawn if shown.after is not None])
    for ob, shown, values in drawn:
        draw_object(context, ob, shown, values)


def note_comparison(context: bpy.types.Context, boxes: list[tuple[bpy.types.Object, np.ndarray]]) -> None:
    """Records where the view shows objects before and after their last solve, by the corners of their boxes."""
    if not boxes:
        return
    matrices = [(stripe_scene.to_array(ob.matrix_world), corners) for ob, corners in boxes]
    corners = np.concatenate([corners @ matrix[:3, :3].T + matrix[:3, 3] for matrix, corners in matrices])
    span = places_beside.find_span(context.area, context.region, context.region_data, corners)
    compared.note_span(context.region, span)


def draw_object(context: bpy.types.Context, ob: bpy.types.Object, shown: ShownObject, values: np.ndarray) -> None:
    """Draws the stripes of an object, those before the last solve up to the divider, and its cage."""
    texture = find_texture(context.scene.reflection_lines.stripes)
    divider = compared.find_divider(context.region) if shown.after is not None else None
    x = 0.0 if divider is None else max(round(divider), 1)  # 0 stands for no divider
    for name, uploaded, side in ((ob.name_full, shown.surface, -1.0), (AFTER + ob.name_full, shown.after, 1.0)):
        if uploaded is not None and uploaded.batch is not None:
            draw_batch(name, uploaded.batch, stripes.keep_side(values, side * x), texture)
    if shown.cage is not None:
        _cache.dots = _cache.dots or draw_cage.compile_dots()
        draw_cage.CagePainter(context, ob, _cache.dots).draw(shown.cage)


def find_address(ob: bpy.types.Object) -> tuple[str, str | None]:
    """Returns name and library, by which an object is found beside a linked one of the same name."""
    return ob.name, None if ob.library is None else ob.library.filepath


def drop_unseen_objects() -> None:
    """Drops what is kept of objects that are gone or that no viewport has drawn for UNSEEN_TIME. Called after drawing,
    since a view may rest for longer.
    """
    late = time.monotonic() - UNSEEN_TIME
    for name in [name for name, shown in _cache.shown.items()
                 if shown.drawn < late or bpy.data.objects.get(shown.address) is None]:
        del _cache.shown[name]
        for kept in (name, AFTER + name):
            _cache.uniforms.pop(kept, None)
        _cache.limits.pop(name, None)
        for fit in (name, BEFORE + name):
            _cache.fits.drop(fit)


def refresh_object(shown: ShownObject, ob: bpy.types.Object, settings: bpy.types.PropertyGroup,
            depsgraph: bpy.types.Depsgraph) -> None:
    solution = solve_history.find_last_solve(ob.name_full) if stripe_scene.needs_solution(settings) else None
    with_cage = settings.cage_on_top and ob.mode == 'EDIT' and draw_cage.read_kind(ob)
    kind = (ob.mode, stripe_scene.identify_content(ob, settings), id(solution), with_cage)
    if not shown.stale and shown.kind == kind:
        return
    read = read_limit_surface(ob) or viewport_surface.read_viewport_surface(ob, depsgraph, shown.topology)
    changed = solution is not None and not is_current(ob, solution, read)
    solve_history.mark_changed(ob.name_full, changed=changed)
    if changed or not is_old_surface_known(ob, read):
        solution = None
    shown.surface.take(build_arrays(ob, settings, read, solution))
    if stripe_scene.is_split(settings) and solution is not None and is_seen(ob, solution):
        shown.after = shown.after or Uploaded()
        shown.corners = places_beside.measure_corners(solution.patch.local)
        shown.after.take(build_shape_arrays(ob, settings, read))
    else:
        shown.after = None
    shown.cage = draw_cage.start_cage(ob, read) if with_cage else None
    shown.topology, shown.kind, shown.stale = read.topology, kind, False


def is_current(ob: bpy.types.Object, solution: LastSolve, read: Surface) -> bool:
    """Returns whether an object is as its last solve left it: the surface shown, or else the mesh below it."""
    if len(read.V) == len(ob.data.vertices):
        return solve_maps.is_current(solution, read.V, shape_keys.read_seen_fraction(ob, solution.patch.key))
    return not read_mesh.is_undone(ob, solution.patch, solution.positions)


def is_old_surface_known(ob: bpy.types.Object, read: Surface) -> bool:
    """Returns whether the surface before the last solve can be drawn: that of the mesh itself, or a cage's. What other
    modifiers made of the mesh then, such as a bevel, is not known.
    """
    return read.normals is not None or len(read.V) == len(ob.data.vertices)


def is_seen(ob: bpy.types.Object, solution: LastSolve) -> bool:
    """Returns whether the last solve is a difference that is seen."""
    return solve_maps.has_moved(solution) and shape_keys.read_seen_fraction(ob, solution.patch.key) != 0.0


def read_limit_surface(ob: bpy.types.Object, before: LastSolve | None = None) -> Surface | None:
    """Returns the limit surface of a cage, whether that or the mesh is solved for; None of other objects. With `before`
    that of the shape before this solve.
    """
    read = viewport_cage.read_viewport_cage(ob, before) if native.STATE.usable else None
    return None if read is None else update_surface(_cache.limits, ob.name_full, *read)


def build_arrays(ob: bpy.types.Object, settings: bpy.types.PropertyGroup, read: Surface,
              solution: LastSolve | None) -> tuple[np.ndarray, ...]:
    """Builds the arrays to upload; empty for a map without a solve."""
    if settings.mode in stripe_scene.MAPS:
        make = solve_maps.build_deviation_map if settings.mode == 'DEVIATION' else solve_maps.build_flat_map
        return NOTHING if solution is None else make(solution, settings.mode)
    if settings.before and solution is not None:
        cage = read_limit_surface(ob, solution) if read.normals is not None else None
        if cage is not None:  # its old limit normals; a coarse cage's own would show none of its surface's dents
            return read.V, read.F, cage.normals
        old = read.V.copy()
        old[solution.patch.index] = solution.patch.local
        # Vertices move along the view, so seen from the view camera the old reflections lie on the present surface.
        shaded = _cache.fits.update_shaded(BEFORE + ob.name_full, old, read.F)
        return read.V[shaded.vertex], shaded.F, shaded.normals
    return build_shape_arrays(ob, settings, read)


def build_shape_arrays(ob: bpy.types.Object, settings: bpy.types.PropertyGroup,
                       read: Surface) -> tuple[np.ndarray, ...]:
    """Builds the arrays of the surface as it is now."""
    build = build_part_arrays if stripe_scene.is_part_only(ob, settings) else build_whole_arrays
    return build(ob.name_full, read)


def build_whole_arrays(name: str, read: Surface) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Builds positions, triangles and normals of the whole surface."""
    if read.normals is not None:
        return read.V, read.F, read.normals
    shaded = _cache.fits.update_shaded(name, read.V, read.F)
    return read.V[shaded.vertex], shaded.F, shaded.normals


def build_part_arrays(name: str, read: Surface) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Builds the arrays of the selected triangles, with the normals that they have in the whole surface."""
    inside = stripes.grow_selection(read.F, read.selected, len(read.V), rings=FIT_RINGS)
    used, F = np.unique(read.F[inside], return_inverse=True)
    V, F = read.V[used], F.reshape(-1, 3).astype(np.int32)
    chosen = read.selected[inside]
    if read.normals is not None:
        return V, F[chosen], read.normals[used]
    shaded = _cache.fits.update_shaded(name, V, F)
    return V[shaded.vertex], shaded.F[chosen], shaded.normals


def build_batch(V: np.ndarray, F: np.ndarray, normals: np.ndarray,
                fraction: np.ndarray | None = None) -> gpu.types.GPUBatch:
    _cache.builds += 1
    values = np.zeros((len(V), 1)) if fraction is None else fraction.reshape(-1, 1)
    return draw_cage.build_batch('TRIS', V, F, nor=normals, val=values)


def find_texture(settings: bpy.types.PropertyGroup) -> gpu.types.GPUTexture:
    """Returns the texture of the environment image; a grey pixel where none is wanted or it has no pixels."""
    wanted = settings.image if settings.mode == 'IMAGE' else None
    key = image_pixels.identify_image(wanted) if wanted is not None else None
    if key not in _cache.textures:
        pixels = image_pixels.read_environment(wanted) if wanted is not None else None
        _cache.textures[key] = build_texture(np.full((1, 1, 4), 0.2, np.float32) if pixels is None else pixels)
    _cache.textures[key] = _cache.textures.pop(key)  # moved to the end, as the one used last
    for old in list(_cache.textures)[:-KEPT_TEXTURES]:
        del _cache.textures[old]
    return _cache.textures[key]


def build_texture(pixels: np.ndarray) -> gpu.types.GPUTexture:
    wrapped = np.ascontiguousarray(np.concatenate([pixels[:, -1:], pixels, pixels[:, :1]], axis=1))
    height, width = wrapped.shape[:2]
    return gpu.types.GPUTexture((width, height), format='RGBA16F',
                                data=gpu.types.Buffer('FLOAT', wrapped.size, wrapped.ravel()))


def draw_batch(name: str, batch: gpu.types.GPUBatch, values: np.ndarray, texture: gpu.types.GPUTexture) -> None:
    data = gpu.types.Buffer('FLOAT', len(values), values)
    if _cache.shader is None:
        _cache.shader = shader.compile_shader()
    if name in _cache.uniforms:
        _cache.uniforms[name].update(data)
    else:
        _cache.uniforms[name] = gpu.types.GPUUniformBuf(data)
    gpu.state.depth_test_set('LESS_EQUAL')
    gpu.state.depth_mask_set(True)  # of two shells the nearer one hides the other's stripes
    gpu.state.blend_set('ALPHA')
    _cache.shader.bind()
    _cache.shader.uniform_block("ub", _cache.uniforms[name])
    _cache.shader.uniform_sampler("environment", texture)
    batch.draw(_cache.shader)
    gpu.state.depth_mask_set(False)
    gpu.state.blend_set('NONE')
    gpu.state.depth_test_set('NONE')


def poll_fits() -> float | None:
    """Redraws surfaces whose fit has finished; a timer that runs while one is pending."""
    name = _cache.fits.take_finished()
    if name is not None and name.removeprefix(BEFORE) in _cache.shown:
        _cache.shown[name.removeprefix(BEFORE)].stale = True
        view_region.redraw_views(bpy.context)
    _cache.fits.advance()
    return POLL_INTERVAL if is_waiting() else None


@bpy.app.handlers.persistent
def note_changes(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    """Marks changed surfaces as stale. A selection is no change of geometry, but it changes which part is drawn; nor is
    a stroke of Sculpt Mode one before the mode ends.
    """
    any_update = scene.reflection_lines.stripes.scope == 'SELECTION'
    for update in depsgraph.updates:
        shown = _cache.shown.get(update.id.original.name_full) if isinstance(update.id, bpy.types.Object) else None
        if shown is not None:
            shown.stale |= update.is_updated_geometry or any_update or update.id.mode == 'SCULPT'
        elif isinstance(update.id, bpy.types.Mesh) and update.id.original.is_editmode:
            note_mesh_changed(update.id.name)
        elif any_update:
            note_all_changed()


def note_mesh_changed(name: str) -> None:
    """Marks the objects that show an edited mesh as stale: a selection changes the cage that is drawn."""
    for shown in _cache.shown.values():
        ob = bpy.data.objects.get(shown.address)
        shown.stale |= ob is not None and ob.data is not None and ob.data.name == name


@bpy.app.handlers.persistent
def note_all_changed(*_: object) -> None:
    """Marks everything as stale, since undo replaces objects without saying which."""
    for shown in _cache.shown.values():
        shown.stale = True


@bpy.app.handlers.persistent
def clear_cache(*_: object) -> None:
    _cache.shown.clear()
    _cache.textures.clear()
    _cache.fits.clear()
    _cache.limits.clear()


# Another frame is no update of the depsgraph to Blender's handlers, though shape keys may change with it.
HANDLERS = (("depsgraph_update_post", note_changes), ("frame_change_post", note_changes),
            ("undo_post", note_all_changed), ("redo_post", note_all_changed), ("load_post", clear_cache))


def stop() -> None:
    if bpy.app.timers.is_registered(poll_fits):
        bpy.app.timers.unregister(poll_fits)
    clear_cache()


register, unregister = draw_in_views(((draw_stripes, 'POST_VIEW'), (legend.draw_legend, 'POST_PIXEL')), HANDLERS, stop)
