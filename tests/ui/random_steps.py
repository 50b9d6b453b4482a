"""Steps of a random walk: what an artist may do at any moment, well considered or not. Each waits as it needs."""
import random
import shutil
from pathlib import Path

import bpy
import dragging
import installation
import numpy as np
import packages
import scenes
import window
from window import Steps

CELLS = 14
DRAG_KEYS = ('ONE', 'PERIOD', 'FIVE', 'BACK_SPACE', 'MINUS', 'TAB', 'X', 'A', 'WHEELUPMOUSE', 'WHEELDOWNMOUSE')


class Walker:
    """One walk: its dice, and the way to Blender. Windows are asked for anew, as a loaded file brings others."""

    def __init__(self, seed: int, file: str) -> None:
        self.dice, self.file = random.Random(seed), file
        self.driver = window.Window()

    def override(self) -> object:
        self.driver.window = bpy.context.window_manager.windows[0]
        return self.driver.override()

    def call(self, operator: str, *how: object, **settings: object) -> str:
        """What the operator said, or why it cannot run. A refusal is an answer, an error of Python is none."""
        room, name = operator.split(".")
        try:
            with self.override():
                return str(getattr(getattr(bpy.ops, room), name)(*how, **settings))
        except (RuntimeError, TypeError) as answer:  # the latter: a mode that this kind of object has not
            assert "Traceback" not in str(answer), answer
            return str(answer).strip()

    def active(self) -> bpy.types.Object | None:
        return bpy.context.view_layer.objects.active

    def positions(self) -> np.ndarray:
        ob = self.active()
        return scenes.positions(ob).copy() if ob is not None and ob.type == 'MESH' else np.zeros((0, 3))

    def check_taken_back(self, tool: str, before: np.ndarray, *, alone: bool) -> None:
        """A tool that was left has changed no bit; another below it goes on where the mouse is now, and may: what both
        leave is tested in test_drag_over_drag.py.
        """
        assert not alone or np.array_equal(self.positions(), before), f"{tool} was left, and has changed the mesh"

    def tools(self) -> list[str]:
        return [f"reflines.{name}" for name in sorted(dir(bpy.ops.reflines))]

    def to_mode(self, mode: str) -> None:
        if self.active() is not None and self.active().mode != mode:
            self.call("object.mode_set", mode=mode)


def new_panel(walker: Walker, cells: int = CELLS) -> Steps:
    """Away with all, and a panel ready for work."""
    walker.to_mode('OBJECT')
    scenes.remove_all()
    with walker.override():
        scenes.edited_panel(cells=cells)
        bpy.context.scene.reflection_lines.stripes.show = True
        bpy.ops.ed.undo_push(message="Panel")
    yield 0.1


def another_panel(walker: Walker) -> Steps:
    walker.to_mode('OBJECT')
    with walker.override():
        ob = scenes.panel(cells=CELLS)
        ob.location.x = walker.dice.uniform(-3.0, 3.0)
        bpy.ops.ed.undo_push(message="Another panel")
    yield 0.1


def run_tool(walker: Walker) -> Steps:
    tool = walker.dice.choice(walker.tools())
    print("   ", tool, walker.call(tool, 'EXEC_DEFAULT', True), flush=True)
    yield 0.1


