# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture by gnuplot: what was measured, with its errors, and what the best parameters give there."""
import subprocess

from sweeping.problem import INTERNAL, Problem
from sweeping.run import unit_of


def draw(asked, result, path):
    """A panel for each curve."""
    lines = [f"set terminal pngcairo size 640,{420 * len(asked.measured)} font ',11'", f"set output '{path}'",
             f"set multiplot layout {len(asked.measured)},1", "set xlabel 'time [s]'", "set key top right",
             "set offsets graph 0.04, graph 0.04, graph 0.1, graph 0.1"]  # fmt: skip
    place = 0
    for number, measured in enumerate(asked.measured):
        fitted = result.fitted[place:place + len(measured.times)]
        place += len(measured.times)
        rows = sorted(zip(measured.times, measured.values, measured.sigmas, fitted))
        lines += [f"$data{number} << END", *(" ".join(f"{x:.9g}" for x in row) for row in rows), "END"]
        unit = f" [{unit_of(measured.observer)}]" if unit_of(measured.observer) else ""
        lines += [f"set ylabel '{measured.observer}{unit}' noenhanced",
                  f"plot $data{number} using 1:2:3 with yerrorbars pointtype 7 linecolor rgb '#333333' title "
                  "'measured',"
                  f" $data{number} using 1:4 with linespoints pointtype 6 linewidth 2 linecolor rgb '#b8500a' title "
                  "'the scene, as fitted'"]  # fmt: skip
    done = subprocess.run(["gnuplot"], input="\n".join(lines) + "\n", capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise Problem(INTERNAL, f"gnuplot: {done.stderr.strip()}")
