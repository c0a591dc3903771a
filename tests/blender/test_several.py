# SPDX-License-Identifier: GPL-3.0-or-later
"""Several sheets in one run: what is of each, what of all, and what comes back to which.

    blender -b --factory-startup --python-exit-code 1 --python test_several.py -- sheet-blender.zip
"""
import json
import pathlib
import subprocess
import sys
import time

import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from simulating import Case, corners_of, places_of, run_all, uv_of


class Several(Case):
    def jam(self, height=0.24, cuts=8, size=0.2):
        """A second, smaller sheet above the first, of one material, its UV map with a seam: another island, shifted and
        mirrored, on its right half."""
        bpy.ops.mesh.primitive_grid_add(x_subdivisions=cuts, y_subdivisions=cuts, size=size, location=(0, 0, height))
        thing = bpy.context.object
        thing.name = "Jam"
        layer = thing.data.uv_layers[0]
        for face in thing.data.polygons:
            for loop in face.loop_indices:
                u, v = layer.data[loop].uv
                layer.data[loop].uv = (u, v) if face.center.x < 0 else (3 - u, v)
        thing.data.materials.append(bpy.data.materials.new("Red"))
        thing.sheet_part.role, thing.sheet_part.thickness = "SHEET", 0.01
        return thing

    def scene_text(self):
        return (self.folder / "told/scene.toml").read_text()

    def test_two_sheets_are_two_tables_and_two_results(self):
        cloth, jam = self.cloth(), self.jam()
        jam.sheet_part.liquid.own = True
        jam.sheet_part.liquid.liquid = "honey"
        self.ball()
        self.save()
        bpy.ops.sheet.simulate()
        run = self.add_on.sheetstream.Run(str(self.folder / "kept_sheet/Cloth/run/run.sheet"))
        described = run[0].scene()
        self.assertEqual([sheet["name"] for sheet in described["sheet"]], ["Cloth", "Jam"])
        self.assertEqual([sheet["thickness"] for sheet in described["sheet"]], [0.02, 0.01])
        self.assertEqual((described["material"]["viscosity"], described["sheet"][1]["material"]["viscosity"]), (80, 19))
        shown = [bpy.data.objects[f"{name} sheet"] for name in ("Cloth", "Jam")]
        self.assertEqual([c.name for c in shown[0].users_collection], ["Liquid"])
        self.assertNotIn("Liquid", [c.name for c in shown[1].users_collection])
        self.assertTrue(cloth.hide_get() and jam.hide_get())
        self.assertEqual([[m.name for m in thing.data.materials] for thing in shown], [["Left", "Right"], ["Red"]])
        for index in range(len(run)):  # each is its triangles, and they are all
            self.scene.frame_set(1 + index)
            frame = run[index]
            for number, thing in enumerate(shown):
                mine = np.asarray(frame["blender.sheet"]).ravel() == number
                np.testing.assert_array_equal(mine, np.asarray(frame["liquid"]).ravel() == number)
                corners = np.asarray(frame["triangle"])[mine]
                self.assertEqual((len(thing.data.polygons), len(thing.data.vertices)),
                                 (mine.sum(), len(np.unique(corners))))
                np.testing.assert_allclose(places_of(thing.data)[corners_of(thing.data)], frame["position"][corners],
                                           atol=1e-6)
        self.scene.frame_end += 1
        self.assertEqual(bpy.ops.sheet.resume(), {"FINISHED"})
        self.assertEqual([thing.sheet.message[:12] for thing in shown], ["frame 6 of 7"] * 2)
        self.assertEqual(bpy.ops.sheet.free(), {"FINISHED"})
        self.assertFalse({"Cloth sheet", "Jam sheet"} & set(bpy.data.objects.keys()))
        self.assertFalse(cloth.hide_get() or jam.hide_get())

    def test_what_each_mesh_carries_comes_back_to_it(self):
        cloth, jam = self.cloth(), self.jam()
        self.ball()
        self.save()
        bpy.ops.sheet.simulate()
        self.scene.frame_set(1)
        smooth, seamed = (bpy.data.objects[f"{name} sheet"].data for name in ("Cloth", "Jam"))
        at_corners = places_of(smooth)[corners_of(smooth)]
        np.testing.assert_allclose(uv_of(smooth), at_corners[..., :2] / 0.4 + 0.5, atol=1e-6)
        at_corners = places_of(seamed)[corners_of(seamed)]
        right = at_corners[..., 0].mean(axis=1) > 0
        u, v = (at_corners[..., :2] / 0.2 + 0.5).transpose(2, 0, 1)
        np.testing.assert_allclose(uv_of(seamed)[..., 0], np.where(right[:, None], 3 - u, u), atol=1e-6)
        np.testing.assert_allclose(uv_of(seamed)[..., 1], v, atol=1e-6)
        self.scene.frame_set(self.scene.frame_end)
        kinds = np.empty(len(smooth.polygons), np.int32)
        smooth.polygons.foreach_get("material_index", kinds)
        self.assertEqual(set(kinds), {0, 1})
        for shown, area in ((smooth, 1), (seamed, 1)):
            uv = uv_of(shown)
            a, b = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
            self.assertAlmostEqual(np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum() / 2, area, delta=0.1)
        self.assertEqual(cloth.sheet_part.result.sheet.number, 0)
        self.assertEqual(jam.sheet_part.result.sheet.number, 1)

    def exported(self, run, index):
        """u and v at the corners of a frame, as other programs get them: by OBJ, and by glTF through Blender."""
        for ending in ("obj", "glb"):
            subprocess.run(["sheet-export", run, "-o", self.folder / f"out/frame_%02d.{ending}"], check=True)
        lines = [line.split() for line in (self.folder / f"out/frame_{index:02}.obj").read_text().splitlines()]
        uv = np.array([line[1:] for line in lines if line[0] == "vt"], float)
        corner = np.array([[int(c.split("/")[1]) for c in line[1:]] for line in lines if line[0] == "f"]) - 1
        binary = (self.folder / f"out/frame_{index:02}.glb").read_bytes()
        size = int.from_bytes(binary[12:16], "little")
        model = json.loads(binary[20:20 + size])

        def values(accessor, kind, width):
            said = model["accessors"][accessor]
            start = 28 + size + model["bufferViews"][said["bufferView"]].get("byteOffset", 0)
            return np.frombuffer(binary, kind, said["count"] * width, start).reshape(-1, width)
        primitive = model["meshes"][0]["primitives"][0]
        corners = values(primitive["indices"], "<u4", 1).reshape(-1, 3)
        gltf = values(primitive["attributes"]["TEXCOORD_0"], "<f4", 2)[corners]
        return uv[corner], np.stack([gltf[..., 0], 1 - gltf[..., 1]], axis=2)

    def test_seams_come_out_of_sheet_export(self):
        self.cloth(), self.jam(), self.ball()
        self.save()
        bpy.ops.sheet.simulate()
        file = self.folder / "kept_sheet/Cloth/run/run.sheet"
        run = self.add_on.sheetstream.Run(str(file))
        for index in (0, len(run) - 1):
            self.scene.frame_set(1 + index)
            shown = np.concatenate([uv_of(bpy.data.objects[f"{name} sheet"].data) for name in ("Cloth", "Jam")])
            number = np.asarray(run[index]["blender.sheet"]).ravel()
            shown = shown[np.argsort(np.argsort(number, kind="stable"))]
            for uv in self.exported(file, index):
                np.testing.assert_allclose(uv, shown, atol=1e-6)
                self.assertTrue((uv[number == 1] > 1).any() and (uv[number == 0] <= 1 + 1e-6).all())
        for kind in (["--solidify"], ["--union", "--voxel", "6mm"]):
            subprocess.run(["sheet-export", *kind, file, "-o", self.folder / "out/body_%02d.obj"], check=True)
            body = (self.folder / f"out/body_{len(run) - 1:02}.obj").read_text().splitlines()
            u = np.array([line.split()[1] for line in body if line.startswith("vt ")], float)
            self.assertTrue((u > 2.01).any() and ((u < 1 + 1e-6) | (u > 2 - 1e-6)).all())  # none between the islands
        (self.folder / "kept_sheet/Cloth/scene_sheet_1.ply").unlink()
        done = subprocess.run(["sheet-export", file, "-o", self.folder / "out/frame_%02d.obj"], check=True,
                              capture_output=True, text=True)
        self.assertIn("scene_sheet_1.ply: this mesh of the scene, which has texture coordinates with seams", done.stderr)

    def test_an_island_that_meets_itself_comes_out_of_sheet_export(self):
        bpy.ops.mesh.primitive_uv_sphere_add(radius=0.2, segments=24, ring_count=12)
        bpy.context.object.name = "Ball"
        bpy.context.object.sheet_part.role, bpy.context.object.sheet_part.thickness = "SHEET", 0.01
        bpy.ops.mesh.primitive_cube_add(size=1, location=(0, 0, -0.71))
        bpy.context.object.sheet_part.role = "SOLID"
        self.scene.gravity.z = -60
        self.save()
        bpy.ops.sheet.simulate()
        file = self.folder / "kept_sheet/Ball/run/run.sheet"
        for index in (0, 5):
            self.scene.frame_set(1 + index)
            shown = uv_of(bpy.data.objects["Ball sheet"].data)
            for uv in self.exported(file, index):
                np.testing.assert_allclose(uv, shown, atol=1e-6)

    def test_a_run_that_is_imported_is_an_object_for_each_sheet(self):
        self.cloth(), self.ball()
        liquid = self.jam().sheet_part.liquid
        liquid.own, liquid.liquid = True, "honey"
        self.save()
        bpy.ops.sheet.simulate()
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        first = self.add_on.import_run(str(self.folder / "kept_sheet/Cloth/run/run.sheet"), material="chocolate,honey")
        self.assertEqual(first.name, "run Cloth")
        self.assertEqual([thing.name for thing in first.children], ["run Cloth mesh 0"])
        second = bpy.data.objects["run Jam"]
        self.assertEqual([{face.material_index for face in thing.data.polygons} for thing in (first, second)],
                         [{0}, {1}])
        np.testing.assert_allclose(uv_of(first.data), places_of(first.data)[corners_of(first.data)][..., :2] / 0.4 + 0.5,
                                   atol=1e-6)
        self.assertGreater(uv_of(second.data).max(), 2)

    def test_holds_and_inlets_are_each_sheets_own(self):
        cloth, jam = self.cloth(), self.jam()
        jam.name = 'Gelée "süß" 糖'
        for thing, half in ((cloth, 0.2), (jam, 0.1)):
            x = places_of(thing.data)[:, 0]
            for name, chosen in (("pinned", x < -half + 1e-3), ("entry", x > half - 1e-3)):
                thing.vertex_groups.new(name=name).add(np.flatnonzero(chosen).tolist(), 1.0, "REPLACE")
            thing.sheet_part.inlet, thing.sheet_part.inlet_speed = "entry", half
        self.save()
        bpy.ops.sheet.simulate()
        run = self.add_on.sheetstream.Run(str(self.folder / "kept_sheet/Cloth/run/run.sheet"))
        first, last = run[0], run[-1]
        in_jam = np.isin(np.arange(first.vertices), first["triangle"][np.asarray(first["blender.sheet"]).ravel() == 1])
        for number, mine, count in ((0, ~in_jam, 11), (1, in_jam, 9)):
            held = np.asarray(first["hold"]).ravel() == 1 << number
            self.assertEqual((held.sum(), held[mine].sum()), (count, count))
        speeds = [table["velocity"][0] for table in first.scene()["inflow"]]
        np.testing.assert_allclose(speeds, (-0.2, -0.1), atol=1e-7)
        self.assertEqual([table["sheet"] for table in first.scene()["hold"]], ["Cloth", jam.name])
        for number in (0, 1):  # what enters is of the sheet where it does
            volumes = [frame["volume"][np.asarray(frame["blender.sheet"]).ravel() == number].sum()
                       for frame in (first, last)]
            edge, speed, thickness = ((0.4, 0.2, 0.02), (0.2, 0.1, 0.01))[number]
            self.assertAlmostEqual(volumes[1] - volumes[0], edge * speed * thickness * last.time,
                                   delta=0.05 * volumes[0])
            self.assertGreater(volumes[1], 1.02 * volumes[0])

    def test_what_a_scene_has_once_is_told(self):
        cloth, jam = self.cloth(), self.jam()
        self.assertEqual(self.told(), 'edges of "Cloth" are 1.6 times as long as those of "Jam": the run soon gives all '
                         "sheets edges of the mean length; set Sheet > Edges to choose one")
        cloth.sheet_part.edges, jam.sheet_part.edges = 0.05, 0.03
        self.assertEqual(self.told(), "all sheets have edges of one length: they are split as those of"
                         ' "Jam" are, which are shortest (Sheet > Edges)')
        body = self.add_on.body_files.read_body(self.folder / "told/scene_sheet_0.ply")
        sides = body.position[body.triangle] - body.position[np.roll(body.triangle, 1, axis=1)]
        self.assertLess(np.linalg.norm(sides, axis=2).max(), 1.4 * 0.03 + 1e-6)
        cloth.sheet_part.edges = 0.03
        self.assertEqual(self.told(), "")
        self.scene.sheet_run.self_contact = False
        self.assertIn("sheets pass through each other", self.told())

    def test_liquids_are_each_sheets_own_or_all_ones(self):
        cloth, jam = self.cloth(), self.jam()
        cloth.sheet_part.edges = jam.sheet_part.edges = 0.03
        self.told()
        self.assertEqual(self.scene_text().count("viscosity"), 1)
        for thing, liquid in ((cloth, "batter"), (jam, "honey")):
            thing.sheet_part.liquid.own = True
            thing.sheet_part.liquid.liquid = liquid
        self.told()
        self.assertNotIn("\n[material]", self.scene_text())
        self.assertEqual(self.scene_text().count("[sheet.material]"), 2)
        subprocess.run(["sheet-init", "--check", "scene.toml"], cwd=self.folder / "told", check=True,
                       stdout=subprocess.DEVNULL)
        jam.sheet_part.role = "NONE"
        self.told()
        self.assertIn("[material]\nviscosity = 1.5\n", self.scene_text())
        self.assertIn("[sheet]\n", self.scene_text())

    def test_check_names_the_sheet_and_selects_in_it(self):
        self.cloth(), self.ball()
        jam = self.jam(height=0.09)
        jam.data.vertices.add(1)  # loose ones are left out, and do not shift the numbers
        self.save()
        self.refused('^Error: the sheet starts inside "Sphere".*In Blender: move the sheet', bpy.ops.sheet.check)
        self.assertEqual(bpy.context.view_layer.objects.active, jam)
        bpy.ops.object.mode_set(mode="OBJECT")
        chosen = [v.index for v in jam.data.vertices if v.select]
        self.assertEqual(len(chosen), 1)
        self.assertLess(np.linalg.norm(jam.matrix_world @ jam.data.vertices[chosen[0]].co), 0.1)
        jam.data.polygons[10].flip()
        self.refused('"Jam": 4 edges between faces', bpy.ops.sheet.check)
        bpy.ops.object.mode_set(mode="OBJECT")

    def test_a_run_is_shown_as_what_it_is_of_whatever_is_chosen_then(self):
        self.cloth(), self.ball()
        jam = self.jam()
        self.save()
        bpy.ops.sheet.simulate()
        folder = self.folder / "kept_sheet/Cloth"
        self.assertFalse(self.add_on.cache.is_older(folder, self.scene))
        jam.sheet_part.role = "NONE"
        time.sleep(0.6)
        self.assertTrue(self.add_on.cache.is_older(folder, self.scene))
        self.add_on.simulate.show_newest(self.scene)
        self.assertEqual([bpy.data.objects[f"{name} sheet"].sheet.number for name in ("Cloth", "Jam")], [0, 1])
        self.refused("of other settings", bpy.ops.sheet.resume)
        self.assertEqual(bpy.ops.sheet.free(), {"FINISHED"})
        self.assertFalse({"Cloth sheet", "Jam sheet"} & set(bpy.data.objects.keys()))


run_all()
