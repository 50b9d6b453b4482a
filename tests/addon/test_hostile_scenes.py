"""Every tool on every hostile scene, and once more after it was saved and opened again."""
from pathlib import Path

import bpy
import pytest

import every_tool
import hostile_scenes
import scenes


@pytest.mark.parametrize("build", hostile_scenes.SCENES.values(), ids=hostile_scenes.SCENES)
def test_tools_end_well(build, capfd, tmp_path: Path) -> None:
    ob = build()
    every_tool.run_every_tool(ob)
    name, place = ob.name, scenes.positions(ob).tobytes()
    if bpy.context.mode != 'OBJECT':
        scenes.object_mode()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "hostile.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "hostile.blend"))
    ob = bpy.data.objects[name]
    assert scenes.positions(ob).tobytes() == place
    scenes.activate(ob)
    every_tool.run_every_tool(ob)
    told = capfd.readouterr()
    assert "Traceback" not in told.out + told.err, told.err


def test_there_are_enough_scenes() -> None:
    assert len(hostile_scenes.SCENES) >= 33
