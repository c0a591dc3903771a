# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of simulating in Blender have in common: a scene to begin with, and what meshes have in them."""
import os
import pathlib
import sys
import tempfile
import time
import unittest

import bpy
import numpy as np

archive = sys.argv[sys.argv.index("--") + 1]
FPS = 24


def loop_values(data, name, width):
    values = np.empty(width * len(data), np.float32)
    data.foreach_get(name, values)
    return values.reshape(-1, width)


def places_of(mesh):
    return loop_values(mesh.vertices, "co", 3)


def corners_of(mesh):
    corners = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    return corners.reshape(-1, 3)


def uv_of(mesh, name="UVMap"):
    return loop_values(mesh.uv_layers[name].data, "uv", 2).reshape(-1, 3, 2)


def add_on():
    """The add-on, installed from the zip file that users install, and switched on."""
    bpy.ops.preferences.addon_install(filepath=archive)
    bpy.ops.preferences.addon_enable(module="sheet_blender")
    import sheet_blender
    return sheet_blender


class Case(unittest.TestCase):
    """An empty scene of six frames, and what tests put into it."""

    @classmethod
    def setUpClass(cls):
        cls.add_on = add_on()

    def setUp(self):
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        self.scene = bpy.context.scene
        self.scene.render.fps, self.scene.frame_start, self.scene.frame_end = FPS, 1, 6
        self.folder = pathlib.Path(tempfile.mkdtemp(dir=os.getcwd()))

    def save(self):
        bpy.ops.wm.save_as_mainfile(filepath=str(self.folder / "kept.blend"))

    def cloth(self, size=0.4, cuts=10, height=0.2):
        """A square above the origin, with UV, two materials and a colour, in a collection of its own."""
        bpy.ops.mesh.primitive_grid_add(x_subdivisions=cuts, y_subdivisions=cuts, size=size, location=(0, 0, height))
        thing = bpy.context.object
        thing.name = "Cloth"
        own = bpy.data.collections.new("Liquid")
        self.scene.collection.children.link(own)
        for collection in thing.users_collection:
            collection.objects.unlink(thing)
        own.objects.link(thing)
        for name in ("Left", "Right"):
            thing.data.materials.append(bpy.data.materials.new(name))
        for face in thing.data.polygons:
            face.material_index = int(face.center.x > 0)
        colour = thing.data.color_attributes.new("Tint", "FLOAT_COLOR", "POINT")
        x = places_of(thing.data)
        colour.data.foreach_set("color", np.concatenate([x + 0.5, np.ones((len(x), 1))], 1).astype(np.float32).ravel())
        thing.sheet_part.role, thing.sheet_part.thickness = "SHEET", 0.02
        return thing

    def ball(self):
        bpy.ops.mesh.primitive_uv_sphere_add(radius=0.1, location=(0, 0, 0), segments=16, ring_count=8)
        bpy.context.object.sheet_part.role = "SOLID"
        return bpy.context.object

    def wait_for_frames(self, folder, frames):
        for _ in range(300):
            if self.add_on.cache.progress_of(folder).frames >= frames:
                return
            time.sleep(0.1)
        self.fail((folder / "log.txt").read_text())

    def told(self):
        folder = self.folder / "told"
        return "\n".join(self.add_on.simulate.write_here(folder, self.scene).told)

    def refused(self, pattern, operator, **options):
        with self.assertRaisesRegex(RuntimeError, pattern):
            operator(**options)


def run_all():
    """The tests of the script that is run; ONLY in the environment is a part of the names of those that are."""
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        names = os.environ.get("ONLY")
        loader = unittest.defaultTestLoader
        loader.testNamePatterns = [f"*{names}*"] if names else None
        good = unittest.TextTestRunner(stream=sys.stdout, verbosity=2).run(
            loader.loadTestsFromModule(sys.modules["__main__"])).wasSuccessful()
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        os.chdir("/")
        if not good:
            raise SystemExit(1)
