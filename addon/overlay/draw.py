"""Draws the stripes over meshes. A batch is rebuilt when its surface changes, never when a setting does."""
import time
from dataclasses import dataclass, field

import bpy
import gpu
import numpy as np

from .. import native, session, solving
from ..bridge import environment, shown_cage, surface
from . import last_solve, limit, seen, shader, stripes
from .normals import FIT_RINGS, Fits

POLL = 0.05  # seconds between two looks at the fit in a thread
UNSEEN = 60.0   # seconds after which what no viewport draws is dropped: of two, each leaves the other its own
TEXTURES = 4    # environment images kept; one of 2,048 x 1,024 pixels takes 16 MB
NOTHING = (np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int32), np.zeros((0, 3)))
BEFORE = "before "  # the fit of an object's shape before its last solve goes by this and its name


@dataclass
class Shown:
    """What is on the GPU of one object."""
    kind: tuple = ()              # how it was read: mode and part
    stale: bool = True            # the surface may have changed since it was uploaded
    topology: object = None
    uploaded: tuple = ()          # the arrays of the batch
    batch: object = None
    drawn: float = field(default_factory=time.monotonic)  # last


@dataclass
class Cache:
    """Of all viewports. Shader and textures are kept: Blender 5.2 crashes when a texture dies after its shader."""
    shown: dict[str, Shown] = field(default_factory=dict)
    fits: Fits = field(default_factory=Fits)
    limits: limit.Limits = field(default_factory=limit.Limits)
    shader: object = None
    uniforms: dict = field(default_factory=dict)   # one buffer an object: drawing is not done when the next is filled
    textures: dict = field(default_factory=dict)
    builds: int = 0               # batches made so far
    handles: list = field(default_factory=list)


_cache = Cache()


def batch_builds() -> int:
    return _cache.builds


def kept() -> set[str]:
    """Names of the objects of which anything is kept."""
    fits, limits = _cache.fits, _cache.limits
    every = (*_cache.shown, *_cache.uniforms, *fits.done, *fits.wanted, *fits.started, *limits.kept)
    return {name.removeprefix(BEFORE) for name in every}


def kept_textures() -> int:
    return len(_cache.textures)


def is_waiting() -> bool:
    """Whether a fit of normals is on its way."""
    return _cache.fits.is_waiting()


def draw() -> None:
    """In a viewport's POST_VIEW."""
    context = bpy.context
    settings = context.scene.reflection_lines.stripes
    if settings.show:
        draw_objects(context, settings)
    drop_unseen()
    if is_waiting() and not bpy.app.timers.is_registered(poll_fits):
        bpy.app.timers.register(poll_fits, first_interval=POLL)


def draw_objects(context: bpy.types.Context, settings: bpy.types.PropertyGroup) -> None:
    for ob in seen.shown_objects(context, settings):
        values = seen.uniforms(context, ob)
        if values is None:
            continue
        shown = _cache.shown.setdefault(ob.name, Shown())
        shown.drawn = time.monotonic()
        refresh(shown, ob, settings, context.evaluated_depsgraph_get())
        if shown.batch is not None:
            paint(ob.name, shown.batch, values, texture_of(settings))


def drop_unseen() -> None:
    """Of objects that are gone, or that no viewport has drawn for long. After drawing: a view may rest for longer."""
    late = time.monotonic() - UNSEEN
    for name in [name for name, shown in _cache.shown.items()
                 if shown.drawn < late or bpy.data.objects.get(name) is None]:
        del _cache.shown[name]
        _cache.uniforms.pop(name, None)
        _cache.limits.drop(name)
        for fit in (name, BEFORE + name):
            _cache.fits.drop(fit)


