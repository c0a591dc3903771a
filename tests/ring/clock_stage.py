#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A stage that stands in place of sheet-step and changes nothing but the clock: each frame goes on to the next output time.

What sheet-collide needs to know of a step is there: it started where it ended.
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "formats" / "python"))
import sheetstream  # noqa: E402

for frame in sheetstream.stage("clock_stage.py (1.0)"):
    start = frame.time
    frame.time = float(frame["next_output_time"][0])
    frame.arrays["start_position"] = sheetstream.Array(frame["position"].copy(), "vertex", "m", "drop")
    frame.arrays["start_time"] = sheetstream.Array([start], "frame", "s", "copy")
    frame.step += 1
