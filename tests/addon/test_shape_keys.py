"""Results in a shape key: what the mesh would have got, and nothing else changed; Re-solve after the view changed."""
import bpy
import numpy as np
import pytest

import scenes
from reflection_lines.read import region_faces, shape_keys

KEY = "Reflection Lines"


def into_key(**settings: object) -> None:
    assert scenes.smooth(result='SHAPE_KEY', **settings) == {'FINISHED'}


def shape(ob: bpy.types.Object, name: str) -> np.ndarray:
    values = np.empty(3 * len(ob.data.vertices), dtype=np.float32)
    ob.data.shape_keys.key_blocks[name].data.foreach_get("co", values)
    return values.reshape(-1, 3)


def seen(ob: bpy.types.Object) -> np.ndarray:
    """With the keys mixed, as it is drawn."""
    evaluated = ob.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return np.array([vertex.co for vertex in evaluated.data.vertices], dtype=np.float32)


def another() -> bpy.types.Object:
    """A panel like the fixture's, alone in its Edit Mode."""
    scenes.object_mode()
    for old in bpy.context.selected_objects:
        old.select_set(False)
    ob = scenes.panel("Other")
    scenes.edit_inner(ob)
    return ob


def smoothed(**settings: object) -> np.ndarray:
    """What Smooth makes of the mesh of a panel like the fixture's."""
    ob = another()
    scenes.smooth(**settings)
    scenes.object_mode()
    result = scenes.positions(ob)
    bpy.data.objects.remove(ob)
    return result


@pytest.mark.parametrize("mode", ['EDIT', 'OBJECT'])
def test_the_key_gets_what_the_mesh_would_have_got(panel, mode) -> None:
    before = scenes.positions(panel)
    scenes.smooth(strength=0.0)  # keeps the region for Object Mode
    if mode == 'OBJECT':
        scenes.object_mode()
    into_key()
    assert panel.mode == 'OBJECT'
    assert np.array_equal(shape(panel, "Basis"), before)
    key = panel.data.shape_keys.key_blocks[KEY]
    assert key.value == 1.0 and panel.active_shape_key == key
    whole = shape(panel, KEY)
    assert np.array_equal(whole, smoothed())
    assert np.allclose(seen(panel), whole, atol=1e-7)
    key.value = 0.5
    assert np.allclose(seen(panel), 0.5 * (whole + before), atol=1e-6)


def test_one_undo_takes_key_and_mode_back(panel) -> None:
    bpy.ops.ed.undo_push(message="start")
    before = scenes.fingerprint(panel)
    into_key()
    bpy.ops.ed.undo()
    again = bpy.data.objects["Panel"]
    assert again.data.shape_keys is None
    scenes.edit(again)
    assert scenes.fingerprint(again) == before


def test_other_keys_keep_every_bit(panel) -> None:
    scenes.object_mode()
    rng = np.random.default_rng(1)
    for name in ("Basis", "Wide", "High"):
        key = panel.shape_key_add(name=name, from_mix=False)
        if name != "Basis":
            key.data.foreach_set("co", (shape(panel, name) + 0.01 * rng.random(shape(panel, name).shape)).ravel())
    others = {name: shape(panel, name).tobytes() for name in ("Basis", "Wide", "High")}
    panel.active_shape_key_index = 0
    scenes.edit_inner(panel)
    into_key()
    into_key(length=0.6)
    assert {name: shape(panel, name).tobytes() for name in others} == others
    assert [key.name for key in panel.data.shape_keys.key_blocks] == ["Basis", "Wide", "High", KEY]


def test_tools_add_up_in_the_key(panel) -> None:
    """As they do in the mesh: the second begins with the result of the first."""
    into_key()
    into_key(length=0.8)
    ob = another()
    scenes.smooth()
    scenes.smooth(length=0.8)
    scenes.object_mode()
    assert np.array_equal(shape(panel, KEY), scenes.positions(ob))


def test_of_several_panels_each_keeps_its_region(panel) -> None:
    scenes.object_mode()
    other = scenes.panel("Other")
    panel.select_set(True)
    scenes.edit(panel, other)
    for ob in (panel, other):
        scenes.select_faces(ob, scenes.inner())
    into_key()
    for ob in (panel, other):
        assert region_faces.read_stored_region(ob.data).tolist() == [scenes.inner()(face) for face in range(256)]


