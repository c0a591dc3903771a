# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbered PLY files of a run, as `sheet-export --union` writes them: which there are, when each is, what it holds.

Needs numpy alone.
"""
from __future__ import annotations

import pathlib
import re
from typing import Any, NamedTuple

import numpy as np

LONGEST_HEADER = 1 << 16  # [bytes]
NUMBER_TYPES = {"char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "<i2", "int16": "<i2",
                "ushort": "<u2", "uint16": "<u2", "int": "<i4", "int32": "<i4", "uint": "<u4", "uint32": "<u4",
                "float": "<f4", "float32": "<f4", "double": "<f8", "float64": "<f8"}


class BodyError(Exception):
    """What is wrong with a file, for the user."""


class Body(NamedTuple):
    """A mesh of triangles: position (n x 3) [m], triangle (m x 3), and arrays at vertices (n, or n x 3) by name."""
    position: Any
    triangle: Any
    arrays: dict[str, Any]


class _Header(NamedTuple):
    size: int  # [bytes]
    time: float | None  # [s]
    vertices: int
    triangles: int
    vertex: Any  # numpy's types of their rows
    triangle: Any
    corners: str  # the name of the list in a triangle's row


def _read_header(path: pathlib.Path) -> _Header:
    with open(path, "rb") as file:
        head = file.read(LONGEST_HEADER)
    end = head.find(b"end_header\n")
    if not head.startswith(b"ply\n") or end < 0:
        raise BodyError(f"{path}: this is no PLY file: write it by sheet-export --union")
    if b"format binary_little_endian 1.0\n" not in head[:end]:
        raise BodyError(f"{path}: it is not binary_little_endian 1.0: write it by sheet-export --union")
    try:
        return _parsed(head[:end].decode("ascii", "replace").splitlines(), end + len(b"end_header\n"))
    except (IndexError, KeyError, ValueError):  # a type that is none, no number where one belongs, a name twice
        raise BodyError(f"{path}: its header is not that of a mesh of triangles: write it by sheet-export --union"
                        ) from None


def _parsed(lines: list[str], size: int) -> _Header:
    counts, rows, time, corners, element = {"vertex": 0, "face": 0}, {"vertex": [], "face": []}, None, "", ""
    for line in lines:
        words = line.split()
        if words[:2] == ["comment", "time"] and len(words) == 3:
            time = float(words[2])
        elif words[:1] == ["element"] and len(words) == 3:
            element = words[1]
            counts[element] = int(words[2])
        elif words[:1] == ["property"] and element in rows:
            if words[1] == "list" and element == "face":
                corners = words[4]
                rows[element] += [("", NUMBER_TYPES[words[2]]), (corners, NUMBER_TYPES[words[3]], 3)]
            else:
                rows[element].append((words[2], NUMBER_TYPES[words[1]]))
    if set(counts) != {"vertex", "face"} or not corners or not {"x", "y", "z"} <= {row[0] for row in rows["vertex"]}:
        raise ValueError
    return _Header(size, time, counts["vertex"], counts["face"], np.dtype(rows["vertex"]), np.dtype(rows["face"]),
                   corners)


def _arrays(rows: Any) -> dict[str, Any]:
    """The columns of a table, those that end in _x, _y, _z as one of vectors."""
    names = [name for name in rows.dtype.names if name not in ("x", "y", "z")]
    vectors = {name[:-2] for name in names if all(name[:-2] + end in names for end in ("_x", "_y", "_z"))}
    result = {name: np.stack([rows[name + end] for end in ("_x", "_y", "_z")], axis=1) for name in sorted(vectors)}
    return result | {name: rows[name] for name in names if name[:-2] not in vectors}


def read_body(path: pathlib.Path) -> Body:
    """The mesh of a file. Raises BodyError, OSError."""
    header = _read_header(path)
    with open(path, "rb") as file:
        file.seek(header.size)
        vertices = np.fromfile(file, header.vertex, header.vertices)
        triangles = np.fromfile(file, header.triangle, header.triangles)
    if len(vertices) < header.vertices or len(triangles) < header.triangles:
        raise BodyError(f"{path}: the file ends before its header says so: write it anew")
    corners = triangles[header.corners].astype(np.int32)
    if len(corners) and ((triangles[triangles.dtype.names[0]] != 3).any() or corners.min() < 0 or
                         corners.max() >= header.vertices):
        raise BodyError(f"{path}: it has other faces than triangles of its vertices: write it by sheet-export --union")
    return Body(np.stack([vertices[axis] for axis in "xyz"], axis=1), corners, _arrays(vertices))


class BodySequence:
    """All files whose names differ from the given one in their last number alone, in the order of their numbers.

    times [s]: what the files say, or if one says nothing, `rate` files a second.
    """

    def __init__(self, path: pathlib.Path, rate: float) -> None:
        self.path = path
        last = re.search(r"\d+(?=\D*$)", path.name)
        if last is None:
            self.files = [path]
        else:
            pattern = re.compile(re.escape(path.name[:last.start()]) + r"(\d+)" + re.escape(path.name[last.end():]))
            found = [(int(match[1]), other) for other in path.parent.iterdir()
                     if (match := pattern.fullmatch(other.name))]
            self.files = [other for _, other in sorted(found)]
        if not self.files:
            raise BodyError(f"{path}: there is no such file")
        said = [_read_header(file).time for file in self.files]
        self.times = np.arange(len(said)) / rate if None in said else np.array(said, float)
        if (np.diff(self.times) <= 0).any():
            late = int(np.flatnonzero(np.diff(self.times) <= 0)[0]) + 1
            raise BodyError(f"{self.files[late]}: its time is not after that of the file before it: the files are of "
                            "several runs; give each run a folder of its own")

    def __len__(self) -> int:
        return len(self.files)

    def __getitem__(self, index: int) -> Body:
        return read_body(self.files[index])
