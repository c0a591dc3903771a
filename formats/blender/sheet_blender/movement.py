# SPDX-License-Identifier: GPL-3.0-or-later
"""How objects move and whether they change their shape, from the scene's frame on."""
from __future__ import annotations

import pathlib
from typing import Any

import bpy
import numpy as np
from mathutils import Matrix, Quaternion

from .errors import SheetError
from .evaluated import WITH_SURFACE, surface_of

MOVED = 1e-7  # [m] or of a unit quaternion: less is rest


def moves(rows: Any) -> bool:
    return bool((np.abs(rows[:, 1:] - rows[0, 1:]) > MOVED).any())


def motion_of(thing: bpy.types.Object, scene: bpy.types.Scene) -> Any:
    """How an object moves from the scene's frame to its last: rows of time [s], place [m] and rotation (a unit
    quaternion w, x, y, z), one a frame. Raises SheetError if its size or shape changes."""
    now, rate, length = scene.frame_current, scene.render.fps / scene.render.fps_base, scene.unit_settings.scale_length
    rows = []
    try:
        for frame in range(now, max(scene.frame_end, now) + 1):
            scene.frame_set(frame)
            matrix = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world.copy()
            place, turn, _ = matrix.decompose()
            if frame == now:
                first, first_turn = matrix, turn
            elif not _is_turned(first, matrix, turn @ first_turn.inverted()):  # a parent may shear what it turns
                turn = _turn_between(first, matrix) @ first_turn
                if not _is_turned(first, matrix, turn @ first_turn.inverted()):
                    raise SheetError(f'"{thing.name}" changes its size at frame {frame}: solids move, but stay as they'
                                     " are")
            rows.append(((frame - now) / rate, *(length * place), *turn))
    finally:
        scene.frame_set(now)
    return np.array(rows)


def _is_turned(first: Matrix, now: Matrix, turn: Quaternion) -> bool:
    """Whether a matrix is another one with this turn before it, but for places."""
    before, after = turn.to_matrix() @ first.to_3x3(), now.to_3x3()
    size = max(row.length for row in after)
    return all((a - b).length <= 1e-4 * size for a, b in zip(before, after))


def _turn_between(first: Matrix, now: Matrix) -> Quaternion:
    try:
        return (now.to_3x3() @ first.to_3x3().inverted()).to_quaternion()
    except ValueError:  # it is flat
        return Quaternion()


def changes_shape(thing: bpy.types.Object, scene: bpy.types.Scene) -> bool:
    """Whether an object has another shape, in its own frame, at the scene's last frame or halfway there than now."""
    data = thing.data
    if thing.type not in WITH_SURFACE or not (thing.modifiers or getattr(data, "shape_keys", None) or
                                              data.animation_data):
        return False
    now = scene.frame_current
    shapes = []
    try:
        for frame in sorted({now, (now + scene.frame_end) // 2, max(now, scene.frame_end)}):
            scene.frame_set(frame)
            with surface_of(thing) as mesh:
                x = np.empty(3 * len(mesh.vertices), np.float32)
                mesh.vertices.foreach_get("co", x)
                shapes.append(x)
    finally:
        scene.frame_set(now)
    first = shapes[0]
    size = max(float(np.ptp(first.reshape(-1, 3), axis=0).max()), 1e-30)
    return any(len(x) != len(first) or float(np.abs(x - first).max()) > 1e-5 * size for x in shapes[1:])


def export_motion(path: str, thing: bpy.types.Object) -> None:
    """Writes an object's motion from the scene's frame on (motion_of) as a file (.csv) for scenes: motion = {kind =
    "keyframed", file = "..."}. Raises SheetError."""
    write_rows(pathlib.Path(path), motion_of(thing, bpy.context.scene))


def write_rows(path: pathlib.Path, rows: Any) -> None:
    lines = ["time [s], x [m], y [m], z [m], qw, qx, qy, qz", *(", ".join(repr(float(v)) for v in r) for r in rows)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