def test_the_key_is_edited_in_place(panel) -> None:
    into_key()
    first = shape(panel, KEY)
    scenes.edit_inner(panel)
    into_key(length=0.8)
    assert panel.mode == 'EDIT'
    scenes.object_mode()
    assert not np.array_equal(shape(panel, KEY), first)
    assert np.array_equal(shape(panel, "Basis"), scenes.positions(scenes.panel("Fresh")))


def test_a_refused_run_makes_no_key(panel) -> None:
    bpy.context.scene.reflection_lines.light.rotation_euler = (0.0, 0.0, 0.0)
    with scenes.refused(panel, "parallel"):
        into_key()


def test_absolute_keys_are_refused(panel) -> None:
    scenes.object_mode()
    panel.shape_key_add(name="Basis")
    panel.data.shape_keys.use_relative = False
    scenes.edit_inner(panel)
    with pytest.raises(RuntimeError, match="absolute shape keys"):
        into_key()


@pytest.mark.parametrize(("name", "value", "told"), [
    ("value", 0.0, "has the value 0: raise its Strength"), ("mute", True, "is muted")])
def test_a_result_that_is_not_seen_says_why(panel, name, value, told) -> None:
    into_key()
    report = panel.reflection_lines.report
    assert "Nothing of the result" not in report.notes
    setattr(panel.data.shape_keys.key_blocks[KEY], name, value)
    into_key(length=0.8)
    assert f"Nothing of the result is seen, since the shape key {KEY} {told}" in report.notes
    assert getattr(panel.data.shape_keys.key_blocks[KEY], name) == value


def edits_the_basis(ob: bpy.types.Object) -> None:
    ob.active_shape_key_index = 0
    scenes.edit_inner(ob, margin=5)


def test_another_key_is_never_mixed_into_the_results(panel) -> None:
    into_key()
    edits_the_basis(panel)
    with scenes.refused(panel, "Basis, but the result would go into Reflection Lines"):
        into_key(length=0.8)
    assert panel.mode == 'EDIT' and panel.active_shape_key.name == "Basis"


def test_a_renamed_result_lets_another_begin(panel) -> None:
    into_key()
    panel.data.shape_keys.key_blocks[KEY].name = "First"
    kept = shape(panel, "First").tobytes()
    edits_the_basis(panel)
    into_key(length=0.8)
    assert [key.name for key in panel.data.shape_keys.key_blocks] == ["Basis", "First", KEY]
    assert shape(panel, "First").tobytes() == kept


def test_a_live_warp_does_not_mix_keys_either(panel) -> None:
    into_key()
    edits_the_basis(panel)
    bpy.ops.reflines.add_warp_lattice()
    bpy.context.scene.reflection_lines.result = 'SHAPE_KEY'
    before = scenes.fingerprint(panel)
    with pytest.raises(RuntimeError, match="edit Reflection Lines to go on with it"):
        bpy.ops.reflines.live_warp('EXEC_DEFAULT', True)
    assert scenes.fingerprint(panel) == before and panel.mode == 'EDIT'


def test_resolve_goes_on_where_another_key_is_edited(panel) -> None:
    """It begins with the shape that the key is relative to, whichever key is edited."""
    into_key(length=0.5)
    first = shape(panel, KEY)
    edits_the_basis(panel)
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True) == {'FINISHED'}
    assert np.array_equal(shape(panel, KEY), first)


def turn_light() -> None:
    bpy.context.scene.reflection_lines.light.rotation_euler.y -= 0.3
    bpy.context.view_layer.update()


@pytest.mark.parametrize("result", ['MESH', 'SHAPE_KEY'])
def test_resolve_after_the_light_turned_is_a_run_from_the_original(panel, result) -> None:
    scenes.smooth(result=result, length=0.5, directional=True)
    scenes.object_mode()
    first = scenes.positions(panel)
    turn_light()
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True) == {'FINISHED'}
    assert not np.array_equal(scenes.positions(panel), first)
    assert np.array_equal(scenes.positions(panel), smoothed(length=0.5, directional=True))