def drag_tool(walker: Walker) -> Steps:
    """Pressed, dragged and typed at random, then kept or left, which changes no bit."""
    dice, before, alone = walker.dice, walker.positions(), not dragging.is_running()
    walker.driver.move(dice.randrange(200, 600), 300)
    yield 0.05
    tool = dice.choice(walker.tools())
    draggable = "follow_mouse" in getattr(bpy.ops.reflines, tool.split(".")[1]).get_rna_type().properties
    answer = walker.call(tool, 'INVOKE_DEFAULT', True, **({"follow_mouse": True} if draggable else {}))
    print("   ", tool, answer, flush=True)
    yield dice.choice((0.02, 0.3))
    for _ in range(dice.randrange(6) if "RUNNING" in answer else 0):
        walker.driver.move(dice.randrange(100, 700), dice.randrange(200, 400))
        yield dice.choice((0.0, 0.1))
        walker.driver.key(dice.choice(DRAG_KEYS), shift=dice.random() < 0.2)
    way_out = dice.choice(('RET', 'LEFTMOUSE', 'ESC', 'RIGHTMOUSE')) if "RUNNING" in answer else 'ESC'
    walker.driver.key(way_out)
    yield 0.8
    walker.driver.key('ESC')
    yield 0.2
    if "RUNNING" in answer and way_out in {'ESC', 'RIGHTMOUSE'}:
        walker.check_taken_back(tool, before, alone=alone)


def pull_lines(walker: Walker) -> Steps:
    """A session of Pull Line: lines are pulled, pinned, sized, muted, deleted and taken back;
    then it is applied, left, which changes no bit, or goes on below the next steps."""
    dice = walker.dice
    before, alone = walker.positions(), not dragging.is_running()
    walker.driver.move(dice.randrange(200, 600), 300)
    yield 0.05
    answer = walker.call("reflines.pull_line", 'INVOKE_DEFAULT', True)
    print("    reflines.pull_line", answer, flush=True)
    if "RUNNING" not in answer:
        return
    yield dice.choice((0.0, 0.3))
    for _ in range(dice.randrange(1, 5)):
        yield from pull_a_line(walker)
    way_out = dice.choice(('RET', 'ESC', None))
    if way_out is not None:
        walker.driver.key(way_out)
        yield 1.0
    if way_out == 'ESC':
        walker.check_taken_back("reflines.pull_line", before, alone=alone)


def pull_a_line(walker: Walker) -> Steps:
    dice, driver = walker.dice, walker.driver
    x, y = dice.randrange(250, 450), dice.randrange(220, 380)
    driver.move(x, y)
    yield 0.1
    driver.event('LEFTMOUSE', 'PRESS', alt=dice.random() < 0.2)
    for _ in range(dice.randrange(3)):
        driver.move(x + dice.randrange(-30, 30), y + dice.randrange(-30, 30))
        yield dice.choice((0.0, 0.1))
    driver.event('LEFTMOUSE', 'RELEASE')
    yield dice.choice((0.0, 0.2))
    if dice.random() < 0.7:
        driver.key(dice.choice(('WHEELUPMOUSE', 'WHEELDOWNMOUSE', 'F', 'M', 'P', 'X')))
    elif dice.random() < 0.7:
        driver.key('Z', ctrl=True, shift=dice.random() < 0.3)
    yield 0.1


def press_on_many_faces(walker: Walker) -> Steps:
    """A press that runs beside Blender: awaited, left, or at work while the scene changes and the next steps are
    taken."""
    yield from new_panel(walker, cells=60)
    tool = walker.dice.choice(("reflines.smooth", "reflines.direction", "reflines.pattern"))
    print("   ", tool, walker.call(tool, 'INVOKE_DEFAULT', True), flush=True)
    yield walker.dice.choice((0.0, 0.3))
    then = walker.dice.choice(("waits", "leaves", "goes on", "is surprised"))
    print("    the user", then, flush=True)
    if then == "waits":
        yield 5.0
    elif then == "leaves":
        walker.driver.key('ESC')
        yield 1.0
    elif then == "is surprised":
        yield from surprise(walker)


def surprised_drag(walker: Walker) -> Steps:
    """Scripts change the scene below a running drag."""
    walker.driver.move(400, 300)
    yield 0.05
    tool = walker.dice.choice(("reflines.smooth", "reflines.pull_line"))
    print("   ", tool, walker.call(tool, 'INVOKE_DEFAULT', True, follow_mouse=True), flush=True)
    yield walker.dice.choice((0.0, 0.2))
    if tool == "reflines.pull_line":
        walker.driver.event('LEFTMOUSE', 'PRESS')
    walker.driver.move(walker.dice.randrange(100, 700), 300)
    yield from surprise(walker)
    walker.driver.move(walker.dice.randrange(100, 700), 300)
    yield 0.2
    for key in ('RET', 'ESC'):
        walker.driver.key(key)
        yield 0.3


