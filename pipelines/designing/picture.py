# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture by gnuplot: what was started from and what is, and what came out of both."""
import subprocess

from sweeping.problem import INTERNAL, Problem


def _rows(name, *columns):
    return [f"${name} << END", *(" ".join(f"{1e3 * x:.9g}" for x in row) for row in zip(*columns)), "END"]


def draw(asked, first, best, path):
    """first, best: (profile, outcome, worst) of two runs."""
    lines = ["set terminal pngcairo size 1100,440 font ',11'", f"set output '{path}'", "set multiplot layout 1,2",
             "set autoscale xfix", "set offsets 0, 0, graph 0.1, graph 0.25", "set key bottom right", "set grid",
             "set ylabel 'thickness [mm]'"]  # fmt: skip
    for name, (profile, outcome, _) in (("first", first), ("best", best)):
        lines += _rows(f"start_{name}", profile.places, profile.thickness)
        lines += _rows(f"end_{name}", outcome.places, outcome.thickness)
        lines += _rows(f"rows_{name}", profile.places, outcome.rows)
    profile = best[0]
    lines += _rows("target", profile.places, asked.target_at(profile.places))
    where = "distance from the axis" if profile.over == "radial" else profile.over
    lines += [f"set xlabel '{where} at the start [mm]'", "set title 'Before the run'",
              "plot $start_first with linespoints pointtype 7 linecolor rgb '#999999' title 'first run', "
              "$start_best with linespoints pointtype 7 linewidth 2 linecolor rgb '#b8500a' title 'as found'",
              "set title 'After it'",
              "plot $end_first with points pointtype 7 pointsize 0.3 linecolor rgb '#999999' title 'first run', "
              "$end_best with points pointtype 7 pointsize 0.3 linecolor rgb '#b8500a' title 'as found', "
              "$target with lines dashtype 2 linewidth 2 linecolor rgb '#333333' title 'wanted'"]  # fmt: skip
    done = subprocess.run(["gnuplot"], input="\n".join(lines) + "\n", capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise Problem(INTERNAL, f"gnuplot: {done.stderr.strip()}")
