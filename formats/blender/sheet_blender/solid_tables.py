# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids of a plan as tables of the scene's text, with their meshes and motions beside it."""
from __future__ import annotations

import pathlib
from typing import Any

import bpy
import numpy as np
from mathutils import Vector

from .errors import SheetError
from .evaluated import Triangles, surface_of, triangles_of
from .holds import quoted, row
from .movement import changes_shape, motion_of, moves, write_rows
from .plan import Plan, Written, plain
from .ply_file import write_ply

FLAT = 1e-5  # of its size: what leaves its plane by less is flat
SAME = 1e-6  # of its size: vertices so near lie at one place


def write_solid(file: pathlib.Path, solid: bpy.types.Object, contact: str, plan: Plan, written: Written) -> list[str]:
    """The table of a solid, whose mesh goes to `file`. What is flat becomes a plane without end, and that is told.
    Raises SheetError if its surface is open, or flat and moves."""
    files, told = written
    scene = bpy.context.scene
    with surface_of(solid) as mesh:
        shape = triangles_of(mesh, solid.matrix_world, scene.unit_settings.scale_length)
    lines = ["", f"[[solid]] # {quoted(solid.name)}"]
    rows = motion_of(solid, scene)
    place, normal = _plane_of(shape)
    if normal is None:
        write_ply(file, _closed(solid.name, shape), None, {}, {})
        files.append(str(file))
        lines += ['shape = "mesh"', f"file = {quoted(file.name)}"]
    elif moves(rows):
        raise SheetError(f'"{solid.name}" moves and is flat: give it a thickness (modifier Solidify)')
    else:
        normal = _towards(normal, place, plan)
        lines += ['shape = "plane"', f"center = {row(map(plain, place))}",
                  f"normal = {row(map(plain, np.round(normal, 7)))}"]
        told.append(f'"{solid.name}" is flat: the run takes it as a plane without end. For a plate with edges give it a'
                    " thickness (modifier Solidify)")
    if contact != "stick":
        lines.append(f'contact = "{contact}"')
    if changes_shape(solid, scene):
        told.append(f'"{solid.name}" changes its shape from frame to frame: solids move, but keep the shape of the'
                    " first frame")
    if moves(rows):
        file = file.with_suffix(".csv")
        write_rows(file, rows)
        files.append(str(file))
        lines += ["center = [0, 0, 0] # the mesh stands where it is at time 0",
                  "rotation = {axis = [0, 0, 1], angle = 0}",
                  f'motion = {{kind = "keyframed", file = {quoted(file.name)}}}']
    return lines


def _plane_of(shape: Triangles) -> tuple[Any, Any]:
    """A point of the plane in which all triangles lie, and its normal; None as normal if there is none."""
    x = shape.position[np.unique(shape.triangle)]
    middle = x.mean(axis=0)
    _, sizes, axes = np.linalg.svd(x - middle, full_matrices=False)
    return middle, axes[2] if sizes[2] <= FLAT * sizes[0] else None


def _towards(normal: Any, place: Any, plan: Plan) -> Any:
    """The normal or its opposite, to the side on which more of the sheets is."""
    length = bpy.context.scene.unit_settings.scale_length
    corners = [length * np.array(sheet.thing.matrix_world @ Vector(corner))
               for sheet in plan.sheets for corner in sheet.thing.bound_box]
    return normal if (np.mean(corners, axis=0) - place) @ normal >= 0 else -normal


def _closed(name: str, shape: Triangles) -> Triangles:
    """The surface; where it is open, with its vertices at one place made one, as filled curves have several. Raises
    SheetError if it stays open."""
    if not _open_edges(shape.triangle):
        return shape
    places = np.round(shape.position / (SAME * max(float(np.ptp(shape.position, axis=0).max()), 1e-30)))
    _, first, one = np.unique(places, axis=0, return_index=True, return_inverse=True)
    triangle = one.ravel()[shape.triangle]
    kept = (triangle != np.roll(triangle, 1, axis=1)).all(axis=1)
    if left := _open_edges(triangle[kept]):
        raise SheetError(f'"{name}" is open along {left} edges, and a solid needs a closed surface: give it a thickness'
                         " (modifier Solidify), or close it (Mesh > Clean Up > Fill Holes in Edit Mode)")
    return Triangles(shape.position[first], triangle[kept], shape.corner[kept], shape.face[kept])


def _open_edges(triangle: Any) -> int:
    """How many edges have only one triangle."""
    sides = np.concatenate([triangle[:, [i, (i + 1) % 3]] for i in range(3)])
    return int((np.unique(np.sort(sides, axis=1), axis=0, return_counts=True)[1] == 1).sum())
