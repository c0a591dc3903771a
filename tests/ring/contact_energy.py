#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Does anything get energy from nothing in sheet-step | sheet-collide? contact_energy.py BEFORE AFTER BODY...

BEFORE has what went into sheet-collide in each step, AFTER the frames of the run, the first one included. A BODY is what
prescribes motion and has effect in these steps, a solid or what is held: its velocity X,Y,Z [m/s], or, of one that spins
about the y axis, its rate [rad/s]. Nothing flows or changes the mesh. For each body let u(x) be its velocity as a rigid
body's, and an observer move with it: to him it rests and does no work.

sheet-collide. Contacts are impulses without bounce: each one brings a point, Σ w_i v_i, to the velocity of what it
meets, across a surface or altogether. That is a projection of all velocities v, in the norm |v|² = Σ m_i |v_i|², on a
convex set: those that do not run on into the contact. u is in that set if the contact is with this body or between
parts of the sheet (a rigid motion keeps what meets together), and a projection brings nothing farther from any member
of its set, so |v' - u| <= |v - u|: where one body alone pushes, the observer sees no gain. That holds for each island of
vertices between which impulses went, by itself. Islands here: changed vertices that are less than two edges apart, more
than impulses reach. If A and B push on one, with B's velocity b as A's observer sees it, projections on B's set change
|v|²/2 by <v' - v, b> - |v' - v|²/2 or less (as b is in it), at most |b|²/2, which is half of the island's mass times
the square of the bodies' relative speed: for a blow of each. With something held in it a triangle's free corners are
moved by up to 4 times the way of the point (longest_corner_lever), so b is up to 4 times as large there.

Contact springs get no more in sheet-collide than it takes of the kinetic energy, but for 1e-4 of that, for the one body
that there is: what it does to springs by moving vertices is no work.

sheet-step. Between its two ends the sheet gets energy from the weight and from what is prescribed only: contact springs
give what they stored, tension what the area loses, viscosity takes. The observer who rests on the only body, so that
this does no work, sees the sum of kinetic energy, weight, tension, springs and, where he spins, centrifugal potential,
fall. With two bodies, of which one drags while the other holds back, it may rise for both, and is not asked for."""
import pathlib
import sys
import tomllib

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "formats" / "python"))
import sheetstream

ROUND_OFF = 1e-12  # of the kinetic energy
OF_SPRINGS = 1e-4
HELD_LEVER = 4


def body(text):
    """The velocity of a body at places, as a function."""
    words = [float(w) for w in text.split(",")]
    if len(words) == 3:
        return lambda x: np.broadcast_to(words, x.shape)
    return lambda x: np.cross([0, words[0], 0], x)


def masses(frame, density):
    """Of the vertices [kg]."""
    mass = np.zeros(len(frame["position"]))
    np.add.at(mass, frame["triangle"].reshape(-1), np.repeat(frame["volume"].reshape(-1) * density / 3, 3))
    return mass


def kinetic(mass, velocity):
    """[J]"""
    return (mass[:, None] * velocity**2).sum() / 2


def longest_edge(frame):
    """[m]"""
    corners = frame["position"][frame["triangle"]]
    return np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max()


def islands(places, reach):
    """Index arrays of places that are joined by steps of less than `reach`."""
    left, result = set(range(len(places))), []
    while left:
        island, front = [], [left.pop()]
        while front:
            island.append(front.pop())
            near = [i for i in left if np.linalg.norm(places[i] - places[island[-1]]) < reach]
            left.difference_update(near)
            front += near
        result.append(np.array(island))
    return result


def spring_energy(springs, x):
    """Of the contact springs of a frame, with vertices at x [J]."""
    if "contact_vertex" not in springs:
        return 0.0
    offset = (springs["contact_weight"][:, :, None] * x[springs["contact_vertex"]]).sum(axis=1)
    normal, stiffness = springs["contact_normal"], springs["contact_stiffness"]
    gap = (normal * offset).sum(axis=1) - springs["contact_rest"].reshape(-1)
    slide = offset - springs["contact_anchor"]
    slide = slide - (normal * slide).sum(axis=1)[:, None] * normal
    return (stiffness[:, 0] * gap**2 + stiffness[:, 1] * (slide**2).sum(axis=1)).sum() / 2


def collide_gains(mass, before, after, bodies):
    """Of each island what is gained beyond what its bodies may give [J], less than 0 if all is well."""
    x, v, w = after["position"], before["velocity"], after["velocity"]
    changed = np.flatnonzero((v != w).any(axis=1))
    held = "hold" in after and bool((after["hold"] != 0).any())
    for island in islands(x[changed], 2 * longest_edge(after)):
        i = changed[island]
        fields = [u(x[i]) for u in bodies]
        gain = min(kinetic(mass[i], w[i] - u) - kinetic(mass[i], v[i] - u) for u in fields)
        relative = max(kinetic(mass[i], a - b) for a in fields for b in fields)
        yield gain - relative * (HELD_LEVER**2 if held else 1) - ROUND_OFF * kinetic(mass, v)


def spring_gain(mass, before, after, u):
    """What springs and vertices have more after sheet-collide, as seen from the body with the velocity u [J]."""
    x = after["position"]
    gain = (spring_energy(after, x) + kinetic(mass, after["velocity"] - u(x)) - spring_energy(before, before["position"])
            - kinetic(mass, before["velocity"] - u(x)))
    return gain - OF_SPRINGS * kinetic(mass, before["velocity"])


def step_gain(mass, start, end, u, weight, tension):
    """What is gained in a step beyond weight, tension and springs, as seen from the body with the velocity u [J]."""
    def energy(frame):
        x = frame["position"]
        a, b, c = (x[frame["triangle"][:, k]] for k in range(3))
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
        centrifugal = kinetic(mass, u(x) - u(0 * x))
        velocity = frame["velocity"] if "velocity" in frame else 0 * x
        return (kinetic(mass, velocity - u(x)) - centrifugal - (mass * ((x - frame.time * u(0 * x)) @ weight)).sum()
                + 2 * tension * area + spring_energy(start, x))
    scale = kinetic(mass, end["velocity"]) + (mass * np.abs(end["position"] @ weight)).sum()
    return energy(end) - energy(start) - ROUND_OFF * scale


def main():
    before, after = (list(sheetstream.read(open(name, "rb"))) for name in sys.argv[1:3])
    bodies = [body(text) for text in sys.argv[3:]]
    if not len(before) == len(after) - 1 > 0:
        sys.exit(f"{len(before)} frames before and {len(after)} after sheet-collide")
    scene = tomllib.loads(after[0]["scene"])
    weight = np.array(scene["environment"]["gravity"])
    mass = masses(after[0], scene["material"]["density"])
    contacts = bad = 0
    for n, (start, end, collided) in enumerate(zip(after, before, after[1:]), 1):
        gains = [("sheet-collide", gain) for gain in collide_gains(mass, end, collided, bodies)]
        contacts += len(gains)
        if len(bodies) == 1:
            gains.append(("sheet-collide to springs", spring_gain(mass, end, collided, bodies[0])))
            gains.append(("sheet-step", step_gain(mass, start, end, bodies[0], weight,
                                                  scene["material"].get("surface_tension", 0))))
        for name, value in gains:
            if value > 0:
                bad += 1
                print(f"step {n}: {name} gives {value:.3g} J")
    if contacts == 0:
        sys.exit("nothing met anything")
    print(f"{len(before)} steps, {contacts} islands, {bad} that gain")
    sys.exit(bad > 0)


main()
