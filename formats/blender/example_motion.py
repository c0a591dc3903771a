# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene whose spoon is animated in Blender: it dips into a sheet, draws through it, turns and comes out again.

    blender -b --factory-startup --python-exit-code 1 --python example_motion.py -- spoon.toml
"""
import math
import pathlib
import sys

import bmesh
import bpy
import numpy as np
from mathutils import Matrix

here = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(here), str(here.parent / "python")]
import sheet_blender  # noqa: E402


def add(name, made):
    mesh = bpy.data.meshes.new(name)
    made.to_mesh(mesh)
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def make_sheet():
    """30 cm wide, 6 mm thick, its rim held."""
    made = bmesh.new()
    bmesh.ops.create_grid(made, x_segments=24, y_segments=24, size=0.15)
    bmesh.ops.triangulate(made, faces=made.faces, quad_method="ALTERNATE")
    sheet = add("sheet", made)
    rim = [v.index for v in made.verts if v.is_boundary]
    sheet.vertex_groups.new(name="pinned rim").add(rim, 1.0, "REPLACE")
    return sheet


def make_spoon():
    """A bowl, an ellipsoid around the object's origin, whose neck rises to a handle."""
    made = bmesh.new()
    bmesh.ops.create_uvsphere(made, u_segments=48, v_segments=24, radius=1.0)
    for vertex in made.verts:
        x, y, z = vertex.co
        vertex.co = (0.036 * x, 0.024 * y, 0.012 * z)
        if x > 0.9:  # drawn out
            way = (x - 0.9) / 0.1
            vertex.co.x += 0.14 * way
            vertex.co.z += 0.02 * way * way
    return add("spoon", made)


def animate(spoon):
    """Down, along, up again while it turns; Blender eases between these keys."""
    spoon.rotation_mode = "XYZ"
    for frame, place, tilt, turn in ((1, (-0.06, 0, 0.03), -25, 0), (8, (-0.06, 0, -0.03), -15, 0),
                                     (17, (0.04, 0.03, -0.04), -20, 70), (25, (0.04, 0.03, 0.04), -35, 100)):
        spoon.location = place
        spoon.rotation_euler = (0, math.radians(tilt), math.radians(turn))
        spoon.keyframe_insert("location", frame=frame)
        spoon.keyframe_insert("rotation_euler", frame=frame)


for old in list(bpy.data.objects):
    bpy.data.objects.remove(old)
scene = bpy.context.scene
scene.render.fps, scene.frame_start, scene.frame_end = 24, 1, 25
sheet, spoon = make_sheet(), make_spoon()
animate(spoon)
scene.frame_set(1)
print(*sheet_blender.export_scene(sys.argv[-1], sheet, thickness=0.006, viscosity=8000.0, solids=(spoon,)))
