# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender gets of each frame, as a line "rows [...]", see readers.py:
    blender -b --factory-startup --python-exit-code 1 --python in_blender.py -- run|gltf ROOT RUN|FOLDER
"""
import json
import pathlib
import sys

import bpy
import numpy as np

how, root, file = sys.argv[sys.argv.index("--") + 1:]
sys.path[:0] = [f"{root}/formats/blender", f"{root}/formats/python"]


def numbers(data, name, width, kind=np.float32):
    values = np.empty(len(data) * width, kind)
    data.foreach_get(name, values)
    return values.reshape(-1, width).astype(float if kind is np.float32 else kind)


def row(time, mesh, thickness, weights):
    return [time, len(mesh.vertices), len(mesh.polygons), thickness.min(), (thickness * weights).sum() / weights.sum(),
            thickness.max()]


def areas(mesh):
    return numbers(mesh.polygons, "area", 1)[:, 0]


def of_run():
    import sheet_blender
    sheet_blender.register()
    scene = bpy.context.scene
    scene.render.fps = 24
    thing = sheet_blender.import_run(file)
    for frame in range(1, scene.frame_end + 1):
        scene.frame_set(frame)
        thickness = numbers(thing.data.attributes["triangle_thickness"].data, "value", 1)[:, 0]
        yield row((frame - 1) / scene.render.fps, thing.data, thickness, areas(thing.data))


def of_gltf():
    for glb in sorted(pathlib.Path(file).glob("*.glb")):
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        # the shading that is the importer's default needs an older numpy than Debian 12 has
        bpy.ops.import_scene.gltf(filepath=str(glb), import_shading="SMOOTH")
        mesh = next(thing.data for thing in bpy.data.objects if thing.type == "MESH")
        corners = numbers(mesh.loops, "vertex_index", 1, np.int32)[:, 0]
        thickness = numbers(mesh.uv_layers[0].data, "uv", 2)[:, 0]  # at the corners
        at_vertices = np.zeros(len(mesh.vertices))
        at_vertices[corners] = thickness
        around = np.bincount(corners, np.repeat(areas(mesh), 3), len(mesh.vertices))
        yield row(bpy.context.scene["time"], mesh, at_vertices, around)


print("rows", json.dumps(list(of_run() if how == "run" else of_gltf())))
