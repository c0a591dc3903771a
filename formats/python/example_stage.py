#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""A stage of one's own: frames in on standard input, frames out on standard output, one for one.

    sheet-init --example | sheet-init - | sheet-loop --steps 10 -- 'sheet-step --dt 0.01 | ./example_stage.py --wind
    0.5' > windy.sheet
"""
import argparse

import sheetstream

parser = argparse.ArgumentParser(description="blows on the sheet; without --wind it passes frames as they are")
parser.add_argument("--wind", type=float, default=0.0, metavar="V", help="added to the velocity along x [m/s]")
parser.add_argument("--no-provenance", action="store_true", help="leave the record of programs as it is")
options = parser.parse_args()

command = "example_stage.py (1.0)" + (f" --wind {options.wind}" if options.wind else "")
for frame in sheetstream.stage(None if options.no_provenance else command):
    if options.wind:
        if "velocity" not in frame:  # absent means at rest
            frame.arrays["velocity"] = sheetstream.Array(0 * frame["position"], "vertex", "m/s", "interpolate")
        frame["velocity"][:, 0] += options.wind
