"""Every tool after each tampered file was opened."""
import sys
from pathlib import Path

import bpy
import pytest

import every_tool
import hostile_files
import scenes


@pytest.mark.parametrize("change", hostile_files.FILES.values(), ids=hostile_files.FILES)
def test_tools_end_well(change, capfd, tmp_path: Path) -> None:
    panel = scenes.edited_panel(cells=8)
    assert scenes.smooth() == {'FINISHED'}
    scenes.object_mode()
    sys.modules["reflection_lines.state.persistence"].save_solves()
    assert panel.reflection_lines.last
    change(panel)
    name = panel.name
    hostile_files.save_past_the_addon(tmp_path / "tampered.blend")
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "tampered.blend"))
    ob = bpy.data.objects[name]
    scenes.activate(ob)
    every_tool.run_every_tool(ob)
    told = capfd.readouterr()
    assert "Traceback" not in told.out + told.err, told.err


def test_there_are_enough_files() -> None:
    assert len(hostile_files.FILES) >= 33
