#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Of the sweep in a folder: pipelines/annulus-diagram/report.py curves FOLDER RATE (what gnuplot draws of the runs with
that rate), or pipelines/annulus-diagram/report.py lines FOLDER (a line for each run)."""
import sys

import columns

what, folder = sys.argv[1:3]
rows = columns.read(f"{folder}/results.csv")
if what == "curves":
    print(", ".join(f"\"{folder}/runs/000/{r['run']:03.0f}/waves.csv\" using (1e3 * $2):(1e3 * $3)"
                    " with lines linewidth 2"
                    f" title \"tension {r['material.surface_tension']:g} N/m\"" for r in rows
                    if r["rate"] == float(sys.argv[3])))
else:
    for r in rows:
        print(f"rate {r['rate']:g}, tension {r['material.surface_tension']:g}: highest {1e3 * r['amplitude']:.3g} mm"
              f" with"
              f" {r['crests']:.0f} crests; above 0.1 mm from {r['seen_from']:g} on, until {r['seen_until']:g}; at half"
              f" the rate"
              f" {1e3 * r['half_up']:.3g} mm up, {1e3 * r['half_down']:.3g} mm down")  # fmt: skip
