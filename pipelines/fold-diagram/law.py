# SPDX-License-Identifier: GPL-3.0-or-later
"""The laws of pipelines/fold-diagram/run: reads FOLDER/sweep/results.csv, leaves law.csv, law.png and period.png there.

Gravity folds: l ~ l_g = (nu h^2 U / g)^(1/4); the height folds: l ~ H [Skorobogatiy, Mahadevan 2000; Ribe 2003]. l = U
T / 2; h and U are those above the folds, U that at which the slot's flow goes through thickness and width there.
"""
import csv
import math
import pathlib
import subprocess
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from sweeping import plot  # noqa: E402

FLOW, DENSITY, GRAVITY = 0.1 * 0.00125 * 0.024, 100, 9.81  # [m^3/s], [kg/m^3], [m/s^2]


def rows_of(folder):
    """viscosity, H, T, l, l_g, and middle half of T, for every run that has a steady period: one whose middle half is
    narrower than a third of it. Says how many have not."""
    rows, others = [], 0
    for r in plot.read_results(folder / "sweep" / "results.csv"):
        mu, height, period = float(r["material.viscosity [Pa*s]"]), float(r["height"]), float(r["period [s]"])
        thickness, width = float(r["thickness [m]"]), float(r["width [m]"])
        if not math.isfinite(period) or float(r["middle_half [s]"]) > period / 3:
            others += 1
        else:
            speed = FLOW / (thickness * width)
            gravity_length = (mu / DENSITY * thickness**2 * speed / GRAVITY) ** 0.25
            rows.append((mu, height, period, speed * period / 2, gravity_length, float(r["middle_half [s]"])))
    print(f"{len(rows)} runs with a steady period, {others} without")
    return np.array(rows)


def exponent(rows, what, law):
    """The exponent b of l/l_g ~ (H/l_g)^b: median of the slopes of all pairs of runs in logarithms [Theil 1950; Sen
    1968], which single runs cannot spoil, with its standard error from 200 samples with replacement."""
    if len(rows) < 5:
        print(f"{what}: {len(rows)} runs: too few for an exponent")
        return
    x, y = np.log(rows[:, 1] / rows[:, 4]), np.log(rows[:, 3] / rows[:, 4])

    def slope(chosen):
        i, j = np.triu_indices(len(chosen), 1)
        dx, dy = x[chosen][j] - x[chosen][i], y[chosen][j] - y[chosen][i]
        return np.median(dy[dx != 0] / dx[dx != 0])

    generator = np.random.default_rng(1)
    error = np.std([slope(generator.integers(0, len(x), len(x))) for _ in range(200)])
    print(f"{what}, {len(rows)} runs: l/l_g ~ (H/l_g)^({slope(np.arange(len(x))):.2f} +- {error:.2f}){law}; "
          f"medians: l/l_g {np.median(np.exp(y)):.2f}, l/H {np.median(np.exp(y - x)):.2f}")  # fmt: skip


def draw(folder, rows):
    curves = ", ".join(f"'{folder}/law.csv' using ($1 == {mu:.6g} ? $2 / $5 : NaN):($4 / $5) with points pointtype 7 "
                       f"linecolor palette cb {math.log10(mu)} notitle" for mu in sorted(set(rows[:, 0])))  # fmt: skip
    script = f"""set terminal pngcairo size 900, 600 font 'sans,12'; set output '{folder}/law.png'; set datafile \
separator ','
set grid linecolor rgb '#cccccc'; set logscale xy; set key top left; set xlabel 'height over l_g'; set ylabel 'length \
of a fold over l_g'
set palette defined (0 '#30123b', 1 '#2f6ea5', 2 '#3fa89a', 3 '#a8cf5e', 4 '#d8b030'); set cblabel 'log_{{10}} of \
viscosity [Pa s]'
set cbrange [{math.log10(min(rows[:, 0])) - 0.01}:{math.log10(max(rows[:, 0])) + 0.01}]
set xtics (1, 1.5, 2, 3, 4, 6, 8, 12); set ytics (0.7, 1, 1.5, 2, 3, 4, 6); set xrange [1:12]; set yrange [0.7:6]
plot {curves}, x linecolor rgb 'black' dashtype 2 title 'l = H', 3.6 linecolor rgb 'black' dashtype 3 title '3.6 l_g'
"""
    subprocess.run(["gnuplot"], input=script, text=True, check=True)


def main():
    folder = pathlib.Path(sys.argv[1])
    rows = rows_of(folder)
    with open(folder / "law.csv", "w", encoding="ascii") as file:
        file.write("# viscosity [Pa*s],height [m],period [s],fold [m],l_g [m],middle half of the periods [s]\n")
        file.writelines(",".join(f"{x:.6g}" for x in row) + "\n" for row in rows)
    high = rows[:, 1] / rows[:, 4]
    exponent(rows[high < 3], "low slots (H < 3 l_g)", ", 1 if the height folds the sheet")
    exponent(rows[(high >= 3) & (high < 5.5)], "between", "")
    exponent(rows[high >= 5.5], "high slots (H > 5.5 l_g)", ", 0 if gravity does")
    draw(folder, rows)
    subprocess.run([pathlib.Path(__file__).resolve().parents[1] / "sweep", "plot", folder / "sweep", "-o",
                    folder / "period.png", "--log", "xy",
                    "--x", "height", "--y", "material.viscosity", "--map", "period"], check=True)  # fmt: skip


if __name__ == "__main__":
    main()
