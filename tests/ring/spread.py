#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How far has a round heap spread? spread.py STREAM

Prints the radius of the disk that has the second moment of the liquid about the y axis [m], in the first and the last
frame, and their difference."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "formats" / "python"))
import sheetstream


def radius(frame):
    corners = frame["position"][frame["triangle"]]
    # The mean square of a linear function over a triangle.
    square = ((corners**2).sum(axis=1) + corners.sum(axis=1) ** 2) / 12
    return np.sqrt(2 * ((square[:, 0] + square[:, 2]) * frame["volume"]).sum() / frame["volume"].sum())


run = sheetstream.Run(sys.argv[1])
first, last = radius(run[0]), radius(run[-1])
print(first, last, last - first)
