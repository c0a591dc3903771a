#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints for each frame of a stream: step, pieces (triangles that hang together across edges), triangles of the smallest,
triangles with three open sides."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "formats" / "python"))
import sheetstream  # noqa: E402

for frame in sheetstream.read(sys.stdin.buffer):
    t = frame["triangle"].astype(np.int64)
    n = len(t)
    sides = np.sort(np.concatenate((t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]])), axis=1)
    order = np.lexsort((sides[:, 1], sides[:, 0]))
    same = (sides[order][1:] == sides[order][:-1]).all(axis=1)
    one, other = order[:-1][same] % n, order[1:][same] % n
    closed = np.bincount(np.concatenate((one, other)), minlength=n)
    piece = np.arange(n)
    while True:  # each takes the smallest number of its neighbours
        least = piece.copy()
        np.minimum.at(least, one, piece[other])
        np.minimum.at(least, other, piece[one])
        if (least == piece).all():
            break
        piece = least
    sizes = np.unique(piece, return_counts=True)[1]
    print(frame.step, len(sizes), sizes.min(), int((closed == 0).sum()))
