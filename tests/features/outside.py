# SPDX-License-Identifier: GPL-3.0-or-later
"""What a bath and pressure do in a step, from the frames at its start and end, whose mesh is one [J]. Potentials are those
of docs/model.md, "Pressure and bath"; which vertices lie on another layer, so that the bath does not reach them, which
are flooded and which triangles are overturned is settled at the start.
"""
import numpy


def si(value):
    """A number of a scene, or a text of one and a unit."""
    if not isinstance(value, str):
        return value
    number, unit = value.split()
    return float(number) * {"mm": 1e-3, "kPa": 1e3, "l": 1e-3}.get(unit, 1)


def normals(frame):
    """Twice each triangle's area, as a vector."""
    a, b, c = (frame["position"][frame["triangle"][:, k]] for k in range(3))
    return numpy.cross(b - a, c - a)


def piled(frame, up, sign):
    """The vertices that lie on a triangle (1) or under one (-1), the triangle's, and its weights."""
    if "contact_vertex" not in frame:
        return numpy.zeros(0, int), numpy.zeros((0, 3), int), numpy.zeros((0, 3))
    weights = frame["contact_weight"]
    on = (weights[:, 0] == 1) & (sign * (frame["contact_normal"] @ up) > 0.5)
    vertices = frame["contact_vertex"].astype(int)[on]
    return vertices[:, 0], vertices[:, 1:], -weights[on, 1:]


def around_vertices(frame, of_triangles):
    """The sum over the triangles around each vertex."""
    total = numpy.zeros(frame.vertices)
    for k in range(3):
        numpy.add.at(total, frame["triangle"][:, k], of_triangles)
    return total


def deep(frame, up, level):
    """Which vertices the bath would stand above, and above all that lies on them."""
    areas = numpy.linalg.norm(normals(frame), axis=1) / 2
    top = frame["position"] @ up - level + around_vertices(frame, frame["volume"].ravel()) / around_vertices(frame, areas)
    (on, below, _), (under, above, _) = piled(frame, up, 1), piled(frame, up, -1)
    while True:
        before = top.copy()
        for k in range(3):
            numpy.maximum.at(top, below[:, k], before[on])
            numpy.maximum.at(top, under, before[above[:, k]])
        if (top == before).all():
            return top < 0


def flooded(frame, up, level, clings):
    """Which vertices are reached from an open rim over vertices that are as deep."""
    found, is_deep = numpy.zeros(frame.vertices, bool), deep(frame, up, level)
    on, below, weights = piled(frame, up, 1)
    if clings or not is_deep.any():
        return found
    is_open = numpy.zeros(frame.vertices, bool)
    is_open[rim_of(frame["triangle"])] = True
    for name in ("hold", "inlet"):
        if name in frame:
            is_open &= frame[name].ravel() == 0
    lies = numpy.zeros(frame.vertices, bool)
    lies[on] = True
    found = is_deep & is_open & ~lies
    sides = numpy.concatenate([frame["triangle"][:, [k, (k + 1) % 3]] for k in range(3)])
    sides = sides[is_deep[sides].all(axis=1)]
    while True:
        before = found.copy()
        found[sides[found[sides].any(axis=1)]] = True
        wet = on[(weights * found[below]).sum(axis=1) >= 0.5]
        found[wet[(is_deep & is_open)[wet]]] = True
        if (found == before).all():
            return found


def pieces(frame):
    """Of each vertex, the number of its piece of the sheet."""
    piece = numpy.arange(frame.vertices)
    while True:
        before = piece.copy()
        least = piece[frame["triangle"]].min(axis=1)
        for k in range(3):
            numpy.minimum.at(piece, frame["triangle"][:, k], least)
        if (piece == before).all():
            return piece


def sides(frame, up):
    """Of each triangle, -1 where its piece lies on its face or is closed, so that its normal points to the bath; which are
    closed."""
    lies = numpy.zeros(frame.vertices, bool)
    lies[piled(frame, up, 1)[0]] = True
    lowest = ~lies[frame["triangle"]].any(axis=1)
    side, closed = numpy.ones(len(frame["triangle"])), numpy.zeros(len(frame["triangle"]), bool)
    piece, x, twice = pieces(frame)[frame["triangle"][:, 0]], frame["position"], normals(frame)
    for number in numpy.unique(piece):
        of = piece == number
        across, area = twice[of].sum(axis=0) / 2, numpy.linalg.norm(twice[of], axis=1).sum() / 2
        corners = frame["triangle"][of]
        room = cones(x - x[numpy.unique(corners)].mean(axis=0), corners)
        least_room = 0.3 * area ** 1.5 / (6 * numpy.pi ** 0.5) if len(rim_of(corners)) else 0
        closed[of] = numpy.linalg.norm(across) <= 0.1 * area and room > least_room
        level_part, bare = (twice @ up)[of & lowest].sum(), numpy.linalg.norm(twice[of & lowest], axis=1).sum()
        side[of] = -1 if closed[of].any() or level_part < -0.1 * bare else 1
    return side, closed


def borne(frame, up, is_flooded):
    """Which vertices lie on another layer that the bath bears, or that is borne itself."""
    found = numpy.zeros(frame.vertices, bool)
    side, _ = sides(frame, up)
    bears = (around_vertices(frame, side * (normals(frame) @ up)) > 0) & ~is_flooded
    on, below, weights = piled(frame, up, 1)
    while True:
        more = on[(weights * bears[below]).sum(axis=1) >= 0.5]
        more = more[~is_flooded[more]]
        if found[more].all():
            return found
        found[more] = bears[more] = True


