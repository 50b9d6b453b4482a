"""A session of a Blender with settings of its own: the add-on is installed over itself time and again, in turns the
same build and another, used and unused. Run by test_reinstall.py with how often and the folder to pack."""
import sys
from collections.abc import Generator
from pathlib import Path

import bpy

import scenes
from packages import MODULE, NATIVE, folder, install, packed

ROUNDS, SOURCE = int(sys.argv[1]), Path(sys.argv[2])


def spoil() -> None:
    """What an installation that writes into the library leaves of it for a moment."""
    for file in folder().iterdir():
        if file.suffix in NATIVE:
            content = file.read_bytes()
            file.write_bytes(bytes(len(content)))
            solve()
            file.write_bytes(content)


def show(cells: int) -> Generator[float, None, None]:
    """With stripes, of so many cells that a thread fits their normals."""
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == 'VIEW_3D')
    region = next(region for region in area.regions if region.type == 'WINDOW')
    with bpy.context.temp_override(window=window, area=area, region=region):
        scenes.remove_all()
        scenes.panel(cells=cells)
        scenes.look_from_above()
        bpy.context.scene.reflection_lines.stripes.show = True
        bpy.ops.wm.tool_set_by_id(name="reflection_lines.tool")  # its gizmos are drawn when the add-on goes
    area.tag_redraw()
    yield 0.2


def solve() -> None:
    ob = scenes.edited_panel()
    assert scenes.smooth() == {'FINISHED'}
    scenes.object_mode()
    bpy.data.objects.remove(ob)


def session() -> Generator[float, None, None]:
    packages = packed(SOURCE, "same.zip", b""), packed(SOURCE, "other.zip", b"another build")
    for turn in range(ROUNDS):
        install(packages[turn // 2 % 2])  # over itself, and over another
        yield 0.05
        if turn % 3 == 1:
            assert bpy.ops.preferences.addon_disable(module=MODULE) == {'FINISHED'}
            assert bpy.ops.preferences.addon_enable(module=MODULE) == {'FINISHED'}
        if turn % 3 != 2:  # unused else
            yield from show(cells=100)
            solve()
            spoil()
    print("all rounds done", flush=True)
    bpy.ops.wm.quit_blender()
    yield 600.0


steps = session()
bpy.context.preferences.view.show_splash = False
bpy.app.timers.register(lambda: next(steps), first_interval=0.5, persistent=True)