def surprise(walker: Walker) -> Steps:
    step = walker.dice.choice((delete_something, change_mode, change_mesh, undo, load, reload_addon, reinstall,
                               add_modifier))
    print("    surprise:", step.__name__, flush=True)
    yield from step(walker)


def grab(walker: Walker) -> Steps:
    """Blender's own drag, with the stripes following."""
    walker.driver.move(500, 400)
    yield 0.05
    for key in ('G', 'Z'):
        walker.driver.key(key)
        yield 0.05
    for y in (420, 380, 450):
        walker.driver.move(500, y)
        yield 0.05
    walker.driver.key(walker.dice.choice(('RET', 'ESC')))
    yield 0.1


def undo(walker: Walker) -> Steps:
    for _ in range(walker.dice.randrange(1, 4)):
        if walker.dice.random() < 0.5:
            walker.driver.key('Z', ctrl=True)
        else:
            walker.call("ed.undo")
        yield 0.15


def redo(walker: Walker) -> Steps:
    for _ in range(walker.dice.randrange(1, 3)):
        if walker.dice.random() < 0.5:
            walker.driver.key('Z', ctrl=True, shift=True)
        else:
            walker.call("ed.redo")
        yield 0.15


def change_mode(walker: Walker) -> Steps:
    walker.to_mode(walker.dice.choice(('OBJECT', 'EDIT', 'EDIT', 'SCULPT', 'WEIGHT_PAINT')))
    yield 0.1


def change_settings(walker: Walker) -> Steps:
    """A setting of the scene, of any of the add-on's sets, to any value it can have."""
    dice, scene = walker.dice, bpy.context.scene.reflection_lines
    holder = dice.choice((scene, scene.stripes, scene.direction, scene.warp, scene.pattern, scene.pull))
    name, found = dice.choice([each for each in holder.bl_rna.properties.items() if not each[1].is_readonly])
    if found.type == 'BOOLEAN':
        setattr(holder, name, dice.random() < 0.5)
    elif found.type == 'ENUM':
        setattr(holder, name, dice.choice([item.identifier for item in found.enum_items]))
    elif found.type == 'FLOAT' and not found.is_array:
        setattr(holder, name, dice.choice((0.0, 0.3, 1.0, -1.0, 7.5)))
    print("   ", name, getattr(holder, name, None), flush=True)
    yield 0.1


def select(walker: Walker) -> Steps:
    ob = walker.active()
    if ob is not None and ob.type == 'MESH':
        walker.to_mode('EDIT')
        if ob.mode == 'EDIT':
            share = walker.dice.choice((0.0, 0.1, 0.9, 1.0, 2.0))
            with walker.override():
                scenes.select_faces(ob, scenes.inner(CELLS) if share == 2.0 else
                                    lambda _: walker.dice.random() < share)
                bpy.ops.ed.undo_push(message="Select")
    yield 0.1


def change_mesh(walker: Walker) -> Steps:
    """Topology, hidden faces, shape keys; in Edit Mode or not."""
    change = walker.dice.choice((
        ("mesh.subdivide", {}), ("mesh.delete", {"type": 'FACE'}), ("mesh.delete", {"type": 'VERT'}),
        ("mesh.hide", {}), ("mesh.reveal", {}), ("mesh.quads_convert_to_tris", {}), ("mesh.flip_normals", {}),
        ("object.shape_key_add", {"from_mix": False}), ("object.duplicate", {}), ("object.duplicate", {"linked": True}),
        ("object.transform_apply", {}), ("transform.resize", {"value": (1.0, 0.0, 1.0)}),
        ("transform.rotate", {"value": 0.7, "orient_axis": 'Y'})))
    ob = walker.active()
    if change[0] == "mesh.subdivide" and ob is not None and ob.type == 'MESH' and len(ob.data.polygons) > 3000:
        change = ("mesh.delete", {"type": 'FACE'})
    print("   ", change[0], walker.call(change[0], 'EXEC_DEFAULT', True, **change[1]), flush=True)
    yield 0.1


