#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What pipelines/annulus/growth reckons.

    pipelines/annulus/growth.py times THEORY.csv PART    a step and the end, in times in which the fastest wave grows
    e-fold pipelines/annulus/growth.py lines THEORY.csv WAVES.csv UNTIL RATE EDGE STEP      lines of growth.csv
    pipelines/annulus/growth.py report GROWTH.csv
"""
import math
import sys

import columns


def times(theory, part):
    fastest = max(row["growth"] for row in columns.read(theory))
    print(f"{part / fastest:.4g} {3 / fastest:.4g}")


def lines(theory, waves, until, *row):
    """Growth of each wave by least squares of the logarithm of its amplitude, over the last two thirds of the run."""
    frames = [frame for frame in columns.read(waves) if frame["time"] > until / 3]
    for wave in columns.read(theory):
        m = int(wave["waves"])
        growth = columns.slope([(frame["time"], math.log(frame[f"a{m}"])) for frame in frames])
        print(f"{','.join(row)},{m},{growth:.5g},{wave['growth']:.5g},{frames[-1][f'a{m}']:.4g}")


def report(growth):
    """Of each run: the waves that are highest in the end, and those that theory has within a fifth of the fastest; and
    what growth comes to with edges of no length, if the difference goes as their square."""
    runs = {}
    for row in columns.read(growth):
        runs.setdefault((row["rate"], row["edge"], row["step"]), []).append(row)
    found = []
    for number, ((rate, edge, step), rows) in enumerate(runs.items(), 1):
        fastest = max(rows, key=lambda r: r["theory"])
        off = [r["growth"] / r["theory"] - 1 for r in rows if r["theory"] > 0.8 * fastest["theory"]]
        print(f"{rate:g} rad/s, edges {edge:g} m, steps {step:g}: highest with"
              f" {max(rows, key=lambda r: r['last'])['waves']:.0f} crests (theory {fastest['waves']:.0f}), growth of"
              f" these"
              f" {fastest['waves']:.0f} {fastest['growth']:.4g}/s ({fastest['theory']:.4g}):"
              f" {100 * (fastest['growth'] / fastest['theory'] - 1):+.1f} %; all that are near:"
              f" {100 * max(off, key=abs):+.1f} % at most")  # fmt: skip
        found.append(fastest["growth"])
        if number % 3 == 0:  # edges, 0.7 of them, half the steps
            limit = found[-2] - (found[-3] - found[-2]) * 0.49 / 0.51
            print(f"{rate:g} rad/s, extrapolated to edges of no length: {limit:.4g}/s:"
                  f" {100 * (limit / fastest['theory'] - 1):+.1f} %")  # fmt: skip


if sys.argv[1] == "times":
    times(sys.argv[2], float(sys.argv[3]))
elif sys.argv[1] == "lines":
    lines(sys.argv[2], sys.argv[3], float(sys.argv[4]), *sys.argv[5:])
else:
    report(sys.argv[2])
