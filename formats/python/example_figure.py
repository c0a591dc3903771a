#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""A figure of a run: four moments of the sheet coloured by thickness, and what became of it over time.

    ./example_figure.py run.sheet run.png --up y
"""
import argparse

import matplotlib

matplotlib.use("agg")  # draws into files; leave this out in a notebook
import matplotlib.pyplot as plt
import numpy as np

from sheetstream import Run, StreamError, plot

parser = argparse.ArgumentParser(description="draws a run: four moments and curves over time")
parser.add_argument("run", help="a sheet stream")
parser.add_argument("figure", help="the file to write: .png, .pdf, .svg, ...")
parser.add_argument("--up", choices="xyz", default="z", help="the axis that is drawn upwards (default z)")
options = parser.parse_args()
try:
    run = Run(options.run)
    moments = [run[i] for i in np.unique(np.linspace(0, len(run) - 1, 4).round().astype(int))]
    limits = (min(np.percentile(frame.thickness(), 1) for frame in moments),
              max(np.percentile(frame.thickness(), 99) for frame in moments))
    figure = plt.figure(figsize=(12, 8), layout="constrained")
    left, right = figure.subfigures(1, 2, width_ratios=(2, 1))
    for i, frame in enumerate(moments):
        plot.sheet(frame, ax=left.add_subplot(2, 2, i + 1, projection="3d"), limits=limits, up=options.up)
    names = ("volume", "area", "thickness_min", "speed_max", "kinetic_energy")
    plot.curves(run, names, right.subplots(len(names), sharex=True))
    figure.savefig(options.figure, dpi=100)
except (StreamError, OSError, IndexError, ValueError) as error:
    parser.exit(3, f"{parser.prog}: {error}\n")
