# SPDX-License-Identifier: MIT
"""The sheet stream as formats/sheet.md specifies it: frames and their arrays, a reader that trusts nothing, a writer,
and stages of one's own."""
from __future__ import annotations

import contextlib
import math
import os
import signal
import struct
import sys
import time
from collections.abc import Iterable, Iterator
from typing import Any, BinaryIO, NamedTuple, NoReturn, Union

import numpy as np
import numpy.typing as npt

from .checksum import checksum as _checksum

Values = Union[npt.NDArray[Any], str]
Floats = npt.NDArray[np.float64]

PLACES = ("vertex", "triangle", "edge", "frame")
TYPES = ("", "int8", "uint8", "int32", "uint32", "int64", "uint64", "float32", "float64", "text")
SIZES = (0, 1, 1, 4, 4, 8, 8, 4, 8, 1)
TRANSFERS = ("drop", "copy", "interpolate", "conserve", "common", "mean")

# Exit codes of all programs of Sheet.
USAGE, BAD_INPUT, CORRUPT, IO = 2, 3, 4, 6

_HEADER = struct.Struct("<8sHHIQQQQdQIIQ40sQ")
_ENTRY = struct.Struct("<48s24sBBBBIQQQQ16s")
_END = struct.Struct("<8sHHIQ32sQ")
_MAJOR, _MINOR = 1, 0
_MAX_ARRAYS, _MAX_ROWS, _MAX_BYTES = 4096, 1 << 32, 1 << 48
_FIRST_PORTION = 16 << 20  # memory asked for before the bytes have really arrived
_NAME_CHARACTERS = frozenset("abcdefghijklmnopqrstuvwxyz0123456789_.:-")

# name: place, type, components (0: any number), unit, rule; the first three are required
_STANDARD = {
    "position": ("vertex", "float64", 3, "m", "interpolate"),
    "triangle": ("triangle", "uint32", 3, "1", "drop"),
    "volume": ("triangle", "float64", 1, "m^3", "conserve"),
    "velocity": ("vertex", "float64", 3, "m/s", "interpolate"),
    "liquid": ("triangle", "uint32", 1, "1", "copy"),
    "sheet": ("triangle", "uint32", 1, "1", "copy"),
    "temperature": ("triangle", "float64", 1, "K", "mean"),
    "temperature_rate": ("triangle", "float64", 1, "K/s", "mean"),
    "temperature_mode": ("triangle", "float64", 0, "K", "mean"),
    "temperature_mode_rate": ("triangle", "float64", 0, "K/s", "mean"),
    "start_position": ("vertex", "float64", 3, "m", "drop"),
    "start_time": ("frame", "float64", 1, "s", "copy"),
    "hold": ("vertex", "uint64", 1, "1", "common"),
    "director_angle": ("edge", "float64", 1, "rad", "drop"),
    "next_output_time": ("frame", "float64", 1, "s", "copy"),
    "step_size": ("frame", "float64", 1, "s", "copy"),
    "touch": ("vertex", "uint64", 0, "1", "common"),
    "hold_force": ("vertex", "float64", 3, "N", "conserve"),
    "touch_force": ("vertex", "float64", 3, "N", "conserve"),
    "touch_load": ("vertex", "float64", 3, "N", "conserve"),
    "solid_force": ("frame", "float64", 3, "N", "copy"),
    "touch_overshoot": ("vertex", "float64", 3, "m", "interpolate"),
    "touch_overshoot_time": ("vertex", "float64", 1, "s", "interpolate"),
    "inlet": ("vertex", "uint64", 1, "1", "common"),
    "inlet_origin": ("vertex", "float64", 3, "m", "interpolate"),
    "swept_volume": ("vertex", "float64", 1, "m^3", "conserve"),
    "contact_vertex": ("frame", "uint32", 4, "1", "drop"),
    "contact_weight": ("frame", "float64", 4, "1", "drop"),
    "contact_normal": ("frame", "float64", 3, "1", "drop"),
    "contact_rest": ("frame", "float64", 1, "m", "drop"),
    "contact_anchor": ("frame", "float64", 3, "m", "drop"),
    "contact_stiffness": ("frame", "float64", 2, "N/m", "drop"),
    "contact_since": ("frame", "float64", 1, "s", "drop"),
    "drop_position": ("frame", "float64", 3, "m", "copy"),
    "drop_velocity": ("frame", "float64", 3, "m/s", "copy"),
    "drop_volume": ("frame", "float64", 1, "m^3", "copy"),
    "drop_liquid": ("frame", "uint32", 1, "1", "copy"),
    "drop_temperature": ("frame", "float64", 1, "K", "copy"),
    "drop_touch": ("frame", "uint32", 1, "1", "copy"),
    "drop_start_position": ("frame", "float64", 3, "m", "drop"),
    "health": ("frame", "float64", 12, "1", "copy"),
    "scene": ("frame", "text", 1, "1", "copy"),
    "provenance": ("frame", "text", 1, "1", "copy"),
}


