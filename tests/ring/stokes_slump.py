#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How does a column of viscous liquid slump on a floor? stokes_slump.py RADIUS HEIGHT VISCOSITY DENSITY TIME...

Stokes' flow without inertia or tension and without slip on the floor, axisymmetric, SI units, by finite elements:
bilinear velocities, a pressure an element (a penalty), on a mesh that is made anew of the outline at each of the steps,
which are of second order. What comes down to the floor beyond the contact line stays there. Prints a line for each
time: the time, the height on the axis and the radius of the cylinder that has the liquid's second moment about it [m],
0.3 % off with 12 elements a side (of 32, and in volume that the outline loses)."""
import sys

import numpy as np
import scipy.sparse
import scipy.sparse.linalg

SIDE = 12  # elements
OUTLINE = 6 * SIDE
GRAVITY = 9.81
PENALTY = 3e4  # of the viscosity
GAUSS = [(a, b) for a in (-(3**-0.5), 3**-0.5) for b in (-(3**-0.5), 3**-0.5)]


def along(line):
    return np.r_[0, np.cumsum(np.hypot(*np.diff(line, axis=0).T))]


def resampled(line, count):
    s = along(line)
    at = np.linspace(0, s[-1], count)
    return np.c_[np.interp(at, s, line[:, 0]), np.interp(at, s, line[:, 1])]


def mesh_within(outline):
    """A square's grid [i][j] = (r, z) whose right and upper sides are the outline, from the floor to the axis [Coons]."""
    corner = np.argmax(outline[:, 0] / outline[:, 0].max() + outline[:, 1] / outline[:, 1].max())
    corner = min(max(corner, OUTLINE // 6), OUTLINE - OUTLINE // 6)
    right, top = resampled(outline[: corner + 1], SIDE + 1), resampled(outline[corner:], SIDE + 1)[::-1]
    ones = np.linspace(0, 1, SIDE + 1)
    floor, axis = np.c_[ones * outline[0, 0], 0 * ones], np.c_[0 * ones, ones * outline[-1, 1]]
    u, v = ones[:, None, None], ones[None, :, None]
    sides = (1 - v) * floor[:, None] + v * top[:, None] + (1 - u) * axis[None] + u * right[None]
    return sides - ((1 - u) * v * top[0] + u * (1 - v) * floor[-1] + u * v * top[-1])


def velocities(grid, viscosity, density):
    """Of the grid's nodes [m/s]."""
    nodes = np.arange((SIDE + 1) ** 2).reshape(SIDE + 1, SIDE + 1)
    quads = np.stack([nodes[:-1, :-1], nodes[1:, :-1], nodes[1:, 1:], nodes[:-1, 1:]], -1).reshape(-1, 4)
    corners = grid.reshape(-1, 2)[quads]
    count = len(quads)
    stiffness, weight = np.zeros((count, 8, 8)), np.zeros((count, 8))
    divergence, volume = np.zeros((count, 8)), np.zeros(count)
    for a, b in GAUSS:
        shape = 0.25 * np.array([(1 - a) * (1 - b), (1 + a) * (1 - b), (1 + a) * (1 + b), (1 - a) * (1 + b)])
        slopes = 0.25 * np.array([[-(1 - b), 1 - b, 1 + b, -(1 + b)], [-(1 - a), -(1 + a), 1 + a, 1 - a]])
        jacobian = np.einsum("ki,eix->ekx", slopes, corners)
        by_place = np.linalg.solve(jacobian, np.broadcast_to(slopes, (count, 2, 4)))
        radius = corners[:, :, 0] @ shape
        whole = np.linalg.det(jacobian) * radius
        strain = np.zeros((count, 4, 8))  # rr, zz, around, and twice rz
        strain[:, 0, 0::2], strain[:, 1, 1::2] = by_place[:, 0], by_place[:, 1]
        strain[:, 2, 0::2] = shape / radius[:, None]
        strain[:, 3, 0::2], strain[:, 3, 1::2] = by_place[:, 1], by_place[:, 0]
        stress = viscosity * np.array([2, 2, 2, 1.0])
        stiffness += np.einsum("eai,a,eaj,e->eij", strain, stress, strain, whole)
        divergence += np.einsum("eai,e->ei", strain[:, :3], whole)
        weight[:, 1::2] -= density * GRAVITY * whole[:, None] * shape
        volume += whole
    stiffness += PENALTY * viscosity * np.einsum("ei,ej->eij", divergence, divergence) / volume[:, None, None]
    unknowns = np.stack([2 * quads, 2 * quads + 1], -1).reshape(count, 8)
    size = 2 * nodes.size
    places = (np.repeat(unknowns, 8, axis=1).ravel(), np.tile(unknowns, (1, 8)).ravel())
    matrix = scipy.sparse.csc_matrix((stiffness.ravel(), places), shape=(size, size))
    force = np.bincount(unknowns.ravel(), weight.ravel(), size)
    held = np.zeros(size, bool)
    held[2 * nodes[0]] = held[2 * nodes[:, 0]] = held[2 * nodes[:, 0] + 1] = True
    free = np.flatnonzero(~held)
    velocity = np.zeros(size)
    velocity[free] = scipy.sparse.linalg.spsolve(matrix[free][:, free], force[free])
    return velocity.reshape(SIDE + 1, SIDE + 1, 2)


def outline_velocity(outline, viscosity, density):
    grid = mesh_within(outline)
    inside = velocities(grid, viscosity, density)
    rim = np.r_[grid[-1, :], grid[-2::-1, -1]]
    there = np.r_[inside[-1, :], inside[-2::-1, -1]]
    s, at = along(rim), along(outline)
    at *= s[-1] / at[-1]
    return np.c_[np.interp(at, s, there[:, 0]), np.interp(at, s, there[:, 1])]


def landed(outline):
    """Cut where it comes to the floor beyond its contact line."""
    outline = outline.copy()
    below = np.flatnonzero(outline[1:-1, 1] <= 0)
    if below.size:
        a, b = outline[below[-1] + 1], outline[below[-1] + 2]
        outline = np.r_[[a + a[1] / (a[1] - b[1]) * (b - a)], outline[below[-1] + 2 :]]
    outline[0, 1] = outline[-1, 0] = 0
    return resampled(outline, OUTLINE + 1)


def cylinder_radius(outline):
    r, rise = outline[:, 0], np.diff(outline[:, 1])
    mean = lambda power: (r[:-1] ** power + r[1:] ** power) / 2
    return (mean(4) * rise).sum() ** 0.5 / (mean(2) * rise).sum() ** 0.5


def main():
    radius, height, viscosity, density, *times = map(float, sys.argv[1:])
    outline = resampled(np.array([[radius, 0], [radius, height], [0, height]]), OUTLINE + 1)
    time = 0.0
    for end in times:
        while time < end - 1e-12:
            velocity = outline_velocity(outline, viscosity, density)
            step = min(0.01 * outline[-1, 1] / np.hypot(*velocity.T).max(), end - time)
            middle = landed(outline + step / 2 * velocity)
            outline = landed(outline + step * outline_velocity(middle, viscosity, density))
            time += step
        print(time, outline[-1, 1], cylinder_radius(outline))


main()
