"""What every sample shares: a mesh object, a view camera, a light direction, and a room whose walls are line lights."""
from dataclasses import dataclass

import bpy
import numpy as np
from mathutils import Matrix, Vector


GAP = 0.015       # what shines between two line lights, of 1
BACKDROP = 0.30


@dataclass(frozen=True)
class Stripes:
    """`count` line lights in a full turn about their direction, one of them at theta = 0; numbers as in the add-on."""
    count: int = 72
    width: float = 0.5      # share of the way from one to the next that is light
    softness: float = 0.12  # share of a stripe that its blurred edge takes


def empty_scene() -> bpy.types.Scene:
    """The scene without the cube, the lamp and the camera it starts with."""
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    for store in (bpy.data.meshes, bpy.data.materials, bpy.data.cameras, bpy.data.lights, bpy.data.worlds):
        for block in list(store):
            store.remove(block)
    return bpy.context.scene


def add_panel(name: str, V: np.ndarray, faces: np.ndarray) -> bpy.types.Object:
    """A smooth-shaded mesh object, active and selected; V #V x 3, faces #F x 3 or #F x 4."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(V.tolist(), [], faces.tolist())
    mesh.polygons.foreach_set("use_smooth", np.ones(len(faces), bool))
    mesh.update()
    panel = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(panel)
    bpy.context.view_layer.objects.active = panel
    panel.select_set(True)
    return panel


def select_faces(panel: bpy.types.Object, chosen: np.ndarray) -> None:
    """Selects exactly these faces (#F bool) and what belongs to them; the object is in Object Mode before and after."""
    mesh = panel.data
    for part in (mesh.vertices, mesh.edges, mesh.polygons):
        part.foreach_set("select", np.zeros(len(part), bool))
    mesh.polygons.foreach_set("select", chosen)
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    bpy.ops.object.mode_set(mode='EDIT')   # entering Edit Mode in face mode flushes the selection to edges and vertices
    bpy.ops.object.mode_set(mode='OBJECT')


def _look_along(direction: Vector) -> Matrix:
    """A rotation whose local Z is `direction`; the local Y points up as far as it can."""
    return direction.to_track_quat('Z', 'Y').to_matrix().to_4x4()


def add_view_camera(view_direction: tuple[float, float, float], centre: tuple[float, float, float],
                    width: float) -> bpy.types.Object:
    """The orthographic scene camera: `view_direction` points from the panel to the viewer, `width` is what it sees."""
    camera = bpy.data.cameras.new("View")
    camera.type = 'ORTHO'
    camera.ortho_scale = width
    camera.clip_end = 20.0
    view = bpy.data.objects.new("View", camera)
    towards = Vector(view_direction).normalized()
    view.matrix_world = Matrix.Translation(Vector(centre) + 4.0 * towards) @ _look_along(towards)
    bpy.context.scene.collection.objects.link(view)
    bpy.context.scene.camera = view
    return view


def add_light_direction(line_direction: tuple[float, float, float],
                        location: tuple[float, float, float]) -> bpy.types.Object:
    """An empty whose local Z is the direction of the line lights."""
    light = bpy.data.objects.new("Light Direction", None)
    light.empty_display_type = 'SINGLE_ARROW'
    light.empty_display_size = 0.4
    light.matrix_world = Matrix.Translation(Vector(location)) @ _look_along(Vector(line_direction).normalized())
    bpy.context.scene.collection.objects.link(light)
    return light


class NodeChain:
    """Builds a chain of math nodes in a node tree; sockets and numbers are both accepted as inputs."""

    def __init__(self, tree: bpy.types.NodeTree) -> None:
        self.tree = tree
        tree.nodes.clear()

    def add(self, kind: str, *inputs: bpy.types.NodeSocket | float | tuple, **settings: str) -> bpy.types.Node:
        node = self.tree.nodes.new(kind)
        for name, value in settings.items():
            setattr(node, name, value)
        for socket, value in zip(node.inputs, inputs, strict=False):   # the inputs not given keep their values
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, socket)
            else:
                socket.default_value = value
        return node

    def math(self, operation: str, *inputs: bpy.types.NodeSocket | float) -> bpy.types.NodeSocket:
        return self.add('ShaderNodeMath', *inputs, operation=operation).outputs[0]

    def dot(self, vector: bpy.types.NodeSocket, axis: Vector) -> bpy.types.NodeSocket:
        return self.add('ShaderNodeVectorMath', vector, tuple(axis), operation='DOT_PRODUCT').outputs["Value"]


def theta_of_direction(nodes: NodeChain, view: Vector, line: Vector) -> bpy.types.NodeSocket:
    """The angle of the looked-up direction about the line lights, 0 in the plane of the viewer (paper, equation 1)."""
    in_plane = (view - view.dot(line) * line).normalized()
    direction = nodes.add('ShaderNodeTexCoord').outputs["Generated"]
    return nodes.math('ARCTAN2', nodes.dot(direction, line.cross(in_plane)), nodes.dot(direction, in_plane))


def set_up_add_on(view: bpy.types.Object, light: bpy.types.Object, stripes: Stripes, length: float) -> None:
    """The settings that the add-on saves with the scene: one press of its button smooths detail finer than `length`,
    with 0 what counts as flaws.
    """
    settings = bpy.context.scene.reflection_lines
    settings.camera, settings.light, settings.length = view, light, length
    settings.stripes.show = True
    settings.stripes.count, settings.stripes.width = stripes.count, stripes.width
    settings.stripes.softness = stripes.softness


