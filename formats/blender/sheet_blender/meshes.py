# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames of runs and bodies as meshes, with their numbers as attributes."""
from __future__ import annotations

from typing import Any

import bpy
import numpy as np

from . import body_files, compat
from .compat import sheetstream


def fill_body(mesh: bpy.types.Mesh, body: body_files.Body, ahead: float, velocity_scale: float = 1.0) -> None:
    """Makes the mesh that of the body, gone on for the time `ahead` [s] with its velocity; its arrays are attributes of
    their names."""
    velocity = body.arrays.get("velocity", np.zeros_like(body.position))
    if len(mesh.vertices) != len(body.position) or not _has_triangles(mesh, body.triangle):
        _set_triangles(mesh, len(body.position), body.triangle)
    mesh.vertices.foreach_set("co", (body.position + ahead * velocity).astype(np.float32).ravel())
    for name, values in (body.arrays | {"velocity": velocity_scale * velocity}).items():
        set_attribute(mesh, name, "FLOAT_VECTOR" if values.ndim == 2 else "FLOAT", "POINT", values)
    mesh.update()


def fill_mesh(mesh: bpy.types.Mesh, frame: sheetstream.Frame, position: Any, velocity_scale: float = 1.0) -> None:
    """Makes the mesh that of the frame, with the attributes thickness, triangle_thickness, velocity, slab and touch."""
    corners = frame["triangle"]
    if len(mesh.vertices) != frame.vertices or not _has_triangles(mesh, corners):
        _set_triangles(mesh, frame.vertices, corners)
    mesh.vertices.foreach_set("co", position.astype(np.float32).ravel())
    thickness = frame.vertex_thickness()
    set_attribute(mesh, "thickness", "FLOAT", "POINT", thickness)
    set_attribute(mesh, "triangle_thickness", "FLOAT", "FACE", frame.thickness())
    set_attribute(mesh, "velocity", "FLOAT_VECTOR", "POINT", velocity_scale * frame.velocity())
    set_attribute(mesh, "slab", "FLOAT_VECTOR", "POINT", frame.vertex_normals() * (thickness / 2)[:, None])
    touch = (np.asarray(frame["touch"]).reshape(frame.vertices, -1) != 0).any(axis=1) if "touch" in frame else None
    set_attribute(mesh, "touch", "FLOAT", "POINT", np.zeros(frame.vertices) if touch is None else touch)
    mesh.update()


def set_slots(mesh: bpy.types.Mesh, liquid: Any) -> None:
    """Gives each face the material of its liquid; `liquid`: their numbers. They have the mesh's materials in turn."""
    slots = np.asarray(liquid).ravel() % max(len(mesh.materials), 1)
    mesh.polygons.foreach_set("material_index", slots.astype(np.int32))


def fill_balls(mesh: bpy.types.Mesh, position: Any, radius: Any, velocity: Any, ball: tuple[Any, Any]) -> None:
    """Makes the mesh a ball at each position, with the attribute velocity; ball: positions and triangles of one of
    radius 1 about 0."""
    vertices, triangles = ball
    corners = (triangles + len(vertices) * np.arange(len(radius))[:, None, None]).reshape(-1, 3)
    if not _has_triangles(mesh, corners):
        _set_triangles(mesh, len(radius) * len(vertices), corners)
    places = position[:, None] + radius[:, None, None] * vertices
    mesh.vertices.foreach_set("co", places.astype(np.float32).ravel())
    set_attribute(mesh, "velocity", "FLOAT_VECTOR", "POINT", np.repeat(velocity, len(vertices), axis=0))
    mesh.update()


def _has_triangles(mesh: bpy.types.Mesh, corners: Any) -> bool:
    if len(mesh.polygons) != len(corners) or len(mesh.loops) != corners.size:
        return False
    now = np.empty(corners.size, np.int32)
    mesh.loops.foreach_get("vertex_index", now)
    return np.array_equal(now, corners.ravel())


def _set_triangles(mesh: bpy.types.Mesh, vertices: int, corners: Any) -> None:
    mesh.clear_geometry()
    mesh.vertices.add(vertices)
    mesh.loops.add(corners.size)
    mesh.polygons.add(len(corners))
    mesh.loops.foreach_set("vertex_index", corners.astype(np.int32).ravel())
    mesh.polygons.foreach_set("loop_start", np.arange(0, corners.size, 3, dtype=np.int32))
    compat.set_polygon_sizes(mesh, np.full(len(corners), 3, np.int32))
    mesh.polygons.foreach_set("use_smooth", np.ones(len(corners), bool))
    mesh.update(calc_edges=True)


def set_attribute(mesh: bpy.types.Mesh, name: str, kind: str, domain: str, values: Any) -> None:
    attribute = mesh.attributes.get(name)
    if attribute is not None and (attribute.data_type, attribute.domain) != (kind, domain):
        mesh.attributes.remove(attribute)
        attribute = None
    if attribute is None:
        attribute = mesh.attributes.new(name, kind, domain)
    attribute.data.foreach_set("vector" if kind == "FLOAT_VECTOR" else "value", np.asarray(values, np.float32).ravel())
