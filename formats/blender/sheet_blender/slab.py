# SPDX-License-Identifier: GPL-3.0-or-later
"""The sheet as a slab of its true thickness, by geometry nodes."""
from __future__ import annotations

from typing import Any

import bpy

from .compat import add_socket


def add_slab(thing: bpy.types.Object) -> bpy.types.Modifier:
    """Gives the object the modifier that shows both sides of the sheet and its rim, at half the thickness from it."""
    modifier = thing.modifiers.new("Sheet slab", "NODES")
    modifier.node_group = slab_group()
    return modifier


def slab_group() -> bpy.types.NodeTree:
    """The node group of the slab, made once a file. Its input "Factor" makes the slab thicker than it is."""
    name = "Sheet slab"
    if name in bpy.data.node_groups:
        return bpy.data.node_groups[name]
    tree = bpy.data.node_groups.new(name, "GeometryNodeTree")
    add_socket(tree, "Geometry", "INPUT", "NodeSocketGeometry")
    factor = add_socket(tree, "Factor", "INPUT", "NodeSocketFloat")
    factor.default_value, factor.min_value = 1.0, 0.0
    add_socket(tree, "Geometry", "OUTPUT", "NodeSocketGeometry")
    link = tree.links.new
    entry, leave = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    named = tree.nodes.new("GeometryNodeInputNamedAttribute")
    named.data_type = "FLOAT_VECTOR"
    named.inputs["Name"].default_value = "slab"
    slab = next(s for s in named.outputs if s.enabled and s.type == "VECTOR")

    def scaled(by: float) -> Any:
        multiply, scale = tree.nodes.new("ShaderNodeMath"), tree.nodes.new("ShaderNodeVectorMath")
        multiply.operation, scale.operation = "MULTIPLY", "SCALE"
        link(entry.outputs["Factor"], multiply.inputs[0])
        multiply.inputs[1].default_value = by
        link(slab, scale.inputs[0])
        link(multiply.outputs[0], scale.inputs["Scale"])
        return scale.outputs["Vector"]

    def moved(geometry: Any, by: float, selection: Any = None) -> Any:
        node = tree.nodes.new("GeometryNodeSetPosition")
        link(geometry, node.inputs["Geometry"])
        link(scaled(by), node.inputs["Offset"])
        if selection is not None:
            link(selection, node.inputs["Selection"])
        return node.outputs["Geometry"]

    rim = tree.nodes.new("GeometryNodeExtrudeMesh")
    rim.mode = "EDGES"
    neighbours = tree.nodes.new("GeometryNodeInputMeshEdgeNeighbors")
    alone = tree.nodes.new("FunctionNodeCompare")
    alone.data_type, alone.operation = "INT", "EQUAL"
    link(neighbours.outputs[0], [s for s in alone.inputs if s.type == "INT"][0])
    [s for s in alone.inputs if s.type == "INT"][1].default_value = 1
    link(moved(entry.outputs["Geometry"], 1), rim.inputs["Mesh"])
    link(alone.outputs[0], rim.inputs["Selection"])
    rim.inputs["Offset Scale"].default_value = 0.0
    flip = tree.nodes.new("GeometryNodeFlipFaces")
    link(moved(entry.outputs["Geometry"], -1), flip.inputs[0])
    join = tree.nodes.new("GeometryNodeJoinGeometry")
    link(flip.outputs[0], join.inputs[0])
    link(moved(rim.outputs["Mesh"], -2, rim.outputs["Top"]), join.inputs[0])
    link(join.outputs[0], leave.inputs["Geometry"])
    for i, node in enumerate(tree.nodes):
        node.location = (200 * (i % 6), -220 * (i // 6))
    return tree