def test_resolve_takes_a_mesh_changed_by_hand_as_it_is(panel) -> None:
    scenes.smooth(length=0.5)
    scenes.object_mode()
    panel.data.vertices[140].co.z += 0.01
    ob = panel.copy()
    ob.data, ob.name = panel.data.copy(), "Other"
    bpy.context.collection.objects.link(ob)
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True) == {'FINISHED'}
    resolved = scenes.positions(panel)
    panel.select_set(False)
    scenes.activate(ob)
    scenes.smooth(length=0.5)
    assert np.array_equal(scenes.positions(ob), resolved)


def test_resolve_begins_with_the_original_of_the_key_after_that_changed(panel) -> None:
    into_key(length=0.5)
    basis = panel.data.shape_keys.key_blocks["Basis"]
    basis.data[140].co.z += 0.01
    changed = shape(panel, "Basis")
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True) == {'FINISHED'}
    assert np.array_equal(shape(panel, "Basis"), changed)
    ob = another()
    scenes.object_mode()
    ob.data.vertices[140].co.z = changed[140, 2]
    scenes.edit_inner(ob)
    scenes.smooth(length=0.5)
    scenes.object_mode()
    assert np.array_equal(shape(panel, KEY), scenes.positions(ob))


def test_resolve_from_edit_mode_is_one_undo_step(panel) -> None:
    scenes.smooth(length=0.5)
    turn_light()
    bpy.ops.ed.undo_push(message="turn")
    before = scenes.positions(panel)
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True) == {'FINISHED'}
    assert panel.mode == 'EDIT' and not np.array_equal(scenes.positions(panel), before)
    bpy.ops.ed.undo()
    again = bpy.data.objects["Panel"]
    assert again.mode == 'EDIT' and np.array_equal(scenes.positions(again), before)


def edits_a_key(ob: bpy.types.Object, name: str) -> None:
    """In Edit Mode; the key Low is a dent beside the basis, and High one beside Low."""
    scenes.object_mode()
    for key in (ob.shape_key_add(name=new, from_mix=False) for new in ("Basis", "Low", "High")):
        key.data[140].co.z -= 0.002 * len(key.name)
    ob.data.shape_keys.key_blocks["High"].relative_key = ob.data.shape_keys.key_blocks["Low"]
    ob.active_shape_key_index = ob.data.shape_keys.key_blocks.find(name)
    scenes.edit_inner(ob)


def shapes(ob: bpy.types.Object) -> dict[str, bytes]:
    ob.update_from_editmode()
    return {key.name: shape(ob, key.name).tobytes() for key in ob.data.shape_keys.key_blocks}


@pytest.mark.parametrize("name", ["Basis", "Low", "High"])
def test_resolve_in_edit_mode_changes_keys_as_a_run_there(panel, name) -> None:
    """Blender moves the keys that are relative to the edited one along with it."""
    edits_a_key(panel, name)
    scenes.smooth(length=0.3)
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True, border='free') == {'FINISHED'}
    assert panel.mode == 'EDIT' and "mesh as it is now" not in panel.reflection_lines.report.notes
    resolved = shapes(panel)
    ob = another()
    edits_a_key(ob, name)
    before = shapes(ob)
    scenes.smooth(length=0.3, border='free')
    for each, other in shapes(ob).items():
        assert np.allclose(np.frombuffer(resolved[each], np.float32), np.frombuffer(other, np.float32), atol=3e-7)
    assert resolved[name] == shapes(ob)[name] != before[name]


def test_resolve_in_edit_mode_on_another_key_begins_with_that(panel) -> None:
    edits_a_key(panel, "Low")
    scenes.smooth(length=0.3)
    scenes.object_mode()
    edited = shapes(panel)["Low"]
    panel.active_shape_key_index = 2
    scenes.edit(panel)
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True) == {'FINISHED'}
    assert "another shape key is edited" in panel.reflection_lines.report.notes
    assert shapes(panel)["Low"] == edited


def test_a_refused_resolve_in_edit_mode_leaves_every_key(panel) -> None:
    edits_a_key(panel, "Low")
    scenes.smooth(length=0.3)
    before = shapes(panel)
    bpy.context.scene.reflection_lines.light.rotation_euler = (0.0, 0.0, 0.0)
    with pytest.raises(RuntimeError, match="parallel"):
        bpy.ops.reflines.resolve('EXEC_DEFAULT', True)
    assert panel.mode == 'EDIT' and shapes(panel) == before


def changed_by_hand(ob: bpy.types.Object) -> None:
    ob.data.vertices[140].co.z += 0.01


