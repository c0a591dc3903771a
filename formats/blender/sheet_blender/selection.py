# SPDX-License-Identifier: GPL-3.0-or-later
"""One sheet of a frame that has several."""
from __future__ import annotations

from typing import Any

import numpy as np

from .carried import SHEET
from .compat import sheetstream


def sheet_of(frame: sheetstream.Frame, position: Any, number: int) -> tuple[sheetstream.Frame, Any]:
    """A frame of the triangles of this number alone, with their vertices, and where these are of `position`; all of
    the frame if it does not tell its sheets apart."""
    if SHEET not in frame:
        return frame, position
    triangles = np.flatnonzero(np.asarray(frame[SHEET]).ravel() == number)
    vertices, corners = np.unique(np.asarray(frame["triangle"])[triangles], return_inverse=True)
    rows = {"vertex": vertices, "triangle": triangles}
    arrays = {name: sheetstream.Array(array.values[rows[array.place]], array.place, array.unit, array.transfer,
                                      array.critical) if array.place in rows else array
              for name, array in frame.arrays.items() if array.place != "edge"}
    one = sheetstream.Frame(frame.time, frame.step, arrays, len(vertices), len(triangles))
    one["triangle"] = corners.reshape(-1, 3).astype(np.uint32)
    return one, position[vertices]