class StreamError(Exception):
    """A stream that is cut short or damaged (exit_code CORRUPT) or says something impossible (BAD_INPUT)."""

    def __init__(self, exit_code: int, message: str) -> None:
        super().__init__(message)
        self.exit_code = exit_code


class Array:
    """Values (a numpy array with a row for each vertex, ..., or a str at place frame) and what they are."""

    def __init__(self, values: npt.ArrayLike, place: str = "vertex", unit: str = "1", transfer: str = "copy",
                 critical: bool = False) -> None:
        self.values: Values = values if isinstance(values, str) else np.asarray(values)
        self.place, self.unit, self.transfer, self.critical = place, unit, transfer, critical

    @property
    def type(self) -> str:
        return "text" if isinstance(self.values, str) else self.values.dtype.name

    @property
    def components(self) -> int:
        return 1 if isinstance(self.values, str) or self.values.ndim < 2 else math.prod(self.values.shape[1:])

    @property
    def rows(self) -> int:
        if isinstance(self.values, str):
            return len(self.values.encode())
        return self.values.shape[0] if self.values.ndim else 1

    def data(self) -> bytes | memoryview:
        """The payload without its padding."""
        if isinstance(self.values, str):
            return self.values.encode()
        return np.ascontiguousarray(self.values, self.values.dtype.newbyteorder("<")).reshape(-1).view(np.uint8).data


class Frame:
    """Time [s], step, and the arrays by name, in the order of the stream. frame[name] are the array's values."""

    def __init__(self, time: float = 0.0, step: int = 0, arrays: dict[str, Array] | None = None, vertices: int = 0,
                 triangles: int = 0, edges: int = 0) -> None:
        self.time, self.step = time, step
        self.arrays: dict[str, Array] = {} if arrays is None else arrays
        self._counts = {"vertex": vertices, "triangle": triangles, "edge": edges}

    def __getitem__(self, name: str) -> Any:
        return self.arrays[name].values

    def __setitem__(self, name: str, values: Values) -> None:
        self.arrays[name].values = values

    def __contains__(self, name: str) -> bool:
        return name in self.arrays

    def count(self, place: str) -> int:
        """Number of vertices, triangles or edges: the rows of the arrays there."""
        return next((a.rows for a in self.arrays.values() if a.place == place), self._counts[place])

    @property
    def vertices(self) -> int:
        """Number of vertices."""
        return self.count("vertex")

    @property
    def triangles(self) -> int:
        """Number of triangles."""
        return self.count("triangle")

    @property
    def edges(self) -> int:
        """Number of edges, if the frame has arrays at place edge; else 0."""
        return self.count("edge")

    def _area_vectors(self) -> Floats:
        a, b, c = (self["position"][self["triangle"][:, i]] for i in range(3))
        return 0.5 * np.cross(b - a, c - a)

    def area(self) -> Floats:
        """Area of each triangle [m^2]."""
        return np.linalg.norm(self._area_vectors(), axis=1)

    def thickness(self) -> Floats:
        """Thickness of each triangle [m]: volume / area."""
        return np.asarray(self["volume"] / self.area())

    def vertex_thickness(self) -> Floats:
        """Thickness at each vertex [m]: all volume around it over all area around it; 0 where no triangle is."""
        volume, area = self._to_vertices(self["volume"]), self._to_vertices(self.area())
        return np.divide(volume, area, out=np.zeros(self.vertices), where=area > 0)

    def vertex_normals(self) -> Floats:
        """Unit normal at each vertex, towards the positive side: the mean of the triangles' around, by area; 0
        without."""
        vectors = self._area_vectors()
        total = np.stack([self._to_vertices(vectors[:, i]) for i in range(3)], axis=1)
        length = np.linalg.norm(total, axis=1, keepdims=True)
        return np.divide(total, length, out=np.zeros_like(total), where=length > 0)

    def velocity(self) -> Floats:
        """Velocity of each vertex [m/s]: the array of that name, 0 where the frame has none."""
        return np.asarray(self["velocity"]) if "velocity" in self else np.zeros((self.vertices, 3))

    def kinetic_energy(self, density: float | None = None) -> float:
        """Kinetic energy [J], with the density [kg/m^3] of the frame's scene or another; nan where none is known."""
        if density is None:
            known = self.scene().get("material", {}).get("density", math.nan)
            density = float(known)
        u2 = (self.velocity()**2).sum(axis=1)
        return float(density / 6 * (self["volume"] * u2[self["triangle"]].sum(axis=1)).sum())

    def scene(self) -> dict[str, Any]:
        """The frame's scene as nested dictionaries; empty if it has none. Needs Python 3.11 or the package tomli."""
        try:
            import tomllib
        except ImportError:  # until Python 3.10
            import tomli as tomllib
        return tomllib.loads(self["scene"]) if "scene" in self else {}

    def _to_vertices(self, values: npt.NDArray[Any]) -> Floats:
        """Sums values of triangles at their vertices."""
        return np.bincount(self["triangle"].reshape(-1), np.repeat(values, 3), self.vertices).astype(float)

    def record(self, command: str) -> None:
        """Counts the command in the array "provenance": where it stands, or on a new line."""
        text = self["provenance"].lstrip("\n") if "provenance" in self else ""
        lines = text.removesuffix("\n").split("\n") if text else []
        for i, line in enumerate(lines):
            count, _, rest = line.partition(" ")
            if rest == command:
                lines[i] = f"{int(count) + 1 if count.isdecimal() else 1} {command}"
                break
        else:
            lines.append(f"1 {command}")
        self.arrays["provenance"] = Array("\n".join(lines), "frame")


