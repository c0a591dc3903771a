#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What pipelines/film-casting/critical reckons, of films of power laws τ ~ rate^n whose width is held.

    pipelines/film-casting/resonance.py theory LEAST MOST COUNT
        critical draw ratio and angular frequency over n, as CSV
    pipelines/film-casting/resonance.py critical N
        the same of one n
    pipelines/film-casting/resonance.py thickness N DRAW PART SIZE
        rows for a sheet as long as SIZE: the steady film, thicker in its middle by PART
    pipelines/film-casting/resonance.py wave FORCES.csv FREQUENCY
        growth and angular frequency of the force on the roll, fitted about FREQUENCY
    pipelines/film-casting/resonance.py onset DRAW GROWTH FREQUENCY DRAW GROWTH FREQUENCY
        draw ratio and frequency without growth, between two

Frequencies and growth are in units of u0/L, the slot's speed over its distance from the roll.

Steady: u'^n h the same everywhere and h u = 1, so u = (1 + (D^m - 1) x)^(1/m), m = 1 - 1/n (D^x where n = 1). With
thickness h (1 + a e^(λt)) and speed u + v e^(λt) to first order [Yeow 1974]

    λ a/u + a' + (v/u)' = 0,   n v'/u' + a = f the same everywhere,   a = v = 0 at the slot, v = 0 at the roll.

The second gives v by integrals of a, which leaves an eigenvalue problem for a; by collocation at Chebyshev's points.
"""
import math
import sys

import numpy as np

import columns

TRANSIT = 2  # [s] from slot to roll at the slot's speed
LENGTH = 0.2  # [m]
THICKNESS = 1e-3  # [m] at the slot


def points(order):
    """Chebyshev's from 0 to 1, the matrix of derivatives there, and that of integrals from 0 on [Trefethen 2000]."""
    k = np.arange(order + 1)
    x = -np.cos(np.pi * k / order)
    c = np.where((k == 0) | (k == order), 2.0, 1.0) * (-1.0) ** k
    apart = x[:, None] - x + np.eye(order + 1)
    derivative = np.outer(c, 1 / c) / apart
    derivative -= np.diag(derivative.sum(axis=1))
    integral = np.zeros((order + 1, order + 1))
    integral[1:, 1:] = np.linalg.inv(derivative[1:, 1:])
    # What vanishes at the first point is integrated exactly by that; constants are added.
    integral[:, 0] = x + 1 - integral.sum(axis=1)
    return (x + 1) / 2, 2 * derivative, integral / 2


def steady(n, draw, x):
    """Speed over the slot's, and its slope."""
    m = 1 - 1 / n
    if abs(m) < 1e-9:
        return draw**x, math.log(draw) * draw**x
    u = (1 + (draw**m - 1) * x) ** (1 / m)
    return u, (draw**m - 1) / m * u ** (1 - m)


def leading(n, draw, order=48):
    """The eigenvalue of the greatest growth: growth rate, angular frequency."""
    x, derivative, integral = points(order)
    u, slope = steady(n, draw, x)
    weighted = integral * slope  # ∫ u' a
    speed = (np.outer(u - 1, weighted[-1]) / (draw - 1) - weighted) / n
    flow = -u[:, None] * (derivative @ (np.eye(order + 1) + speed / u[:, None]))
    values = np.linalg.eigvals(flow[1:, 1:])
    # Those of high frequency are of the points, not of the film; the first pair is that of draw resonance.
    values = values[(values.imag > 1) & (values.imag < 60)]
    first = values[np.argmax(values.real)]
    return first.real, first.imag


def critical(n):
    """Draw ratio from which on disturbances grow, and their angular frequency: by bisection in ln D."""
    low, high = math.log(1.5), math.log(1e3)
    for _ in range(44):
        middle = (low + high) / 2
        growth, frequency = leading(n, math.exp(middle))
        low, high = (low, middle) if growth > 0 else (middle, high)
    return math.exp(middle), frequency


def thickness(n, draw, part, size):
    """Rows of place from the middle of a sheet that begins at the slot, and thickness: what the roll has, it keeps."""
    x = np.linspace(0, 1, 201)
    h = THICKNESS * (1 + part * np.sin(np.pi * x)) / steady(n, draw, x)[0]
    return "[" + ",".join(f"[{LENGTH * at - size / 2:.8g},{there:.10g}]" for at, there in zip(x, h)) + "]"


def wave(time, force, about):
    """Fits F = a + e^(σt) (b cos ωt + c sin ωt): least squares for a, b, c, over a grid of σ and ω that is refined."""
    best, width = (math.inf, 0.0, about), 4.0
    for _ in range(6):
        _, growth, frequency = best
        for sigma in growth + width * np.linspace(-1, 1, 41):
            for omega in frequency + 1.5 * width * np.linspace(-1, 1, 41):
                grown = np.exp(sigma * time)
                basis = np.stack([grown**0, grown * np.cos(omega * time), grown * np.sin(omega * time)], axis=1)
                amplitude = np.linalg.lstsq(basis, force, rcond=None)[0]
                best = min(best, (float(np.sum((basis @ amplitude - force) ** 2)), sigma, omega))
        width /= 5
    return best[1:]


def of_roll(path, about):
    """The wave in the force on the roll, once what was put in has become draw resonance."""
    table = columns.read(path)
    time = np.array([row["time"] for row in table]) / TRANSIT
    force = np.array([row["force_of_hold_3_x"] for row in table])
    return wave(time[time > 1], force[time > 1] / force[-1], about)


def onset(below, above):
    """Of (draw ratio, growth, frequency): where nothing grows, linear in the logarithm of the draw ratio."""
    part = below[1] / (below[1] - above[1])
    return below[0] * (above[0] / below[0]) ** part, (1 - part) * below[2] + part * above[2]


def main():
    task, given = sys.argv[1], sys.argv[2:]
    if task == "theory":
        print("n,draw,frequency")
        for n in np.linspace(float(given[0]), float(given[1]), int(given[2])):
            print("{:.6g},{:.8g},{:.8g}".format(n, *critical(n)))
    elif task == "critical":
        print("{:.8g} {:.8g}".format(*critical(float(given[0]))))
    elif task == "thickness":
        print(thickness(*map(float, given)))
    elif task == "wave":
        print("{:.6g} {:.6g}".format(*of_roll(given[0], float(given[1]))))
    elif task == "onset":
        print("{:.5g},{:.5g}".format(*onset([float(g) for g in given[:3]], [float(g) for g in given[3:]])))
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
