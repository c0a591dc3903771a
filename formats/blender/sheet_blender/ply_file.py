# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles with their arrays as binary PLY, which sheet-init reads."""
from __future__ import annotations

import pathlib
from typing import Any

import numpy as np

from .evaluated import Thickness, Triangles


def _ply_columns(arrays: dict[str, Any]) -> list[tuple[str, str, Any]]:
    """Properties of PLY, by name, type and values: name, or name_0, name_1, ... of several components."""
    columns = []
    for name, values in arrays.items():
        kind = "uchar" if values.dtype == np.uint8 else "int" if values.dtype.kind == "i" else "double"
        parts = [(name, values)] if values.ndim == 1 else \
            [(f"{name}_{k}", values[:, k]) for k in range(values.shape[1])]
        columns += [(part, kind, column) for part, column in parts]
    return columns


def write_ply(path: pathlib.Path, shape: Triangles, thickness: Thickness | None, at_vertices: dict[str, Any],
              at_triangles: dict[str, Any]) -> None:
    """One object's triangles and their vertices, with thickness at vertices or triangles, and other arrays."""
    if thickness is not None:
        (at_vertices if thickness.place == "vertex" else at_triangles)["thickness"] = thickness.values
    used, corners = np.unique(shape.triangle, return_inverse=True)
    numpy_types = {"uchar": "u1", "int": "<i4", "double": "<f8"}
    of_vertex, of_face = _ply_columns(at_vertices), _ply_columns(at_triangles)
    vertex = np.zeros(len(used), [("x", "<f8", 3), *((n, numpy_types[k]) for n, k, _ in of_vertex)])
    face = np.zeros(len(shape.triangle), [("count", "u1"), ("corners", "<i4", 3),
                                          *((n, numpy_types[k]) for n, k, _ in of_face)])
    vertex["x"], face["count"], face["corners"] = shape.position[used], 3, corners.reshape(-1, 3)
    for name, _, values in of_vertex:
        vertex[name] = values[used]
    for name, _, values in of_face:
        face[name] = values
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertex)}",
              *(f"property double {axis}" for axis in "xyz"), *(f"property {k} {n}" for n, k, _ in of_vertex),
              f"element face {len(face)}", "property list uchar int vertex_indices",
              *(f"property {k} {n}" for n, k, _ in of_face), "end_header\n"]
    path.write_bytes("\n".join(header).encode() + vertex.tobytes() + face.tobytes())
