#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Do the contact springs of a pile carry it? layer_forces.py LAYERS GRAVITY DENSITY < STREAM

For the last frame: the vertical force of the springs between each layer (equal numbers of vertices, the lowest first) and
the one below, over the weight of all layers above: 1 at rest. Prints them; fails unless all are within 1 %."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "formats" / "python"))
import sheetstream

layers, gravity, density = int(sys.argv[1]), float(sys.argv[2]), float(sys.argv[3])
for frame in sheetstream.read(sys.stdin.buffer):
    pass
x, vertices, weights = frame["position"], frame["contact_vertex"], frame["contact_weight"]
normal, anchor, stiffness = frame["contact_normal"], frame["contact_anchor"], frame["contact_stiffness"]
c = (weights[:, :, None] * x[vertices]).sum(axis=1)
slide = c - anchor
slide -= (slide * normal).sum(axis=1)[:, None] * normal
gap = (c * normal).sum(axis=1) - frame["contact_rest"].reshape(-1)
force = -stiffness[:, :1] * gap[:, None] * normal - stiffness[:, 1:] * slide  # on the first feature

layer = vertices // (len(x) // layers)
first = layer[:, 0]
second = np.where(weights[:, 0] == 1, layer[:, 1], layer[:, 2])
weight = frame["volume"].sum() / layers * density * gravity  # of one layer
good = True
for below in range(layers - 1):
    up = force[(first == below + 1) & (second == below), 1].sum() - force[(first == below) & (second == below + 1), 1].sum()
    ratio = up / (weight * (layers - 1 - below))
    print(f"{ratio:.6f}")
    good = good and abs(ratio - 1) < 0.01
sys.exit(0 if good else 1)
