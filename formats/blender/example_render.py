# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture of a run by Cycles, without a window:

    blender -b --factory-startup --python-exit-code 1 --python example_render.py -- run.sheet picture.png --frame 12
"""
import argparse
import pathlib
import sys

import bpy
import numpy as np
from mathutils import Vector

here = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(here), str(here.parent / "python")]
import sheet_blender  # noqa: E402

parser = argparse.ArgumentParser(prog="example_render.py", description="renders a frame of a run")
parser.add_argument("run")
parser.add_argument("picture")
parser.add_argument("--frame", type=int, help="Blender's frame, from 1 (default: the last)")
parser.add_argument("--material", default="caramel")
parser.add_argument("--size", default="480x270")
parser.add_argument("--samples", type=int, default=64)
parser.add_argument("--blur", action="store_true", help="motion blur, by the sheet's velocity")
options = parser.parse_args(sys.argv[sys.argv.index("--") + 1:])


def look_at(thing, target):
    thing.rotation_euler = (Vector(target) - thing.location).to_track_quat("-Z", "Y").to_euler()


def add_light(scene, place, target, size, power):
    light = bpy.data.objects.new("Light", bpy.data.lights.new("Light", "AREA"))
    light.data.size, light.data.energy, light.location = size, power, place
    look_at(light, target)
    scene.collection.objects.link(light)


def light_and_camera(scene, thing):
    """A camera that sees all of the object at the scene's frame, a key light, and a bright sky."""
    corners = np.array([thing.matrix_world @ v.co for v in thing.data.vertices])
    middle = (corners.min(axis=0) + corners.max(axis=0)) / 2
    radius = max(float(np.linalg.norm(corners - middle, axis=1).max()), 1e-6)
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.sensor_fit, camera.data.angle = "VERTICAL", 0.36  # 2 asin(1 / 5.7): all of the ball around it
    camera.data.clip_start, camera.data.clip_end = 0.01 * radius, 1000 * radius
    camera.location = Vector(middle) + 5.7 * radius * Vector((0.5, -0.78, 0.36)).normalized()
    look_at(camera, middle)
    scene.collection.objects.link(camera)
    scene.camera = camera
    add_light(scene, Vector(middle) + 4 * radius * Vector((-0.8, -0.5, 1)), middle, 3 * radius, 400 * radius**2)
    scene.world = scene.world or bpy.data.worlds.new("World")
    if scene.world.node_tree is None:  # before Blender 5.0
        scene.world.use_nodes = True
    sky = scene.world.node_tree.nodes["Background"].inputs
    sky["Color"].default_value, sky["Strength"].default_value = (0.75, 0.85, 1, 1), 0.8


sheet_blender.register()
for old in list(bpy.data.objects):
    bpy.data.objects.remove(old)
scene = bpy.context.scene
scene.render.engine = "CYCLES"
try:
    thing = sheet_blender.import_run(options.run, options.material)
except sheet_blender.SheetError as error:
    sys.exit(f"example_render.py: {error}")
scene.frame_set(scene.frame_end if options.frame is None else options.frame)
light_and_camera(scene, thing)
scene.render.resolution_x, scene.render.resolution_y = map(int, options.size.split("x"))
scene.render.resolution_percentage = 100
scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.sample_clamp_indirect = options.samples, False, 1.0
scene.render.use_motion_blur, scene.render.motion_blur_shutter = options.blur, 0.25
scene.view_settings.view_transform = "Standard"
scene.render.filepath = str(pathlib.Path(options.picture).resolve())
bpy.ops.render.render(write_still=True)