def _what_else(head: bytes, first: bool) -> str:
    """What stands where a frame should: `head` is its first bytes, `first` whether nothing was before."""
    for beginning, program in ((b"\x28\xb5\x2f\xfd", "zstd"), (b"\x1f\x8b", "gzip"), (b"\xfd7zXZ\0", "xz"),
                               (b"BZh", "bzip2")):
        if head.startswith(beginning):
            return f"this is {program}-compressed: read it through {program} -dc"
    if head.startswith(b"sheet-text"):
        return "this is the text form: read it through sheet-parse"
    text = all(c >= 32 or 9 <= c <= 13 for c in head)
    return ("not a sheet stream: a frame starts with SHEETFRM" +
            ("; this is text: of a scene, sheet-init makes the first frame" if first and text else ""))


def _padded(size: int) -> int:
    return (size + 63) // 64 * 64


def _is_name(name: str) -> bool:
    return 0 < len(name) < 48 and _NAME_CHARACTERS.issuperset(name)


def _is_unit(unit: str) -> bool:
    return 0 < len(unit) < 24 and all(" " < c < "\x7f" for c in unit)


# Each says what is wrong; None if nothing is. The messages are those of the C++ reader.


def _find_header_error(arrays: int, counts: Iterable[int], when: float) -> str | None:
    if arrays > _MAX_ARRAYS:
        return f"{arrays} arrays are more than the {_MAX_ARRAYS} that a frame may have"
    for rows in counts:
        if rows > _MAX_ROWS:
            return f"{rows} vertices, triangles or edges are more than 2^32"
    if not math.isfinite(when):
        return "the time is not finite"
    return None


def _find_entry_error(name: str, unit: str, place: str, kind: str, transfer: str, components: int, rows: int,
                      expected_rows: int | None) -> str | None:
    floating = kind in ("float32", "float64")
    if not _is_name(name):
        return "its name is not 1 to 47 characters of [a-z0-9_.:-]"
    if not _is_unit(unit):
        return 'its unit is not 1 to 23 printable characters without blanks ("1" for none)'
    if components == 0:
        return "it has no components"
    if kind == "text" and (place != "frame" or components != 1):
        return "text belongs to the frame, with one component"
    if transfer == "common" and (floating or kind == "text"):
        return 'transfer "common" is for integers'
    if transfer in ("interpolate", "conserve", "mean") and not floating:
        return f'transfer "{transfer}" is for floating point'
    if transfer == "mean" and place != "triangle":
        return 'transfer "mean" is for triangles, which have a volume'
    if place != "frame" and rows != expected_rows:
        return f"it has {rows} rows, the frame has {expected_rows} at place {place}"
    return None


def _find_text_error(data: bytes | bytearray) -> str | None:
    at = data.find(0)
    if at >= 0:
        return f"its byte {at} is zero, text has none"
    try:
        data.decode()
    except UnicodeDecodeError as error:
        return f"its byte {error.start} is not UTF-8"
    return None


