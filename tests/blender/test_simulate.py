# SPDX-License-Identifier: GPL-3.0-or-later
"""Simulating in a Blender without a window, by the operators that the panel has: what comes back, what is told, what is
kept, and what differs between Blenders.

    blender -b --factory-startup --python-exit-code 1 --python test_simulate.py -- sheet-blender.zip
"""
import pathlib
import subprocess
import sys
import time
import types

import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from simulating import FPS, Case, corners_of, loop_values, places_of, run_all, uv_of


class Simulating(Case):
    # ---- a run

    def test_a_run_is_simulated_stopped_gone_on_with_and_freed(self):
        cloth, _ = self.cloth(), self.ball()
        self.refused("save the .blend first", bpy.ops.sheet.simulate)
        self.save()
        self.scene.frame_end = 200
        self.assertEqual(bpy.ops.sheet.simulate(wait=False), {"FINISHED"})
        folder = self.folder / "kept_sheet/Cloth"
        state = self.add_on.cache.progress_of
        self.wait_for_frames(folder, 4)
        self.assertEqual(state(folder).state, "running")
        self.assertTrue(0 < state(folder).part < 1 and state(folder).left > 0)
        self.refused("goes on already", bpy.ops.sheet.simulate)
        self.assertEqual(bpy.ops.sheet.stop(), {"FINISHED"})
        self.assertEqual(state(folder).state, "stopped")
        stopped = len(self.add_on.follow.open_run(str(folder / "run/run.sheet")))
        self.assertTrue(4 <= stopped < 200)
        self.assertEqual(self.scene.frame_current, stopped)
        shown = bpy.data.objects["Cloth sheet"]
        self.scene.frame_end = stopped + 2  # and no further
        self.assertEqual(bpy.ops.sheet.resume(), {"FINISHED"})
        self.assertEqual((state(folder).state, self.scene.frame_current), ("done", stopped + 2))
        self.assertEqual(self.scene.frame_end, stopped + 2)
        straight = self.folder / "straight"
        subprocess.run(["sheet-run", "-q", "scene.toml", "-o", straight, "--until", repr((stopped + 1) / FPS), "--fps",
                        repr(float(FPS)), "--stream-only"], cwd=folder, check=True)
        self.assertEqual((straight / "run.sheet").read_bytes(), (folder / "run/run.sheet").read_bytes())
        self.assertTrue((folder / "run/health.txt").exists() and not (folder / "run/picture.png").exists())
        # what is shown
        self.assertEqual([c.name for c in shown.users_collection], ["Liquid"])
        self.assertEqual([m.name for m in shown.data.materials], ["Left", "Right"])
        self.assertEqual((cloth.hide_get(), cloth.hide_render, shown.hide_render), (True, True, False))
        # another setting
        self.assertFalse(self.add_on.cache.is_older(folder, self.scene))
        cloth.sheet_part.thickness = 0.03
        time.sleep(0.6)
        self.assertTrue(self.add_on.cache.is_older(folder, self.scene))
        self.refused("of other settings", bpy.ops.sheet.resume)
        self.scene.frame_end = 3
        self.assertEqual(bpy.ops.sheet.simulate(), {"FINISHED"})
        self.assertTrue((folder / "run~/run.sheet").exists())
        self.assertEqual(len([o for o in bpy.data.objects if o.name.startswith("Cloth sheet")]), 1)
        self.assertEqual(bpy.ops.sheet.free(), {"FINISHED"})
        self.assertEqual((folder.exists(), cloth.hide_get(), cloth.hide_render), (False, False, False))
        self.assertNotIn("Cloth sheet", bpy.data.objects)

    def test_a_run_that_goes_on_is_found_again_when_the_file_is_opened(self):
        self.cloth(), self.ball()
        self.scene.frame_end = 400
        self.save()
        bpy.ops.sheet.simulate(wait=False)
        self.save()
        folder = self.folder / "kept_sheet/Cloth"
        self.wait_for_frames(folder, 2)
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        bpy.ops.wm.open_mainfile(filepath=str(self.folder / "kept.blend"))
        self.assertTrue(self.add_on.cache.progress_of(folder).alive)
        bpy.ops.sheet.stop()
        self.assertFalse(self.add_on.cache.progress_of(folder).alive)
        self.assertIn("Cloth sheet", bpy.data.objects)

    def test_a_run_that_fails_says_why(self):
        self.cloth(), self.ball()
        self.save()
        mine = self.folder / "mine"
        mine.mkdir()
        (mine / "sheet-run").write_text("#!/bin/sh\necho 'sheet-step: error: the moon is full' >&2; exit 5\n")
        (mine / "sheet-run").chmod(0o755)
        preferences = bpy.context.preferences.addons["sheet_blender"].preferences
        preferences.programs = str(mine)
        try:
            self.refused("the moon is full", bpy.ops.sheet.simulate)
            preferences.programs = str(self.folder)
            self.refused("sheet-run is not in .*Preferences", bpy.ops.sheet.simulate)
        finally:
            preferences.programs = ""

    # ---- what comes back

    def test_uv_colours_and_materials_come_back(self):
        cloth, _ = self.cloth(), self.ball()
        self.save()
        bpy.ops.sheet.simulate()
        shown = bpy.data.objects["Cloth sheet"].data
        self.scene.frame_set(1)
        at = {tuple(np.round(x, 4) + 0.0): i for i, x in enumerate(places_of(cloth.data).astype(float) + (0, 0, 0.2))}
        source = {}  # UV of each vertex
        corners = np.empty(len(cloth.data.loops), np.int32)
        cloth.data.loops.foreach_get("vertex_index", corners)
        for vertex, uv in zip(corners, loop_values(cloth.data.uv_layers[0].data, "uv", 2)):
            source[vertex] = uv
        x, uv, triangles = places_of(shown), uv_of(shown), corners_of(shown)
        for corner, vertex in enumerate(triangles.ravel()):
            np.testing.assert_allclose(uv.reshape(-1, 2)[corner], source[at[tuple(np.round(x[vertex].astype(float), 4) + 0.0)]], atol=1e-6)
        tint = loop_values(shown.color_attributes["Tint"].data, "color", 4)
        np.testing.assert_allclose(tint[:, :2], x[triangles.ravel()][:, :2] + 0.5, atol=1e-6)
        remeshed = False
        for frame in range(1, self.scene.frame_end + 1):  # monotone: the map is the start's, however it is remeshed
            self.scene.frame_set(frame)
            uv, material = uv_of(shown), np.empty(len(shown.polygons), np.int32)
            shown.polygons.foreach_get("material_index", material)
            remeshed = remeshed or len(shown.polygons) != 200
            self.assertTrue(((uv >= -1e-6) & (uv <= 1 + 1e-6)).all())
            a, b = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
            area = (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2
            self.assertGreater(area.min(), 0)
            self.assertAlmostEqual(area.sum(), 1, places=5)
            middle = uv.mean(axis=1)[:, 0]
            clear = np.abs(middle - 0.5) > 0.15
            np.testing.assert_array_equal(material[clear], (middle > 0.5)[clear])
        self.assertTrue(remeshed)

    def test_a_seam_of_a_uv_map_stays_one(self):
        cloth, _ = self.cloth(), self.ball()
        layer = cloth.data.uv_layers[0]
        for face in cloth.data.polygons:  # the right half is another island, shifted and mirrored
            for loop in face.loop_indices:
                u, v = layer.data[loop].uv
                layer.data[loop].uv = (u, v) if face.center.x < 0 else (3 - u, v)
        self.save()
        bpy.ops.sheet.simulate()
        shown = bpy.data.objects["Cloth sheet"].data
        for frame in (1, self.scene.frame_end):
            self.scene.frame_set(frame)
            uv = uv_of(shown)
            right = uv.mean(axis=1)[:, 0] > 1.5
            self.assertTrue((uv[~right, :, 0] <= 0.5 + 1e-6).all() and (uv[right, :, 0] >= 2 - 1e-6).all())
            a, b = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
            area = (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2
            np.testing.assert_array_equal(np.sign(area[np.abs(area) > 1e-7]), np.where(right, -1, 1)[np.abs(area) > 1e-7])
            if frame == 1:
                self.assertAlmostEqual(np.abs(area).sum(), 1, places=5)
            self.assertAlmostEqual(np.abs(area).sum(), 1, delta=0.1)

    def test_an_island_that_meets_itself_keeps_its_sides_apart(self):
        bpy.ops.mesh.primitive_uv_sphere_add(radius=0.2, segments=24, ring_count=12)  # a seam from pole to pole
        ball = bpy.context.object
        ball.name = "Ball"
        ball.sheet_part.role, ball.sheet_part.thickness = "SHEET", 0.01
        bpy.ops.mesh.primitive_cube_add(size=1, location=(0, 0, -0.71))
        bpy.context.object.sheet_part.role = "SOLID"
        self.scene.gravity.z = -60  # it comes down in these frames, and is remeshed
        self.save()
        bpy.ops.sheet.simulate()
        shown = bpy.data.objects["Ball sheet"].data
        self.scene.frame_set(1)
        with self.add_on.evaluated.surface_of(ball) as mesh:
            corner = self.add_on.evaluated.triangles_of(mesh, ball.matrix_world, 1.0).corner
            wanted = loop_values(mesh.uv_layers[0].data, "uv", 2)[corner]
        np.testing.assert_allclose(uv_of(shown), wanted, atol=1e-6)
        run = self.add_on.sheetstream.Run(str(self.folder / "kept_sheet/Ball/run/run.sheet"))
        self.assertFalse(run[-1].triangles == run[0].triangles and (run[-1]["triangle"] == run[0]["triangle"]).all())
        for frame in range(1, self.scene.frame_end + 1):
            self.scene.frame_set(frame)
            uv = uv_of(shown)
            middle = uv.mean(axis=1)
            clear = np.abs(middle[:, 1] - 0.5) < 0.3  # from the poles, where all of u is near
            self.assertLess(np.ptp(uv[clear], axis=1)[:, 0].max(), 0.2)  # no triangle has all of the map in it
            a, b = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
            area = (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2
            self.assertAlmostEqual(np.abs(area[clear]).sum(), 0.6, delta=0.08)

    def test_the_liquid_gives_its_look_where_the_mesh_has_none(self):
        self.cloth().data.materials.clear()
        self.ball()
        self.save()
        self.scene.sheet_run.liquid = "honey"
        self.scene.frame_end = 2
        bpy.ops.sheet.simulate()
        self.assertEqual([m.name for m in bpy.data.objects["Cloth sheet"].data.materials], ["Sheet honey"])
        text = (self.folder / "kept_sheet/Cloth/scene.toml").read_text()
        self.assertIn("viscosity = 19.0\ndensity = 1420.0\nsurface_tension = 0.05", text)

    # ---- the panel's settings

    def test_a_scene_of_one_sheet_is_this_text(self):
        cloth, ball = self.cloth(), self.ball()
        cloth.name, ball.sheet_part.contact = 'Clöth "x"', "slip"
        x = places_of(cloth.data)[:, 0]
        for name, chosen in (("pinned a", x < -0.19), ("in", x > 0.19)):
            cloth.vertex_groups.new(name=name).add(np.flatnonzero(chosen).tolist(), 1.0, "REPLACE")
        cloth.sheet_part.inlet = "in"
        for thing in (cloth, ball):
            for frame, place in ((1, 0.0), (6, 0.5)):
                thing.location.x = place
                thing.keyframe_insert("location", frame=frame)
        self.scene.sheet_run.liquid = "honey"
        self.told()
        self.assertEqual((self.folder / "told/scene.toml").read_text(), """# made by Blender of "Clöth \\"x\\""
[sheet]
shape = "mesh"
file = "scene.ply"
thickness = 0.02
arrays = ["blender.uv", "blender.color", "blender.material"]

[material]
viscosity = 19.0
density = 1420.0
surface_tension = 0.055

[environment]
gravity = [0.0, 0.0, -9.81]

[contact]
self = true

[[hold]] # "pinned a"
region = {array = "painted.0"}
kind = "pinned"
motion = {kind = "keyframed", file = "scene.csv"}

[inflow] # "in"
region = {array = "entry"}
velocity = [-0.1, 0.0, 0.0]
thickness = 0.02

[[solid]] # "Sphere"
shape = "mesh"
file = "scene_solid_0.ply"
contact = "slip"
center = [0, 0, 0] # the mesh stands where it is at time 0
rotation = {axis = [0, 0, 1], angle = 0}
motion = {kind = "keyframed", file = "scene_solid_0.csv"}
""")

    def test_edges_are_split_and_uv_with_them(self):
        cloth = self.cloth(cuts=2)
        cloth.sheet_part.edges = 0.04
        with self.add_on.evaluated.surface_of(cloth, 0.04) as mesh:
            shape = self.add_on.evaluated.triangles_of(mesh, cloth.matrix_world, 1.0)
            vertices, _, layers = self.add_on.carried.collect(mesh, shape)
        sides = shape.position[shape.triangle] - shape.position[np.roll(shape.triangle, 1, axis=1)]
        self.assertLessEqual(np.linalg.norm(sides, axis=2).max(), 1.4 * 0.04 + 1e-6)
        np.testing.assert_allclose(vertices["blender.uv"], shape.position[:, :2] / 0.4 + 0.5, atol=1e-6)

    def test_thickness_at_faces_is_that_however_many_vertices_there_are(self):
        bpy.ops.mesh.primitive_cylinder_add(vertices=12, end_fill_type="NOTHING")
        band = bpy.context.object
        band.sheet_part.role = "SHEET"
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.quads_convert_to_tris()
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertEqual(len(band.data.vertices), len(band.data.polygons))
        wanted = np.linspace(0.01, 0.02, 24).astype(np.float32)
        band.data.attributes.new("thickness", "FLOAT", "FACE").data.foreach_set("value", wanted)
        self.told()
        subprocess.run(["sheet-init", "scene.toml", "-o", "first.sheet"], cwd=self.folder / "told", check=True)
        frame = self.add_on.sheetstream.Run(str(self.folder / "told/first.sheet"))[0]
        np.testing.assert_allclose(frame.thickness(), wanted, rtol=1e-5)
        band.data.attributes.remove(band.data.attributes["thickness"])
        band.data.attributes.new("thickness", "INT", "POINT")
        self.assertIn('its attribute "thickness" is not taken: it must be a Float', self.told())

    def test_an_inlet_and_holds_are_taken_from_what_is_selected(self):
        cloth = self.cloth()
        x = places_of(cloth.data)
        bpy.context.view_layer.objects.active = cloth
        for kind, chosen in (("inlet", x[:, 0] > 0.19), ("pinned", x[:, 0] < -0.19)):
            bpy.ops.object.mode_set(mode="OBJECT")
            for name in ("vertices", "edges", "polygons"):
                data = getattr(cloth.data, name)
                data.foreach_set("select", [False] * len(data))
            for edge in cloth.data.edges:
                edge.select = all(chosen[v] for v in edge.vertices)
            cloth.data.vertices.foreach_set("select", chosen)
            bpy.context.tool_settings.mesh_select_mode = (False, True, False)
            bpy.ops.object.mode_set(mode="EDIT")
            self.assertEqual(bpy.ops.sheet.from_selection(kind=kind), {"FINISHED"})
        bpy.ops.object.mode_set(mode="OBJECT")
        cloth.sheet_part.inlet_speed = 0.5
        self.save()
        bpy.ops.sheet.simulate()
        frame = self.add_on.sheetstream.Run(str(self.folder / "kept_sheet/Cloth/run/run.sheet"))
        self.assertEqual(np.count_nonzero(frame[0]["hold"]), 11)
        self.assertEqual(np.count_nonzero(frame[0]["inlet"] == 3), 11)
        inflow = frame[0].scene()["inflow"]
        np.testing.assert_allclose(inflow["velocity"], (-0.5, 0, 0), atol=1e-9)
        self.assertGreater(frame[-1]["volume"].sum(), frame[0]["volume"].sum() * 1.05)

    def test_roles_are_those_of_collections_too(self):
        cloth, ball = self.cloth(), self.ball()
        cloth.sheet_part.role = ball.sheet_part.role = "AUTO"
        self.assertEqual(self.add_on.parts.role_of(cloth), "NONE")
        cloth.users_collection[0].sheet_collection.role = "SHEET"
        self.assertEqual(self.add_on.parts.sheets_of(self.scene), [cloth])
        other = self.cloth()
        self.assertEqual(set(self.add_on.parts.sheets_of(self.scene)), {cloth, other})
        other.sheet_part.role = "NONE"
        self.assertEqual(self.add_on.parts.sheets_of(self.scene), [cloth])
        cloth.sheet_part.role = "NONE"
        with self.assertRaisesRegex(self.add_on.SheetError, "no object is a sheet"):
            self.add_on.parts.sheets_of(self.scene)

    # ---- check

    def test_check_says_what_is_wrong_in_blenders_words_and_selects_it(self):
        cloth, ball = self.cloth(), self.ball()
        self.save()
        self.assertEqual(bpy.ops.sheet.check(), {"FINISHED"})
        text = bpy.data.texts["Sheet check"].as_string()
        self.assertIn("Modelled", text)
        self.assertIn("contact", text)
        cloth.data.flip_normals()
        cloth.data.polygons[44].flip()
        self.refused(r"4 edges between faces that look to different sides: Mesh > Normals > Recalculate Outside",
                     bpy.ops.sheet.check)
        self.assertEqual(cloth.mode, "EDIT")
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertEqual({e.index for e in cloth.data.edges if e.select},
                         {e.index for e in cloth.data.edges if e.key in cloth.data.polygons[44].edge_keys})
        cloth.data.polygons[44].flip()
        cloth.data.update()
        ball.location.z = 0.15
        bpy.context.view_layer.update()
        self.refused("starts inside \"Sphere\".*In Blender: move the sheet or the solid", bpy.ops.sheet.check)
        bpy.ops.object.mode_set(mode="OBJECT")
        chosen = [v.index for v in cloth.data.vertices if v.select]
        self.assertEqual(len(chosen), 1)
        self.assertLess(np.linalg.norm(cloth.data.vertices[chosen[0]].co), 0.1)

    # ---- nothing is lost in silence

    def test_gravity_is_the_scenes(self):
        self.cloth()
        self.scene.gravity = (0, 3, -4)
        self.told()
        self.assertIn("gravity = [0.0, 3.0, -4.0]", (self.folder / "told/scene.toml").read_text())
        self.scene.use_gravity = False
        self.told()
        self.assertNotIn("gravity", (self.folder / "told/scene.toml").read_text())

    def test_another_unit_scale(self):
        cloth = self.cloth(size=40, height=20)
        cloth.sheet_part.thickness = 2.0
        self.scene.unit_settings.scale_length = 0.01
        self.assertIn("gravity is 0.0981 m/s² at this unit scale", self.told())
        text = (self.folder / "told/scene.toml").read_text()
        self.assertIn("thickness = 0.02\n", text)
        self.scene.gravity.z = -981
        self.assertNotIn("unit scale", self.told())
        bpy.context.view_layer.objects.active = cloth
        bpy.ops.sheet.export_scene(filepath=str(self.folder / "own.toml"), thickness=3.0)
        self.assertIn("thickness = 0.03\n", (self.folder / "own.toml").read_text())

    def test_texts_and_curves_are_solids_and_sheets(self):
        self.cloth()
        bpy.ops.object.text_add()
        text = bpy.context.object
        text.data.body, text.data.extrude, text.scale = "O", 0.1, (0.2, 0.2, 0.2)
        text.sheet_part.role = "SOLID"
        bpy.ops.curve.primitive_bezier_circle_add(radius=0.1, location=(0, 0, -0.4))
        circle = bpy.context.object
        circle.sheet_part.role = "SOLID"
        with self.assertRaisesRegex(self.add_on.SheetError, '"BezierCircle" has no faces: fill it.*Convert > Mesh'):
            self.told()
        circle.data.dimensions, circle.data.fill_mode, circle.data.extrude = "2D", "BOTH", 0.05
        self.told()
        for number in (0, 1):
            body = self.add_on.body_files.read_body(self.folder / f"told/scene_solid_{number}.ply")
            self.assertGreater(len(body.triangle), 50)
        done = subprocess.run(["sheet-init", "--check", str(self.folder / "told/scene.toml")], capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        bpy.context.view_layer.objects.active = circle  # as the sheet of a scene, too
        bpy.ops.sheet.export_scene(filepath=str(self.folder / "circle.toml"))
        self.assertGreater((self.folder / "circle.ply").stat().st_size, 1000)
        bpy.ops.object.empty_add()
        self.refused('"Empty" has no surface', bpy.ops.sheet.export_scene, filepath=str(self.folder / "none.toml"))

    def test_what_changes_its_shape_is_told(self):
        cloth, ball = self.cloth(), self.ball()
        self.assertEqual(self.told(), "")
        for thing, words in ((ball, '"Sphere" changes its shape.*keep the shape'), (cloth, '"Cloth" changes its shape')):
            thing.shape_key_add(name="Basis")
            key = thing.shape_key_add(name="Bulge")
            for point in key.data:
                point.co *= 1.5
            key.value = 0
            key.keyframe_insert("value", frame=1)
            key.value = 1
            key.keyframe_insert("value", frame=6)
            self.assertRegex(self.told(), words)

    def test_a_sheet_that_moves_takes_its_holds_along_or_says_so(self):
        cloth = self.cloth()
        for frame, x in ((1, 0.0), (6, 0.5)):
            cloth.location.x = x
            cloth.keyframe_insert("location", frame=frame)
        self.assertRegex(self.told(), '"Cloth" moves, and nothing of it is held')
        self.assertFalse((self.folder / "told/scene.csv").exists())
        cloth.vertex_groups.new(name="pinned side").add(
            np.flatnonzero(places_of(cloth.data)[:, 0] > 0.19).tolist(), 1.0, "REPLACE")
        self.assertEqual(self.told(), "")
        self.save()
        bpy.ops.sheet.simulate()
        run = self.add_on.sheetstream.Run(str(self.folder / "kept_sheet/Cloth/run/run.sheet"))
        for index in (0, 5):
            self.scene.frame_set(1 + index)
            held = run[index]["hold"] != 0
            np.testing.assert_allclose(run[index]["position"][held][:, 0], 0.2 + cloth.matrix_world.translation.x,
                                       atol=1e-5)

    def test_vertex_groups_that_do_nothing_are_told(self):
        cloth = self.cloth()
        cloth.vertex_groups.new(name="rim")
        self.assertRegex(self.told(), 'vertex group "rim" holds nothing')
        cloth.sheet_part.clamped = "rim"
        cloth.vertex_groups["rim"].add([0, 1, 2], 1.0, "REPLACE")
        self.assertEqual(self.told(), "")
        self.assertIn('kind = "clamped"', (self.folder / "told/scene.toml").read_text())

    def test_what_blender_does_not_evaluate_is_refused_or_evaluated(self):
        cloth, ball = self.cloth(), self.ball()
        ball.modifiers.new("Finer", "SUBSURF")
        ball.hide_viewport = True
        self.told()
        fine = self.add_on.body_files.read_body(self.folder / "told/scene_solid_0.ply")
        self.assertGreater(len(fine.position), 3 * len(ball.data.vertices))
        self.assertTrue(ball.hide_viewport)
        bpy.context.view_layer.layer_collection.children["Liquid"].exclude = True
        with self.assertRaisesRegex(self.add_on.SheetError, '"Cloth" is in no collection of this view layer'):
            self.told()

    def test_force_fields_are_told(self):
        self.cloth()
        bpy.ops.object.effector_add(type="WIND")
        self.assertIn("force fields do not act", self.told())

    def test_ones_own_solids_come_back_with_a_run(self):
        cloth, ball = self.cloth(), self.ball()
        self.add_on.export_scene(str(self.folder / "own.toml"), cloth, solids=(ball,))
        subprocess.run(f"cd '{self.folder}'; sheet-init own.toml -o own.sheet", shell=True, check=True)
        self.add_on.import_run(str(self.folder / "own.sheet"))
        solid = bpy.data.objects["own mesh 0"]
        self.assertEqual(len(solid.data.vertices), len(ball.data.vertices))
        np.testing.assert_allclose(places_of(solid.data), places_of(ball.data), atol=1e-6)
        shown = bpy.data.objects["own"].data  # so do UV maps
        np.testing.assert_allclose(uv_of(shown).reshape(-1, 2), places_of(shown)[corners_of(shown).ravel()][:, :2] / 0.4
                                   + 0.5, atol=1e-6)

    # ---- other Blenders

    def test_curves_of_an_action_are_found_in_every_blender(self):
        compat = self.add_on.compat
        cube = self.ball()
        self.assertEqual(compat.fcurves_of(cube), [])
        cube.keyframe_insert("location", frame=1)
        self.assertEqual(len(compat.fcurves_of(cube)), 3)
        bag = types.SimpleNamespace(fcurves=["x", "y"])
        strip = types.SimpleNamespace(channelbag=lambda slot: bag if slot == "own" else None)
        action = types.SimpleNamespace(layers=[types.SimpleNamespace(strips=[strip])])
        data = types.SimpleNamespace(action=action, action_slot="own")
        self.assertEqual(compat.fcurves_of(types.SimpleNamespace(animation_data=data)), ["x", "y"])
        action.fcurves = ["of", "the", "first", "slot"]  # in 4.4 and 4.5
        self.assertEqual(compat.fcurves_of(types.SimpleNamespace(animation_data=data)), ["x", "y"])
        for slot in ("another", None):
            data.action_slot = slot
            self.assertEqual(compat.fcurves_of(types.SimpleNamespace(animation_data=data)), [])

    def test_nodes_are_those_of_every_blender(self):
        compat = self.add_on.compat

        class Older:  # has a tree as soon as it uses nodes
            node_tree = None

            def __setattr__(self, name, value):
                object.__setattr__(self, "node_tree", "made")

        class Newer:  # has one, and warns of whom asks for it
            node_tree = "there"

            def __setattr__(self, name, value):
                raise DeprecationWarning(name)

        self.assertEqual((compat.nodes_of(Older()), compat.nodes_of(Newer())), ("made", "there"))
        older = [types.SimpleNamespace(name=name, identifier=name) for name in ("Color", "Fac")]
        newer = [older[0], types.SimpleNamespace(name="Factor", identifier="Fac")]
        self.assertEqual([compat.socket_of(sockets, "Fac") for sockets in (older, newer)], [older[1], newer[1]])
        tree = compat.new_modifier_tree("Tried")
        self.assertEqual((tree.bl_idname, hasattr(tree, "is_modifier")), ("GeometryNodeTree", False))
        made = types.SimpleNamespace(is_modifier=False)
        data = types.SimpleNamespace(node_groups=types.SimpleNamespace(new=lambda name, kind: made))
        kept, compat.bpy = compat.bpy, types.SimpleNamespace(data=data)
        try:
            self.assertTrue(compat.new_modifier_tree("Tried").is_modifier)
        finally:
            compat.bpy = kept

    def test_faces_have_their_sizes_in_every_blender(self):
        compat = self.add_on.compat
        for read_only in (False, True):
            said = []
            mesh = types.SimpleNamespace(polygons=types.SimpleNamespace(foreach_set=lambda *a: said.append(a)))
            sizes = types.SimpleNamespace(is_readonly=read_only)
            rna = types.SimpleNamespace(properties={"loop_total": sizes})
            kinds = types.SimpleNamespace(MeshPolygon=types.SimpleNamespace(bl_rna=rna))
            kept, compat.bpy = compat.bpy, types.SimpleNamespace(types=kinds)
            try:
                compat.set_polygon_sizes(mesh, [3, 3])
            finally:
                compat.bpy = kept
            self.assertEqual(said, [] if read_only else [("loop_total", [3, 3])])

    def test_questions_are_asked_in_every_blender(self):
        compat = self.add_on.compat
        operator = types.SimpleNamespace(bl_label="Free the Run")
        for newer in (False, True):
            def ask(*asked, **more):
                if more and not newer:
                    raise TypeError("keyword arguments")
                return asked, more
            kept, compat.bpy = compat.bpy, types.SimpleNamespace(context=types.SimpleNamespace(
                window_manager=types.SimpleNamespace(invoke_confirm=ask)))
            try:
                answer = compat.confirm(operator, "event", "It is gone then.")
            finally:
                compat.bpy = kept
            more = {"title": "Free the Run", "message": "It is gone then."} if newer else {}
            self.assertEqual(answer, ((operator, "event"), more))

    def test_sockets_are_shown_in_every_blender(self):
        compat = self.add_on.compat
        cube = self.ball()
        modifier, drawn = self.add_on.slab.add_slab(cube), []
        layout = types.SimpleNamespace(prop=lambda data, name, text: drawn.append((data, name, text)))
        compat.draw_socket(layout, modifier, "Thickness Factor")
        self.assertEqual(drawn[0][1:], (f'["{modifier.node_group.inputs[1].identifier}"]', "Thickness Factor"))
        self.assertEqual(modifier.path_resolve(drawn[0][1]), 1.0)
        socket = types.SimpleNamespace(name="Factor", identifier="Socket_1", in_out="INPUT")
        tree = types.SimpleNamespace(interface=types.SimpleNamespace(items_tree=[socket]))
        inputs = types.SimpleNamespace(Socket_1=types.SimpleNamespace(value=1.0))
        newer = types.SimpleNamespace(node_group=tree, properties=types.SimpleNamespace(inputs=inputs))
        compat.draw_socket(layout, newer, "Factor")
        self.assertEqual(drawn[1], (inputs.Socket_1, "value", "Factor"))

    def test_texts_in_toml_are_read_in_every_python(self):
        compat = self.add_on.compat
        self.assertEqual(compat.read_toml("[a]\nb = 1\n"), {"a": {"b": 1}})
        hidden = {name: sys.modules.get(name) for name in ("tomllib", "tomli", "pip._vendor.tomli")}
        try:
            sys.modules.update({"tomllib": None, "tomli": types.SimpleNamespace(loads=lambda text: {"mine": text})})
            self.assertEqual(compat.read_toml("x"), {"mine": "x"})
            sys.modules.update({"tomli": None, "pip._vendor.tomli": None})
            with self.assertRaises(ImportError):
                compat.read_toml("x")
        finally:
            for name, module in hidden.items():
                sys.modules.pop(name, None)
                if module is not None:
                    sys.modules[name] = module

    def test_progress_is_a_bar_or_a_line(self):
        compat, said = self.add_on.compat, []
        compat.progress(types.SimpleNamespace(label=lambda **k: said.append(k["text"])), 0.25, "a")
        compat.progress(types.SimpleNamespace(progress=lambda **k: said.append(k["factor"])), 0.5, "b")
        self.assertEqual(said, ["25 %, a", 0.5])


run_all()
