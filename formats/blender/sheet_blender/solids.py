# SPDX-License-Identifier: GPL-3.0-or-later
"""The solids of a run's scene, as objects."""
from __future__ import annotations

import math
import pathlib
from typing import Any

import bmesh
import bpy
import numpy as np
from mathutils import Matrix, Quaternion, Vector

from . import body_files
from .compat import fcurves_of


def add_solids(described: dict[str, Any], parent: bpy.types.Object, scene: bpy.types.Scene) -> None:
    """Adds the scene's balls, boxes, cylinders, capsules, planes and meshes (OFF) in their places at time 0, as the
    parent's children; motion at a constant velocity, about an axis at a constant rate, or by rows is keyed. Others are
    passed over, with a word on the terminal."""
    solids = described.get("solid", [])
    for number, solid in enumerate(solids if isinstance(solids, list) else []):
        try:
            _add_solid(solid, number, parent, scene)
        except (KeyError, TypeError, ValueError, AttributeError, OSError) as error:
            print(f"Sheet: {parent.name}: solid {number} is passed over: {error}")


def _add_solid(solid: dict[str, Any], number: int, parent: bpy.types.Object, scene: bpy.types.Scene) -> None:
    mesh = _solid_mesh(solid, parent.sheet.file)
    thing = bpy.data.objects.new(f"{parent.name} {solid['shape']} {number}", mesh)
    scene.collection.objects.link(thing)
    thing.parent = parent
    turn = solid.get("rotation", {})
    if turn:
        thing.rotation_mode = "AXIS_ANGLE"
        thing.rotation_axis_angle = (turn["angle"], *turn["axis"])
    thing.location = solid.get("center", (0, 0, 0))
    motion = solid.get("motion", {})
    if motion.get("kind") == "keyframed":
        _key_rows(thing, motion, parent.sheet, scene)
        return
    turning = motion.get("kind") == "rotating" and np.ndim(motion["rate"]) == 0
    moved = _put_on_axis(thing, motion, parent, scene) if turning else thing
    velocity = motion.get("velocity", [0, 0, 0])
    velocity = np.array(velocity if np.shape(velocity) == (3,) else (0, 0, 0), float)
    if turning or velocity.any():
        _key_motion(moved, velocity, motion["rate"] if turning else None, parent.sheet, scene)


def _put_on_axis(thing: bpy.types.Object, motion: dict[str, Any], parent: bpy.types.Object,
                 scene: bpy.types.Scene) -> bpy.types.Object:
    """An empty on the axis about which it turns, whose child it becomes."""
    axis = bpy.data.objects.new(f"{thing.name} axis", None)
    scene.collection.objects.link(axis)
    axis.parent, thing.parent = parent, axis
    axis.location = motion["center"]
    axis.empty_display_size = 0.001
    thing.location -= axis.location
    axis.rotation_mode = "AXIS_ANGLE"
    axis.rotation_axis_angle = (0, *Vector(motion["axis"]).normalized())
    return axis


def _key_rows(thing: bpy.types.Object, motion: dict[str, Any], settings: Any, scene: bpy.types.Scene) -> None:
    """A key for each row; between them on straight lines, which the run's motion leaves by little."""
    times = motion["times"]
    still = [motion.get("center", (0, 0, 0))] * len(times)
    frames = [Matrix.LocRotScale(Vector(place), Quaternion(turn), None) for place, turn in
              zip(motion.get("places", still), motion.get("rotations", [(1, 0, 0, 0)] * len(times)))]
    first = next((i for i, time in enumerate(times) if time >= 0), -1)
    if times[first] > 0 and first > 0:
        raise ValueError("its motion has no row at time 0")
    own = frames[first].inverted() @ thing.matrix_basis
    rate = scene.render.fps / scene.render.fps_base
    thing.rotation_mode = "QUATERNION"
    for time, frame in zip(times, frames):
        thing.location, turn, _ = (frame @ own).decompose()
        turn.make_compatible(thing.rotation_quaternion)
        thing.rotation_quaternion = turn
        at = settings.start + (time - settings.first_time) / settings.speed * rate
        thing.keyframe_insert("location", frame=at)
        thing.keyframe_insert("rotation_quaternion", frame=at)
    for curve in fcurves_of(thing):
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"