def find_form_error(frame: Frame) -> str | None:
    """Says what is wrong with names, places, types and sizes; None if nothing is."""
    counts = {place: frame.count(place) for place in PLACES[:3]}
    error = _find_header_error(len(frame.arrays), counts.values(), frame.time)
    if error:
        return error
    for name, a in frame.arrays.items():
        if a.type not in TYPES or a.place not in PLACES or a.transfer not in TRANSFERS:
            return f'array "{name}": {a.type}, {a.place} or {a.transfer} is no type, place or transfer rule'
        error = _find_entry_error(name, a.unit, a.place, a.type, a.transfer, a.components, a.rows, counts.get(a.place))
        error = error or (_find_text_error(bytes(a.data())) if a.type == "text" else None)
        if error:
            return f'array "{name}": {error}'
    return _find_edge_error(frame.arrays, counts["edge"])


def _find_edge_error(arrays: dict[str, Array], edges: int) -> str | None:
    if edges and all(a.place != "edge" for a in arrays.values()):
        return f"the frame counts {edges} edges but has no array at place edge"
    return None


def _find_contact_error(frame: Frame, vertices: npt.NDArray[Any]) -> str | None:
    bad = vertices.reshape(-1) >= frame.vertices
    if bad.any():
        i = int(bad.argmax())
        return (f'array "contact_vertex": contact {i // 4} names vertex {vertices.flat[i]}, '
                f"the frame has {frame.vertices}")
    for other in ("weight", "normal", "rest", "anchor", "stiffness"):
        if f"contact_{other}" not in frame.arrays:
            return f'array "contact_{other}" is missing beside "contact_vertex"'
    return None


def _rows_wanted(frame: Frame, name: str) -> int:
    for kind, leader in (("contact_", "contact_vertex"), ("drop_", "drop_volume")):
        if name.startswith(kind):
            return frame.arrays[leader].rows if leader in frame.arrays else 0
    return 1


def _find_standard_error(frame: Frame, name: str, array: Array) -> str | None:
    place, kind, components, unit, transfer = _STANDARD[name]
    components = components or array.components
    if (array.place, array.type, array.components) != (place, kind, components):
        return (f'array "{name}" is {array.place} {array.type} x {array.components}, '
                f"it must be {place} {kind} x {components}")
    if array.unit != unit:
        return f'array "{name}" has unit "{array.unit}", it must be "{unit}"'
    if array.transfer != transfer:
        return f'array "{name}" has transfer "{array.transfer}", it must be "{transfer}"'
    values: Any = array.values
    if name == "triangle":
        outside = values >= frame.vertices
        bad = outside.any(axis=1) | (values == np.roll(values, 1, axis=1)).any(axis=1)
        if not bad.any():
            return None
        i = int(bad.argmax())
        t = values[i]
        if outside[i].any():
            return (f'array "triangle": triangle {i} names vertex {t[outside[i].argmax()]}, '
                    f"the frame has {frame.vertices}")
        return f'array "triangle": triangle {i} names vertex {t[0] if t[0] == t[1] else t[2]} twice'
    if place == "frame" and kind != "text":
        rows = _rows_wanted(frame, name)
        if array.rows != rows and name not in ("health", "solid_force"):
            return f'array "{name}" has {array.rows} rows, it must have {rows}'
    if name.startswith("drop_"):
        for other in ("drop_position", "drop_volume"):
            if other not in frame.arrays:
                return f'array "{other}" is missing beside "{name}"'
    if name == "contact_vertex":
        return _find_contact_error(frame, values)
    if kind != "float64":
        return None
    if name == "contact_since":
        dates = values.reshape(-1) < np.inf
        return None if dates.all() else f'array "{name}": row {dates.argmin()} is neither finite nor -inf'
    finite = np.isfinite(values).reshape(array.rows, -1).all(axis=1) if array.rows else np.ones(0, bool)
    if not finite.all():
        return f'array "{name}": row {finite.argmin()} is not finite'
    if name == "volume" and not (values > 0).all():
        i = int((values > 0).argmin())
        return f'array "volume": triangle {i} has volume {_number(values.flat[i])} m^3, it must be positive'
    if name == "temperature" and not (values > 0).all():
        i = int((values > 0).argmin())
        return f'array "temperature": triangle {i} has {_number(values.flat[i])} K, it must be above 0'
    if name == "drop_volume" and not (values > 0).all():
        i = int((values > 0).argmin())
        return f'array "drop_volume": drop {i} has volume {_number(values.flat[i])} m^3, it must be positive'
    if name == "drop_temperature" and not (values > 0).all():
        i = int((values > 0).argmin())
        return f'array "drop_temperature": drop {i} has {_number(values.flat[i])} K, it must be above 0'
    if name == "step_size" and not values.flat[0] > 0:
        return f'array "step_size" is {_number(values.flat[0])} s, it must be positive'
    return None


