#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Does a strip of two that overlap pull as it must? lap_joint.py STREAM

Two strips of 40 mm x 20 mm x 2 mm and one of 20 mm x 20 mm x 4 mm in a row, whose ends part at 30 mm/s. Each has
L' = F L^2/(3 mu V) [V5 of docs/model.md], so F = 3 mu v/(sum of L^2/V). Prints force over that, from 0.3 s on, and fails
where it is off by more than 3 %."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "formats" / "python"))
import sheetstream

viscosity, speed, step = 100, 0.03, 1e-4
length, volume = np.array([0.08, 0.02]), np.array([3.2e-6, 1.6e-6])
time, good = 0.0, True
for frame in sheetstream.Run(sys.argv[1]):
    while time < frame.time - step / 2:
        force = 3 * viscosity * speed / (length**2 / volume).sum()
        length = length + step * force * length**2 / (3 * viscosity * volume)
        time += step
    if frame.time < 0.29:
        continue
    end = frame["position"][:, 0] > frame["position"][:, 0].max() - 1e-6
    ratio = frame["hold_force"][end, 0].sum() / (3 * viscosity * speed / (length**2 / volume).sum())
    print(f"{frame.time:.1f} s: {ratio:.4f}")
    good = good and abs(ratio - 1) < 0.03
sys.exit(not good)
