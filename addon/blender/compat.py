"""Differences between Blender 3.4, 4.3 and 5.2 in the interfaces that this add-on uses."""
import re

import bmesh
import bpy
import numpy as np


def is_shape_locked(key: bpy.types.ShapeKey) -> bool:
    """Returns whether the shape key is locked, which Blender can do from 4.2 on."""
    return getattr(key, "lock_shape", False)


def strip_error_prefix(error: RuntimeError) -> str:
    """Returns the text that an operator reported, or that its poll gave, without what Blender puts before it: the
    translated word "Error: ", and the operator's name.

    Reports have a translation of their own from Blender 4.1 on.
    """
    translated = getattr(bpy.app.translations, "pgettext_rpt", bpy.app.translations.pgettext_tip)
    text = str(error).removeprefix(f"{translated('Error')}: ").removeprefix("Error: ").strip()
    return re.sub(r"^Operator bpy\.ops\.\S+ ", "", text)


def read_edge_creases(mesh: bpy.types.Mesh) -> np.ndarray:
    """Reads the crease of every edge: #edges in [0, 1].

    An attribute from Blender 4.0 on, absent where nothing is creased.
    """
    return read_crease_values(mesh, "crease_edge", len(mesh.edges), mesh.edges)


def read_vertex_creases(mesh: bpy.types.Mesh) -> np.ndarray:
    """Reads the crease of every vertex: #vertices in [0, 1]. In Edit Mode Blender 3 has them in the edit mesh alone."""
    layers = mesh.vertex_creases if bpy.app.version < (4, 0, 0) else ()  # Blender 4 has a collection of that name, too
    if layers and mesh.is_editmode:
        elements = bmesh.from_edit_mesh(mesh).verts
        layer = elements.layers.crease.verify()
        return np.array([element[layer] for element in elements])
    return read_crease_values(mesh, "crease_vert", len(mesh.vertices), layers[0].data if layers else ())


def read_crease_values(mesh: bpy.types.Mesh, name: str, count: int,
                       before: bpy.types.bpy_prop_collection | tuple) -> np.ndarray:
    """Reads creases from the attribute `name`, or from the collection `before`, which held them in Blender 3."""
    values = np.zeros(count, dtype=np.float32)
    if bpy.app.version < (4, 0, 0):
        if len(before) > 0:
            before.foreach_get("crease" if name == "crease_edge" else "value", values)
    elif name in mesh.attributes:
        attribute = mesh.attributes[name]
        if mesh.is_editmode:  # attributes have no data there
            values[:] = read_edited_values(bmesh.from_edit_mesh(mesh), attribute.domain, name)
        else:
            attribute.data.foreach_get("value", values)
    return values.astype(np.float64)


def read_edited_values(edited: bmesh.types.BMesh, domain: str, name: str) -> list[float]:
    """Reads a float layer of the edit mesh; zeros where the mesh has no such layer."""
    elements = edited.edges if domain == 'EDGE' else edited.verts
    layer = elements.layers.float.get(name)
    return [0.0] * len(elements) if layer is None else [element[layer] for element in elements]


def find_action_curves(holder: bpy.types.AnimData | bpy.types.NlaStrip) -> bpy.types.bpy_prop_collection | None:
    """Finds the F-curves with which an action animates the owner of the animation data, or of the strip; None without.

    From Blender 4.4 on an action has some for each of its slots, in the layers' strips; from 5 on these only.
    """
    action = holder.action
    if action is None or bpy.app.version < (4, 4, 0):
        return None if action is None else action.fcurves
    slot = holder.action_slot
    bags = () if slot is None else (strip.channelbag(slot) for layer in action.layers for strip in layer.strips)
    return next((bag.fcurves for bag in bags if bag is not None), None)


def find_slot_number(holder: bpy.types.AnimData | bpy.types.NlaStrip) -> int:
    """Returns the number of the action's slot that is used; 0 before Blender 4.4, where actions have none."""
    slot = holder.action_slot if bpy.app.version >= (4, 4, 0) else None
    return 0 if slot is None else slot.handle
