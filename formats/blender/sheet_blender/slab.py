# SPDX-License-Identifier: GPL-3.0-or-later
"""The sheet as a slab of its true thickness, by geometry nodes.

An array of two makes the second side, and the nodes only move, flip and extrude what is there: nodes that join geometry
make UV maps common attributes until Blender 3.4, which materials do not find.
"""
from __future__ import annotations

from typing import Any

import bpy

from .compat import add_socket, new_modifier_tree

SLAB, FACTOR = "Sheet slab", "Thickness Factor"  # the modifier, and its input
GROUP = "Sheet slab of two sides"


def add_slab(thing: bpy.types.Object) -> bpy.types.Modifier:
    """Gives the object the modifiers that show both sides of the sheet and its rim, at half the thickness from it;
    returns the second one, which does it."""
    twice = thing.modifiers.new("Sheet sides", "ARRAY")
    twice.count, twice.use_relative_offset, twice.show_expanded = 2, False, False
    modifier = thing.modifiers.new(SLAB, "NODES")
    modifier.node_group = slab_group()
    return modifier


def slab_group() -> bpy.types.NodeTree:
    """The node group of the slab, made once a file. Its input FACTOR makes the slab thicker than it is."""
    if GROUP in bpy.data.node_groups:
        return bpy.data.node_groups[GROUP]
    tree = new_modifier_tree(GROUP)
    add_socket(tree, "Geometry", "INPUT", "NodeSocketGeometry")
    factor = add_socket(tree, FACTOR, "INPUT", "NodeSocketFloat")
    factor.default_value, factor.min_value = 1.0, 0.0
    add_socket(tree, "Geometry", "OUTPUT", "NodeSocketGeometry")
    link = tree.links.new
    entry, leave = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    named = tree.nodes.new("GeometryNodeInputNamedAttribute")
    named.data_type = "FLOAT_VECTOR"
    named.inputs["Name"].default_value = "slab"
    slab = next(s for s in named.outputs if s.enabled and s.type == "VECTOR")

    def math(operation: str, *inputs: Any) -> Any:
        """A node of numbers whose first inputs are these sockets or constants; its output."""
        made = tree.nodes.new("ShaderNodeMath")
        made.operation = operation
        for socket, value in zip(made.inputs, inputs):
            if isinstance(value, (int, float)):
                socket.default_value = value
            else:
                link(value, socket)
        return made.outputs[0]

    def moved(geometry: Any, by: Any, selection: Any = None) -> Any:
        """By so many times the factor and the slab."""
        place, scale = tree.nodes.new("GeometryNodeSetPosition"), tree.nodes.new("ShaderNodeVectorMath")
        scale.operation = "SCALE"
        link(slab, scale.inputs[0])
        link(math("MULTIPLY", entry.outputs[FACTOR], by), scale.inputs["Scale"])
        link(geometry, place.inputs["Geometry"])
        link(scale.outputs["Vector"], place.inputs["Offset"])
        if selection is not None:
            link(selection, place.inputs["Selection"])
        return place.outputs["Geometry"]

    size = tree.nodes.new("GeometryNodeAttributeDomainSize")
    link(entry.outputs["Geometry"], size.inputs["Geometry"])
    index = tree.nodes.new("GeometryNodeInputIndex").outputs[0]

    def in_first(count: str) -> Any:
        """1 in the first of the two sides, by the number of its points, edges or faces."""
        return math("LESS_THAN", index, math("DIVIDE", size.outputs[count], 2.0))

    sides = moved(entry.outputs["Geometry"], math("MULTIPLY_ADD", in_first("Point Count"), 2.0, -1.0))
    flip = tree.nodes.new("GeometryNodeFlipFaces")
    link(sides, flip.inputs[0])
    link(math("SUBTRACT", 1.0, in_first("Face Count")), flip.inputs["Selection"])
    rim = tree.nodes.new("GeometryNodeExtrudeMesh")
    rim.mode = "EDGES"
    alone = math("COMPARE", tree.nodes.new("GeometryNodeInputMeshEdgeNeighbors").outputs[0], 1.0, 0.5)
    link(flip.outputs[0], rim.inputs["Mesh"])
    link(math("MULTIPLY", alone, in_first("Edge Count")), rim.inputs["Selection"])
    rim.inputs["Offset Scale"].default_value = 0.0
    link(moved(rim.outputs["Mesh"], -2.0, rim.outputs["Top"]), leave.inputs["Geometry"])
    for i, node in enumerate(tree.nodes):
        node.location = (200 * (i % 6), -220 * (i // 6))
    return tree