def find_value_error(frame: Frame) -> str | None:
    """Says which standard array breaks its rule; None if none does."""
    for name in ("position", "triangle", "volume"):
        if name not in frame:
            return f'array "{name}" is missing'
    for name, array in frame.arrays.items():
        error = _find_standard_error(frame, name, array) if name in _STANDARD else None
        if error:
            return error
    if frame.edges:
        t = frame["triangle"]
        sides = np.sort(np.concatenate((t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]])), axis=1).astype(np.uint64)
        edges = np.unique(sides[:, 0] << np.uint64(32) | sides[:, 1]).size
        if edges != frame.edges:
            return f"the frame counts {frame.edges} edges, its triangles have {edges}"
    return None


class Header(NamedTuple):
    """What the header of a frame says."""

    minor: int
    size: int  # of the whole frame [bytes]
    vertices: int
    triangles: int
    edges: int
    time: float  # [s]
    step: int
    arrays: int
    table_checksum: int


class _Payload(NamedTuple):
    type: str
    components: int
    rows: int
    bytes: int
    checksum: int


class Reader:
    """Iterates over the frames of a binary file object, trusting nothing. Raises StreamError."""

    def __init__(self, file: BinaryIO, name: str | None = None, check_values: bool = True) -> None:
        self._file: Any = file  # whose readinto() BinaryIO does not name
        self._check_values = check_values
        self._name = name or str(getattr(file, "name", "stream"))
        self._position = self._consumed = self._unended = 0
        self.frames = self.ends = 0  # read so far

    def __iter__(self) -> Iterator[Frame]:
        while (header := self._read_header()) is not None:
            yield self._read_frame(header)

    def headers(self) -> Iterator[tuple[int, Header]]:
        """Of a file that can seek: where each frame starts, and its header; what follows the headers is passed over."""
        length = self._file.seek(0, os.SEEK_END)
        self._file.seek(self._consumed)
        while (header := self._read_header()) is not None:
            if self._position + header.size > length:
                self._corrupt(length,
                              f"the frame is cut short, {length - self._position} of {header.size} bytes are there")
            yield self._position, header
            self._consumed = self._file.seek(self._position + header.size)
            self.frames += 1
            self._unended += 1

    def read_at(self, number: int, start: int) -> Frame:
        """Of a file that can seek: the frame of that number, which starts there."""
        self._consumed = self._file.seek(start)
        self.frames = number
        header = self._read_header()
        if header is None:
            self._corrupt(start, "no frame is there any more: the file has changed")
        return self._read_frame(header)

    def _read_frame(self, header: Header) -> Frame:
        frame, table = self._read_table(header)
        for name, payload in table:
            self._read_payload(frame.arrays[name], name, payload)
        error = find_value_error(frame) if self._check_values else None
        if error:
            raise StreamError(BAD_INPUT, f"{self._name}: frame {self.frames}: {error}")
        self.frames += 1
        self._unended += 1
        return frame

    def _corrupt(self, byte: int, what: str) -> NoReturn:
        raise StreamError(CORRUPT, f"{self._name}: frame {self.frames}, byte {byte}: {what}")

    def _fill(self, view: memoryview) -> int:
        """Fills the memory from the file as far as it goes; returns the number of bytes."""
        done = 0
        while done < len(view) and (got := self._file.readinto(view[done:])):
            done += got
        self._consumed += done
        return done

    def _take(self, size: int) -> bytearray:
        block = bytearray(size)
        return block[:self._fill(memoryview(block))]

    def _check_version(self, major: int, flags: int) -> None:
        if major != _MAJOR:
            self._corrupt(self._position, f"format version {major} is not {_MAJOR}: a newer sheet is needed")
        if flags:
            self._corrupt(self._position, f"critical flags {flags:#x} are unknown to version {_MAJOR}.{_MINOR}: "
                          "a newer sheet is needed")

    def _read_end(self, block: bytearray) -> None:
        magic, major, minor, flags, frames, reserved, checksum = _END.unpack(block)
        if _checksum(block[:56]) != checksum:
            self._corrupt(self._position, "end mark: checksum mismatch")
        self._check_version(major, flags)
        if minor <= _MINOR and any(reserved):
            self._corrupt(self._position, "reserved bytes of the end mark are not zero")
        if frames != self._unended:
            self._corrupt(self._position, f"end mark counts {frames} frames, there are {self._unended}")
        self.ends += 1
        self._unended = 0

    def _read_header(self) -> Header | None:
        """The header of the next frame, END marks passed over; None at the end of the stream."""
        block = self._find_frame()
        if block is None:
            return None
        _, major, minor, flags, size, *counts, when, step, arrays, a, table_checksum, b, checksum = \
            _HEADER.unpack(block)
        if _checksum(block[:120]) != checksum:
            self._corrupt(self._position, "frame header: checksum mismatch")
        self._check_version(major, flags)
        if minor <= _MINOR and (a or any(b)):
            self._corrupt(self._position, "reserved bytes of the frame header are not zero")
        if arrays > _MAX_ARRAYS:
            self._corrupt(self._position, f"{arrays} arrays are more than the {_MAX_ARRAYS} that a frame may have")
        if size < 128 + 128 * arrays or size > _MAX_BYTES or size % 64:
            self._corrupt(self._position, f"a frame of {size} bytes cannot be")
        return Header(minor, size, counts[0], counts[1], counts[2], when, step, arrays, table_checksum)

    def _find_frame(self) -> bytearray | None:
        """The bytes of the next header, END marks passed over; None at the end of the stream."""
        after_end = False
        while True:
            self._position = self._consumed
            block = self._take(64)
            if not block and after_end:
                return None
            if not block:
                self._corrupt(self._consumed, "the stream was cut short: no end mark" if self.frames else
                              "the stream is empty: not even an end mark")
            if block.startswith(b"SHEETEND"):
                if len(block) < 64:
                    self._corrupt(self._consumed, "the end mark is cut short")
                self._read_end(block)
                after_end = True
                continue
            if b"SHEETFRM".startswith(block) or b"SHEETEND".startswith(block):
                self._corrupt(self._consumed, "the stream was cut short: a frame or end mark has just begun")
            if not block.startswith(b"SHEETFRM"):
                self._corrupt(self._position, _what_else(bytes(block), self._position == 0))
            if len(block) == 64:
                block += self._take(64)
            if len(block) < 128:
                self._corrupt(self._consumed, "the frame header is cut short")
            return block

    def _read_table(self, header: Header) -> tuple[Frame, list[tuple[str, _Payload]]]:
        """A frame whose arrays have no values yet, and name, type, ... of each payload."""
        minor, size, *counts, when, step, arrays, checksum = header
        block = self._take(128 * arrays)
        if len(block) < 128 * arrays:
            self._corrupt(self._consumed, "the array table is cut short")
        if _checksum(block) != checksum:
            self._corrupt(self._position + 128, "array table: checksum mismatch")
        error = _find_header_error(arrays, counts, when)
        if error:
            self._corrupt(self._position, error)
        frame = Frame(when, step, {}, *counts)
        table: list[tuple[str, _Payload]] = []
        twice = None
        offset = 128 + 128 * arrays
        for i, entry in enumerate(_ENTRY.iter_unpack(block)):
            name, array, payload, error = self._read_entry(entry, minor, counts, size, offset)
            if error or not array or not payload:
                shown = "".join(c if " " <= c <= "~" else "?" for c in name)
                self._corrupt(self._position + 128 + 128 * i, f'array {i} "{shown}": {error}')
            if name in frame:
                twice = twice or name
            frame.arrays[name] = array
            table.append((name, payload))
            offset += _padded(payload.bytes)
        if offset != size:
            self._corrupt(self._position, f"the frame has {size} bytes, its arrays need {offset}")
        if twice:
            self._corrupt(self._position, f'array "{twice}" appears twice')
        error = _find_edge_error(frame.arrays, counts[2])
        if error:
            self._corrupt(self._position, error)
        for name, array in frame.arrays.items():
            if array.critical and name not in _STANDARD:
                self._corrupt(self._position, f'array "{name}" is critical and unknown to version {_MAJOR}.{_MINOR}: '
                              "a newer sheet is needed")
        return frame, table

    @staticmethod
    def _read_entry(entry: tuple[Any, ...], minor: int, counts: list[int], frame_size: int,
                    expected_offset: int) -> tuple[str, Array | None, _Payload | None, str | None]:
        """Name, array without values, its payload, and what is wrong if something is."""
        raw_name, raw_unit, place, kind, transfer, flags, components, rows, offset, size, checksum, reserved = entry
        name, unit = raw_name.rstrip(b"\0").decode("latin-1"), raw_unit.rstrip(b"\0").decode("latin-1")

        if len(name) == 48 or "\0" in name:
            return "", None, None, "its name does not end"

        def find_error() -> str | None:
            if len(unit) == 24 or "\0" in unit:
                return "its unit does not end"
            if place >= len(PLACES):
                return f"place {place} is unknown"
            if not 1 <= kind < len(TYPES):
                return f"type {kind} is unknown"
            if transfer >= len(TRANSFERS):
                return f"transfer rule {transfer} is unknown"
            if flags & ~1:
                return f"flags {flags:#x} are unknown"
            if minor <= _MINOR and any(reserved):
                return "reserved bytes are not zero"
            if rows * components * SIZES[kind] != size:
                return f"{rows} rows of {components} {TYPES[kind]} are not {size} bytes"
            if offset != expected_offset:
                return f"it starts at byte {offset} of the frame, {expected_offset} expected"
            if size > frame_size - offset:
                return f"its {size} bytes do not fit into the frame"
            return _find_entry_error(name, unit, PLACES[place], TYPES[kind], TRANSFERS[transfer], components, rows,
                                     counts[place] if place < 3 else None)

        error = find_error()
        if error:
            return name, None, None, error
        array = Array("", PLACES[place], unit, TRANSFERS[transfer], bool(flags & 1))
        return name, array, _Payload(TYPES[kind], components, rows, size, checksum), None

    def _read_payload(self, array: Array, name: str, payload: _Payload) -> None:
        kind, components, rows, size, checksum = payload
        start, full, block = self._consumed, _padded(size), bytearray()
        while len(block) < full:
            have = len(block)
            portion = min(full - have, max(have, _FIRST_PORTION))
            block += bytes(portion)
            got = self._fill(memoryview(block)[have:])
            if got < portion:
                self._corrupt(self._consumed, f'array "{name}": cut short, {have + got} of {full} bytes are there')
        if _checksum(block) != checksum:
            self._corrupt(start, f'array "{name}": checksum mismatch')
        padding = block[size:]
        if any(padding):
            at = start + size + len(padding) - len(padding.lstrip(b"\0"))
            self._corrupt(at, f'array "{name}": padding is not zero')
        if kind == "text":
            del block[size:]
            error = _find_text_error(block)
            if error:
                self._corrupt(start, f'array "{name}": {error}')
            array.values = block.decode()
            return
        dtype = np.dtype(kind).newbyteorder("<")
        shape: tuple[int, ...] = (rows,) if components == 1 else (rows, components)
        array.values = np.frombuffer(block, dtype, rows * components).reshape(shape) if rows else np.zeros(shape, dtype)


