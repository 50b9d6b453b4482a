"""A bake of keyed handles: one solve a frame, each from the same start, and nothing written before the last of them."""
from collections.abc import Sequence
from dataclasses import dataclass

import bpy
import numpy as np

from .. import native
from ..animation import baked_keys, handle_keys
from ..model import line_run
from ..model.border import settle_border
from ..model.patch import Patch
from ..model.refusal import Refusal
from ..model.solution import Solution, SolveSettings
from ..model.view import View
from ..read import gather, read_mesh, shape_keys
from ..read.mesh_checks import Purpose
from ..state import optimizer_cache, solve_history
from ..targets import crossed
from ..targets.line_handles import HandleBuild
from ..view import facing
from .line_build import LineBuild

MOST_NOTES = 3
MOST_FRAMES = 1000  # each is a shape key
PULL = "REFLINES_OT_pull_line"
LOST_START = ("the shape before its handles is not known, since another tool ran or the mesh was changed, undone, "
              "renamed or duplicated after Pull Line: press Pull Line and Enter, and they begin with the mesh as it is")


@dataclass(frozen=True)
class FrameRequest:
    """The solve of one frame."""
    patch: Patch
    seen: View
    settings: SolveSettings
    build: HandleBuild


class HandleBake:
    """The bake of one object, frame by frame. Object and scene are looked up at each, since undo in another window
    replaces them.
    """

    def __init__(self, scene: bpy.types.Scene, ob: bpy.types.Object) -> None:
        self.scene, self.name, self.mode = scene.name, ob.name, ob.mode
        self.before = scene.frame_current, scene.frame_subframe
        self.frames: tuple[float, ...] = ()
        self.shapes: list[np.ndarray] = []  # #vertices x 3 float32, of the frames that are done
        self.notes: list[str] = []          # about lines that miss their handles
        self.lines = LineBuild(scene)
        self.progress = native.reflines.Progress()

    def begin(self, step: int) -> None:
        """Finds the frames and the start, in Object Mode, where shape keys are made; refuses what cannot be baked."""
        ob = bpy.data.objects[self.name]
        if ob.mode != 'OBJECT':
            bpy.ops.object.mode_set(mode='OBJECT')
        if not ob.reflection_lines.handles.read(ob.data):
            raise Refusal(f"{ob.name} has no handles: pull a line first")
        self.frames = choose_frames(ob, step)
        self.run = read_run(ob)
        self.start = solve_history.read_original_shape(ob, self.run.result)
        if self.start is None:
            raise Refusal(f"{ob.name}: {LOST_START}")
        self.notes += describe_partners(ob)
        baked_keys.refuse_foreign_action(ob)

    def is_done(self) -> bool:
        return len(self.shapes) == len(self.frames)

    @property
    def frame(self) -> float:
        """The frame that is at work, the last one at the end."""
        return self.frames[min(len(self.shapes), len(self.frames) - 1)]

    def describe(self) -> str:
        """Says how far the bake has come."""
        return f"Bake Handles: frame {self.frame:g}, {len(self.shapes)} of {len(self.frames)} done"

    def gather_next(self) -> FrameRequest:
        """Gathers handles, view and light of the next frame, as Re-solve does; a refusal names it."""
        ob, scene, run = self.find_object(), self.find_scene(), self.run
        handle_keys.set_frame(scene, self.frame)
        try:
            handles = ob.reflection_lines.handles.read(ob.data)
            purpose = Purpose.WRITE_SHARED if self.mode == 'EDIT' else Purpose.WRITE
            patch = gather.gather_patch(ob, run.result, self.start, purpose=purpose)
            build, seen = self.lines.build(scene, ob, patch, handles), facing.read_patch_view(scene, patch)
        except Refusal as refusal:
            raise Refusal(f"Frame {self.frame:g}: {refusal}") from refusal
        settings = SolveSettings(settle_border(run.border, joined=False), scene.reflection_lines.length, run.limit,
                                 build_crossed=crossed.build_kept_target if run.lights != 'SINGLE' else None)
        return FrameRequest(patch, seen, settings, build)

    async def solve(self, request: FrameRequest) -> Solution | Refusal:
        """Solves a frame, without Blender; a refusal names it."""
        try:
            return await optimizer_cache.await_solve_with_cache(request.patch, request.seen, request.settings,
                                                                request.build, self.progress)
        except Refusal as refusal:
            return Refusal(f"Frame {self.frame:g}: {refusal}")
        except native.Cancelled:
            return Refusal("The bake was cancelled")

    def take(self, solution: Solution | Refusal) -> None:
        """Takes the shape of the frame from its solution; raises a refusal."""
        if isinstance(solution, Refusal):
            raise solution
        shape = read_mesh.read_coordinates(self.find_object(), solution.patch.key)
        shape[solution.patch.index] = solution.patch.to_object_space(solution.positions)
        builder = self.lines.builder
        self.notes += [f"Frame {self.frame:g}: {note}" for note in builder.conflicts + builder.missed]
        self.shapes.append(shape.astype(np.float32))

    def find_scene(self) -> bpy.types.Scene:
        scene = bpy.data.scenes.get(self.scene)
        if scene is None:
            raise Refusal(f"The scene {self.scene} was removed while it was baked")
        return scene

    def find_object(self) -> bpy.types.Object:
        ob = bpy.data.objects.get(self.name)
        if ob is None or ob.type != 'MESH' or ob.mode != 'OBJECT' or len(ob.data.vertices) != len(self.start):
            raise Refusal(f"{self.name} was changed while it was baked: it is left as it is now")
        return ob

    def write(self) -> None:
        """Writes the shape keys, and goes back to the frame before. The result's own key would be seen twice: muted."""
        ob = self.find_object()
        result = find_result_key(ob) if self.run.result == 'SHAPE_KEY' else None
        keys = ob.data.shape_keys
        basis = "Basis" if keys is None else (keys.reference_key if result is None else result.relative_key).name
        baked_keys.replace_baked_keys(ob, self.frames, self.shapes, basis)
        if result is not None:
            find_result_key(ob).mute = True
        self.leave()

    def leave(self) -> None:
        """Goes back to the frame before. Setting the frame that is there would undo changes without a key."""
        scene, (whole, part) = bpy.data.scenes.get(self.scene), self.before
        if scene is not None and (scene.frame_current, scene.frame_subframe) != self.before:
            scene.frame_set(whole, subframe=part)

    def cancel(self) -> None:
        """Goes back to the frame and the mode before."""
        self.leave()
        ob = bpy.data.objects.get(self.name)
        if ob is not None and ob.mode != self.mode and ob == bpy.context.view_layer.objects.active:
            bpy.ops.object.mode_set(mode=self.mode)

    def describe_notes(self) -> list[str]:
        """Returns the first sentences about what was not reached, and how many more there are."""
        more = len(self.notes) - MOST_NOTES
        return self.notes[:MOST_NOTES] + ([f"{more} more lines pass beside their handles"] if more > 0 else [])

    def describe_result(self) -> str:
        count = len(self.frames)
        return (f"{count} shape key{'s' if count > 1 else ''} for the frames {self.frames[0]:g} to {self.frames[-1]:g} "
                f"({self.name})")