def light_the_room(view: bpy.types.Object, light: bpy.types.Object, stripes: Stripes) -> None:
    """A world of line lights, infinitely far and infinitely long: Cycles then shows what the add-on's stripes show.

    The camera itself sees an even backdrop: only the panel mirrors the lights.
    """
    world = bpy.data.worlds.new("Line Lights")
    world.use_nodes = True
    world.cycles.sampling_method = 'NONE'   # a mirror looks lamps up, it never samples them: no importance map needed
    bpy.context.scene.world = world
    nodes = NodeChain(world.node_tree)
    directions = [thing.matrix_world.col[2].to_3d().normalized() for thing in (view, light)]
    theta = theta_of_direction(nodes, *directions)
    turn = nodes.math('MULTIPLY_ADD', theta, stripes.count / (2.0 * np.pi), 0.5)
    off_centre = nodes.math('ABSOLUTE', nodes.math('SUBTRACT', nodes.math('FRACT', turn), 0.5))
    blur = stripes.softness * min(stripes.width, 1.0 - stripes.width)
    ramp = nodes.math('DIVIDE', nodes.math('SUBTRACT', 0.5 * stripes.width, off_centre), blur)
    lamp = nodes.add('ShaderNodeClamp', nodes.math('ADD', ramp, 0.5)).outputs[0]
    seen_directly = nodes.add('ShaderNodeLightPath').outputs["Is Camera Ray"]
    behind_the_panel = nodes.math('MULTIPLY', seen_directly, BACKDROP)
    mirrored = nodes.math('MULTIPLY', nodes.math('SUBTRACT', 1.0, seen_directly), nodes.math('MAXIMUM', lamp, GAP))
    strength = nodes.math('ADD', behind_the_panel, mirrored)
    background = nodes.add('ShaderNodeBackground', (1.0, 1.0, 1.0, 1.0), strength)
    nodes.add('ShaderNodeOutputWorld', background.outputs[0])


def car_paint(name: str, colour: tuple[float, float, float]) -> bpy.types.Material:
    """Metallic paint under a clear coat polished like a mirror."""
    paint = bpy.data.materials.new(name)
    paint.use_nodes = True
    paint.diffuse_color = (*colour, 1.0)
    paint.metallic, paint.roughness = 0.9, 0.25
    shader = paint.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*colour, 1.0)
    shader.inputs["Metallic"].default_value = 1.0
    shader.inputs["Roughness"].default_value = 0.0
    return paint


def set_up_render(width: int, height: int, samples: int) -> None:
    """Cycles on the processor with few samples; Debian's builds carry no denoiser. Colours are shown as they are."""
    scene = bpy.context.scene
    scene.render.engine = 'CYCLES'
    scene.cycles.samples = samples
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = width, height, 100
    scene.render.image_settings.file_format = 'PNG'
    scene.view_settings.view_transform = 'Standard'


def look_through_camera() -> None:
    """Every 3D viewport of the saved file shows the camera's view with the sidebar open."""
    for screen in bpy.data.screens:
        for area in screen.areas:
            if area.type == 'VIEW_3D':
                area.spaces.active.region_3d.view_perspective = 'CAMERA'
                area.spaces.active.show_region_ui = True


@dataclass(frozen=True)
class Shot:
    """How a sample is seen and lit, and what its faces are to look like."""
    view_direction: tuple[float, float, float]
    line_direction: tuple[float, float, float]
    centre: tuple[float, float, float]
    width: float                       # that the camera sees
    lamp: tuple[float, float, float]   # where the light direction's arrow stands
    stripes: Stripes
    colour: tuple[float, float, float]
    length: float = 0.0                # of Smooth: 0 is what counts as flaws


def stage(name: str, V: np.ndarray, quads: np.ndarray, inside: np.ndarray, shot: Shot) -> bpy.types.Object:
    """A scene with this panel alone, the faces whose vertices are all `inside` (#V bool) selected, in Object Mode."""
    empty_scene()
    panel = add_panel(name, V, quads)
    panel.data.materials.append(car_paint("Paint", shot.colour))
    select_faces(panel, inside[quads].all(axis=1))
    view = add_view_camera(shot.view_direction, shot.centre, shot.width)
    light = add_light_direction(shot.line_direction, shot.lamp)
    set_up_add_on(view, light, shot.stripes, shot.length)
    light_the_room(view, light, shot.stripes)
    set_up_render(800, 600, samples=8)
    look_through_camera()
    bpy.context.view_layer.update()
    return panel


def subdivide(panel: bpy.types.Object) -> None:
    """A Subdivision Surface modifier: what it shows is the panel, and the mesh is its cage."""
    modifier = panel.modifiers.new("Subdivision", 'SUBSURF')
    modifier.levels, modifier.render_levels = 3, 4


def save(panel: bpy.types.Object, path: str) -> None:
    """In Edit Mode, ready for one press of the button."""
    bpy.context.view_layer.objects.active = panel
    bpy.ops.object.mode_set(mode='EDIT')
    bpy.ops.wm.save_as_mainfile(filepath=path, compress=True)
