#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What every program gets of one run, whose mesh changes: times, points, cells and thickness as sheet-info has them."""
import os
import tempfile
import unittest

import numpy as np

import sheetstream
from readers import READERS, Missing, shell

AT_VERTICES = ("Blender, of `.glb`", "three.js, of `.glb`")
SINGLE = (*AT_VERTICES, "Blender, by the add-on")


class Readers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        os.chdir(cls.folder.name)
        shell("sheet-init --example | sed 's/^edge_length = .*/edge_length = 0.1/' > scene.toml; sheet-init scene.toml | "
              "sheet-loop -q --until 0.375 --fps 24 -o run.sheet -- 'sheet-remesh | sheet-step | sheet-collide'")
        cls.wanted = np.array(READERS["sheet-info"]("run.sheet"))
        cls.at_vertices = cls.wanted.copy()
        for row, frame in zip(cls.at_vertices, sheetstream.Run("run.sheet")):
            row[3], row[5] = frame.vertex_thickness().min(), frame.vertex_thickness().max()

    @classmethod
    def tearDownClass(cls):
        os.chdir("/")
        cls.folder.cleanup()

    def test_they_get_what_sheet_info_says(self):
        self.assertEqual(len(self.wanted), 10)
        self.assertGreater(len(set(self.wanted[:, 1])), 2)
        for name, read in READERS.items():
            with self.subTest(name):
                try:
                    rows = np.array(read("run.sheet"))
                except Missing as error:
                    self.skipTest(f"no {error}; tests/install --all installs it")
                wanted = self.at_vertices if name in AT_VERTICES else self.wanted
                np.testing.assert_array_equal(rows[:, 1:3], wanted[:, 1:3])
                np.testing.assert_allclose(rows, wanted, rtol=1e-5 if name in SINGLE else 1e-12, atol=1e-15)


if __name__ == "__main__":
    unittest.main(verbosity=2)
