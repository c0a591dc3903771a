# SPDX-License-Identifier: GPL-3.0-or-later
"""The drops of a run: an object beside the sheet's, one mesh of a ball for each."""
from __future__ import annotations

import math
from typing import Any

import bmesh
import bpy
import numpy as np

from .compat import sheetstream
from .meshes import fill_balls, set_slots

SUBDIVISIONS = 3  # of the icosahedron: 320 triangles a ball


def has_drops(described: dict[str, Any]) -> bool:
    """Whether a scene's tables ask for drops."""
    tear = described.get("tear")
    return isinstance(tear, dict) and tear.get("drops") is True


def add_drops(thing: bpy.types.Object) -> None:
    """Gives an object that follows a run another one, in the same collections, which shows its drops, with its
    materials."""
    name = f"{thing.name} drops"
    drops = bpy.data.objects.new(name, bpy.data.meshes.new(name))
    for collection in thing.users_collection:
        collection.objects.link(drops)
    drops.parent = thing
    for material in thing.data.materials:
        drops.data.materials.append(material)
    thing.sheet.drops = drops


def follow_drops(thing: bpy.types.Object, frame: sheetstream.Frame, ahead: float, velocity_scale: float) -> None:
    """Brings the object of an object's drops, if it has one, to a frame of its run, gone on for the time `ahead` [s]
    with their velocities."""
    drops = thing.sheet.drops
    if drops is None:
        return
    volume = frame["drop_volume"] if "drop_volume" in frame else np.zeros(0)
    if not len(volume):
        fill_balls(drops.data, np.zeros((0, 3)), np.zeros(0), np.zeros((0, 3)), ball())
        return
    velocity = frame["drop_velocity"]
    fill_balls(drops.data, frame["drop_position"] + ahead * velocity, np.cbrt(3 * volume / (4 * math.pi)),
               velocity_scale * velocity, ball())
    if thing.sheet.by_liquid and "drop_liquid" in frame:
        set_slots(drops.data, np.repeat(frame["drop_liquid"], len(drops.data.polygons) // len(volume)))


def ball() -> tuple[Any, Any]:
    """Positions and triangles of a ball with the volume of one of radius 1."""
    made = bmesh.new()
    try:
        bmesh.ops.create_icosphere(made, subdivisions=SUBDIVISIONS, radius=1.0)
        scale = (4 * math.pi / 3 / made.calc_volume(signed=True)) ** (1 / 3)
        return (scale * np.array([vertex.co for vertex in made.verts]),
                np.array([[vertex.index for vertex in face.verts] for face in made.faces]))
    finally:
        made.free()
