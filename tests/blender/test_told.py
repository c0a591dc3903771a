# SPDX-License-Identifier: GPL-3.0-or-later
"""What people do in Blender with objects, modifiers, scenes and files: each is right in the run or told.

    blender -b --factory-startup --python-exit-code 1 --python test_told.py -- sheet-blender.zip
"""
import pathlib
import subprocess
import sys

import bpy
import numpy as np
from mathutils import Matrix, Quaternion, Vector

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from simulating import Case, places_of, run_all, uv_of


class Told(Case):
    def body(self, name="scene"):
        return self.add_on.body_files.read_body(self.folder / f"told/{name}.ply")

    def area_and_volume(self, name):
        body = self.body(name)
        a, b, c = (body.position[body.triangle[:, i]] for i in range(3))
        return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2, (np.cross(a, b) * c).sum() / 6

    def follows(self, solid, number=0):
        """Whether the run's motion, which is said to the mesh at time 0, brings it to where Blender has it."""
        self.told()
        rows = np.loadtxt(self.folder / f"told/scene_solid_{number}.csv", delimiter=",", skiprows=1)
        poses = [Matrix.LocRotScale(Vector(row[1:4]), Quaternion(row[4:8]), None) for row in rows]
        start = [Vector(x) for x in self.body(f"scene_solid_{number}").position]
        for frame, pose in enumerate(poses, 1):
            self.scene.frame_set(frame)
            moved = pose @ poses[0].inverted()
            for x, vertex in zip(start, solid.data.vertices):
                self.assertLess((moved @ x - solid.matrix_world @ vertex.co).length, 1e-5)
        self.scene.frame_set(1)

    def turn(self, thing, path="rotation_euler"):
        for frame, angle in ((1, 0.2), (6, 1.0)):
            setattr(thing, path, (angle, 0.3 * angle, 2 * angle))
            thing.keyframe_insert(path, frame=frame)

    # ---- objects

    def test_mirrored_objects_have_their_outside_outside(self):
        cloth, ball = self.cloth(), self.ball()
        self.told()
        area, volume = self.area_and_volume("scene_solid_0")
        cloth.scale, ball.scale = (-1, 1, 1), (1, -1, 1)
        bpy.context.view_layer.update()
        self.assertEqual(self.told(), "")
        np.testing.assert_allclose(self.area_and_volume("scene_solid_0"), (area, volume), rtol=1e-6)
        self.assertGreater(volume, 0.003)
        body = self.body()  # materials go with the faces: on the right what was on the left
        rows = body.triangle
        normal = np.cross(body.position[rows[:, 1]] - body.position[rows[:, 0]],
                          body.position[rows[:, 2]] - body.position[rows[:, 0]])
        self.assertTrue((normal[:, 2] > 0).all())
        self.turn(ball)
        self.follows(ball)

    def test_what_a_parent_shears_turns_as_it_does_here_or_is_refused(self):
        self.cloth()
        ball = self.ball()
        bpy.ops.object.empty_add()
        parent = bpy.context.object
        ball.parent, ball.rotation_euler, parent.scale = parent, (0.5, 0.5, 0), (1, 2, 1)
        self.turn(parent)
        self.follows(ball)
        parent.animation_data_clear()
        self.turn(ball)
        with self.assertRaisesRegex(self.add_on.SheetError, '"Sphere" changes its size at frame 2'):
            self.told()

    def test_linked_duplicates_are_objects_and_instances_are_told(self):
        self.cloth()
        ball = self.ball()
        other = ball.copy()
        other.location.x = 0.3
        self.scene.collection.objects.link(other)
        bpy.context.view_layer.update()
        self.assertEqual(self.told(), "")
        np.testing.assert_allclose(self.body("scene_solid_1").position.mean(axis=0), (0.3, 0, 0), atol=1e-6)
        bpy.data.objects.remove(other)
        for file in (self.folder / "told").iterdir():
            file.unlink()
        kept = bpy.data.collections.new("Balls")
        self.scene.collection.objects.unlink(ball)
        kept.objects.link(ball)
        ball.sheet_part.role, kept.sheet_collection.role = "AUTO", "SOLID"
        bpy.ops.object.collection_instance_add(collection="Balls", location=(0.2, 0, 0))
        self.assertRegex(self.told(), '"Balls" shows a copy of "Sphere", which the run has not: .*Make Instances Real')
        self.assertFalse((self.folder / "told/scene_solid_0.ply").exists())
        self.scene.collection.children.link(kept)
        self.assertRegex(self.told(), '"Balls" shows a copy of "Sphere"')
        self.assertTrue((self.folder / "told/scene_solid_0.ply").exists())
        bpy.data.objects.remove(bpy.data.objects["Balls"])
        self.assertEqual(self.told(), "")
        bpy.ops.mesh.primitive_plane_add(size=0.5)
        ball.parent, bpy.context.object.instance_type = bpy.context.object, "VERTS"
        bpy.context.view_layer.update()
        self.assertRegex(self.told(), '"Plane" shows 4 copies of "Sphere"')

    def test_instances_of_geometry_nodes_are_told_or_refused(self):
        self.cloth()
        ball = self.ball()
        add_socket = self.add_on.compat.add_socket
        tree = bpy.data.node_groups.new("Spread", "GeometryNodeTree")
        for side in ("INPUT", "OUTPUT"):
            add_socket(tree, "Geometry", side, "NodeSocketGeometry")
        entry, leave, spread, cube, join = (tree.nodes.new(kind) for kind in (
            "NodeGroupInput", "NodeGroupOutput", "GeometryNodeInstanceOnPoints", "GeometryNodeMeshCube",
            "GeometryNodeJoinGeometry"))
        tree.links.new(entry.outputs[0], spread.inputs["Points"])
        tree.links.new(cube.outputs[0], spread.inputs["Instance"])
        tree.links.new(spread.outputs[0], join.inputs[0])
        tree.links.new(entry.outputs[0], join.inputs[0])
        tree.links.new(join.outputs[0], leave.inputs[0])
        ball.modifiers.new("Spread", "NODES").node_group = tree
        self.assertRegex(self.told(), f'"Sphere" shows {len(ball.data.vertices)} copies of "Sphere".*Realize Instances')
        tree.links.new(spread.outputs[0], leave.inputs[0])
        with self.assertRaisesRegex(self.add_on.SheetError, '"Sphere" has no faces: .*Realize Instances'):
            self.told()

    def test_what_the_eye_hides_takes_part(self):
        cloth, ball = self.cloth(), self.ball()
        for thing in (cloth, ball):
            thing.hide_set(True)
        ball.hide_render = True
        self.assertEqual(self.told(), "")
        self.assertEqual(len(self.body("scene_solid_0").position), len(ball.data.vertices))

    def test_edit_mode_is_no_other_mesh(self):
        cloth = self.cloth()
        bpy.context.view_layer.objects.active = cloth
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.transform.translate(value=(0, 0, 0.5))
        self.assertEqual(self.told(), "")
        self.assertAlmostEqual(self.body().position[0, 2], 0.7, places=6)
        bpy.ops.object.mode_set(mode="OBJECT")

    # ---- meshes and modifiers

    def test_modifiers_are_as_in_the_viewport(self):
        cloth = self.cloth()
        for vertex in cloth.data.vertices:
            vertex.co.x += 0.2
        cloth.modifiers.new("Mirror", "MIRROR")
        self.assertEqual(self.told(), "")
        self.assertAlmostEqual(self.area_and_volume("scene")[0], 2 * 0.4**2, places=6)
        fine = cloth.modifiers.new("Fine", "SUBSURF")
        self.assertEqual(self.told(), 'modifier "Fine" of "Cloth" has 1 level in viewports and 2 levels in renders: the'
                         " run begins with the first")
        self.assertEqual(len(self.body().triangle), 2 * 4 * 2 * 100)
        fine.show_viewport = False
        self.assertEqual(self.told(), 'modifier "Fine" of "Cloth" is off in viewports: the run begins without it')
        fine.show_viewport, fine.show_render = True, False
        self.assertEqual(self.told(), 'modifier "Fine" of "Cloth" is off in renders: the run begins with it')
        cloth.modifiers.remove(fine)
        cloth.modifiers.new("Thick", "SOLIDIFY")
        self.assertRegex(self.told(), 'modifier "Thick" of "Cloth" makes two sheets of one.*Thickness')

    def test_simplified_subdivisions_are_told(self):
        cloth = self.cloth()
        fine = cloth.modifiers.new("Fine", "SUBSURF")
        fine.levels = fine.render_levels = 2
        self.assertEqual(self.told(), "")
        self.assertEqual(len(self.body().triangle), 2 * 16 * 100)
        self.scene.render.use_simplify, self.scene.render.simplify_subdivision = True, 0
        self.assertRegex(self.told(), '"Fine" of "Cloth" has 0 levels in viewports and 2 levels in renders')
        self.assertEqual(len(self.body().triangle), 2 * 100)

    def test_a_flat_solid_is_a_plane_and_an_open_one_is_refused(self):
        self.cloth(height=0.5)
        bpy.ops.mesh.primitive_plane_add(size=1, location=(0.3, 0, 0.1), rotation=(np.pi + 0.1, 0, 0))  # looks down
        plane = bpy.context.object
        plane.sheet_part.role, plane.sheet_part.contact = "SOLID", "slip"
        bpy.context.view_layer.update()
        self.assertEqual(self.told(), '"Plane" is flat: the run takes it as a plane without end. For a plate with edges'
                         " give it a thickness (modifier Solidify)")
        solid, = self.add_on.compat.read_toml((self.folder / "told/scene.toml").read_text())["solid"]
        self.assertEqual((solid["shape"], solid["contact"]), ("plane", "slip"))
        np.testing.assert_allclose(solid["center"], (0.3, 0, 0.1), atol=1e-6)
        np.testing.assert_allclose(solid["normal"], (0, -np.sin(0.1), np.cos(0.1)), atol=1e-6)
        done = subprocess.run(["sheet-init", "--check", str(self.folder / "told/scene.toml")], capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.turn(plane)
        with self.assertRaisesRegex(self.add_on.SheetError, '"Plane" moves and is flat: give it a thickness'):
            self.told()
        plane.animation_data_clear()
        plane.modifiers.new("Thick", "SOLIDIFY").thickness = 0.05
        self.assertEqual(self.told(), "")
        self.assertAlmostEqual(self.area_and_volume("scene_solid_0")[1], 0.05, places=4)
        bpy.data.objects.remove(plane)
        ball = self.ball()
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.edge_split(type="EDGE")
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertEqual(self.told(), "")  # its vertices are one again in the run
        self.assertEqual(len(self.body("scene_solid_0").position), 16 * 7 + 2)
        bpy.data.objects.remove(ball)
        bpy.ops.mesh.primitive_cylinder_add(end_fill_type="NOTHING", radius=0.1, depth=0.2, vertices=12)
        bpy.context.object.sheet_part.role = "SOLID"
        with self.assertRaisesRegex(self.add_on.SheetError, '"Cylinder" is open along 24 edges.*Solidify'):
            self.told()

    def test_what_modifiers_make_of_a_uv_map_comes_back(self):
        cloth = self.cloth()
        for vertex in cloth.data.vertices:
            vertex.co.x += 0.2
        modifier = cloth.modifiers.new("Mirror", "MIRROR")
        modifier.use_mirror_u = True
        self.save()
        self.scene.frame_end = 2
        bpy.ops.sheet.simulate()
        self.scene.frame_set(1)
        shown = bpy.data.objects["Cloth sheet"].data
        x = places_of(shown)[[v for face in shown.polygons for v in face.vertices]][:, 0]
        uv, clear = uv_of(shown).reshape(-1, 2), np.abs(x) > 1e-6  # in the middle two maps meet
        np.testing.assert_allclose(uv[clear, 0], (np.where(x >= 0, x / 0.4, 1 + x / 0.4))[clear], atol=1e-6)
        self.assertEqual(len(uv), 3 * 400)

    def test_attributes_come_back_or_are_told(self):
        cloth = self.cloth()
        x = places_of(cloth.data)
        for name, kind, values in (("wetness", "FLOAT", x[:, 0]), ("flow", "FLOAT_VECTOR", 2 * x)):
            cloth.data.attributes.new(name, kind, "POINT").data.foreach_set(
                "value" if kind == "FLOAT" else "vector", np.ascontiguousarray(values, np.float32).ravel())
        self.assertEqual(self.told(), "")
        self.save()
        bpy.ops.sheet.simulate()
        shown = bpy.data.objects["Cloth sheet"].data
        self.scene.frame_set(1)
        x = places_of(shown)
        wetness, flow = np.empty(len(x), np.float32), np.empty(3 * len(x), np.float32)
        shown.attributes["wetness"].data.foreach_get("value", wetness)
        shown.attributes["flow"].data.foreach_get("vector", flow)
        np.testing.assert_allclose(wetness, x[:, 0], atol=1e-6)
        np.testing.assert_allclose(flow.reshape(-1, 3)[:, :2], 2 * x[:, :2], atol=1e-6)
        self.scene.frame_set(6)
        self.assertGreater(shown.attributes["wetness"].data[0].value, -0.21)
        self.assertEqual(len(shown.attributes["wetness"].data), len(shown.vertices))
        cloth.data.attributes.new("steps", "INT", "FACE")
        self.assertIn('attribute "steps" of "Cloth" does not come back', self.told())

    def test_split_edges_keep_thickness_and_groups(self):
        cloth = self.cloth(cuts=4)
        x = places_of(cloth.data)
        cloth.data.attributes.new("thickness", "FLOAT", "POINT").data.foreach_set(
            "value", np.ascontiguousarray(0.01 + 0.02 * (x[:, 0] + 0.2), np.float32))
        cloth.vertex_groups.new(name="pinned").add(np.flatnonzero(x[:, 0] < -0.19).tolist(), 1.0, "REPLACE")
        cloth.vertex_groups.new(name="entry").add(np.flatnonzero(x[:, 0] > 0.19).tolist(), 1.0, "REPLACE")
        cloth.sheet_part.edges, cloth.sheet_part.inlet = 0.02, "entry"
        self.assertEqual(self.told(), "")
        subprocess.run(["sheet-init", "scene.toml", "-o", "first.sheet"], cwd=self.folder / "told", check=True)
        frame = self.add_on.sheetstream.Run(str(self.folder / "told/first.sheet"))[0]
        middle = frame["position"][frame["triangle"]].mean(axis=1)
        self.assertGreater(frame.triangles, 500)
        np.testing.assert_allclose(frame.thickness(), 0.01 + 0.02 * (middle[:, 0] + 0.2), rtol=1e-4)
        held = np.asarray(frame["hold"]).ravel() != 0
        np.testing.assert_array_equal(held, frame["position"][:, 0] < -0.19)
        np.testing.assert_array_equal(np.asarray(frame["inlet"]).ravel() != 0, frame["position"][:, 0] > 0.19)

    def test_shape_keys_are_as_they_are_mixed(self):
        cloth = self.cloth()
        cloth.shape_key_add(name="Basis")
        key = cloth.shape_key_add(name="Up")
        for point in key.data:
            point.co.z += 0.1
        key.value = 0.5
        self.assertEqual(self.told(), "")
        self.assertAlmostEqual(self.body().position[:, 2].mean(), 0.25, places=6)

    def test_loose_edges_and_vertices_are_left_out_and_hold_nothing(self):
        cloth, ball = self.cloth(), self.ball()
        for thing in (cloth, ball):
            count = len(thing.data.vertices)
            thing.data.vertices.add(2)
            thing.data.edges.add(1)
            thing.data.edges[-1].vertices = (count, count + 1)
            thing.data.update()
        self.save()
        self.assertEqual(bpy.ops.sheet.check(), {"FINISHED"})
        said = bpy.data.texts["Sheet check"].as_string()
        self.assertIn("2 vertices without faces are left out", said)
        self.assertIn('"Sphere": 2 vertices without faces are left out', said)
        self.told()
        self.assertEqual((len(self.body().position), len(self.body("scene_solid_0").position)), (121, 114))
        bpy.ops.object.mode_set(mode="OBJECT")
        cloth.vertex_groups.new(name="pinned").add([121, 122], 1.0, "REPLACE")
        with self.assertRaisesRegex(self.add_on.SheetError, '"pinned" holds nothing: no vertex of a face'):
            self.told()

    def test_faces_of_many_corners_are_triangles(self):
        bpy.ops.mesh.primitive_circle_add(vertices=20, radius=0.2, fill_type="NGON")
        disk = bpy.context.object
        disk.sheet_part.role = "SHEET"
        self.assertEqual(self.told(), "")
        wanted = 10 * 0.2**2 * np.sin(np.pi / 10)
        self.assertEqual(len(self.body().triangle), 18)
        self.assertAlmostEqual(self.area_and_volume("scene")[0], wanted, places=6)
        disk.sheet_part.edges = 0.03
        self.told()
        self.assertGreater(len(self.body().triangle), 400)
        self.assertAlmostEqual(self.area_and_volume("scene")[0], wanted, places=6)

    # ---- scenes and files

    def test_two_scenes_with_one_sheet_have_a_run_each(self):
        cloth = self.cloth()
        self.save()
        self.scene.frame_end = 2
        bpy.ops.sheet.simulate()
        first, folder = bpy.data.objects["Cloth sheet"], self.add_on.cache.folder_of(self.scene)
        other = bpy.data.scenes.new("Another one")
        other.collection.objects.link(cloth)
        other.render.fps, other.frame_end = 24, 3
        bpy.context.window.scene = other
        self.assertEqual(self.add_on.cache.folder_of(other).name, "Cloth_Another_one")
        with bpy.context.temp_override(scene=other):
            bpy.ops.sheet.simulate()
        second = next(thing for thing in other.objects if thing.sheet.file)
        self.assertNotEqual(first, second)
        runs = [self.add_on.sheetstream.Run(thing.sheet.file) for thing in (first, second)]
        self.assertEqual([len(run) for run in runs], [2, 3])
        bpy.context.window.scene = self.scene
        self.assertEqual(self.add_on.cache.folder_of(self.scene), folder)
        self.add_on.simulate.show_newest(self.scene)
        self.assertEqual(sum(bool(thing.sheet.file) for thing in self.scene.objects), 1)
        self.scene.sheet_run.cache = str(self.folder / "kept_sheet/Cloth_Another_one")
        self.refused('has the run of the scene "Another one"', bpy.ops.sheet.simulate)
        self.scene.sheet_run.cache = ""
        bpy.ops.sheet.free()
        self.assertFalse(folder.exists())
        self.assertEqual([thing.name for thing in bpy.data.objects if thing.sheet.file], [second.name])

    def test_names_and_paths_may_have_blanks_and_any_letters(self):
        cloth, ball = self.cloth(), self.ball()
        cloth.name, ball.name = 'Glasur "süß" / 糖', "Löffel äöü"
        cloth.data.uv_layers[0].name = "Karte ß"
        folder = self.folder / "mein Kuchen (ä) 糖'"
        folder.mkdir()
        bpy.ops.wm.save_as_mainfile(filepath=str(folder / "Törtchen 2.blend"))
        self.assertEqual(bpy.ops.sheet.check(), {"FINISHED"})
        self.scene.frame_end = 2
        bpy.ops.sheet.simulate()
        self.scene.frame_end = 3
        self.assertEqual(bpy.ops.sheet.resume(), {"FINISHED"})
        bpy.ops.wm.save_mainfile()
        bpy.ops.wm.open_mainfile(filepath=str(folder / "Törtchen 2.blend"))
        shown = bpy.data.objects['Glasur "süß" / 糖 sheet']
        self.add_on.simulate.show_newest(bpy.context.scene)
        self.assertEqual(shown.sheet.message[:12], "frame 2 of 3")
        self.assertAlmostEqual(uv_of(shown.data, "Karte ß").max(), 1, places=5)
        self.assertEqual([p.name for p in folder.glob("*/*")], ["Glasur_süß_糖"])
        self.add_on.import_run(shown.sheet.file)
        self.assertIn("run mesh 0", bpy.data.objects)

    def test_time_stretching_is_told(self):
        self.cloth()
        self.scene.render.frame_map_new = 200
        self.assertIn("Time Stretching", self.told())


run_all()