def depth_integral(heights, clings):
    """Of the square of what of the heights is below 0, or of all, over each triangle; over a twelfth of its area."""
    def whole(d):
        return ((d ** 2).sum(axis=1) + d.sum(axis=1) ** 2) / 2
    if clings:
        return whole(heights)
    under = (heights < 0).sum(axis=1)
    result = numpy.where(under >= 2, whole(heights), 0)
    for alone in (1, 2): # one corner on its side of the surface
        for k in range(3):
            d = numpy.roll(heights, -k, axis=1)
            here = (under == alone) & ((d[:, 0] < 0) == (alone == 1))
            x, b, c = d[here].T
            corner = x ** 4 / ((x - b) * (x - c))
            result[here] = corner if alone == 1 else result[here] - corner
    result[under == 3] = whole(heights[under == 3])
    return result


def work_of_bath(said, start, end, of_liquids):
    bath, gravity = said["environment"]["bath"], numpy.array([si(value) for value in said["environment"]["gravity"]])
    level, weight = si(bath.get("level", 0)), si(bath["density"]) * numpy.linalg.norm(gravity)
    g = numpy.linalg.norm(gravity)
    up = -gravity / g
    triangle, volume = start["triangle"], start["volume"].ravel()
    clings = bath.get("clings", False)
    around = flooded(start, up, level, clings)
    is_open = ~borne(start, up, around)[triangle]
    side, closed = sides(start, up)
    overturned = (~closed & (side * (normals(start) @ up) < 0))[:, numpy.newaxis]
    steep = 0.025 * numpy.linalg.norm(normals(start), axis=1) # a twentieth of the area
    reached = is_open & ((start["position"] @ up)[triangle] < level)
    from_below = is_open & ~around[triangle] & ~overturned
    all_round = reached & (overturned | around[triangle])
    liquid = start["liquid"].ravel() if "liquid" in start else numpy.zeros(len(triangle), int)
    density, _ = of_liquids(said, liquid)
    level_part = side * (normals(start) @ up) / numpy.linalg.norm(normals(start), axis=1)
    floats_by = numpy.clip((level_part - 0.5) / 0.25, 0, 1) * bath.get("spreads", not clings)
    thrust = density * g * volume ** 2 / 2 * (reached & from_below).mean(axis=1) * floats_by

    def potential(frame):
        heights = (frame["position"] @ up)[triangle] - level
        projected = side * (normals(frame) @ up) / 2
        counts = numpy.where((projected < steep) & ~closed, numpy.maximum(projected + steep, 0) ** 2 / (4 * steep), projected)
        floats = weight / 12 * from_below.mean(axis=1) * counts * depth_integral(heights, clings)
        dips = -weight * volume / 3 * (heights * all_round).sum(axis=1)
        spread = numpy.divide(thrust, projected, out=numpy.zeros(len(thrust)), where=thrust > 0)
        return (floats + dips + spread).sum()

    return potential(start) - potential(end)


def rim_of(corners):
    """Edges of one triangle, in its sense."""
    sides = numpy.concatenate([corners[:, [k, (k + 1) % 3]] for k in range(3)])
    _, index, count = numpy.unique(numpy.sort(sides, axis=1), axis=0, return_index=True, return_counts=True)
    return sides[index[count == 1]]


def cones(x, corners):
    """The volume between these triangles and the origin."""
    return numpy.einsum("ij,ij->i", x[corners[:, 0]], numpy.cross(x[corners[:, 1]], x[corners[:, 2]])).sum() / 6


def swept(start, end, corners):
    """The volume that these triangles sweep on the side of their normals."""
    origin = start["position"].mean(axis=0)
    first, last = (frame["position"] - origin for frame in (start, end))
    a, b = rim_of(corners).T # its cone from the origin is no part of the sheet
    cone = (numpy.cross(first[a], first[b]) + numpy.cross(last[a], last[b])) / 2
    return (cones(last, corners) - cones(first, corners) +
            ((last[a] - first[a] + last[b] - first[b]) * cone).sum() / 6)


def enclosed(frame, corners):
    """By these triangles, whose rim, if there is one, is closed from its middle."""
    x, rim = frame["position"], rim_of(corners)
    return cones(x - x[rim if len(rim) else corners].mean(axis=(0, 1)), corners)


def work_of_gas(pressure, start, end, corners, number):
    """The integral of p over the volume, from that at the start to that and what is swept; with holes by its mean."""
    ambient, n = si(pressure.get("ambient", 101325)), pressure.get("exponent", 1)
    amounts = [frame["gas.amount"].ravel()[number] for frame in (start, end) if "gas.amount" in frame]
    amount = numpy.mean(amounts)
    first = enclosed(start, corners) + si(pressure.get("more_volume", 0))
    last = first + swept(start, end, corners)
    if "gas.hole_area" in end: # its amount changes much in a step
        return numpy.mean([frame["gas.pressure"].ravel()[number] for frame in (start, end)]) * (last - first)
    filled = numpy.log(last / first) if n == 1 else (last ** (1 - n) - first ** (1 - n)) / (1 - n)
    return ambient * (amount ** n * filled - (last - first))


def work_of_pressure(pressure, start, end):
    """Constant pressure times the volume that is swept, or of the gas within; what only drains does none."""
    if pressure["law"] == "draining":
        return 0
    triangle = start["triangle"]
    inside = start["enclosure"].ravel() if "enclosure" in start else numpy.ones(len(triangle), int)
    if pressure["law"] == "constant":
        return si(pressure["value"]) * swept(start, end, triangle[inside > 0])
    assert pressure["law"] == "gas", pressure
    return sum(work_of_gas(pressure, start, end, triangle[inside == k + 1], k) for k in range(inside.max())
               if (inside == k + 1).any())