def read(file: BinaryIO | str | os.PathLike[str], name: str | None = None,
         check_values: bool = True) -> Iterator[Frame]:
    """Iterates over the frames of a binary file object, or of the file of that name."""
    if isinstance(file, (str, os.PathLike)):
        with open(file, "rb") as opened:
            yield from Reader(opened, name, check_values)
    else:
        yield from Reader(file, name, check_values)


def encode(frame: Frame) -> list[bytes | memoryview]:
    """The frame as a list of blocks of bytes."""
    error = find_form_error(frame)
    if error:
        raise StreamError(BAD_INPUT, f"cannot write frame: {error}")
    payloads: list[bytes | memoryview] = []
    table = b""
    offset = 128 + 128 * len(frame.arrays)
    for name, a in frame.arrays.items():
        data = a.data()
        padding = bytes(_padded(len(data)) - len(data))
        table += _ENTRY.pack(name.encode(), a.unit.encode(), PLACES.index(a.place), TYPES.index(a.type),
                             TRANSFERS.index(a.transfer), int(a.critical), a.components, a.rows, offset, len(data),
                             _checksum(bytes(data) + padding if padding else data), bytes(16))
        payloads += [block for block in (data, padding) if len(block)]
        offset += len(data) + len(padding)
    if offset > _MAX_BYTES:
        raise StreamError(BAD_INPUT, "cannot write frame: it is larger than 2^48 bytes")
    header = _HEADER.pack(b"SHEETFRM", _MAJOR, _MINOR, 0, offset, frame.vertices, frame.triangles, frame.edges,
                          frame.time, frame.step, len(frame.arrays), 0, _checksum(table), bytes(40), 0)[:120]
    return [header + struct.pack("<Q", _checksum(header)) + table, *payloads]