def _key_motion(thing: bpy.types.Object, velocity: Any, turning: float | None, settings: Any,
                scene: bpy.types.Scene) -> None:
    rate = scene.render.fps / scene.render.fps_base
    origin = np.array(thing.location)
    for frame in (settings.start, settings.start + 1000):
        time = settings.first_time + (frame - settings.start) / rate * settings.speed
        thing.location = origin + velocity * time
        thing.keyframe_insert("location", frame=frame)
        if turning is not None:
            thing.rotation_axis_angle[0] = turning * time
            thing.keyframe_insert("rotation_axis_angle", frame=frame)
    for curve in fcurves_of(thing):
        curve.extrapolation = "LINEAR"
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"


def _solid_mesh(solid: dict[str, Any], run_file: str) -> bpy.types.Mesh:
    shape = solid["shape"]
    if shape == "mesh" and solid["file"].lower().endswith((".off", ".ply")):
        return _mesh_of_file(solid, run_file)
    made = bmesh.new()
    if shape == "sphere":
        bmesh.ops.create_icosphere(made, subdivisions=5, radius=solid["radius"])
    elif shape == "box":
        bmesh.ops.create_cube(made, size=1.0)
        bmesh.ops.scale(made, vec=solid["size"], verts=made.verts)
    elif shape == "cylinder":
        bmesh.ops.create_cone(made, cap_ends=True, segments=96, radius1=solid["radius"], radius2=solid["radius"],
                              depth=solid["height"])
        bmesh.ops.rotate(made, matrix=Matrix.Rotation(math.pi / 2, 3, "X"), verts=made.verts)  # stands along y
    elif shape == "capsule":
        bmesh.ops.create_uvsphere(made, u_segments=64, v_segments=32, radius=solid["radius"])
        bmesh.ops.rotate(made, matrix=Matrix.Rotation(math.pi / 2, 3, "X"), verts=made.verts)  # stands along y
        bmesh.ops.translate(made, vec=(0, solid["length"] / 2, 0), verts=[v for v in made.verts if v.co.y > 1e-9])
        bmesh.ops.translate(made, vec=(0, -solid["length"] / 2, 0), verts=[v for v in made.verts if v.co.y < -1e-9])
    elif shape == "plane":
        bmesh.ops.create_grid(made, x_segments=1, y_segments=1, size=50.0)
        turn = Vector((0, 0, 1)).rotation_difference(Vector(solid.get("normal", (0, 0, 1))))
        bmesh.ops.rotate(made, matrix=turn.to_matrix(), verts=made.verts)
    else:
        made.free()
        raise ValueError(f"its shape is not drawn here: {shape}")
    mesh = bpy.data.meshes.new(f"Sheet {shape}")
    made.to_mesh(mesh)
    made.free()
    if shape in ("sphere", "capsule"):
        mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), bool))
    return mesh


def _mesh_of_file(solid: dict[str, Any], run_file: str) -> bpy.types.Mesh:
    """A mesh of triangles in OFF or PLY (binary, as export writes it), beside the run or above it, with or without the
    folders of its name."""
    folder = pathlib.Path(bpy.path.abspath(run_file)).resolve().parent
    name = pathlib.Path(solid["file"])
    places = [place / part for place in (folder, *folder.parents) for part in (name, name.name)]
    found = next((place for place in places if place.is_file()), None)
    if found is None:
        raise ValueError(f"{name} is neither beside the run nor above it")
    x, corners = _read_ply(found) if found.suffix.lower() == ".ply" else _read_off(found)
    mesh = bpy.data.meshes.new("Sheet mesh")
    mesh.from_pydata((x * solid.get("scale", 1.0)).tolist(), [], corners.tolist())
    return mesh


def _read_ply(found: pathlib.Path) -> tuple[Any, Any]:
    try:
        body = body_files.read_body(found)
    except body_files.BodyError as error:
        raise ValueError(str(error)) from error
    return np.asarray(body.position, float), body.triangle


def _read_off(found: pathlib.Path) -> tuple[Any, Any]:
    numbers = " ".join(line.split("#")[0] for line in found.read_text().splitlines()).split()
    if len(numbers) < 4 or numbers[0] != "OFF":
        raise ValueError(f"{found} does not begin with OFF")
    points, faces = int(numbers[1]), int(numbers[2])
    x = np.array(numbers[4:4 + 3 * points], float).reshape(-1, 3)
    corners = np.array(numbers[4 + 3 * points:4 + 3 * points + 4 * faces], int).reshape(-1, 4)
    if (corners[:, 0] != 3).any() or corners.min() < 0 or corners[:, 1:].max() >= points:
        raise ValueError(f"{found} has other faces than triangles of its vertices")
    return x, corners[:, 1:]
