#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What pipelines/fold-law.sh reckons.

    pipelines/fold-law.py line SWING.csv FOLDS.csv UNTIL     period, middle half, thickness, width: of a line of law.csv
    pipelines/fold-law.py exponent LAW.csv KIND EDGE TOLERANCE [LEAST [MOST]]
    pipelines/fold-law.py collapse LAW.csv                   collapse.csv of pipelines/folding/law
"""
import math
import statistics
import sys

import columns


def line(swing, folds, until):
    """The median of the periods and the range of their middle half; means over the later half of the run."""
    periods = sorted(row["period"] for row in columns.read(folds) if row["period"] > 0)
    if len(periods) < 2:
        sys.exit(f"{folds}: too few folds; simulate more periods")
    quarter = (len(periods) + 3) // 4
    later = [row for row in columns.read(swing) if row["time"] > until / 2]
    size = [statistics.fmean(row[name] for row in later) if later else math.nan for name in ("thickness", "width")]
    middle = periods[len(periods) - quarter] - periods[quarter - 1]
    print(f"{statistics.median(periods):.5g},{middle:.3g},{size[0]:.4g},{size[1]:.4g}")


def exponent(law, kind, edge, tolerance, least=0.0, most=1e9):
    """That of frequency in what is varied, by least squares of logarithms; of the values from least to most alone."""
    rows = [r for r in columns.read(law) if r["kind"] == kind and r["edge"] == edge and r["tolerance"] == tolerance]
    points = [(math.log(r[kind]), -math.log(r["period"])) for r in rows if least <= r[kind] <= most]
    print(f"{columns.slope(points):.3f}" if len(points) > 1 else "")


def collapse(law):
    """A line for each of law.csv: edge, tolerance, H / l_g and l / l_g, U [m/s] and l_g [m], with l = U T / 2 and
    l_g = (nu h^2 U / g)^(1/4); U is the speed at which the slot's flow goes through thickness and width above the
    folds."""
    for r in columns.read(law):
        speed = r["speed"] * 0.00125 * 0.04 / (r["thickness"] * r["width"])
        scale = (3.33 * r["thickness"] ** 2 * speed / 9.81) ** 0.25
        numbers = (r["height"] / scale, speed * r["period"] / 2 / scale, speed, scale)
        print(f"{r['edge']:g},{r['tolerance']:g}," + ",".join(f"{x:.4g}" for x in numbers))


if sys.argv[1] == "line":
    line(sys.argv[2], sys.argv[3], float(sys.argv[4]))
elif sys.argv[1] == "exponent":
    exponent(sys.argv[2], sys.argv[3], *map(float, sys.argv[4:]))
else:
    collapse(sys.argv[2])
