"""Draws the cage of a mesh in Edit Mode over its stripes: in the theme's colours, lines and dots with a rim that sets
them off from white and from black stripes.
"""
from collections.abc import Generator
from contextlib import contextmanager
from dataclasses import dataclass

import bpy
import gpu
import numpy as np
from mathutils import Matrix

from ..model.surface import Surface
from ..read import read_edit_cage
from ..read.image_pixels import decode_srgb
from ..read.read_edit_cage import EditCage
from . import stripe_scene, stripes

RIM = 1.0            # pixels to each side of lines and dots
RIM_OPACITY = 0.55
SELECTED_WIDTH = 1.5  # pixels of a selected line; others have one
FACES_NEARER = 3e-4  # fraction of the distance from the eye by which faces are nearer than the stripes
# Lines and dots face the eye, so on a slope one side of them would sink into the surface: they are nearer by their own
# radius times this, which shows them whole up to a slope of 63 degrees.
RADII_NEARER = 2.0
# Lengths of a mean edge in pixels between which edges and vertices fade away: dense ones would hide the stripes.
GONE, FULL = 5.0, 14.0
FEW = 500  # so many selected edges are drawn however short they are

DOT_VERTEX = """
void main()
{
  gl_Position = mvp * vec4(pos, 1.0);
  gl_PointSize = size;
}
"""
DOT_FRAGMENT = """
void main()
{
  float from_rim = 0.5 * size - length(gl_PointCoord - vec2(0.5)) * size;
  float inner = smoothstep(-0.5, 0.5, from_rim - rim.w);
  fragColor = vec4(mix(rim.rgb, color.rgb, inner), color.a * smoothstep(0.0, 1.0, from_rim));
}
"""


@dataclass(frozen=True)
class CageStyle:
    """Colours, sRGB, and the diameter of a dot in pixels, as the theme has them."""
    wire: np.ndarray
    edge_selected: np.ndarray
    vertex: np.ndarray
    vertex_selected: np.ndarray
    vertex_active: np.ndarray
    face_selected: np.ndarray
    face_opacity: float
    dot: float


@dataclass
class CageBatches:
    """The GPU batches of a cage; None for what it does not have."""
    plain_edges: gpu.types.GPUBatch | None
    marked_edges: gpu.types.GPUBatch | None
    marked_rims: gpu.types.GPUBatch | None
    plain_dots: gpu.types.GPUBatch | None
    marked_dots: gpu.types.GPUBatch | None
    active_dot: gpu.types.GPUBatch | None
    edge_length: float  # of a mean edge


@dataclass
class ShownCage:
    """The cage of an object as far as it was drawn: batches are built when a view needs them."""
    faces: gpu.types.GPUBatch | None  # the selected ones
    edge_length: float                # of a mean edge of the surface; 0 where the cage is another mesh
    batches: CageBatches | None = None


def read_style(context: bpy.types.Context) -> CageStyle:
    theme, scale = context.preferences.themes[0].view_3d, context.preferences.system.pixel_size
    colors = (theme.wire_edit, theme.edge_select, theme.vertex, theme.vertex_select, (1.0, 1.0, 1.0),
              theme.face_select[:3])
    # Blender draws dots of 1.4 times the theme's size.
    return CageStyle(*(np.array(color, dtype=np.float64) for color in colors), theme.face_select[3],
                     (1.4 * theme.vertex_size + 2.0 * RIM) * scale)


def choose_rim(color: np.ndarray) -> np.ndarray:
    """Returns the grey that sets a colour off: light for dark ones, dark for others."""
    return np.full(3, 0.9 if decode_srgb(color) @ (0.2126, 0.7152, 0.0722) < 0.15 else 0.0)


def read_kind(ob: bpy.types.Object) -> tuple:
    """Reads what the look of the cage depends on besides the mesh: the select mode and the active vertex."""
    return tuple(bpy.context.tool_settings.mesh_select_mode), read_edit_cage.read_active_vertex(ob.data)