def choose_frames(ob: bpy.types.Object, step: int) -> tuple[float, ...]:
    """Returns the frames to bake: within the preview range where that is in use, else within the keys, or of handles
    that only drivers change within the scene; refuses handles that neither changes.
    """
    keyed = handle_keys.list_keyed_frames(ob)
    if not keyed and not handle_keys.has_animated_handles(ob):
        raise Refusal(f"The handles of {ob.name} have no keys: key the place of a handle first, by a right click on it "
                      "in the sidebar")
    scene = bpy.context.scene
    first, last = (min(keyed), max(keyed)) if keyed else (scene.frame_start, scene.frame_end)
    if scene.use_preview_range:
        first, last = scene.frame_preview_start, scene.frame_preview_end
    return list_frames(keyed, first, last, step)


def list_frames(keyed: Sequence[float], first: float, last: float, step: int) -> tuple[float, ...]:
    """Returns the keyed frames of a range, its ends, and every `step` frames from its begin, in order."""
    if (last - first) / step > MOST_FRAMES:
        raise Refusal(f"There would be more than {MOST_FRAMES} frames to bake: take a shorter preview range")
    inner = {float(first), float(last), *(float(each) for each in keyed if first <= each <= last)}
    steps = {first + step * number for number in range(int((last - first) // step) + 1)}
    frames = tuple(sorted(inner | steps))
    if len(frames) > MOST_FRAMES:
        raise Refusal(f"There are {len(frames)} frames to bake, more than {MOST_FRAMES}: take fewer keys")
    return frames


def read_run(ob: bpy.types.Object) -> line_run.LineRun:
    """Reads the settings of the last Pull Line."""
    stored = ob.reflection_lines.run
    if stored.operator != PULL:
        raise Refusal(f"{ob.name}: {LOST_START}")
    try:
        return line_run.decode_line_run(stored.settings)
    except Refusal as refusal:
        raise Refusal(f"{ob.name}: {refusal}") from refusal


def describe_partners(ob: bpy.types.Object) -> list[str]:
    """Says that others do not follow where they were moved as one with the object: a bake is of one object."""
    others = [name for name in ob.reflection_lines.run.list_joined() if name != ob.name]
    return [f"A bake moves one object: {', '.join(others)}, which followed the pull, stayed, and the border was Tangent"
            ] if others else []


def find_result_key(ob: bpy.types.Object) -> bpy.types.ShapeKey:
    return ob.data.shape_keys.key_blocks[shape_keys.NAME]
