"""Every sample opens on the add-on's tab of the sidebar, as README's first use says."""
from pathlib import Path

import bpy

import sidebar
import window

SAMPLES = sorted((Path(__file__).resolve().parents[2] / "blend_samples").glob("*.blend"))


def test_every_sample_opens_on_the_tab(driver: window.Window) -> sidebar.Steps:
    assert not (yield from sidebar.shows_tab(driver))  # no setting of Blender's start-up file puts it in front
    assert len(SAMPLES) >= 9
    for path in SAMPLES:
        bpy.ops.wm.open_mainfile(filepath=str(path), load_ui=True)
        yield 1.0
        assert (yield from sidebar.shows_tab(window.Window())), path.name
