# SPDX-License-Identifier: MIT
"""Runs as sequences: frames read from a file when they are asked for, curves over time as arrays."""
from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from typing import overload

import numpy as np
import numpy.typing as npt

from .quantities import QUANTITIES
from .stream import Array, Floats, Frame, Header, Reader, StreamError, Writer, find_value_error, BAD_INPUT

# Quantities that frames may have as an array, one number a triangle or vertex, and that sheet-info --csv sums up; not
# those that it reckons, of a liquid that is not Newtonian.
_RECKONED = ("thickness", "strain_rate", "viscosity")
_ARRAYS = tuple(name for name, quantity in QUANTITIES.items()
                if quantity.where != "frame" and f"{name}_mean" in QUANTITIES and name not in _RECKONED)

# Columns of Run.curves(), as sheet-info --csv calls them.
CURVES = ("time", "step", "vertices", "triangles", "area", "volume", "thickness_min", "thickness_mean", "thickness_max",
          "speed_max", "kinetic_energy", *(f"{name}_{kind}" for name in _ARRAYS for kind in ("min", "mean", "max")))


class Run(Sequence[Frame]):
    """The frames of a file, in order of time. Only headers are read at first; run[i], run[-1] and iteration read
    frames, run[2:5] is a list of them. Raises StreamError where the file is not what it should be.

    partial: take a stream that was cut short, or that is being written, as far as its frames are whole.
    """

    def __init__(self, path: str | os.PathLike[str], partial: bool = False) -> None:
        self.path = os.fspath(path)
        self.complete = True  # does the stream have its end mark?
        self._starts: list[int] = []
        self.headers: list[Header] = []
        with open(self.path, "rb") as file:
            try:
                for start, header in Reader(file, self.path).headers():
                    self._starts.append(start)
                    self.headers.append(header)
            except StreamError as error:
                if not partial or " cut short" not in str(error):
                    raise
                self.complete = False

    def __len__(self) -> int:
        return len(self.headers)

    @overload
    def __getitem__(self, index: int) -> Frame: ...

    @overload
    def __getitem__(self, index: slice) -> list[Frame]: ...

    def __getitem__(self, index: int | slice) -> Frame | list[Frame]:
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        number = index + len(self) if index < 0 else index
        if not 0 <= number < len(self):
            raise IndexError(f"{self.path}: frame {index} of {len(self)}")
        with open(self.path, "rb") as file:
            return Reader(file, self.path).read_at(number, self._starts[number])

    def __iter__(self) -> Iterator[Frame]:
        with open(self.path, "rb") as file:
            reader = Reader(file, self.path)
            for number, start in enumerate(self._starts):
                yield reader.read_at(number, start)

    def __repr__(self) -> str:
        span = f", {self.times[0]:g} to {self.times[-1]:g} s" if self.headers else ""
        return f"<Run {self.path}: {len(self)} frames{span}{'' if self.complete else ', cut short'}>"

    @property
    def times(self) -> Floats:
        """Time of each frame [s]."""
        return np.array([header.time for header in self.headers])

    @property
    def steps(self) -> npt.NDArray[np.int64]:
        """Step of each frame."""
        return np.array([header.step for header in self.headers], np.int64)

    def at(self, time: float) -> Frame:
        """The last frame that is not later than a time [s]; the first if all are."""
        return self[max(0, int(np.searchsorted(self.times, time, "right")) - 1)]

    def curves(self, density: float | None = None) -> dict[str, Floats]:
        """What CURVES names, over the frames, in SI units: arrays with an entry for each frame. The mean thickness is
        the whole sheet's, volume by area. Kinetic energy needs the density [kg/m^3], by default the scene's; else it is
        nan. Of arrays that the first frame does not have, such as temperature, there are none.
        """
        rows = [_measure(frame, density) for frame in self]
        absent = [name for name in _ARRAYS if len(self) and name not in self[0]]
        return {name: np.array([row[i] for row in rows], float) for i, name in enumerate(CURVES)
                if name.rpartition("_")[0] not in absent}