def renamed(ob: bpy.types.Object) -> None:
    ob.name = "Bonnet"


def undone(_: bpy.types.Object) -> None:
    bpy.ops.ed.undo_push(message="once")
    scenes.smooth(length=0.8)
    bpy.ops.ed.undo()


@pytest.mark.parametrize("change", [changed_by_hand, renamed, undone])
def test_resolve_tells_where_it_does_not_know_the_start(panel, change, capfd) -> None:
    scenes.smooth(length=0.5)
    scenes.object_mode()
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True) == {'FINISHED'}
    assert "began with the mesh as it is now" not in capfd.readouterr().out
    change(panel)
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True) == {'FINISHED'}
    *_, said, result = capfd.readouterr().out.splitlines()
    assert said.startswith("Warning: ") and "The run began with the mesh as it is now: " in said
    assert result.startswith("Info: ")


@pytest.fixture(params=['en_US', 'de_DE'])
def language(request) -> str:
    """Of the interface; the word that Blender writes before an error."""
    view = bpy.context.preferences.view
    kept = view.language
    view.language = request.param
    for name in ("use_translate_tooltips", "use_translate_reports"):
        if hasattr(view, name):
            setattr(view, name, True)
    yield {'en_US': "Error", 'de_DE': "Fehler"}[request.param]
    view.language = kept


def test_resolve_hands_on_a_refusal_as_it_is(panel, language) -> None:
    scenes.smooth(length=0.5)
    panel.scale.z = 0.0
    with pytest.raises(RuntimeError) as failure:
        bpy.ops.reflines.resolve('EXEC_DEFAULT', True)
    assert str(failure.value).startswith(f"{language}: Panel is scaled to nothing")
    assert panel.mode == 'EDIT'


def test_resolve_tells_of_other_faces(panel, capfd) -> None:
    scenes.smooth(length=0.5)
    scenes.select_faces(panel, lambda face: face == 100)
    bpy.ops.mesh.subdivide()
    scenes.object_mode()
    assert bpy.ops.reflines.resolve('EXEC_DEFAULT', True) == {'FINISHED'}
    assert "The mesh has changed since the last run: +" in capfd.readouterr().out


@pytest.mark.parametrize("how", ["apply", "discard"])
def test_live_warp_into_a_key(panel, how) -> None:
    before = scenes.fingerprint(panel)
    bpy.ops.reflines.add_warp_lattice()
    scenes.object_mode()
    kept = scenes.fingerprint(panel)
    settings = bpy.context.scene.reflection_lines
    settings.result = 'SHAPE_KEY'
    bpy.ops.reflines.live_warp('EXEC_DEFAULT', True)
    settings.warp.lattice.data.points[12].co_deform.x += 0.2
    bpy.ops.reflines.live_warp('EXEC_DEFAULT', True, action=how.upper())
    if how == "discard":
        assert scenes.fingerprint(panel) == kept
        return
    assert shape(panel, "Basis").tobytes() == before[0]
    assert not np.array_equal(shape(panel, KEY), shape(panel, "Basis"))


@pytest.mark.parametrize("how", ["mixed", "pinned", "pinned and muted", "muted", "by group", "absolute"])
def test_the_mixed_shape_is_what_is_seen(panel, how) -> None:
    """Stripes of cages are drawn on it. Where Blender mixes by groups or times, none is read."""
    into_key()
    scenes.object_mode()
    own = panel.shape_key_add(name="Own", from_mix=True)
    for point in own.data:
        point.co.y += 0.2 * point.co.x
    own.relative_key, own.value, own.slider_max = panel.data.shape_keys.key_blocks[KEY], 0.7, 2.0
    panel.data.shape_keys.key_blocks[KEY].value = 0.3
    panel.active_shape_key_index = 2
    panel.show_only_shape_key = how.startswith("pinned")
    own.mute = how.endswith("muted")
    if how == "by group":
        own.vertex_group = panel.vertex_groups.new(name="Some").name
    panel.data.shape_keys.use_relative = how != "absolute"
    bpy.context.view_layer.update()
    mixed = shape_keys.read_mixed_shape(panel)
    if how in {"by group", "absolute"}:
        assert mixed is None
    else:
        assert np.abs(mixed - seen(panel)).max() < 1e-6