def add_modifier(walker: Walker) -> Steps:
    ob = walker.active()
    if ob is not None and ob.type == 'MESH':
        if len(ob.modifiers) > 1 or walker.dice.random() < 0.3:
            ob.modifiers.clear()
        else:
            ob.modifiers.new("", walker.dice.choice(('SUBSURF', 'MIRROR', 'SOLIDIFY')))
        walker.call("ed.undo_push", message="Modifiers")
    yield 0.1


def delete_something(walker: Walker) -> Steps:
    """As scripts do it, or as the X key does: then pointers to it stay."""
    found = sorted(bpy.context.scene.collection.all_objects, key=lambda ob: ob.name)
    if found:
        ob = walker.dice.choice(found)
        print("   ", ob.name, flush=True)
        if walker.dice.random() < 0.5:
            bpy.data.objects.remove(ob)
        else:
            ob.users_collection[0].objects.unlink(ob)
        walker.call("ed.undo_push", message="Delete")
    yield 0.1


def activate(walker: Walker) -> Steps:
    walker.to_mode('OBJECT')
    found = sorted(ob.name for ob in bpy.context.view_layer.objects)
    if found:
        scenes.activate(bpy.data.objects[walker.dice.choice(found)])
    yield 0.1


def pull_lattice(walker: Walker) -> Steps:
    """In a live warp, which follows while the next steps are taken; begun first where there is none."""
    settings = bpy.context.scene.reflection_lines
    if settings.warp.lattice is None:
        print("   ", walker.call("reflines.add_warp_lattice", 'EXEC_DEFAULT', True), flush=True)
    if settings.live.panel is None:
        print("   ", walker.call("reflines.live_warp", 'EXEC_DEFAULT', True), flush=True)
    lattice = bpy.context.scene.reflection_lines.warp.lattice
    for _ in range(walker.dice.randrange(4) if lattice is not None else 0):
        walker.dice.choice(lattice.data.points).co_deform.x += walker.dice.uniform(-0.3, 0.3)
        lattice.data.update_tag()
        yield walker.dice.choice((0.0, 0.1, 0.5))
    yield 0.1


def reload_addon(walker: Walker) -> Steps:
    walker.call("preferences.addon_disable", module=installation.NAME)
    yield walker.dice.choice((0.0, 0.2))
    installation.install()
    yield 0.1


def reinstall(walker: Walker) -> Steps:
    """A package over itself, of the same build or another; only where an installed one is tested, for the checkout's
    is not to be written over."""
    if installation.INSTALLED:
        tail = walker.dice.choice((b"", b"another build"))
        source = Path(walker.file).parent / "reflection_lines"
        if not source.exists():
            shutil.copytree(packages.folder(), source, ignore=shutil.ignore_patterns("__pycache__"))
        packages.install(packages.packed(source, "again.zip", tail))
        yield walker.dice.choice((0.0, 0.2))
        installation.install()
    yield 0.1


def save(walker: Walker) -> Steps:
    walker.call("wm.save_as_mainfile", filepath=walker.file, check_existing=False)
    yield 0.1


def load(walker: Walker) -> Steps:
    """The walk's file, or a sample."""
    samples = sorted((installation.ROOT / "blend_samples").glob("*.blend"))
    file = walker.dice.choice((walker.file, walker.file, str(walker.dice.choice(samples))))
    print("   ", file, walker.call("wm.open_mainfile", filepath=file, load_ui=False), flush=True)
    yield 0.5
    walker.driver = window.Window()
