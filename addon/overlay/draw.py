"""Draws the stripes over the active mesh. A batch is rebuilt when the surface changes, never when a setting does."""
from dataclasses import dataclass, field

import bpy
import gpu
import numpy as np

from .. import session
from . import shader, stripes


@dataclass
class Cache:
    """What is on the GPU, for the one object that is shown."""
    name: str = ""
    mode: str = ""
    stale: bool = True            # the surface may have changed since it was uploaded
    signature: bytes = b""
    batch: object = None
    shader: object = None
    uniforms: object = None
    builds: int = 0               # batches made so far
    handles: list = field(default_factory=list)


_cache = Cache()


def batch_builds() -> int:
    return _cache.builds


def draw() -> None:
    """In a viewport's POST_VIEW."""
    context = bpy.context
    ob = context.view_layer.objects.active
    if not context.scene.reflection_lines.stripes.show or not is_shown(ob, context.space_data):
        return
    values = uniforms(context, ob)
    if values is None:
        return
    refresh(ob, context.evaluated_depsgraph_get())
    if _cache.batch is not None:
        paint(values)


def is_shown(ob: bpy.types.Object | None, space: bpy.types.SpaceView3D) -> bool:
    if ob is None or ob.type != 'MESH':
        return False
    return ob.mode in {'OBJECT', 'EDIT'} and ob.visible_get(viewport=space)


def uniforms(context: bpy.types.Context, ob: bpy.types.Object) -> np.ndarray | None:
    """None where the light is missing or parallel to the view: there are no reflection lines then."""
    settings = context.scene.reflection_lines.stripes
    view_direction, line_direction = session.shown_directions(context.scene, ob)
    if line_direction is None:
        return None
    locked = settings.eye == 'CAMERA' and view_direction is not None
    eye = stripes.Eye(view_direction) if locked else viewport_eye(context.region_data)
    axes = stripes.zero_axes(eye.direction, line_direction)
    if axes is None:
        return None
    region_3d = context.region_data
    return stripes.uniforms(model=array(ob.matrix_world), view_matrix=array(region_3d.view_matrix),
                            projection=array(region_3d.window_matrix), eye=eye, axes=axes,
                            look=look(settings, ob.mode))


def array(matrix: object) -> np.ndarray:
    return np.array(matrix, dtype=np.float64)


def viewport_eye(region_3d: bpy.types.RegionView3D) -> stripes.Eye:
    back = array(region_3d.view_matrix.inverted_safe())
    return stripes.Eye(back[:3, 2], back[:3, 3] if region_3d.is_perspective else None)


def look(settings: bpy.types.PropertyGroup, mode: str) -> stripes.Look:
    offset = stripes.ABOVE_CAGE if mode == 'EDIT' and not settings.cage_on_top else stripes.BELOW_CAGE
    return stripes.Look(settings.count, settings.width, settings.softness,
                        tuple(settings.color), tuple(settings.gap_color), settings.opacity, offset)


def refresh(ob: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> None:
    if not _cache.stale and (_cache.name, _cache.mode) == (ob.name, ob.mode):
        return
    shown = session.shown_surface(ob, depsgraph)
    signature = stripes.signature(shown.V, shown.F, shown.normals)
    if signature != _cache.signature:
        _cache.batch = make_batch(shown.V, shown.F, shown.normals) if len(shown.F) else None
        _cache.signature = signature
    _cache.name, _cache.mode, _cache.stale = ob.name, ob.mode, False


def make_batch(V: np.ndarray, F: np.ndarray, normals: np.ndarray) -> gpu.types.GPUBatch:
    _cache.builds += 1
    layout = gpu.types.GPUVertFormat()
    layout.attr_add(id="pos", comp_type='F32', len=3, fetch_mode='FLOAT')
    layout.attr_add(id="nor", comp_type='F32', len=3, fetch_mode='FLOAT')
    vertices = gpu.types.GPUVertBuf(len=len(V), format=layout)
    # attr_fill takes other types and orders as well, and draws them wrongly.
    vertices.attr_fill(id="pos", data=np.ascontiguousarray(V, np.float32))
    vertices.attr_fill(id="nor", data=np.ascontiguousarray(normals, np.float32))
    triangles = gpu.types.GPUIndexBuf(type='TRIS', seq=np.ascontiguousarray(F, np.uint32))
    return gpu.types.GPUBatch(type='TRIS', buf=vertices, elem=triangles)


def paint(values: np.ndarray) -> None:
    data = gpu.types.Buffer('FLOAT', len(values), values)
    if _cache.shader is None:
        _cache.shader = shader.compile_shader()
        _cache.uniforms = gpu.types.GPUUniformBuf(data)
    else:
        _cache.uniforms.update(data)
    gpu.state.depth_test_set('LESS_EQUAL')
    gpu.state.depth_mask_set(False)
    gpu.state.blend_set('ALPHA')
    _cache.shader.bind()
    _cache.shader.uniform_block("ub", _cache.uniforms)
    _cache.batch.draw(_cache.shader)
    gpu.state.blend_set('NONE')
    gpu.state.depth_test_set('NONE')


@bpy.app.handlers.persistent
def note_changes(_: object, depsgraph: bpy.types.Depsgraph) -> None:
    for update in depsgraph.updates:
        if update.is_updated_geometry and isinstance(update.id, bpy.types.Object) and update.id.name == _cache.name:
            _cache.stale = True


@bpy.app.handlers.persistent
def note_everything(*_: object) -> None:
    """Undo and a new file exchange objects without saying which."""
    _cache.stale = True


HANDLERS = (("depsgraph_update_post", note_changes), ("undo_post", note_everything), ("redo_post", note_everything),
            ("load_post", note_everything))


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
    _cache.batch, _cache.signature, _cache.stale = None, b"", True
