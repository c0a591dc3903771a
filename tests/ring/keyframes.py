#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Motions by rows, for motion.bats.

    keyframes.py spoon              rows of a spoon that dips into a sheet and turns
    keyframes.py turn RATE END      rows of a steady turn about y [rad/s], to the time END
    keyframes.py rigid RUN ROWS     how far each frame of a run is from the first one moved as the rows say [m]: the largest
"""
import csv
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "formats" / "python"))
import sheetstream


def about(axis, angle):
    axis = np.asarray(axis, float)
    return np.r_[np.cos(angle / 2), np.sin(angle / 2) * axis / np.linalg.norm(axis)]


def write(rows):
    print("time [s], x [mm], y [mm], z [mm], qw, qx, qy, qz")
    for row in rows:
        print(", ".join(repr(float(value)) for value in np.concatenate(row)))


def matrix(w, x, y, z):
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


if sys.argv[1] == "spoon":
    write(([t], [300 * t, -120 + 2400 * t * (0.5 - t), 0], about([0, 0, 1], 1.2 + np.sin(4 * t)))
          for t in np.arange(13) / 24)
elif sys.argv[1] == "turn":
    rate, end = map(float, sys.argv[2:])
    write(([t], [0, 0, 0], about([0, 1, 0], rate * t)) for t in np.linspace(0, end, 9))
else:
    with open(sys.argv[3], encoding="utf-8") as file:
        rows = np.array([[float(value) for value in row] for row in list(csv.reader(file))[1:]])
    run = sheetstream.Run(sys.argv[2])
    first, worst = run[0]["position"], 0.0
    turns, places = [matrix(*row[4:]) for row in rows], rows[:, 1:4] / 1000
    for frame in run:
        k = int(np.argmin(abs(rows[:, 0] - frame.time)))
        assert abs(rows[k, 0] - frame.time) < 1e-12
        moved = (first - places[0]) @ turns[0] @ turns[k].T + places[k]
        worst = max(worst, abs(frame["position"] - moved).max())
    print(f"{worst:.3g}")
