#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh with its vertices and triangles in another order, and mirrored, and how far their runs differ.

    other_order.py make MESH.obj   writes plain.obj, permuted.obj (by permutation.txt) and mirrored.obj (x to -x)
    other_order.py compare BOUND   plain.sheet against permuted.sheet and mirrored.sheet: prints the greatest distance
of a vertex from its place in any frame after the first, over the size of the sheet, and fails above BOUND."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "formats" / "python"))
import sheetstream

MIRROR = np.array([-1, 1, 1])


def write(name, positions, triangles):
    """As OBJ; triangles count from 0."""
    with open(name, "w") as file:
        file.writelines("v {} {} {}\n".format(*(float(c) for c in x)) for x in positions)
        file.writelines("f {} {} {}\n".format(*(t + 1)) for t in triangles)


def make(mesh):
    rows = [line.split() for line in open(mesh)]
    x = np.array([[float(w) for w in r[1:]] for r in rows if r[0] == "v"])
    t = np.array([[int(w) - 1 for w in r[1:]] for r in rows if r[0] == "f"])
    random = np.random.default_rng(3)
    order = random.permutation(len(x))  # vertex i of the permuted mesh is vertex order[i]
    np.savetxt("permutation.txt", order, fmt="%d")
    turned = np.array([np.roll(c, random.integers(3)) for c in np.argsort(order)[t]])
    write("plain.obj", x, t)
    write("permuted.obj", x[order], random.permutation(turned))
    write("mirrored.obj", x * MIRROR, t[:, ::-1])


def compare(bound):
    plain, permuted, mirrored = ([f["position"] for f in sheetstream.read(open(f"{name}.sheet", "rb"))][1:]
                                 for name in ("plain", "permuted", "mirrored"))
    if not len(plain) == len(permuted) == len(mirrored) > 0:
        sys.exit(f"{len(plain)}, {len(permuted)} and {len(mirrored)} steps")
    order = np.loadtxt("permutation.txt", dtype=int)
    worst = 0
    for x, p, m in zip(plain, permuted, mirrored):
        size = np.ptp(x, axis=0).max()
        worst = max(worst, *(np.linalg.norm(d, axis=1).max() / size for d in (x[order] - p, x * MIRROR - m)))
    print(f"{worst:.3g} of the size, {bound:g} allowed")
    sys.exit(not worst <= bound)


if sys.argv[1] == "make":
    make(sys.argv[2])
else:
    compare(float(sys.argv[2]))
