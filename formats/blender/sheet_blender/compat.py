# SPDX-License-Identifier: GPL-3.0-or-later
"""What differs between the Blenders that the add-on runs in, 3.4 to 5.x, and where the package sheetstream is.

Tried in 3.4.1; the rest is as the release notes of 4.0 to 5.2 tell. Each function asks for what there is, not for a
version, so that it can be tested without the other Blender.
"""
from __future__ import annotations

import importlib
from typing import Any

import bpy

try:
    from . import sheetstream
except ImportError:
    try:
        import sheetstream  # type: ignore[no-redef]
    except ImportError as error:
        raise ImportError("Sheet's add-on needs the package sheetstream: install sheet-blender.zip, which has it, or"
                          " put the folder formats/python on PYTHONPATH") from error

__all__ = ["add_socket", "confirm", "draw_socket", "fcurves_of", "new_modifier_tree", "nodes_of", "progress",
           "read_toml", "set_polygon_sizes", "sheetstream", "socket_of"]


def read_toml(text: str) -> dict[str, Any]:
    """The tables of a text in TOML. Python has a reader since 3.11 (Blender 4.1); before, tomli is one, and so is the
    copy that pip has, which Blender brings along. ImportError if there is none, ValueError if the text is wrong."""
    for name in ("tomllib", "tomli", "pip._vendor.tomli"):
        try:
            reader = importlib.import_module(name)
        except ImportError:
            continue
        return dict(reader.loads(text))
    raise ImportError("this Blender's Python has no reader of TOML")


def nodes_of(thing: Any) -> Any:
    """The tree of nodes of a material or a world, made if there is none."""
    if thing.node_tree is None:  # since 5.0 there always is one, and to ask for it is deprecated
        thing.use_nodes = True
    return thing.node_tree


def socket_of(sockets: Any, identifier: str) -> Any:
    """A socket of a node by what it is called in files: names change, as Fac became Factor in 5.0."""
    return next(socket for socket in sockets if socket.identifier == identifier)


def new_modifier_tree(name: str) -> Any:
    """A node group for modifiers of geometry nodes."""
    tree = bpy.data.node_groups.new(name, "GeometryNodeTree")
    if hasattr(tree, "is_modifier"):  # since 4.0 groups may be tools, too, and modifiers offer those that say so
        tree.is_modifier = True
    return tree


def add_socket(tree: Any, name: str, side: str, kind: str) -> Any:
    """A socket of a node group; side: INPUT or OUTPUT."""
    if hasattr(tree, "interface"):  # since 4.0
        return tree.interface.new_socket(name, in_out=side, socket_type=kind)
    return (tree.inputs if side == "INPUT" else tree.outputs).new(kind, name)


def draw_socket(layout: Any, modifier: Any, name: str) -> None:
    """An input of a modifier of geometry nodes, by the name of its socket, for the user to change."""
    tree = modifier.node_group
    sockets = tree.interface.items_tree if hasattr(tree, "interface") else tree.inputs
    identifier = next(s.identifier for s in sockets if s.name == name and getattr(s, "in_out", "INPUT") == "INPUT")
    inputs = getattr(getattr(modifier, "properties", None), "inputs", None)
    if inputs is not None and hasattr(inputs, identifier):  # since 5.2
        layout.prop(getattr(inputs, identifier), "value", text=name)
    else:
        layout.prop(modifier, f'["{identifier}"]', text=name)


def fcurves_of(thing: Any) -> list[Any]:
    """The curves that animate an object; none if it has no action, or no slot of it."""
    data = thing.animation_data
    if data is None or data.action is None:
        return []
    if not hasattr(data, "action_slot"):  # since 4.4 an action may have curves of several objects
        return list(data.action.fcurves)
    if data.action_slot is None:
        return []
    return [curve for layer in data.action.layers for strip in layer.strips
            for bag in [strip.channelbag(data.action_slot)] if bag is not None for curve in bag.fcurves]


def progress(layout: Any, part: float, text: str) -> None:
    """A bar that is filled to this part (0 to 1), or a line that says so."""
    if hasattr(layout, "progress"):  # since 4.0
        layout.progress(factor=part, type="BAR", text=text)
    else:
        layout.label(text=f"{100 * part:.0f} %" + (f", {text}" if text else ""), icon="TIME")


def confirm(operator: Any, event: Any, message: str) -> Any:
    """Asks the user before an operator goes on: to be returned by its invoke()."""
    manager = bpy.context.window_manager
    try:
        return manager.invoke_confirm(operator, event, title=operator.bl_label, message=message)
    except TypeError:  # until 4.0 the question is the operator's name
        return manager.invoke_confirm(operator, event)


def set_polygon_sizes(mesh: Any, sizes: Any) -> None:
    """The number of corners of each face."""
    if not bpy.types.MeshPolygon.bl_rna.properties["loop_total"].is_readonly:  # it follows from loop_start since 4.0
        mesh.polygons.foreach_set("loop_total", sizes)
