# SPDX-License-Identifier: MIT
"""Lets meshio read and write streams (.sheet): importing this module registers the format.

meshio knows one mesh a file: reading takes the last frame, or that of a number (read(file, frame=0)); vectors and
numbers at vertices and triangles come along, thickness [m] with them; time and step are field data. Writing takes
triangles and their thickness or volume.

>>> import meshio, sheetstream.meshio
>>> points = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
>>> meshio.write("a.sheet", meshio.Mesh(points, {"triangle": [[0, 1, 2]]}, cell_data={"thickness": [[0.002]]}))
>>> mesh = meshio.read("a.sheet")
>>> mesh.cell_data["volume"][0].tolist(), mesh.cell_data["thickness"][0].tolist()
([0.001], [0.002])
"""
from __future__ import annotations

import os
from typing import Any, BinaryIO, Union

import meshio
import numpy as np

from .run import Run, make_frame, write as write_run
from .stream import Array, Frame, Reader, StreamError, Writer

File = Union[str, os.PathLike, BinaryIO]


def to_mesh(frame: Frame) -> Any:
    """The frame as a meshio.Mesh."""
    data: dict[str, dict[str, Any]] = {"vertex": {}, "triangle": {"thickness": frame.thickness()}}
    for name, array in frame.arrays.items():
        if array.place in data and name not in ("position", "triangle"):
            data[array.place][name] = array.values
    return meshio.Mesh(frame["position"], {"triangle": frame["triangle"].astype(np.int64)}, point_data=data["vertex"],
                       cell_data={name: [values] for name, values in data["triangle"].items()},
                       field_data={"time": np.array([frame.time]), "step": np.array([frame.step])})


def from_mesh(mesh: Any) -> Frame:
    """The triangles of a meshio.Mesh as a frame; raises StreamError."""
    numbers = [i for i, block in enumerate(mesh.cells) if block.type == "triangle"]
    if len(numbers) < len(mesh.cells) or not numbers:
        kinds = ", ".join(sorted({block.type for block in mesh.cells})) or "no cells"
        raise StreamError(3, f"a sheet has triangles only, the mesh has {kinds}")
    corners = np.concatenate([mesh.cells[i].data for i in numbers])
    data = {name: np.concatenate([np.ravel(values[i]) for i in numbers]) for name, values in mesh.cell_data.items()
            if name in ("thickness", "volume")}
    if not data:
        raise StreamError(3, 'the mesh needs cell data "thickness" [m] or "volume" [m^3]')
    points = np.zeros((len(mesh.points), 3))
    points[:, :np.shape(mesh.points)[1]] = mesh.points
    frame = make_frame(points, corners, data.get("thickness", 1.0),
                       float(np.ravel(mesh.field_data.get("time", 0.0))[0]),
                       int(np.ravel(mesh.field_data.get("step", 0))[0]))
    if "volume" in data:
        frame["volume"] = data["volume"].astype(float)
    if "velocity" in mesh.point_data:
        frame.arrays["velocity"] = Array(np.array(mesh.point_data["velocity"], float), "vertex", "m/s", "interpolate")
    return frame


def read(file: File, frame: int = -1) -> Any:
    """A frame of a stream, by default the last, as a meshio.Mesh."""
    try:
        if isinstance(file, (str, os.PathLike)):
            return to_mesh(Run(file)[frame])
        return to_mesh(list(Reader(file))[frame])
    except (StreamError, IndexError) as error:
        raise meshio.ReadError(str(error)) from error


def write(file: File, mesh: Any) -> None:
    """Writes a stream of one frame."""
    try:
        made = from_mesh(mesh)
        if isinstance(file, (str, os.PathLike)):
            write_run(file, [made])
            return
        writer = Writer(file)
        writer.write(made)
        writer.end()
    except StreamError as error:
        raise meshio.WriteError(str(error)) from error


meshio.register_format("sheet", [".sheet"], read, {"sheet": write})
