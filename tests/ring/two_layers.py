#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much of a sheet on a plate, seen from above, is in two layers? two_layers.py STREAM

Prints the part in the first and in the last frame, by rays on a grid of 1 mm."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "formats" / "python"))
import sheetstream


def part(frame):
    x = frame["position"][:, [0, 2]]
    low, high = x.min(axis=0), x.max(axis=0)
    rays = np.stack(np.meshgrid(*(np.arange(a, b, 1e-3) for a, b in zip(low, high)), indexing="ij"), -1)
    layers = np.zeros(rays.shape[:2], int)
    for a, b, c in x[frame["triangle"]]:
        sides = []
        for p, q in ((a, b), (b, c), (c, a)):
            way = q - p
            sides.append(way[0] * (rays[..., 1] - p[1]) - way[1] * (rays[..., 0] - p[0]))
        layers += (np.min(sides, axis=0) > 0) | (np.max(sides, axis=0) < 0)
    return (layers > 1).sum() / (layers > 0).sum()


run = sheetstream.Run(sys.argv[1])
print(part(run[0]), part(run[-1]))
