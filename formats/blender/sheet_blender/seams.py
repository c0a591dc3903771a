# SPDX-License-Identifier: GPL-3.0-or-later
"""A layer with seams, where the corners at a vertex differ: its values at triangles that have come since the start.

Each vertex knows where it was in the mesh at the start. A triangle begins in the face in which its middle was, and from
there the way goes to where each of its corners was, over sides that are no seams: so an island that meets itself, as
that of a tube or a ball does, keeps its sides apart, and what reaches over a seam ends at it.
"""
from __future__ import annotations

from typing import Any

import numpy as np
from mathutils.bvhtree import BVHTree

SEAM = 1e-6  # corners of a vertex that differ by more stand at a seam
MOST_STEPS = 64  # from face to face


class Seamed:
    """position (n x 3), triangle (m x 3) and values (m x 3 x components) at the start."""

    def __init__(self, position: Any, triangle: Any, values: Any) -> None:
        self.values = values
        self.corners = position[triangle]  # m x 3 x 3
        self.tree = BVHTree.FromPolygons(position.tolist(), triangle.tolist())
        self.neighbour = _neighbours(triangle, values)
        self.near = 1e-9 * float(np.ptp(position, axis=0).max())  # of which distance none counts

    def look_up(self, rest: Any, triangle: Any) -> Any:
        """Values at the corners of triangles (m x 3 x components) whose vertices were at `rest` (n x 3) then."""
        middles = rest[triangle].mean(axis=1)
        start = np.array([self.tree.find_nearest(middle)[2] for middle in middles], int)
        target = rest[triangle].reshape(-1, 3)
        face, weights = self._walk(np.repeat(start, 3), target)
        return np.einsum("ij,ijk->ik", weights, self.values[face]).reshape(*triangle.shape, -1)

    def _walk(self, face: Any, target: Any) -> tuple[Any, Any]:
        """The faces where the ways end that begin in these, and the weights of their corners there."""
        raw, weights, distance = self._place(face, target)
        best, best_weights, best_distance = face.copy(), weights, distance
        before = np.full(len(face), -1)
        going = np.flatnonzero(distance > self.near)
        for _ in range(MOST_STEPS):
            if not len(going):
                break
            after = self._next(face[going], before[going], raw[going], best_distance[going], target[going])
            going, after = going[after >= 0], after[after >= 0]
            before[going], face[going] = face[going], after
            raw[going], new, distance = self._place(after, target[going])
            nearer = distance < best_distance[going]
            rows = going[nearer]
            best[rows], best_weights[rows], best_distance[rows] = after[nearer], new[nearer], distance[nearer]
            going = going[distance > self.near]
        return best, best_weights

    def _next(self, face: Any, before: Any, raw: Any, distance: Any, target: Any) -> Any:
        """The faces behind the sides over which the ways go on, -1 where they end: the side beyond which the target
        is, of two the further; where it is above or below the face, that to a face that is nearer to it."""
        options = self.neighbour[face]
        blocked = (options < 0) | (options == before[:, None])
        cost = np.where((raw < -1e-12) & ~blocked, raw, np.inf)
        inside = np.flatnonzero((raw >= -1e-12).all(axis=1))
        for i in range(3):
            rows = inside[~blocked[inside, i]]
            away = self._place(options[rows, i], target[rows])[2]
            cost[rows, i] = np.where(away < distance[rows], away, np.inf)
        side = cost.argmin(axis=1)
        every = np.arange(len(face))
        return np.where(np.isfinite(cost[every, side]), options[every, side], -1)

    def _place(self, face: Any, point: Any) -> tuple[Any, Any, Any]:
        """Of the points' feet on the faces' planes the weights of the corners; those of the nearest points in the
        faces; how far these are."""
        a, b, c = self.corners[face].transpose(1, 0, 2)
        u, v, w = b - a, c - a, point - a
        uu, uv, vv, wu, wv = ((p * q).sum(1) for p, q in ((u, u), (u, v), (v, v), (w, u), (w, v)))
        scale = uu * vv - uv * uv
        flat = scale <= 0
        scale[flat] = 1
        raw = np.stack([np.zeros(len(face)), (vv * wu - uv * wv) / scale, (uu * wv - uv * wu) / scale], axis=1)
        raw[:, 0] = 1 - raw[:, 1] - raw[:, 2]
        raw[flat] = (1, 0, 0)
        weights = raw.copy()
        outside = np.flatnonzero((raw < 0).any(axis=1))
        if len(outside):
            weights[outside] = _on_sides(self.corners[face[outside]], point[outside])
        foot = np.einsum("ij,ijk->ik", weights, self.corners[face])
        return raw, weights, np.linalg.norm(foot - point, axis=1)


def _on_sides(corners: Any, point: Any) -> Any:
    """Weights of the corners in the points of the faces' sides that are nearest to these."""
    best = np.zeros((len(point), 3))
    least = np.full(len(point), np.inf)
    every = np.arange(len(point))
    for i in range(3):
        j = (i + 1) % 3
        along = corners[:, j] - corners[:, i]
        square = np.maximum((along * along).sum(1), np.finfo(float).tiny)
        part = np.clip(((point - corners[:, i]) * along).sum(1) / square, 0, 1)
        away = np.linalg.norm(corners[:, i] + part[:, None] * along - point, axis=1)
        rows = every[away < least]
        best[rows] = 0
        best[rows, i], best[rows, j], least[rows] = 1 - part[rows], part[rows], away[rows]
    return best


def _neighbours(triangle: Any, values: Any) -> Any:
    """The face on the other side of the side opposite each corner (m x 3), -1 at borders and seams: sides with the same
    two vertices and values at them join."""
    n = len(triangle)
    keys = []
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        a, b, u, v = triangle[:, j], triangle[:, k], values[:, j], values[:, k]
        swap = (a > b)[:, None]
        ends = np.sort(np.stack([a, b], 1), 1)
        keys.append(np.concatenate([ends, np.round(np.where(swap, v, u) / SEAM), np.round(np.where(swap, u, v) / SEAM)],
                                   axis=1))
    _, side, count = np.unique(np.concatenate(keys), axis=0, return_inverse=True, return_counts=True)
    side = side.reshape(-1)
    order = np.argsort(side, kind="stable")
    first = np.flatnonzero(count[side[order]] == 2)[::2]  # the two of a side stand together
    result = np.full(3 * n, -1)
    one, other = order[first], order[first + 1]
    result[one], result[other] = other % n, one % n
    return result.reshape(3, n).T
