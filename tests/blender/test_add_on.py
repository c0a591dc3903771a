# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on of formats/blender in a Blender without a window, installed from the zip file that users install: what it
imports against sheet-info, what it exports through sheet-init, its errors, and a picture.

    blender -b --factory-startup --python-exit-code 1 --python test_add_on.py -- sheet-blender.zip
"""
import csv
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import bmesh
import bpy
import numpy as np
from mathutils import Quaternion, Vector

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from simulating import FPS, add_on, archive

root = pathlib.Path(__file__).resolve().parents[2]


def shell(command):
    done = subprocess.run(["bash", "-ec", "set -o pipefail; " + command], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def attribute(mesh, name, width=1):
    data = mesh.attributes[name].data
    values = np.empty(len(data) * width, np.float32)
    data.foreach_get("vector" if width == 3 else "value", values)
    return values.reshape(-1, width) if width > 1 else values


def corners_of(mesh):
    corners = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    return corners.reshape(-1, 3)


def places_of(mesh):
    places = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", places)
    return places.reshape(-1, 3)


def shown_volume(thing):
    """Volume inside of what modifiers make of the object; outward triangles count as positive."""
    evaluated = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    made = bmesh.new()
    made.from_mesh(evaluated.to_mesh())
    volume = made.calc_volume(signed=True)
    made.free()
    evaluated.to_mesh_clear()
    return volume


class AddOn(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.add_on = add_on()
        assert pathlib.Path(cls.add_on.__file__).is_relative_to(os.environ["BLENDER_USER_SCRIPTS"])
        shell("sheet-init --example | sed 's/^edge_length = .*/edge_length = 0.1/' > scene.toml; "
              f"sheet-init scene.toml | sheet-loop -q --until 0.3 --fps {FPS} -o run.sheet -- "
              "'sheet-remesh | sheet-step | sheet-collide'; sheet-info --csv run.sheet > run.csv")
        with open("run.csv") as file:
            cls.rows = [{k: float(v) for k, v in row.items() if v} for row in csv.DictReader(file)]
        cls.run_of = cls.add_on.sheetstream.Run("run.sheet")

    def setUp(self):
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        bpy.context.scene.render.fps = FPS

    def test_every_frame_is_what_sheet_info_says(self):
        thing = self.add_on.import_run("run.sheet")
        scene = bpy.context.scene
        self.assertEqual((scene.frame_end, scene.unit_settings.system), (len(self.rows), "METRIC"))
        self.assertGreater(len({row["vertices"] for row in self.rows}), 2)
        order = [*range(len(self.rows)), 3, 0, 5]  # backwards, too
        for i in order:
            row, frame = self.rows[i], self.run_of[i]
            scene.frame_set(1 + i)
            mesh = thing.data
            self.assertEqual((len(mesh.vertices), len(mesh.polygons)), (row["vertices"], row["triangles"]))
            self.assertFalse(mesh.validate())
            np.testing.assert_array_equal(corners_of(mesh), frame["triangle"])
            np.testing.assert_allclose(places_of(mesh), frame["position"], atol=1e-6)
            area, volume = np.array([p.area for p in mesh.polygons]), attribute(mesh, "triangle_thickness")
            self.assertAlmostEqual(area.sum() / row["area"], 1, places=5)
            self.assertAlmostEqual((area * volume).sum() / row["volume"], 1, places=5)
            self.assertAlmostEqual(volume.min() / row["thickness_min"], 1, places=5)
            self.assertAlmostEqual(volume.max() / row["thickness_max"], 1, places=5)
            speed = np.linalg.norm(attribute(mesh, "velocity", 3), axis=1).max()
            self.assertAlmostEqual(speed, np.linalg.norm(frame.velocity(), axis=1).max(), places=5)
            self.assertIn(f"{row['time']:.4g} s", thing.sheet.message)
            touching = attribute(mesh, "touch").sum()
            self.assertEqual(touching, np.count_nonzero(frame["touch"]) if "touch" in frame else 0)
        self.assertGreater(np.count_nonzero(self.run_of[-1]["touch"]), 0)

    def test_the_slab_has_the_volume_and_stands_upright(self):
        thing = self.add_on.import_run("run.sheet")
        for i, tolerance in ((0, 1e-4), (len(self.rows) - 1, 0.03)):
            bpy.context.scene.frame_set(1 + i)
            self.assertAlmostEqual(shown_volume(thing) / self.rows[i]["volume"], 1, delta=tolerance)
        self.assertAlmostEqual((thing.matrix_world.to_3x3() @ Vector((0, 1, 0))).z, 1, places=6)  # gravity is along -y

    def test_time_between_frames_speed_and_start(self):
        thing = self.add_on.import_run("run.sheet", start=10, speed=0.5)
        bpy.context.scene.frame_set(10)
        np.testing.assert_allclose(places_of(thing.data), self.run_of[0]["position"], atol=1e-6)
        bpy.context.scene.frame_set(13)  # 1.5 frames of the run
        first, second = self.run_of[1], self.run_of[2]
        half = first["position"] + first.velocity() * 0.5 / FPS
        if np.array_equal(first["triangle"], second["triangle"]):
            half = (first["position"] + second["position"]) / 2
        np.testing.assert_allclose(places_of(thing.data), half, atol=1e-6)
        np.testing.assert_allclose(attribute(thing.data, "velocity", 3), 0.5 * first.velocity(), atol=1e-6)
        thing.sheet.between = False
        np.testing.assert_allclose(places_of(thing.data), first["position"], atol=1e-6)

    def test_a_saved_file_goes_on_to_follow_its_run(self):
        self.assertEqual(bpy.ops.sheet.import_run(filepath=os.path.abspath("run.sheet"), material="honey"), {"FINISHED"})
        bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath("kept.blend"))
        bpy.ops.wm.open_mainfile(filepath=os.path.abspath("kept.blend"))
        bpy.context.scene.frame_set(len(self.rows))
        self.assertEqual(len(bpy.data.objects["run"].data.vertices), self.rows[-1]["vertices"])
        self.assertEqual(bpy.data.objects["run"].data.materials[0].name, "Sheet honey")

    def test_drops_are_balls_that_follow_the_time(self):
        shell(f"sheet-init {root}/tests/features/drops.toml | sheet-loop -q --until 0.05 --fps 100 -o drops.sheet -- "
              "'sheet-remesh --smooth --edge-length 0.004 | sheet-tear | sheet-emit | sheet-step --tolerance 0.05 | "
              "sheet-collide'")
        run = self.add_on.sheetstream.Run("drops.sheet")
        thing = self.add_on.import_run("drops.sheet", material="honey", speed=FPS / 100)
        drops = thing.sheet.drops
        self.assertEqual((drops.parent, drops.data.materials[0].name), (thing, "Sheet honey"))
        counts = set()
        for i in [*range(len(run)), 2, 0]:  # backwards, too
            bpy.context.scene.frame_set(1 + i)
            frame, mesh = run[i], drops.data
            volume = frame["drop_volume"] if "drop_volume" in frame else np.zeros(0)
            counts.add(len(volume))
            self.assertFalse(mesh.validate())
            self.assertEqual(len(mesh.polygons), 320 * len(volume))
            if len(volume):
                places = places_of(mesh).reshape(len(volume), -1, 3)
                np.testing.assert_allclose(places.mean(axis=1), frame["drop_position"], atol=1e-6)
                self.assertAlmostEqual(shown_volume(drops) / volume.sum(), 1, places=4)
                velocity = attribute(mesh, "velocity", 3).reshape(len(volume), -1, 3)
                np.testing.assert_allclose(velocity[:, 0], FPS / 100 * frame["drop_velocity"], atol=1e-6)
        self.assertGreater(len(counts), 2)
        bpy.context.scene.frame_set(2, subframe=0.5)
        frame = run[1]
        places = places_of(drops.data).reshape(len(frame["drop_volume"]), -1, 3).mean(axis=1)
        np.testing.assert_allclose(places, frame["drop_position"] + 0.005 * frame["drop_velocity"], atol=1e-6)
        self.assertIsNone(self.add_on.import_run("run.sheet").sheet.drops)

    def test_drops_have_the_material_of_their_liquid(self):
        drops = {"drop_position": np.zeros((3, 3)), "drop_velocity": np.zeros((3, 3)), "drop_volume": np.ones(3),
                 "drop_liquid": np.array([1, 0, 1], np.uint32)}
        thing = self.add_on.import_run("run.sheet", material="chocolate,honey")
        self.add_on.follow.add_drops(thing)
        self.add_on.follow.follow_drops(thing, drops, 0.0, 1.0)
        mesh = thing.sheet.drops.data
        slots = np.array([face.material_index for face in mesh.polygons]).reshape(3, -1)
        np.testing.assert_array_equal(slots, np.repeat([[1], [0], [1]], slots.shape[1], axis=1))

    def test_solids_stand_where_the_scene_has_them(self):
        shell("sed 's/^radius = \"0.2 m\"/&\\nmotion = {kind = \"translating\", velocity = [0.4, 0, 0]}/' scene.toml > moving.toml;"
              "printf '[[solid]]\\nshape = \"capsule\"\\nradius = 0.1\\nlength = 0.4\\ncenter = [2, 0, 0]\\n' >> moving.toml;"
              "sheet-init moving.toml -o moving.sheet")
        self.add_on.import_run("moving.sheet")
        ball, capsule = bpy.data.objects["moving sphere 0"], bpy.data.objects["moving capsule 1"]
        bpy.context.scene.frame_set(1 + FPS)
        np.testing.assert_allclose(ball.matrix_world.translation, (0.4, 0, -0.3), atol=1e-6)
        np.testing.assert_allclose(sorted(ball.dimensions), [0.4] * 3, rtol=1e-3)
        np.testing.assert_allclose(sorted(capsule.dimensions), [0.2, 0.2, 0.6], rtol=1e-2)

    def test_a_wheel_rolls(self):
        shell("cat scene.toml - > wheel.toml << 'END'\n[[solid]]\nshape = \"box\"\nsize = [0.2, 0.4, 0.3]\ncenter = [1, -1, 0]\n"
              "velocity = [0.6, 0, 0]\nangular_velocity = [0, 0, -3]\nEND\nsheet-init wheel.toml -o wheel.sheet")
        self.add_on.import_run("wheel.sheet")
        box = bpy.data.objects["wheel box 1"]
        bpy.context.scene.frame_set(1 + 2 * FPS)
        place = box.parent.matrix_basis @ box.matrix_basis
        np.testing.assert_allclose(place.translation, (2.2, -1, 0), atol=1e-5)
        np.testing.assert_allclose(place.to_3x3() @ Vector((0, 1, 0)), (math.sin(6), math.cos(6), 0), atol=1e-5)

    def test_solids_follow_the_rows_of_their_motion(self):
        half = math.sqrt(0.5)
        shell("cat scene.toml - > led.toml << 'END'\n[[solid]]\nshape = \"box\"\nsize = [0.2, 0.1, 0.3]\ncenter = [0, -1, 0.5]\n"
              "motion = {kind = \"keyframed\", times = [0, 1, 2], places = [[0, -1, 0], [0.3, -1, 0], [0.3, -1, 0]], "
              f"rotations = [[1, 0, 0, 0], [1, 0, 0, 0], [{half}, 0, {half}, 0]]}}\nEND\nsheet-init led.toml -o led.sheet")
        self.add_on.import_run("led.sheet")
        box = bpy.data.objects["led box 1"]
        for frame, place in ((1, (0, -1, 0.5)), (1 + FPS, (0.3, -1, 0.5)), (1 + 2 * FPS, (0.8, -1, 0))):
            bpy.context.scene.frame_set(frame)
            np.testing.assert_allclose(box.matrix_basis.translation, place, atol=1e-6)  # it turns about its place
        np.testing.assert_allclose(box.matrix_basis.to_quaternion(), (half, 0, half, 0), atol=1e-6)

    def test_an_animated_solid_moves_in_the_run_as_it_does_here(self):
        bpy.ops.mesh.primitive_grid_add(x_subdivisions=8, y_subdivisions=8, size=1.0)
        sheet = bpy.context.object
        bpy.ops.object.empty_add(location=(0, 0, -0.5))
        arm = bpy.context.object
        bpy.ops.mesh.primitive_cube_add(size=0.2, location=(0.4, 0, 0))
        cube, scene = bpy.context.object, bpy.context.scene
        cube.parent, cube.scale = arm, (1, 2, 0.5)
        scene.frame_end, scene.unit_settings.scale_length = 20, 0.1
        for frame, angle in ((1, 0.0), (12, 2.0), (20, 1.0)):
            arm.rotation_euler.z, arm.location.x = angle, 0.1 * angle
            arm.keyframe_insert("rotation_euler", frame=frame)
            arm.keyframe_insert("location", frame=frame)
        scene.frame_set(3)  # the run's time 0
        self.assertEqual(self.add_on.export_scene("arm.toml", sheet, solids=(cube,))[-1], "arm_solid_0.csv")
        shell("sheet-init arm.toml -o arm.sheet; rm arm_solid_0.csv")
        motion = self.add_on.sheetstream.Run("arm.sheet")[0].scene()["solid"][0]["motion"]
        self.assertEqual((scene.frame_current, len(motion["times"])), (3, 18))
        for i in (0, 4, 17):
            scene.frame_set(3 + i)
            self.assertAlmostEqual(motion["times"][i], i / FPS, places=12)
            np.testing.assert_allclose(motion["places"][i], 0.1 * np.array(cube.matrix_world.translation), atol=1e-8)
            turn = cube.matrix_world.to_quaternion()
            self.assertAlmostEqual(abs(turn.dot(Quaternion(motion["rotations"][i]))), 1, places=6)
        cube.keyframe_insert("scale", frame=3)
        cube.scale.x = 3
        cube.keyframe_insert("scale", frame=10)
        scene.frame_set(3)
        self.assert_error('"Cube" changes its size at frame 4', self.add_on.export_motion, "arm.csv", cube)
        self.assertFalse(pathlib.Path("arm.csv").exists())

    def test_a_painted_scene_goes_through_sheet_init(self):
        bpy.ops.mesh.primitive_grid_add(x_subdivisions=12, y_subdivisions=8, size=1.0)
        thing = bpy.context.object
        thing.scale, thing.location = (2, 1, 1), (0, 0, 3)
        bpy.context.view_layer.update()
        x = places_of(thing.data)
        left, corner = np.flatnonzero(x[:, 0] < -0.49), np.flatnonzero(np.hypot(x[:, 0] - 0.4, x[:, 1]) < 0.2)
        thing.vertex_groups.new(name="pinned side").add(left.tolist(), 1.0, "REPLACE")
        group = thing.vertex_groups.new(name="Clamped corner")
        group.add(corner.tolist(), 0.8, "REPLACE")
        group.add([0], 0.3, "REPLACE")  # painted too thinly to hold
        thickness = thing.data.attributes.new("thickness", "FLOAT", "POINT")
        values = (0.004 + 0.002 * (x[:, 0] + 0.5)).astype(np.float32)
        thickness.data.foreach_set("value", values)
        bpy.ops.mesh.primitive_cube_add(size=0.5, location=(0, 0, 2))
        files = self.add_on.export_scene("painted.toml", thing, solids=(bpy.context.object,))
        self.assertEqual(files, ["painted.toml", "painted.ply", "painted_carried.npz", "painted_solid_0.ply"])
        shell("sheet-init --check painted.toml; sheet-init painted.toml | sheet-loop -q --steps 2 -o painted.sheet -- "
              "'sheet-step --dt 1e-3 | sheet-collide'; sheet-init painted.toml -o start.sheet")
        frame = self.add_on.sheetstream.Run("start.sheet")[0]
        np.testing.assert_allclose(frame["position"], x * (2, 1, 1) + (0, 0, 3), atol=1e-6)
        held = np.flatnonzero(frame["hold"])
        np.testing.assert_array_equal(held, np.union1d(left, corner))
        tables = frame.scene()["hold"]
        kinds = {tables[int(bits).bit_length() - 1]["kind"]: i for i, bits in enumerate(frame["hold"]) if bits}
        self.assertEqual((kinds["pinned"] in left, kinds["clamped"] in corner), (True, True))
        self.assertAlmostEqual(frame.thickness().max(), 0.006, delta=1e-4)
        self.assertAlmostEqual(frame.thickness().min(), 0.004, delta=1e-4)

    def test_materials_are_the_renderers(self):
        listed = subprocess.run(["sheet-render", "--list-liquids"], capture_output=True, text=True, check=True).stdout
        rows = [[name, *(" ".join(f"{x:g}" for x in numbers) for numbers in ((index,), absorption, scattering))]
                for name, (index, absorption, scattering) in self.add_on.LIQUIDS.items()]
        self.assertEqual("".join("\t".join(row) + "\n" for row in rows), listed)
        self.assertIn("honey", self.add_on.LIQUIDS)

    def test_each_liquid_has_its_material(self):
        pathlib.Path("sauce.toml").write_text(
            "".join(f'[[sheet]]\nname = "{name}"\nshape = "disk"\nradius = {radius}\nedge_length = 0.008\n'
                    f'thickness = 0.004\ncenter = [0, 0, {height}]\n[sheet.material]\nviscosity = {viscosity}\n'
                    'density = 1300\n'
                    for name, radius, height, viscosity in (("below", 0.03, 0, 5), ("above", 0.02, 0.01, 10))))
        shell("sheet-init sauce.toml | sheet-loop -q --until 0.1 --fps 24 -o sauce.sheet -- 'sheet-remesh | sheet-step'")
        run = self.add_on.sheetstream.Run("sauce.sheet")
        thing = self.add_on.import_run("sauce.sheet", material="chocolate,honey")
        self.assertEqual([m.name for m in thing.data.materials], ["Sheet chocolate", "Sheet honey"])
        for i in (0, len(run) - 1):
            bpy.context.scene.frame_set(1 + i)
            shown = [face.material_index for face in thing.data.polygons]
            self.assertEqual(shown, np.asarray(run[i]["liquid"]).ravel().tolist())
            self.assertEqual(set(shown), {0, 1})
        bpy.ops.sheet.import_run(filepath="sauce.sheet", material="honey", further="chocolate,glass")
        names = [m.name for m in bpy.context.object.data.materials]
        self.assertEqual(names, ["Sheet honey", "Sheet chocolate", "Sheet glass"])
        bpy.ops.sheet.import_run(filepath="sauce.sheet", material="honey")  # told apart, unless it is said otherwise
        self.assertEqual([m.name for m in bpy.context.object.data.materials], ["Sheet honey", "Sheet caramel"])
        self.assertEqual({face.material_index for face in bpy.context.object.data.polygons}, {0, 1})
        apart = self.add_on.import_run("sauce.sheet")
        self.assertEqual([m.name for m in apart.data.materials], ["Sheet caramel", "Sheet chocolate"])
        bpy.ops.sheet.import_run(filepath="sauce.sheet", material="thickness")
        self.assertEqual([m.name for m in bpy.context.object.data.materials], ["Sheet thickness"])
        alone = self.add_on.import_run("sauce.sheet", material="honey")
        self.assertEqual({face.material_index for face in alone.data.polygons}, {0})
        with self.assertRaisesRegex(self.add_on.SheetError, 'material "tar" is unknown'):
            self.add_on.import_run("sauce.sheet", material="honey,tar")

    def bodies(self):
        """A sheet that falls on a ball, each frame as one closed body: the files, and what sheet-info says of them."""
        if not pathlib.Path("fall.csv").exists():
            pathlib.Path("fall.toml").write_text(
                '[sheet]\nshape = "rectangle"\nsize = ["40 mm", "30 mm"]\nedge_length = "8 mm"\nthickness = "4 mm"\n'
                'plane = "xz"\ncenter = [0, "20 mm", 0]\nvelocity = [0, -0.1, 0]\n'
                '[material]\nviscosity = 5\ndensity = 1300\n[environment]\ngravity = [0, -9.81, 0]\n'
                '[[solid]]\nshape = "sphere"\nradius = "10 mm"\n')
            shell(f"sheet-init fall.toml | sheet-loop -q --until 0.2 --fps {FPS} -o fall.sheet -- "
                  "'sheet-remesh | sheet-step | sheet-collide'; sheet-info --csv fall.sheet > fall.csv; "
                  "sheet-export --union --voxel 1mm --close 1mm fall.sheet -o bodies/body_%03d.ply")
        with open("fall.csv") as file:
            rows = [{k: float(v) for k, v in row.items() if v} for row in csv.DictReader(file)]
        return sorted(pathlib.Path("bodies").glob("*.ply")), rows

    def test_bodies_are_one_mesh_that_follows_the_time(self):
        files, rows = self.bodies()
        thing = self.add_on.import_bodies(str(files[3]), material="honey")
        scene = bpy.context.scene
        self.assertEqual((scene.frame_end, scene.unit_settings.system), (len(files), "METRIC"))
        seen = set()
        for i in [*range(len(files)), 1, 0, 4]:  # backwards, too
            scene.frame_set(1 + i)
            body, mesh = self.add_on.body_files.read_body(files[i]), thing.data
            self.assertFalse(mesh.validate())
            np.testing.assert_array_equal(corners_of(mesh), body.triangle)
            np.testing.assert_allclose(places_of(mesh), body.position, atol=1e-7)
            np.testing.assert_allclose(attribute(mesh, "thickness"), body.arrays["thickness"], atol=1e-7)
            if i > 0:
                np.testing.assert_allclose(attribute(mesh, "velocity", 3), body.arrays["velocity"], atol=1e-6)
            self.assertAlmostEqual(shown_volume(thing) / rows[i]["volume"], 1, places=4)
            self.assertIn(f"{files[i].name}, {i} of {len(files)}, {rows[i]['time']:.4g} s", thing.sheet.message)
            seen.add(len(mesh.polygons))
        self.assertGreater(len(seen), 2)
        self.assertAlmostEqual((thing.matrix_world.to_3x3() @ Vector((0, 1, 0))).z, 1, places=6)
        self.assertEqual(thing.data.materials[0].name, "Sheet honey")

    def test_bodies_go_on_between_their_files_with_their_velocity(self):
        files, rows = self.bodies()
        thing = self.add_on.import_bodies(str(files[0]), start=10, speed=0.5)
        bpy.context.scene.frame_set(13)  # 1.5 files on
        body = self.add_on.body_files.read_body(files[1])
        velocity = body.arrays["velocity"]
        np.testing.assert_allclose(places_of(thing.data), body.position + velocity * 0.5 / FPS, atol=1e-7)
        np.testing.assert_allclose(attribute(thing.data, "velocity", 3), 0.5 * velocity, atol=1e-6)
        thing.sheet.between = False
        np.testing.assert_allclose(places_of(thing.data), body.position, atol=1e-7)

    def test_bodies_without_times_are_one_a_frame(self):
        files, _ = self.bodies()
        os.makedirs("untimed")
        for file in files:
            whole = file.read_bytes()
            self.assertIn(b"\ncomment time ", whole)
            pathlib.Path("untimed", file.name).write_bytes(re.sub(rb"comment time [^\n]*\n", b"", whole, count=1))
        self.assertEqual(bpy.ops.sheet.import_bodies(filepath=os.path.abspath(f"untimed/{files[0].name}")), {"FINISHED"})
        bpy.context.scene.frame_set(4)
        self.assertIn(f"{files[3].name}, 3 of {len(files)}", bpy.data.objects["body_000"].sheet.message)

    def test_bodies_are_blurred_along_their_velocity(self):
        files, _ = self.bodies()
        thing = self.add_on.import_bodies(str(files[1]), material="batter")
        scene = bpy.context.scene
        scene.frame_set(2)  # it falls at more than 0.4 m/s, by 20 mm a frame
        camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
        camera.data.type, camera.data.ortho_scale = "ORTHO", 0.1
        camera.location, camera.rotation_euler = (0, -1, 0.01), (math.pi / 2, 0, 0)
        scene.collection.objects.link(camera)
        scene.camera, scene.render.engine, scene.cycles.samples = camera, "CYCLES", 16
        scene.cycles.use_denoising = False
        scene.render.resolution_x = scene.render.resolution_y = 40
        scene.render.film_transparent, scene.render.motion_blur_shutter = True, 1.0
        shown = {}
        for scene.render.use_motion_blur in (False, True):
            scene.render.filepath = os.path.abspath("blur.png")
            bpy.ops.render.render(write_still=True)
            image = bpy.data.images.load(scene.render.filepath)
            alpha = np.array(image.pixels[:]).reshape(40, 40, 4)[..., 3]
            bpy.data.images.remove(image)
            shown[scene.render.use_motion_blur] = (np.count_nonzero((alpha > 0.02).any(axis=1)),
                                                   np.count_nonzero((alpha > 0.02).any(axis=0)))
        self.assertGreater(shown[True][0], shown[False][0] + 4)  # rows
        self.assertLessEqual(abs(shown[True][1] - shown[False][1]), 1)  # columns
        self.assertEqual(thing.data.attributes["velocity"].domain, "POINT")

    def test_errors_of_bodies_name_what_is_wrong(self):
        files, _ = self.bodies()
        whole = files[0].read_bytes()
        for name, content, what in (("text.ply", b"solid", "this is no PLY file"),
                                    ("cut.ply", whole[:-1], "the file ends before its header says so"),
                                    ("ascii.ply", whole.replace(b"binary_little_endian", b"ascii", 1), "it is not binary"),
                                    ("type.ply", whole.replace(b"property double x", b"property tuple x", 1), "its header"),
                                    ("face.ply", whole[:-12] + b"\xff" * 12, "other faces than triangles")):
            pathlib.Path(name).write_bytes(content)
            self.assert_error(f"{name}: .*{what}", self.add_on.import_bodies, name)
        self.assert_error("no_000.ply: there is no such file", self.add_on.import_bodies, "no_000.ply")
        self.assert_error("nowhere.*[Nn]o such file", self.add_on.import_bodies, "nowhere/no_000.ply")
        os.makedirs("mixed")
        for i in (0, 1):
            pathlib.Path(f"mixed/a_{i}.ply").write_bytes(whole)
        self.assert_error("a_1.ply: its time is not after", self.add_on.import_bodies, "mixed/a_0.ply")

    def test_errors_name_what_is_wrong(self):
        self.assert_error("no.sheet.*[Nn]o such file", self.add_on.import_run, "no.sheet")
        pathlib.Path("text.sheet").write_text("not a stream")
        self.assert_error("text.sheet", self.add_on.import_run, "text.sheet")
        self.assert_error('material "jam" is unknown: choose chocolate', self.add_on.import_run, "run.sheet", "jam")
        bpy.ops.mesh.primitive_grid_add(x_subdivisions=3, y_subdivisions=3)
        thing = bpy.context.object
        thing.vertex_groups.new(name="pinned nothing")
        self.assert_error('"pinned nothing" holds nothing', self.add_on.export_scene, "bad.toml", thing)
        thing.vertex_groups.clear()
        thing.data.attributes.new("thickness", "FLOAT", "POINT")
        self.assert_error('"thickness" is 0 at vertex 0; it must be positive', self.add_on.export_scene, "bad.toml", thing)
        self.assert_error("choose a mesh", self.add_on.export_scene, "bad.toml", None)
        self.assertFalse(pathlib.Path("bad.toml").exists())

    def test_a_run_that_is_cut_short_is_shown_as_far_as_it_is(self):
        whole = pathlib.Path("run.sheet").read_bytes()
        pathlib.Path("cut.sheet").write_bytes(whole[:len(whole) // 2])
        thing = self.add_on.import_run("cut.sheet")
        there = len(self.add_on.sheetstream.Run("cut.sheet", partial=True))
        self.assertTrue(0 < there < len(self.rows))
        self.assertIn(f" of {there},", thing.sheet.message)
        self.assertEqual(bpy.context.scene.frame_end, there)

    def assert_error(self, pattern, call, *arguments):
        with self.assertRaisesRegex(self.add_on.SheetError, pattern):
            call(*arguments)


class Page(unittest.TestCase):
    def test_commands_run_and_the_picture_shows_the_sheet(self):
        commands = re.findall(r"^    \$ (.+)$", (root / "docs/blender.md").read_text(), re.M)
        self.assertEqual(len(commands), 8)
        os.makedirs("page/build/share")
        os.symlink(archive, "page/build/share/sheet-blender.zip")
        os.symlink(root / "formats", "page/formats")
        for command in commands:
            small = command.replace("--until 1", "--until 0.01").replace("--blur", "--blur --size 96x54 --samples 4")
            small = small.replace("drape.png", "drape.png --frames 3 --size 64x48 --samples 1")
            shell("cd page; cp -n ../scene.toml ../run.sheet .; " + small)
        image = bpy.data.images.load(os.path.abspath("page/picture.png"))
        pixels = np.array(image.pixels[:]).reshape(54, 96, 4)
        corner, middle = pixels[-4:, :4, :3].mean(axis=(0, 1)), pixels[22:32, 40:56, :3].mean(axis=(0, 1))
        self.assertGreater(np.abs(corner - middle).max(), 0.1)
        self.assertGreater(middle[0] / middle[2], corner[0] / corner[2] + 0.2)  # chocolate is browner than the sky


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    suite = unittest.defaultTestLoader.loadTestsFromModule(sys.modules["__main__"])
    good = unittest.TextTestRunner(stream=sys.stdout, verbosity=2).run(suite).wasSuccessful()
    os.chdir("/")
    if not good:
        raise SystemExit(1)
