#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Does sheet-collide take energy? energy_beside.py DENSITY RATE BEFORE AFTER

BEFORE has what went into sheet-collide, AFTER the frames of the run, in a scene whose only solid turns about the y axis
at RATE [rad/s]. Contacts are impulses between parts of the sheet and of the solid, inelastic: seen by an observer who
turns with the solid, where that rests, those of the solid do no work and the others take some, so that
    sum m |v' - w x'|^2 / 2  <=  sum m |v - w x'|^2 / 2
with v before, v' and x' after, w x' the solid's velocity there. Prints the ratio of the sides and fails above 1."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "formats" / "python"))
import sheetstream

density, rate = float(sys.argv[1]), float(sys.argv[2])
before, after = (list(sheetstream.read(open(name, "rb"))) for name in sys.argv[3:5])
good = len(before) == len(after) - 1 > 0
for i, (a, b) in enumerate(zip(before, after[1:])):
    mass = np.zeros(len(b["position"]))
    np.add.at(mass, b["triangle"].reshape(-1), np.repeat(b["volume"].reshape(-1) * density / 3, 3))
    solid = np.cross([0, rate, 0], b["position"])
    was, is_now = ((mass[:, None] * (f["velocity"] - solid) ** 2).sum() for f in (a, b))
    print(f"step {i + 1}: {is_now / was:.6f}")
    good = good and is_now <= was * (1 + 1e-12)
sys.exit(0 if good else 1)
