#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What VTK's reader and ParaView's get of a run that sheet-export has written, against sheet-info and the stream; the
macro of formats/paraview, its state file and its picture. Ends with 77 where both programs are missing."""
import csv
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import matplotlib.image
import numpy as np

import sheetstream

try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError:
    vtk_to_numpy = None

root = pathlib.Path(__file__).resolve().parents[2]
PARAVIEW = shutil.which("pvpython") and os.environ.get("DISPLAY")

ASK = """
import sys
from paraview import simple as pv
for file in sys.argv[1:]:
    if file.endswith(".pvsm"):
        pv.LoadState(file)
        print("views", len(pv.GetRenderViews()))
        reader = next(s for s in pv.GetSources().values() if s.GetXMLName() == "PVDReader")
    else:
        reader = pv.OpenDataFile(file)
    for time in reader.TimestepValues:
        reader.UpdatePipeline(time)
        data, thickness = reader.GetDataInformation(), reader.CellData["thickness"].GetRange()
        print("frame", repr(time), data.GetNumberOfPoints(), data.GetNumberOfCells(), *map(repr, thickness))
    pv.ResetSession()
"""


def shell(command, **more):
    done = subprocess.run(["bash", "-ec", "set -o pipefail; " + command], capture_output=True, text=True, **more)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


class Readers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        os.chdir(cls.folder.name)
        shell("sheet-init --example | sed 's/^edge_length = .*/edge_length = 0.1/' > scene.toml; "
              "sheet-init scene.toml | sheet-loop -q --until 0.3 --fps 24 -o run.sheet -- "
              "'sheet-remesh | sheet-step | sheet-collide'; sheet-export run.sheet -o 'out/frame_%04d.vtu'; "
              "sheet-info --csv run.sheet > run.csv")
        pathlib.Path("ask.py").write_text(ASK)
        with open("run.csv") as file:
            cls.rows = [{k: float(v) for k, v in row.items() if v} for row in csv.DictReader(file)]

    @classmethod
    def tearDownClass(cls):
        os.chdir("/")
        cls.folder.cleanup()

    @unittest.skipUnless(vtk_to_numpy, "no vtkmodules; tests/install --all installs them")
    def test_vtk_reads_every_frame(self):
        run = sheetstream.Run("run.sheet")
        for i, row in enumerate(self.rows):
            reader = vtkXMLUnstructuredGridReader()
            reader.SetFileName(f"out/frame_{i:04}.vtu")
            reader.Update()
            grid = reader.GetOutput()
            self.assertEqual(reader.GetErrorCode(), 0)
            self.assertEqual((grid.GetNumberOfPoints(), grid.GetNumberOfCells()), (row["vertices"], row["triangles"]))
            self.assertEqual(grid.GetFieldData().GetArray("TimeValue").GetValue(0), row["time"])
            np.testing.assert_array_equal(vtk_to_numpy(grid.GetPoints().GetData()), run[i]["position"])
            np.testing.assert_array_equal(vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 3),
                                          run[i]["triangle"])
            self.assertEqual({grid.GetCellType(k) for k in range(grid.GetNumberOfCells())}, {5})
            thickness = vtk_to_numpy(grid.GetCellData().GetArray("thickness"))
            np.testing.assert_allclose([thickness.min(), thickness.max()], [row["thickness_min"], row["thickness_max"]],
                                       rtol=1e-12)
            volume = vtk_to_numpy(grid.GetCellData().GetArray("volume")).sum()
            self.assertAlmostEqual(volume / row["volume"], 1, places=12)

    @unittest.skipUnless(PARAVIEW, "no pvpython and xvfb-run; tests/install --all installs them")
    def test_paraview_reads_every_frame_and_shows_thickness_and_touch(self):
        commands = re.findall(r"^    \$ (.+)$", (root / "docs/paraview.md").read_text(), re.M)
        self.assertEqual(len(commands), 3)
        os.makedirs("page")
        shell(f"ln -s ../run.sheet {root}/formats .; " +
              "; ".join(commands), cwd="page")
        said = shell("pvpython ask.py page/out/frame.pvd page/run.pvsm")
        self.assertIn("views 2", said)
        frames = np.array([line.split()[1:] for line in said.splitlines() if line.startswith("frame")], float)
        wanted = [[row[k] for k in ("time", "vertices", "triangles", "thickness_min", "thickness_max")] for row in self.rows]
        np.testing.assert_allclose(frames, 2 * wanted, rtol=1e-12)
        picture = matplotlib.image.imread("page/run.png")[:, :, :3]
        left, right = picture[:, :430], picture[:, 600:1030]  # without the scales
        self.assertGreater((left[:, :, 1] > left[:, :, 0] + 0.15).mean(), 0.02)  # green
        self.assertGreater((right[:, :, 0] > right[:, :, 1] + 0.3).mean(), 0.0002)  # red

    @unittest.skipUnless(PARAVIEW, "no pvpython and xvfb-run; tests/install --all installs them")
    def test_errors_name_the_file_and_the_remedy(self):
        shell("sheet-select --last run.sheet | sheet-export --solidify -o bare.vtu")
        for file, message in (("no.pvd", "no.pvd: no such file; sheet-export"),
                              ("bare.vtu", "bare.vtu: no array thickness")):
            done = subprocess.run(["pvpython", str(root / "formats/paraview/show_sheet.py"), file],
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 2)
            self.assertIn(message, done.stdout + done.stderr)


if __name__ == "__main__":
    if not vtk_to_numpy and not PARAVIEW:
        print("skipped: neither VTK nor ParaView is here; tests/install --all installs them")
        sys.exit(77)
    unittest.main(verbosity=2)
