#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A stage that spoils the sheet: in each step from step FIRST on it takes nine tenths of the first triangle's volume, as
long as there is more than a millionth of it, and says so nowhere. It takes SECONDS for each.

    spoiler_stage.py FIRST [SECONDS]
"""
import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "formats" / "python"))
import sheetstream  # noqa: E402

for frame in sheetstream.stage(None):
    volume = frame["volume"]
    if frame.step >= int(sys.argv[1]) and volume[0] > 1e-6 * volume[1]:
        volume[0] *= 0.1
    time.sleep(float(sys.argv[2]) if len(sys.argv) > 2 else 0)