def refresh(shown: Shown, ob: bpy.types.Object, settings: bpy.types.PropertyGroup,
            depsgraph: bpy.types.Depsgraph) -> None:
    solution = session.last_solution(ob.name) if seen.needs_solution(settings) else None
    kind = (ob.mode, seen.content(ob, settings), id(solution), settings.id_data.reflection_lines.solve_for)
    if not shown.stale and shown.kind == kind:
        return
    read = limit_surface(ob, settings) or surface.read(ob, depsgraph, shown.topology)
    if solution is not None and not last_solve.is_current(solution, read.V, len(ob.data.vertices)):
        solution = None
    arrays = arrays_of(ob, settings, read, solution)
    if len(arrays) != len(shown.uploaded) or not all(map(np.array_equal, arrays, shown.uploaded)):
        shown.batch = make_batch(*arrays) if len(arrays[1]) else None
        shown.uploaded = arrays
    shown.topology, shown.kind, shown.stale = read.topology, kind, False


def limit_surface(ob: bpy.types.Object, settings: bpy.types.PropertyGroup) -> surface.Surface | None:
    """Of a cage, where that is what is solved for."""
    wanted = settings.id_data.reflection_lines.solve_for == 'CAGE' and native.STATE.usable
    read = shown_cage.read(ob) if wanted else None
    return None if read is None else _cache.limits.surface(ob.name, *read)


def arrays_of(ob: bpy.types.Object, settings: bpy.types.PropertyGroup, read: surface.Surface,
              solution: solving.Last | None) -> tuple[np.ndarray, ...]:
    """What is uploaded; nothing for a map of no solve."""
    if settings.mode in seen.MAPS:
        make = last_solve.residual_map if settings.mode == 'RESIDUAL' else last_solve.deviation_map
        return make(solution, settings.map_range) if solution is not None else NOTHING
    if settings.before and solution is not None:
        V, F, old = last_solve.before(solution, read.V, read.F, len(ob.data.vertices))
        shaded = _cache.fits.shaded(BEFORE + ob.name, old, F)
        return V[shaded.vertex], shaded.F, shaded.normals
    return part(ob.name, read) if seen.is_part_only(ob, settings) else whole(ob.name, read)


def whole(name: str, read: surface.Surface) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Positions, triangles and normals of a batch."""
    if read.normals is not None:
        return read.V, read.F, read.normals
    shaded = _cache.fits.shaded(name, read.V, read.F)
    return read.V[shaded.vertex], shaded.F, shaded.normals


def part(name: str, read: surface.Surface) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The selected triangles, with the normals that they have in the whole."""
    inside = stripes.around(read.F, read.selected, len(read.V), rings=FIT_RINGS)
    used, F = np.unique(read.F[inside], return_inverse=True)
    V, F = read.V[used], F.reshape(-1, 3).astype(np.int32)
    chosen = read.selected[inside]
    if read.normals is not None:
        return V, F[chosen], read.normals[used]
    shaded = _cache.fits.shaded(name, V, F)
    return V[shaded.vertex], shaded.F[chosen], shaded.normals


def make_batch(V: np.ndarray, F: np.ndarray, normals: np.ndarray,
               share: np.ndarray | None = None) -> gpu.types.GPUBatch:
    _cache.builds += 1
    layout = gpu.types.GPUVertFormat()
    layout.attr_add(id="pos", comp_type='F32', len=3, fetch_mode='FLOAT')
    layout.attr_add(id="nor", comp_type='F32', len=3, fetch_mode='FLOAT')
    layout.attr_add(id="val", comp_type='F32', len=1, fetch_mode='FLOAT')
    vertices = gpu.types.GPUVertBuf(len=len(V), format=layout)
    # attr_fill takes other types and orders as well, and draws them wrongly.
    vertices.attr_fill(id="pos", data=np.ascontiguousarray(V, np.float32))
    vertices.attr_fill(id="nor", data=np.ascontiguousarray(normals, np.float32))
    values = np.zeros((len(V), 1)) if share is None else share.reshape(-1, 1)
    vertices.attr_fill(id="val", data=np.ascontiguousarray(values, np.float32))
    triangles = gpu.types.GPUIndexBuf(type='TRIS', seq=np.ascontiguousarray(F, np.uint32))
    return gpu.types.GPUBatch(type='TRIS', buf=vertices, elem=triangles)


