#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the waves of a ring did that was turned up and down: pipelines/annulus/hysteresis.py NAME WAVES.csv

Prints the highest; when waves of 0.1 mm are there, and when they are gone; how high they are at half the greatest rate.
"""
import math
import sys

import columns

HALF = 0.015  # half the greatest rate [rad/s]

frames = columns.read(sys.argv[2])
pairs = list(zip(frames, frames[1:]))
top = max(frames, key=lambda f: f["amplitude"])
seen = [f["rate"] for f in frames if f["amplitude"] > 1e-4] or [math.nan]
up = next((b["amplitude"] for a, b in pairs if b["rate"] > a["rate"] and b["rate"] >= HALF), math.nan)
down = next((b["amplitude"] for a, b in pairs[::-1] if b["rate"] < a["rate"] and a["rate"] > HALF >= b["rate"]),
            math.nan)
print(f"{sys.argv[1]}: highest {1e3 * top['amplitude']:.3g} mm with {top['waves']:.0f} crests at {top['time']:g} s;"
      f" above 0.1 mm"
      f" from {seen[0]:.4g} rad/s on, until {seen[-1]:.4g}; at 0.015 rad/s {1e3 * up:.3g} mm up, {1e3 * down:.3g} mm"
      f" down")
