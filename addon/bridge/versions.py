"""All that differs between Blender 3.4, 4.3 and 5.2 in what this add-on uses."""
import bmesh
import bpy
import numpy as np


def shape_is_locked(key: bpy.types.ShapeKey) -> bool:
    """Shape keys can be locked from Blender 4.2 on."""
    return getattr(key, "lock_shape", False)


def reported_error(error: RuntimeError) -> str:
    """What an operator reported, without the word that Blender writes before it in the language of the interface.

    Reports have a translation of their own from Blender 4.1 on."""
    translated = getattr(bpy.app.translations, "pgettext_rpt", bpy.app.translations.pgettext_tip)
    return str(error).removeprefix(f"{translated('Error')}: ").removeprefix("Error: ").strip()


def edge_creases(mesh: bpy.types.Mesh) -> np.ndarray:
    """#edges in [0, 1]. An attribute from Blender 4.0 on, absent where nothing is creased."""
    return crease_values(mesh, "crease_edge", len(mesh.edges), mesh.edges)


def vertex_creases(mesh: bpy.types.Mesh) -> np.ndarray:
    """#vertices in [0, 1]."""
    layers = getattr(mesh, "vertex_creases", None)
    return crease_values(mesh, "crease_vert", len(mesh.vertices), layers[0].data if layers else ())


def crease_values(mesh: bpy.types.Mesh, name: str, count: int, before: object) -> np.ndarray:
    """`before` holds them as `crease` in Blender 3; there it may be empty."""
    values = np.zeros(count, dtype=np.float32)
    if bpy.app.version < (4, 0, 0):
        if len(before) > 0:
            before.foreach_get("crease" if name == "crease_edge" else "value", values)
    elif name in mesh.attributes:
        attribute = mesh.attributes[name]
        if mesh.is_editmode:  # attributes have no data there
            values[:] = edited_values(bmesh.from_edit_mesh(mesh), attribute.domain, name)
        else:
            attribute.data.foreach_get("value", values)
    return values.astype(np.float64)


def edited_values(edited: bmesh.types.BMesh, domain: str, name: str) -> list[float]:
    elements = edited.edges if domain == 'EDGE' else edited.verts
    layer = elements.layers.float.get(name)
    return [0.0] * len(elements) if layer is None else [element[layer] for element in elements]
