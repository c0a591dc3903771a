# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panel in the Physics tab does, as a script: a printed sheet of two materials drapes over a ball, and a
picture of it by Cycles.

    blender -b --factory-startup --python-exit-code 1 --python example_simulate.py -- drape.blend drape.png
"""
import argparse
import pathlib
import sys

import bpy
from mathutils import Vector


def look_at(thing, target):
    thing.rotation_euler = (Vector(target) - thing.location).to_track_quat("-Z", "Y").to_euler()


def material(name, colour, texture=None):
    made = bpy.data.materials.new(name)
    if made.node_tree is None:  # before Blender 5.0
        made.use_nodes = True
    made.diffuse_color = (*colour, 1)
    surface = made.node_tree.nodes["Principled BSDF"]
    surface.inputs["Base Color"].default_value, surface.inputs["Roughness"].default_value = (*colour, 1), 0.3
    if texture is not None:
        node = made.node_tree.nodes.new("ShaderNodeTexImage")
        node.image = texture
        made.node_tree.links.new(node.outputs["Color"], surface.inputs["Base Color"])
    return made


def model():
    """A sheet with a texture on its left and a plain colour on its right, above a ball."""
    for old in list(bpy.data.objects):
        if old.type == "MESH":
            bpy.data.objects.remove(old)
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.08, location=(0, 0, 0.02), segments=48, ring_count=24)
    bpy.ops.object.shade_smooth()
    ball = bpy.context.object
    ball.name = "Ball"
    ball.data.materials.append(material("Porcelain", (0.8, 0.8, 0.75)))
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=20, y_subdivisions=20, size=0.3, location=(0, 0, 0.11))
    cloth = bpy.context.object
    cloth.name = "Cloth"
    grid = bpy.data.images.new("Grid", 512, 512)
    grid.generated_type = "COLOR_GRID"
    cloth.data.materials.append(material("Printed", (0.2, 0.4, 0.8), grid))
    cloth.data.materials.append(material("Plain", (0.7, 0.15, 0.05)))
    for face in cloth.data.polygons:
        face.material_index = int(face.center.x > 0.03)
    return cloth, ball


def choose(scene, cloth, ball, frames):
    """What a user chooses in the panel."""
    scene.render.fps, scene.frame_start, scene.frame_end = 50, 1, frames
    cloth.sheet_part.role, ball.sheet_part.role = "SHEET", "SOLID"
    cloth.sheet_part.thickness, cloth.sheet_part.edges = 0.006, 0.008
    scene.sheet_run.liquid = "honey"
    scene.sheet_run.viscosity, scene.sheet_run.liquid = 600, "own"


def render(scene, picture, size=(480, 360), samples=32):
    camera = scene.camera
    camera.data.lens, camera.location = 60, (0.3, -0.5, 0.4)
    look_at(camera, (0, 0, -0.01))
    lamp = next(thing for thing in scene.objects if thing.type == "LIGHT")
    lamp.data.type, lamp.data.energy, lamp.location = "SUN", 3, (1, -1, 2)
    look_at(lamp, (0, 0, 0))
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.5, 0.55, 0.6, 1)
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", samples, False
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = *size, 100
    scene.view_settings.view_transform = "Standard"
    scene.render.filepath = str(pathlib.Path(picture).resolve())
    bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="example_simulate.py", description="simulates and draws a sheet on a ball")
    parser.add_argument("blend", help="file to save; the run is kept beside it")
    parser.add_argument("picture")
    parser.add_argument("--frames", type=int, default=40)
    parser.add_argument("--size", default="480x360")
    parser.add_argument("--samples", type=int, default=32)
    options = parser.parse_args(sys.argv[sys.argv.index("--") + 1:])
    here = pathlib.Path(__file__).resolve().parent
    sys.path[:0] = [str(here), str(here.parent / "python")]
    import sheet_blender
    sheet_blender.register()
    bpy.ops.wm.save_as_mainfile(filepath=str(pathlib.Path(options.blend).resolve()))
    choose(bpy.context.scene, *model(), options.frames)
    bpy.ops.sheet.check()
    bpy.ops.sheet.simulate()
    bpy.ops.wm.save_mainfile()
    render(bpy.context.scene, options.picture, tuple(map(int, options.size.split("x"))), options.samples)