def texture_of(settings: bpy.types.PropertyGroup) -> gpu.types.GPUTexture:
    """Of the environment image; a grey point where none is wanted or none can be had."""
    wanted = settings.image if settings.mode == 'IMAGE' else None
    key = environment.key(wanted) if wanted is not None else None
    if key not in _cache.textures:
        pixels = environment.read(wanted) if wanted is not None else None
        _cache.textures[key] = make_texture(np.full((1, 1, 4), 0.2, np.float32) if pixels is None else pixels)
    _cache.textures[key] = _cache.textures.pop(key)  # the one used last at the end
    for old in list(_cache.textures)[:-TEXTURES]:
        del _cache.textures[old]
    return _cache.textures[key]


def make_texture(pixels: np.ndarray) -> gpu.types.GPUTexture:
    wrapped = np.ascontiguousarray(np.concatenate([pixels[:, -1:], pixels, pixels[:, :1]], axis=1))
    height, width = wrapped.shape[:2]
    return gpu.types.GPUTexture((width, height), format='RGBA16F',
                                data=gpu.types.Buffer('FLOAT', wrapped.size, wrapped.ravel()))


def paint(name: str, batch: gpu.types.GPUBatch, values: np.ndarray, texture: gpu.types.GPUTexture) -> None:
    data = gpu.types.Buffer('FLOAT', len(values), values)
    if _cache.shader is None:
        _cache.shader = shader.compile_shader()
    if name in _cache.uniforms:
        _cache.uniforms[name].update(data)
    else:
        _cache.uniforms[name] = gpu.types.GPUUniformBuf(data)
    gpu.state.depth_test_set('LESS_EQUAL')
    gpu.state.depth_mask_set(False)
    gpu.state.blend_set('ALPHA')
    _cache.shader.bind()
    _cache.shader.uniform_block("ub", _cache.uniforms[name])
    _cache.shader.uniform_sampler("environment", texture)
    batch.draw(_cache.shader)
    gpu.state.blend_set('NONE')
    gpu.state.depth_test_set('NONE')


def poll_fits() -> float | None:
    """A timer, so on Blender's own thread: draws again what has better normals now."""
    name = _cache.fits.finished()
    if name is not None and name.removeprefix(BEFORE) in _cache.shown:
        _cache.shown[name.removeprefix(BEFORE)].stale = True
        for window in bpy.context.window_manager.windows:
            for area in window.screen.areas:
                if area.type == 'VIEW_3D':
                    area.tag_redraw()
    _cache.fits.advance()
    return POLL if is_waiting() else None


@bpy.app.handlers.persistent
def note_changes(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    """A new selection is no new geometry, but it says which part is shown."""
    any_update = scene.reflection_lines.stripes.scope == 'SELECTION'
    for update in depsgraph.updates:
        if not (update.is_updated_geometry or any_update):
            continue
        if isinstance(update.id, bpy.types.Object) and update.id.name in _cache.shown:
            _cache.shown[update.id.name].stale = True
        elif any_update:
            note_everything()


@bpy.app.handlers.persistent
def note_everything(*_: object) -> None:
    """Undo exchanges objects without saying which."""
    for shown in _cache.shown.values():
        shown.stale = True


@bpy.app.handlers.persistent
def forget(*_: object) -> None:
    _cache.shown.clear()
    _cache.textures.clear()
    _cache.fits.forget()
    _cache.limits.forget()


HANDLERS = (("depsgraph_update_post", note_changes), ("undo_post", note_everything), ("redo_post", note_everything),
            ("load_post", forget))


def register() -> None:
    if bpy.app.background:
        return
    for name, handler in HANDLERS:
        getattr(bpy.app.handlers, name).append(handler)
    _cache.handles.append(bpy.types.SpaceView3D.draw_handler_add(draw, (), 'WINDOW', 'POST_VIEW'))


def unregister() -> None:
    while _cache.handles:
        bpy.types.SpaceView3D.draw_handler_remove(_cache.handles.pop(), 'WINDOW')
        for name, handler in HANDLERS:
            getattr(bpy.app.handlers, name).remove(handler)
    if bpy.app.timers.is_registered(poll_fits):
        bpy.app.timers.unregister(poll_fits)
    forget()
