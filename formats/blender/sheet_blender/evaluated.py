# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects as triangles in metres, modifiers applied: what a scene file takes."""
from __future__ import annotations

from contextlib import contextmanager
from collections.abc import Iterator
from typing import Any, NamedTuple

import bmesh
import bpy
import numpy as np

from .errors import SheetError

WITH_SURFACE = ("MESH", "CURVE", "SURFACE", "FONT", "META")
MOST_SPLITS = 12  # rounds, each of which halves edges


class Triangles(NamedTuple):
    """position (n x 3) [m] in the world; triangle (m x 3); corner: the mesh's loop of each corner (m x 3); face: its
    polygon of each triangle (m)."""
    position: Any
    triangle: Any
    corner: Any
    face: Any


class Thickness(NamedTuple):
    """values [m], at each vertex or triangle; place: vertex or face."""
    values: Any
    place: str


@contextmanager
def surface_of(thing: bpy.types.Object, edges: float = 0.0) -> Iterator[bpy.types.Mesh]:
    """The mesh of an object with its modifiers, for as long as the block lasts; its edges are split until none is
    longer than 1.4 times `edges` [Blender's units, in the world] if that is above 0. Raises SheetError if there is
    none."""
    if thing.type not in WITH_SURFACE:
        raise SheetError(f'"{thing.name}" has no surface: a {thing.type.lower()} is neither a sheet nor a solid')
    if thing.name not in bpy.context.view_layer.objects:
        raise SheetError(f'"{thing.name}" is in no collection of this view layer, so Blender does not evaluate it: tick'
                         " its collection in the outliner, or give it the role None")
    evaluated = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    split = None
    try:
        if mesh is None or not len(mesh.polygons):
            remedy = ": fill it, or give it a depth (Object Data > Geometry), or make it a mesh (Object > Convert >" \
                " Mesh)"
            if thing.type == "MESH":
                made_by_nodes = any(modifier.type == "NODES" for modifier in thing.modifiers)
                remedy = ": its geometry nodes may need Realize Instances" if made_by_nodes else ""
            raise SheetError(f'"{thing.name}" has no faces{remedy}')
        if edges > 0:
            split = _split(mesh, thing.matrix_world, 1.4 * edges)
        yield split or mesh
    finally:
        evaluated.to_mesh_clear()
        if split is not None:
            bpy.data.meshes.remove(split)


def _split(mesh: bpy.types.Mesh, matrix: Any, longest: float) -> bpy.types.Mesh | None:
    """A copy whose edges are at most so long in the world; None if they are."""
    made = bmesh.new()
    try:
        made.from_mesh(mesh)
        bmesh.ops.triangulate(made, faces=made.faces)  # diagonals of faces become edges, too
        _keep_weights_above(0.5, made)
        for rounds in range(MOST_SPLITS):
            long = [edge for edge in made.edges
                    if (matrix.to_3x3() @ (edge.verts[1].co - edge.verts[0].co)).length > longest]
            if not long:
                break
            bmesh.ops.subdivide_edges(made, edges=long, cuts=1, use_grid_fill=True, use_single_edge=True)
            bmesh.ops.triangulate(made, faces=made.faces)
        if rounds == 0:
            return None
        _keep_weights_above(0.999, made)  # a new vertex is in the groups that both ends of its edge are in
        result = bpy.data.meshes.new("Sheet split")
        made.to_mesh(result)
        for slot in mesh.materials:
            result.materials.append(slot)
        return result
    finally:
        made.free()


def _keep_weights_above(least: float, made: Any) -> None:
    """Makes those weights in vertex groups 1, and takes others away."""
    layer = made.verts.layers.deform.active
    for vertex in made.verts if layer is not None else ():
        weights = vertex[layer]
        for group, weight in list(weights.items()):
            if weight > least:
                weights[group] = 1.0
            else:
                del weights[group]


def triangles_of(mesh: bpy.types.Mesh, matrix: Any, length: float) -> Triangles:
    """The mesh's triangles in the world; `length`: metres of Blender's unit. Mirrored ones are turned round."""
    mesh.calc_loop_triangles()
    x, corners = np.empty(3 * len(mesh.vertices)), np.empty(3 * len(mesh.loop_triangles), np.int32)
    mesh.vertices.foreach_get("co", x)
    mesh.loop_triangles.foreach_get("vertices", corners)
    loops, faces = np.empty(corners.size, np.int32), np.empty(len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("loops", loops)
    mesh.loop_triangles.foreach_get("polygon_index", faces)
    world = np.array(matrix)
    position = (x.reshape(-1, 3) @ world[:3, :3].T + world[:3, 3]) * length
    triangles, corner = corners.reshape(-1, 3), loops.reshape(-1, 3)
    if np.linalg.det(world[:3, :3]) < 0:
        triangles, corner = triangles[:, ::-1], corner[:, ::-1]
    return Triangles(position, triangles, corner, faces)


def painted_groups(thing: bpy.types.Object, mesh: bpy.types.Mesh, names: list[str], triangle: Any) -> dict[str, Any]:
    """Which vertices of triangles have a weight above 0.5 in each of these vertex groups."""
    groups = {group.index: group.name for group in thing.vertex_groups if group.name in names}
    painted = {name: np.zeros(len(mesh.vertices), bool) for name in groups.values()}
    for vertex in mesh.vertices if groups else ():
        for membership in vertex.groups:
            if membership.group in groups and membership.weight > 0.5:
                painted[groups[membership.group]][vertex.index] = True
    with_faces = np.isin(np.arange(len(mesh.vertices)), triangle)
    return {name: chosen & with_faces for name, chosen in painted.items()}


def thickness_of(mesh: bpy.types.Mesh, faces: Any) -> Thickness | None:
    """The attribute "thickness"; None without one."""
    attribute = mesh.attributes.get("thickness")
    if attribute is None or attribute.data_type != "FLOAT" or attribute.domain not in ("POINT", "FACE"):
        return None
    values = np.empty(len(attribute.data))
    attribute.data.foreach_get("value", values)
    return Thickness(values, "vertex") if attribute.domain == "POINT" else Thickness(values[faces], "face")