class Writer:
    """Writes frames to a binary file object. A stream without end() counts as cut short."""

    def __init__(self, file: BinaryIO) -> None:
        self._file, self._unended = file, 0

    def _write(self, block: bytes | memoryview) -> None:
        view = memoryview(block).cast("B")
        while len(view):  # unbuffered files write what they can
            view = view[self._file.write(view):]

    def write(self, frame: Frame) -> None:
        """Appends a frame."""
        for block in encode(frame):
            self._write(block)
        self._unended += 1

    def end(self) -> None:
        """Writes the end mark."""
        mark = _END.pack(b"SHEETEND", _MAJOR, _MINOR, 0, self._unended, bytes(32), 0)[:56]
        self._write(mark + struct.pack("<Q", _checksum(mark)))
        self._unended = 0


def _number(x: Any) -> str:
    """The canonical text of a numpy scalar (section 6)."""
    if isinstance(x, np.integer):
        return str(x)
    if np.isnan(x):
        bits = f"{int.from_bytes(x.tobytes(), sys.byteorder):0{2 * x.dtype.itemsize}x}"
        return "nan" if bits in ("7ff8000000000000", "7fc00000") else f"nan:{bits}"
    if np.isinf(x):
        return "inf" if x > 0 else "-inf"
    return repr(float(np.format_float_scientific(x)) if x.dtype.itemsize == 4 else float(x)).removesuffix(".0")