def _measure(frame: Frame, density: float | None) -> tuple[float, ...]:
    """A row of CURVES."""
    area, volume = frame.area(), frame["volume"]
    thickness = volume / area if len(volume) else np.full(1, np.nan)
    speed = np.linalg.norm(frame.velocity(), axis=1)
    total, surface = float(volume.sum()), float(area.sum())
    return (frame.time, frame.step, frame.vertices, frame.triangles, surface, total, thickness.min(),
            total / surface if surface > 0 else np.nan, thickness.max(), speed.max(initial=0),
            frame.kinetic_energy(density), *(x for name in _ARRAYS for x in _range(frame, name, area)))


def _range(frame: Frame, name: str, area: Floats) -> tuple[float, float, float]:
    """Least value, mean by area, greatest value of an array; nan if the frame does not have it."""
    if name not in frame or not frame.triangles:
        return (np.nan, np.nan, np.nan)
    values = np.asarray(frame[name], float)
    by_triangle = values if QUANTITIES[name].where == "triangle" else values[frame["triangle"]].mean(axis=1)
    return (values.min(), float((area * by_triangle).sum() / area.sum()), values.max())


def make_frame(position: npt.ArrayLike, triangle: npt.ArrayLike, thickness: npt.ArrayLike, time: float = 0.0,
               step: int = 0) -> Frame:
    """A frame of vertices (n, 3) [m], triangles (m, 3) and thickness [m], one or one a triangle. Raises StreamError.

    >>> make_frame([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], 0.01)["volume"].tolist()
    [0.005]
    >>> make_frame([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 3]], 0.01)
    Traceback (most recent call last):
    sheetstream.stream.StreamError: cannot make frame: array "triangle": triangle 0 names vertex 3, the frame has 3
    """
    x, corners = np.array(position, np.float64), np.array(triangle)
    for name, array in (("position", x), ("triangle", corners)):
        if array.ndim != 2 or array.shape[1] != 3:
            raise StreamError(BAD_INPUT, f"cannot make frame: {name} has shape {array.shape}, it must be (any, 3)")
    if corners.size and (corners.dtype.kind not in "iu" or corners.min() < 0 or corners.max() >= 1 << 32):
        raise StreamError(BAD_INPUT, "cannot make frame: triangle must have integers from 0 to 2^32 - 1")
    h = np.asarray(thickness, np.float64)
    if h.shape not in ((), (1,), (len(corners),)):
        raise StreamError(BAD_INPUT, f"cannot make frame: thickness has shape {h.shape}, it must be one number, or one"
                                     f" for each of {len(corners)} triangles (where vertices have it:"
                                     " thickness[triangle].mean(axis=1))")
    frame = Frame(time, step, {"position": Array(x, "vertex", "m", "interpolate"),
                               "triangle": Array(corners.astype(np.uint32), "triangle", "1", "drop"),
                               "volume": Array(np.ones(len(corners)), "triangle", "m^3", "conserve")})
    error = find_value_error(frame)
    if not error:
        h = np.broadcast_to(h, len(corners))
        error = _find_flat_error(frame.area(), h)
    if not error:
        frame["volume"] = h * frame.area()
        error = find_value_error(frame)
    if error:
        raise StreamError(BAD_INPUT, f"cannot make frame: {error}")
    return frame


def _find_flat_error(area: Floats, thickness: Floats) -> str:
    """Which triangle can have no volume, and why; "" if all can."""
    for triangle in np.flatnonzero(~(thickness > 0))[:1]:
        return f"the thickness of triangle {triangle} is {thickness[triangle]:g} m, it must be positive"
    for triangle in np.flatnonzero(~(area > 0))[:1]:
        return f"triangle {triangle} has no area: its corners lie on a line; leave it out, or move one"
    return ""


def write(path: str | os.PathLike[str], frames: Iterable[Frame]) -> None:
    """Writes frames to a file, with an end mark; if something fails, without one. Raises StreamError for a bad
    frame."""
    with open(path, "wb") as file:
        writer = Writer(file)
        for number, frame in enumerate(frames):
            error = find_value_error(frame)
            if error:
                raise StreamError(BAD_INPUT, f"{os.fspath(path)}: frame {number} would be wrong: {error}")
            writer.write(frame)
        writer.end()