def start_cage(ob: bpy.types.Object, surface: Surface) -> ShownCage:
    """Begins to show the cage of an object in Edit Mode that has changed."""
    faces = build_batch('TRIS', surface.V, surface.F[surface.selected])
    sample = surface.F[::max(1, len(surface.F) // 1000)]
    ends = surface.V[sample[:, 0]] - surface.V[sample[:, 1]]
    length = float(np.linalg.norm(ends, axis=1).mean()) if len(ends) else 0.0
    return ShownCage(faces, 0.0 if read_edit_cage.has_edit_modifiers(ob) else length)


def build_cage(cage: EditCage, kind: tuple, style: CageStyle) -> CageBatches:
    """Builds the batches. `kind` is the select mode (vertices, edges, faces) and the active vertex, -1 for none."""
    (by_vertex, _, _), active = kind
    chosen = cage.vertex_selected
    marked = chosen[cage.edges].any(axis=1) if by_vertex else cage.edge_selected
    # In between a selected vertex and another one the colour changes; of a selected edge both ends are coloured.
    full = chosen if by_vertex else np.ones(len(chosen), dtype=bool)
    colors, rims = (np.column_stack([np.where(full[:, None], one, other), np.full(len(full), opacity)])
                    for one, other, opacity in ((style.edge_selected, style.wire, 1.0),
                                                (choose_rim(style.edge_selected), choose_rim(style.wire), RIM_OPACITY)))
    dots = cage.vertices if by_vertex else cage.vertices[:0]
    own = dots[dots == active]
    return CageBatches(build_batch('LINES', cage.V, cage.edges[~marked]),
                       build_batch('LINES', cage.V, cage.edges[marked], color=colors),
                       build_batch('LINES', cage.V, cage.edges[marked], color=rims),
                       build_batch('POINTS', cage.V, dots[~chosen[dots]]),
                       build_batch('POINTS', cage.V, dots[chosen[dots]]),
                       build_batch('POINTS', cage.V, own), cage.measure_edge())


def build_batch(kind: str, V: np.ndarray, index: np.ndarray, **more: np.ndarray) -> gpu.types.GPUBatch | None:
    """Builds a batch of points, lines or triangles: `index` is #elements x 1, 2 or 3; `more` are further attributes of
    the vertices by their names, #V x 1 to 4.
    """
    if not len(index):
        return None
    layout, attributes = gpu.types.GPUVertFormat(), {"pos": V, **more}
    for name, values in attributes.items():
        layout.attr_add(id=name, comp_type='F32', len=values.shape[1], fetch_mode='FLOAT')
    vertices = gpu.types.GPUVertBuf(len=len(V), format=layout)
    for name, values in attributes.items():  # attr_fill accepts other types and memory orders too, and misreads them
        vertices.attr_fill(id=name, data=np.ascontiguousarray(values, np.float32))
    elements = gpu.types.GPUIndexBuf(type=kind, seq=np.ascontiguousarray(index, np.uint32))
    return gpu.types.GPUBatch(type=kind, buf=vertices, elem=elements)


def compile_dots() -> gpu.types.GPUShader:
    """Compiles the shader of round dots."""
    info = gpu.types.GPUShaderCreateInfo()
    info.push_constant('MAT4', "mvp")
    info.push_constant('VEC4', "color")
    info.push_constant('VEC4', "rim")  # its colour, and its width in pixels
    info.push_constant('FLOAT', "size")
    info.vertex_in(0, 'VEC3', "pos")
    info.fragment_out(0, 'VEC4', "fragColor")
    info.vertex_source(DOT_VERTEX)
    info.fragment_source(DOT_FRAGMENT)
    return gpu.shader.create_from_info(info)


class SurfacePainter:
    """Draws over the surface of one object in one viewport."""

    def __init__(self, context: bpy.types.Context, ob: bpy.types.Object) -> None:
        self.region_3d, self.ob = context.region_data, ob
        self.size = np.array([context.region.width, context.region.height], dtype=np.float64)
        self.offset = stripe_scene.compute_offset(context, ob)
        self.xray = context.space_data.shading.show_xray

    def measure_pixels(self, radius: float) -> float:
        """Returns by how much something of this radius in pixels is nearer than the stripes, for `move_nearer`."""
        return RADII_NEARER * stripes.measure_pixels(np.array(self.region_3d.window_matrix), radius, self.size[0])

    def project_nearer(self, fraction: float) -> Matrix:
        """Returns the projection that draws nearer to the eye than the stripes."""
        return Matrix(stripes.move_nearer(np.array(self.region_3d.window_matrix), self.offset + fraction))

    @contextmanager
    def nearer(self, fraction: float) -> Generator[None, None, None]:
        """Lets Blender's own shaders draw so."""
        with gpu.matrix.push_pop(), gpu.matrix.push_pop_projection():
            gpu.matrix.load_matrix(self.region_3d.view_matrix @ self.ob.matrix_world)
            gpu.matrix.load_projection_matrix(self.project_nearer(fraction))
            yield


class CagePainter(SurfacePainter):
    """Draws the cage of one object in one viewport."""

    def __init__(self, context: bpy.types.Context, ob: bpy.types.Object, dots: gpu.types.GPUShader) -> None:
        super().__init__(context, ob)
        self.dots, self.style = dots, read_style(context)

    def draw(self, shown: ShownCage) -> None:
        gpu.state.depth_test_set('NONE' if self.xray else 'LESS_EQUAL')
        gpu.state.depth_mask_set(False)
        gpu.state.blend_set('ALPHA')
        if shown.faces is not None:
            self.draw_faces(shown.faces)
        few = min(max(2.0 - self.ob.data.total_edge_sel / FEW, 0.0), 1.0)
        if few > 0.0 or not shown.edge_length or self.fade(shown.edge_length) > 0.0:
            shown.batches = shown.batches or self.build_batches()
            seen = self.fade(shown.batches.edge_length)
            self.draw_lines(shown.batches, seen, max(seen, few))
            self.draw_vertices(shown.batches, seen, max(seen, few))
        gpu.state.blend_set('NONE')
        gpu.state.depth_test_set('NONE')

    def build_batches(self) -> CageBatches:
        cage = read_edit_cage.read_edit_cage(self.ob, bpy.context.evaluated_depsgraph_get())
        return build_cage(cage, read_kind(self.ob), self.style)

    def draw_vertices(self, batches: CageBatches, seen: float, marked: float) -> None:
        style = self.style
        for batch, color, opacity in ((batches.plain_dots, style.vertex, seen),
                                      (batches.marked_dots, style.vertex_selected, marked),
                                      (batches.active_dot, style.vertex_active, 1.0)):
            if batch is not None and opacity > 0.0:
                self.draw_dots(batch, color, opacity)

    def fade(self, edge_length: float) -> float:
        """Returns the opacity of edges by the length of a mean one in pixels at the object's place."""
        depth = abs((self.region_3d.perspective_matrix @ self.ob.matrix_world)[3][3])
        window = abs(self.region_3d.window_matrix[0][0]) * 0.5 * self.size[0]
        scale = sum(self.ob.matrix_world.to_scale()) / 3.0
        pixels = edge_length * abs(scale) * window / (max(depth, 1e-9) if self.region_3d.is_perspective else 1.0)
        return min(max((pixels - GONE) / (FULL - GONE), 0.0), 1.0)

    def draw_faces(self, faces: gpu.types.GPUBatch) -> None:
        shader = gpu.shader.from_builtin('UNIFORM_COLOR')
        with self.nearer(FACES_NEARER):
            shader.bind()
            shader.uniform_float("color", (*self.style.face_selected, self.style.face_opacity))
            faces.draw(shader)

    def draw_lines(self, batches: CageBatches, seen: float, chosen: float) -> None:
        with self.nearer(self.measure_pixels(0.5 * SELECTED_WIDTH + RIM)):
            plain = gpu.shader.from_builtin('POLYLINE_UNIFORM_COLOR')
            plain.bind()
            plain.uniform_float("viewportSize", self.size)
            if batches.plain_edges is not None and seen > 0.0:
                rim = choose_rim(self.style.wire)
                for color, opacity, width in ((rim, RIM_OPACITY, 1.0 + 2.0 * RIM), (self.style.wire, 1.0, 1.0)):
                    plain.uniform_float("lineWidth", width)
                    plain.uniform_float("color", (*color, opacity * seen))
                    batches.plain_edges.draw(plain)
            marked = gpu.shader.from_builtin('POLYLINE_SMOOTH_COLOR')
            marked.bind()
            marked.uniform_float("viewportSize", self.size)
            for batch, width in ((batches.marked_rims, SELECTED_WIDTH + 2.0 * RIM),
                                 (batches.marked_edges, SELECTED_WIDTH)):
                if batch is not None and chosen > 0.5:
                    marked.uniform_float("lineWidth", width)
                    batch.draw(marked)

    def draw_dots(self, batch: gpu.types.GPUBatch, color: np.ndarray, opacity: float) -> None:
        near = self.project_nearer(self.measure_pixels(0.5 * self.style.dot + RIM))  # before the lines
        gpu.state.program_point_size_set(True)
        self.dots.bind()
        self.dots.uniform_float("mvp", near @ self.region_3d.view_matrix @ self.ob.matrix_world)
        # Linear values, which shaders take other than Blender's own.
        self.dots.uniform_float("color", (*decode_srgb(color), opacity))
        self.dots.uniform_float("rim", (*decode_srgb(choose_rim(color)), RIM))
        self.dots.uniform_float("size", self.style.dot)
        batch.draw(self.dots)
        gpu.state.program_point_size_set(False)
