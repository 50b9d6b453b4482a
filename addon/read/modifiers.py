"""The modifiers of an object as a solve sees them: which of them shape the surface that the viewport shows."""
import bpy

# Modifiers that move no vertex; Edge Split duplicates some.
SHADING_ONLY = {'WEIGHTED_NORMAL', 'NORMAL_EDIT', 'EDGE_SPLIT', 'DATA_TRANSFER', 'UV_PROJECT', 'UV_WARP',
         'VERTEX_WEIGHT_EDIT', 'VERTEX_WEIGHT_MIX', 'VERTEX_WEIGHT_PROXIMITY'}
# Geometry nodes that only set smooth shading, as Blender's own Smooth by Angle does.
SHADING_ONLY_NODES = {'NodeGroupInput', 'NodeReroute', 'GeometryNodeSetShadeSmooth', 'GeometryNodeSetMeshNormal'}
DEFORMING = {'ARMATURE', 'CAST', 'CLOTH', 'CORRECTIVE_SMOOTH', 'CURVE', 'DISPLACE', 'HOOK', 'LAPLACIANDEFORM',
             'LAPLACIANSMOOTH', 'LATTICE', 'MESH_CACHE', 'MESH_DEFORM', 'MESH_SEQUENCE_CACHE', 'MULTIRES', 'NODES',
             'OCEAN', 'SHRINKWRAP', 'SIMPLE_DEFORM', 'SMOOTH', 'SOFT_BODY', 'SURFACE_DEFORM', 'WARP', 'WAVE'}
OUTSIDE = -1.0  # the offset of a Solidify whose outer side is the surface itself


def find_shaping_modifiers(ob: bpy.types.Object | None) -> list[bpy.types.Modifier]:
    """Returns the modifiers shown in the viewport, without those at the end that change the shading only."""
    shown = [modifier for modifier in ob.modifiers if modifier.show_viewport] if ob is not None else []
    while shown and is_shading_only(shown[-1]):
        shown.pop()
    return shown


def is_shading_only(modifier: bpy.types.Modifier) -> bool:
    """Returns whether a modifier moves no vertex."""
    if modifier.type != 'NODES':
        return modifier.type in SHADING_ONLY
    nodes = modifier.node_group.nodes if modifier.node_group is not None else ()
    makers = {node.bl_idname for node in nodes if any(socket.type == 'GEOMETRY' for socket in node.outputs)}
    return makers <= SHADING_ONLY_NODES


def is_subdivision(modifier: bpy.types.Modifier) -> bool:
    return modifier.type == 'SUBSURF' and modifier.levels > 0


def find_cage_modifiers(ob: bpy.types.Object | None) -> list[bpy.types.Modifier]:
    """Returns the shaping modifiers without those at the end that only give the surface a thickness or its shading."""
    makers = find_shaping_modifiers(ob)
    while makers and (makers[-1].type == 'SOLIDIFY' or is_shading_only(makers[-1])):
        makers.pop()
    return makers


def find_shells(ob: bpy.types.Object) -> list[bpy.types.SolidifyModifier]:
    """Returns the modifiers that give the surface of a cage its thickness."""
    return [modifier for modifier in find_shaping_modifiers(ob)[len(find_cage_modifiers(ob)):]
            if modifier.type == 'SOLIDIFY']


def shows_cage_surface(ob: bpy.types.Object) -> bool:
    """Returns whether the surface of a cage is what is seen, and no shell that lies off it."""
    return all(shell.offset == OUTSIDE for shell in find_shells(ob))


def is_cage(ob: bpy.types.Object | None) -> bool:
    """Returns whether the last modifier that shapes the surface is a Subdivision Surface with levels; its thickness
    follows by itself.
    """
    makers = find_cage_modifiers(ob)
    return bool(makers) and is_subdivision(makers[-1])


def describe_unsolved_modifiers(ob: bpy.types.Object) -> tuple[str, ...]:
    """Describes, in sentences, modifiers that make the surface shown another one than the surface solved."""
    if is_cage(ob):
        return describe_shells(ob)
    makers, said = find_shaping_modifiers(ob), []
    levels = [modifier.name for modifier in makers if is_subdivision(modifier)]
    if levels:
        said.append(f"The modifier {makers[-1].name} follows {levels[-1]}, so the mesh was solved as if it were not "
                    f"subdivided: move {levels[-1]} to the end, or hide what follows it, to solve for the cage")
    deforming = [each.name for each in makers if each.type in DEFORMING and not is_shading_only(each)]
    if deforming:
        said.append(f"The mesh was solved as it is without the modifier {', '.join(deforming)}, which moves what is "
                    "shown: hide or apply it to judge the lines")
    return tuple(said)


def describe_shells(ob: bpy.types.Object) -> tuple[str, ...]:
    """Says that a shell lies off the surface that was solved, where one does."""
    off = [shell.name for shell in find_shells(ob) if shell.offset != OUTSIDE]
    return (f"The shell of {off[0]} lies off the surface that was solved; with Offset -1 that is its outer side",) \
        if off else ()