def text(frame: Frame) -> str:
    """The canonical text of a frame: lines from "frame" to its last row."""
    lines = ["frame", f"time {_number(np.float64(frame.time))}", f"step {frame.step}", f"vertices {frame.vertices}",
             f"triangles {frame.triangles}", f"edges {frame.edges}"]
    for name, a in frame.arrays.items():
        place = f"frame[{a.rows}]" if a.place == "frame" and a.type != "text" else a.place
        critical = " critical" if a.critical else ""
        lines.append(f"array {name} {place} {a.type} {a.components} {a.unit} {a.transfer}{critical}")
        if isinstance(a.values, str):
            lines += [f"| {line}" if line else "|" for line in a.values.split("\n")] if a.values else []
        else:
            lines += [" ".join(map(_number, row)) for row in a.values.reshape(a.rows, a.components)]
    return "".join(f"{line}\n" for line in lines)


def _exit(code: int, message: str) -> NoReturn:
    print(f"{os.path.basename(sys.argv[0])}: {message}", file=sys.stderr)
    sys.exit(code)


def _report_time(frames: int, seconds: float) -> None:
    """Where sheet-loop runs the stage, it wants to know the time that the stage took: on a descriptor that it names."""
    descriptor = os.environ.get("SHEET_REPORT_FD", "")
    if descriptor.isdecimal() and int(descriptor) > 2:
        line = f"time {os.getpid()} {os.path.basename(sys.argv[0])} {frames} {seconds:.6f}\n"
        with contextlib.suppress(OSError):  # a missing line is a missing line in a report, no more
            os.write(int(descriptor), line.encode())


def stage(command: str | None = None) -> Iterator[Frame]:
    """Yields each frame of standard input; as the loop leaves it, the frame goes to standard output.

    A command (program, version in brackets, options that differ from their defaults) is recorded as provenance.
    Ends the program as all stages end: exit code and message for what is wrong with the stream, quietly if nobody
    reads the output any more. Leaving the loop early leaves out the end mark, so that the stream counts as cut short.
    """
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    if sys.stdin.isatty() or sys.stdout.isatty():
        _exit(USAGE, "a sheet stream is binary: use a pipe or a file on both sides")
    reader = Reader(open(sys.stdin.fileno(), "rb", buffering=0, closefd=False), "standard input")
    writer = Writer(open(sys.stdout.fileno(), "wb", buffering=0, closefd=False))
    busy = 0.0
    try:
        for frame in reader:
            start = time.monotonic()
            yield frame
            error = find_value_error(frame)
            if error:
                _exit(BAD_INPUT, f"frame {reader.frames - 1} would be wrong: {error}")
            if command is not None:
                frame.record(command)
            writer.write(frame)
            busy += time.monotonic() - start
        writer.end()
        _report_time(reader.frames, busy)
    except StreamError as error:
        _exit(error.exit_code, str(error))
    except BrokenPipeError:
        sys.exit(0)
    except OSError as error:
        _exit(IO, f"cannot read or write the stream: {error.strerror}")
