#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The package of formats/python: doctests of modules and of its page, types, installation by pip, and that runs say in it
what sheet-info says of them. (That it reads and writes every stream of the corpus: tests/unit/formats/corpus_test.py.)"""
import csv
import doctest
import importlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import matplotlib

matplotlib.use("agg")
import meshio  # noqa: E402
import numpy as np  # noqa: E402

import sheetstream  # noqa: E402
import sheetstream.meshio  # noqa: E402
from sheetstream import Run, StreamError, checksum, make_frame, plot, write  # noqa: E402

root = pathlib.Path(__file__).resolve().parents[2]
package = root / "formats/python"
page = root / "docs/python.md"
MODULES = ("", ".checksum", ".fit", ".meshio", ".plot", ".run", ".stream")


def shell(command, **more):
    return subprocess.run(["bash", "-ec", "set -o pipefail; " + command], capture_output=True, text=True, **more)


def commands_of_page():
    """What the page says to type into a shell: indented lines that begin with $."""
    return re.findall(r"^    \$ (.+)$", page.read_text(), re.M)


class WithRun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        os.chdir(cls.folder.name)
        done = shell("sheet-init --example | sed 's/^edge_length = .*/edge_length = 0.1/' > scene.toml; "
                     "sheet-init scene.toml | sheet-loop -q --until 0.3 --fps 24 -o run.sheet -- "
                     "'sheet-remesh | sheet-step | sheet-collide'; sheet-info --csv run.sheet > run.csv")
        assert done.returncode == 0, done.stderr
        with open("run.csv") as file:
            cls.rows = list(csv.DictReader(file))

    @classmethod
    def tearDownClass(cls):
        os.chdir("/")
        cls.folder.cleanup()


class Package(WithRun):
    def test_doctests_of_modules(self):
        os.mkdir("modules")
        os.chdir("modules")
        self.addCleanup(os.chdir, "..")
        for name in MODULES:
            result = doctest.testmod(importlib.import_module("sheetstream" + name))
            self.assertEqual(result.failed, 0, name)
            self.assertTrue(result.attempted > 0 or name == ".stream", name)

    def test_doctests_of_the_page(self):
        result = doctest.testfile(str(page), module_relative=False)
        self.assertEqual(result.failed, 0)
        self.assertGreater(result.attempted, 15)

    def test_commands_of_the_page(self):
        os.makedirs("clone/formats", exist_ok=True)
        shutil.copytree(package, "clone/formats/python", ignore=shutil.ignore_patterns("build", "*.egg-info"),
                        dirs_exist_ok=True)
        shutil.copy("run.sheet", "clone")
        commands = commands_of_page()
        self.assertGreaterEqual(len(commands), 3)
        environment = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
        environment["PATH"] = "/usr/bin:" + environment["PATH"]
        environment.update(PIP_NO_INDEX="1", PIP_DISABLE_PIP_VERSION_CHECK="1")
        done = shell("\n".join(commands), cwd="clone", env=environment)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertTrue(os.path.getsize("clone/run.png") > 50000)
        done = shell("cd /; \"$OLDPWD\"/clone/env/bin/python -c 'import sheetstream; print(sheetstream.__file__); "
                     "import importlib.metadata as m; print(m.version(\"sheetstream\"))'; "
                     "test -e \"$OLDPWD\"/clone/env/lib/python3*/site-packages/sheetstream/py.typed", env=environment)
        self.assertIn("clone/env/lib", done.stdout, done.stderr)
        self.assertRegex((root / "CMakeLists.txt").read_text(), rf"VERSION {re.escape(done.stdout.split()[1])}\b")

    def test_types(self):
        done = shell(f"cd {package} && /usr/bin/mypy --cache-dir=/dev/null -p sheetstream")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


class Runs(WithRun):
    def test_curves_are_those_of_sheet_info(self):
        run = Run("run.sheet")
        self.assertEqual(len(run), len(self.rows))
        self.assertGreater(len(set(run.curves()["triangles"])), 1)  # the mesh changes
        for name, values in run.curves().items():
            if name != "speed_max":
                said = [float(row[name]) for row in self.rows]
                np.testing.assert_allclose(values, said, rtol=1e-12, atol=0, err_msg=name)
        self.assertEqual(run.times.tolist(), [float(row["time"]) for row in self.rows])
        self.assertEqual(run.steps.tolist(), [int(row["step"]) for row in self.rows])
        self.assertEqual(Run("run.sheet").curves(density=2600)["kinetic_energy"][-1], 2 * run.curves()["kinetic_energy"][-1])

    def test_frames_by_number_slice_and_time(self):
        run = Run("run.sheet")
        self.assertEqual([frame.time for frame in run[1:6:2]], run.times[1:6:2].tolist())
        self.assertEqual((run[-1].time, run.at(0.1).time, run.at(-1).time), (0.3, run.times[2], 0))
        self.assertEqual(sum(1 for _ in run), len(run))
        with self.assertRaisesRegex(IndexError, "run.sheet: frame 99 of 9"):
            run[99]

    def test_a_stream_is_read_by_its_name_too(self):
        with open("run.sheet", "rb") as file:
            times = [frame.time for frame in sheetstream.read(file)]
        self.assertEqual([frame.time for frame in sheetstream.read("run.sheet")], times)
        self.assertGreater(len(times), 1)
        with self.assertRaises(FileNotFoundError):
            list(sheetstream.read("none.sheet"))

    def test_only_what_is_asked_for_is_read(self):
        data = bytearray(pathlib.Path("run.sheet").read_bytes())
        start = Run("run.sheet")._starts[3]
        data[start + 20 * 128] ^= 1  # in a payload of frame 3
        pathlib.Path("damaged.sheet").write_bytes(data)
        run = Run("damaged.sheet")
        self.assertEqual(run[2].time, run.times[2])
        self.assertEqual(run[4].time, run.times[4])
        with self.assertRaisesRegex(StreamError, r"damaged.sheet: frame 3, byte \d+: array \"\w+\": checksum mismatch"):
            run[3]

    def test_a_stream_cut_short(self):
        data = pathlib.Path("run.sheet").read_bytes()
        for size in (len(data) - 64, len(data) - 100, len(data) - 5000, Run("run.sheet")._starts[4] + 70):
            pathlib.Path("cut.sheet").write_bytes(data[:size])
            with self.assertRaisesRegex(StreamError, "cut.sheet: frame .* cut short"):
                Run("cut.sheet")
            run = Run("cut.sheet", partial=True)
            self.assertFalse(run.complete)
            self.assertEqual(len(list(run)), len(run))
            self.assertIn(len(run), (4, 8, 9))
        pathlib.Path("other.sheet").write_bytes(b"hello" * 100)
        with self.assertRaisesRegex(StreamError, "other.sheet: frame 0, byte 0: not a sheet stream"):
            Run("other.sheet", partial=True)

    def test_joined_streams(self):
        data = pathlib.Path("run.sheet").read_bytes()
        pathlib.Path("joined.sheet").write_bytes(data + data)
        run = Run("joined.sheet")
        self.assertEqual((len(run), run[9].time, run[-1].time), (18, 0, 0.3))
        self.assertEqual(sum(1 for _ in run), 18)

    def test_what_is_written_passes_sheet_check(self):
        write("copy.sheet", Run("run.sheet"))
        self.assertEqual(pathlib.Path("copy.sheet").read_bytes(), pathlib.Path("run.sheet").read_bytes())
        corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
        write("made.sheet", [make_frame(corners, [[0, 1, 2], [0, 2, 3]], [0.01, 0.02], time=i / 2) for i in range(2)])
        self.assertEqual(shell("sheet-check made.sheet").returncode, 0)
        bad = Run("made.sheet")[0]
        bad["volume"] = np.array([1, -1.0])
        with self.assertRaisesRegex(StreamError, "bad.sheet: frame 0 would be wrong: array \"volume\": triangle 1 has"):
            write("bad.sheet", [bad])

    def test_frames_that_cannot_be_made(self):
        square = np.zeros((4, 3))
        for wrong, message in (((square[:, :2], [[0, 1, 2]], 1), r"position has shape \(4, 2\)"),
                               ((square, [[0, 1, -1]], 1), "integers from 0"),
                               ((square, [[0, 1, 1]], 1), "names vertex 1 twice"),
                               ((square, [[0, 1, 2]], 1), "triangle 0 has no area: its corners lie on a line"),
                               ((np.eye(3), [[0, 1, 2]], 0), "the thickness of triangle 0 is 0 m, it must be positive"),
                               ((np.eye(3), [[0, 1, 2]], np.nan), "the thickness of triangle 0 is nan m"),
                               ((np.eye(3), [[0, 1, 2]], [1, 1, 1]), r"thickness has shape \(3,\), .* of 1 triangles"),
                               ((square * np.nan, [[0, 1, 2]], 1), "not finite")):
            with self.assertRaisesRegex(StreamError, "cannot make frame: .*" + message):
                make_frame(*wrong)

    def test_values_at_vertices(self):
        frame = Run("run.sheet")[-1]
        self.assertEqual(frame.vertex_thickness().shape, (frame.vertices,))
        self.assertLessEqual(frame.vertex_thickness().max(), frame.thickness().max())
        np.testing.assert_allclose(np.linalg.norm(frame.vertex_normals(), axis=1), 1)
        corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [5, 5, 5]]
        square = make_frame(corners, [[0, 1, 2], [0, 2, 3]], [1, 3])
        self.assertEqual(square.vertex_thickness().tolist(), [2, 1, 2, 3, 0])
        self.assertEqual(square.vertex_normals()[:, 2].tolist(), [1, 1, 1, 1, 0])
        self.assertTrue(np.isnan(square.kinetic_energy()))


class Checksums(unittest.TestCase):
    def test_numpy_says_what_xxhash_says(self):
        import xxhash
        data = np.random.default_rng(1).bytes(3 << 20)
        for size in (0, *range(17, 1500), 16384, 16385, (1 << 20) + 64, len(data)):
            self.assertEqual(checksum.numpy_checksum(data[:size]), xxhash.xxh3_64_intdigest(data[:size]), size)

    def test_streams_are_read_without_xxhash(self):
        corpus = root / "formats/corpus/1.0"
        code = ("import sys; sys.modules['xxhash'] = None\nimport sheetstream, pathlib\n"
                f"for path in sorted(pathlib.Path({str(corpus)!r}).glob('*/*.sheet')):\n"
                "    try: list(sheetstream.Reader(open(path, 'rb'))); print('passed')\n"
                "    except sheetstream.StreamError: print('failed')\n")
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
        counts = [len(list((corpus / kind).glob("*.sheet"))) for kind in ("failed", "passed")]
        self.assertEqual(done.stdout.split(), ["failed"] * counts[0] + ["passed"] * counts[1])


class Meshio(WithRun):
    def test_frames_are_what_sheet_info_says(self):
        for number, row in ((-1, self.rows[-1]), (0, self.rows[0])):
            mesh = meshio.read("run.sheet") if number else sheetstream.meshio.read("run.sheet", frame=0)
            thickness, volume = mesh.cell_data["thickness"][0], mesh.cell_data["volume"][0]
            self.assertEqual((len(mesh.points), len(mesh.cells[0])), (int(row["vertices"]), int(row["triangles"])))
            self.assertAlmostEqual(thickness.min(), float(row["thickness_min"]), delta=1e-15)
            self.assertAlmostEqual(volume.sum(), float(row["volume"]), delta=1e-14)
            self.assertEqual((mesh.field_data["time"][0], mesh.field_data["step"][0]),
                             (float(row["time"]), int(row["step"])))

    def test_there_and_back(self):
        mesh = meshio.read("run.sheet")
        meshio.write("back.sheet", mesh)
        frame, last = Run("back.sheet")[0], Run("run.sheet")[-1]
        for name in ("position", "triangle", "volume", "velocity"):
            np.testing.assert_array_equal(frame[name], last[name])
        self.assertEqual((frame.time, frame.step), (last.time, last.step))
        meshio.write("back.vtu", mesh)  # an array of 64 bits and vectors included
        self.assertEqual(len(meshio.read("back.vtu").points), last.vertices)

    def test_errors(self):
        pathlib.Path("bad.sheet").write_bytes(b"x" * 200)
        with self.assertRaisesRegex(meshio.ReadError, "bad.sheet: frame 0, byte 0: not a sheet stream"):
            sheetstream.meshio.read("bad.sheet")
        done = shell("/usr/bin/python3 -c 'import meshio, sheetstream.meshio; meshio.read(\"bad.sheet\")'")
        self.assertEqual(done.returncode, 1)
        self.assertIn("not a sheet stream", done.stdout + done.stderr)
        square = [[0, 0], [1, 0], [1, 1], [0, 1]]
        for mesh, message in ((meshio.Mesh(square, {"quad": [[0, 1, 2, 3]]}), "triangles only, the mesh has quad"),
                              (meshio.Mesh(square, {"triangle": [[0, 1, 2]]}), "needs cell data \"thickness\"")):
            with self.assertRaisesRegex(meshio.WriteError, message):
                meshio.write("no.sheet", mesh)


class Figures(WithRun):
    def test_colours_and_curves_say_their_units(self):
        run = Run("run.sheet")
        ax = plot.sheet(run[-1], up="y")
        self.assertEqual((ax.get_title(), ax.get_zlabel()), ("t = 0.3 s", "y [m]"))
        self.assertEqual(ax.figure.axes[1].get_ylabel(), "thickness [mm]")
        low, high = ax.figure.axes[1].get_ylim()
        thickness = 1e3 * run[-1].thickness()
        np.testing.assert_allclose((low, high), np.percentile(thickness, (1, 99)))
        for quantity in ("speed", "swept_volume"):
            plot.sheet(run[-1], quantity)
        with self.assertRaisesRegex(ValueError, '"heat" is neither'):
            plot.sheet(run[-1], "heat")
        axes = plot.curves(run, ["thickness_min"])
        np.testing.assert_allclose(axes[0].lines[0].get_ydata(), [1e3 * float(row["thickness_min"]) for row in self.rows])
        with self.assertRaisesRegex(ValueError, '"heat" is no curve'):
            plot.curves(run, ["heat"])

    def test_the_example_names_what_is_wrong(self):
        done = shell(f"{package}/example_figure.py nonesuch.sheet a.png")
        self.assertEqual((done.returncode, done.stdout), (3, ""))
        self.assertIn("nonesuch.sheet", done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
