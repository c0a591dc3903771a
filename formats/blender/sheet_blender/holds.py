# SPDX-License-Identifier: GPL-3.0-or-later
"""What is held of a sheet, and where liquid enters, in the words of scenes: by arrays of its mesh file."""
from __future__ import annotations

from typing import Any

import numpy as np

from .errors import SheetError
from .programs import HOLD_KINDS

MOST_HOLDS = 64


def kind_of(group: str) -> str | None:
    """The kind of hold that a vertex group is by its name, "pinned..." or "clamped..."; None for others."""
    return next((kind for kind in HOLD_KINDS if group.lower().startswith(kind)), None)


def hold_tables(groups: dict[str, Any], kinds: dict[str, str], motion: str, first: int,
                of: str) -> tuple[list[str], dict[str, Any]]:
    """The lines of a [[hold]] for each group, and the arrays at vertices by which they choose. motion: the value of the
    key, "" for none; first: the number of the first one in the scene; of: the line that names the sheet, or ""."""
    lines: list[str] = []
    arrays = {}
    for number, (name, painted) in enumerate(groups.items(), first):
        if not painted.any():
            raise SheetError(f'vertex group "{name}" holds nothing: no vertex of a face has a weight above 0.5')
        array = f"painted.{number}"
        arrays[array] = painted.astype(np.uint8)
        lines += ["", f"[[hold]] # {quoted(name)}", *([of] if of else []), f'region = {{array = "{array}"}}',
                  f'kind = "{kinds[name]}"']
        if motion:
            lines.append(f"motion = {motion}")
    return lines, arrays


def inflow_table(name: str, painted: Any, position: Any, triangle: Any, speed: float, thickness: float, several: bool,
                 of: str) -> tuple[list[str], dict[str, Any]]:
    """The lines of the [inflow] at the painted part of the border, along the sheet into it, and its array. several:
    whether the scene has more of them; of: the line that names the sheet, or ""."""
    border = rim_vertices(triangle, len(position))
    entry = painted & border
    inwards = np.zeros(3)
    for i in range(3):
        a, b, c = triangle[:, i], triangle[:, (i + 1) % 3], triangle[:, (i + 2) % 3]
        side = _is_rim(triangle, i) & entry[a] & entry[b]
        along = position[b[side]] - position[a[side]]
        length = np.linalg.norm(along, axis=1, keepdims=True)
        way = position[c[side]] - position[a[side]]
        way -= along * (way * along).sum(1, keepdims=True) / length**2
        inwards += (way / np.linalg.norm(way, axis=1, keepdims=True) * length).sum(0)
    if np.linalg.norm(inwards) < 1e-12:
        raise SheetError(f'vertex group "{name}" has no edge of the sheet\'s border, where alone liquid can enter: in'
                         ' Edit Mode select border edges, and choose Inlet in the panel')
    velocity = speed * inwards / np.linalg.norm(inwards)
    table = "[[inflow]]" if several else "[inflow]"
    lines = ["", f"{table} # {quoted(name)}", *([of] if of else []), 'region = {array = "entry"}',
             f"velocity = {row(velocity)}", f"thickness = {thickness!r}"]
    return lines, {"entry": entry.astype(np.uint8)}


def row(values: Any) -> str:
    return "[" + ", ".join(repr(float(v)) for v in values) + "]"


def quoted(text: str) -> str:
    """A TOML string of one line."""
    shown = "".join(c if c.isprintable() else "?" for c in text)
    return '"' + shown.replace("\\", "\\\\").replace('"', '\\"') + '"'


def _sides(triangle: Any) -> Any:
    return np.sort(np.concatenate([triangle[:, [0, 1]], triangle[:, [1, 2]], triangle[:, [2, 0]]]), axis=1)


def _is_rim(triangle: Any, i: int) -> Any:
    """Whether side i of each triangle is on the border."""
    _, side, counts = np.unique(_sides(triangle), axis=0, return_inverse=True, return_counts=True)
    return counts[side.reshape(3, -1)[i]] == 1


def rim_vertices(triangle: Any, vertices: int) -> Any:
    edges, counts = np.unique(_sides(triangle), axis=0, return_counts=True)
    result = np.zeros(vertices, bool)
    result[edges[counts == 1].ravel()] = True
    return result
