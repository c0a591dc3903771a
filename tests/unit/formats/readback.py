# SPDX-License-Identifier: GPL-3.0-or-later
"""readback.py UNIT_FORMATS: exported meshes, read back by meshio and numpy, have their points, cells and arrays."""
import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

import meshio
import numpy as np

POINTS = np.array([[0.1, 1 / 3, -1e-300], [1e300, 0, -0.0], [5e-324, 2, 123456789.123456789], [1, 1, 1]])
TRIANGLES = np.array([[0, 1, 2], [2, 1, 3]])
POINT_THICKNESS = np.array([0.1, 0.2, 0.3, 1 / 7])
CELL_THICKNESS = np.array([1e-5, 2 / 3])
VELOCITY = np.arange(1.0, 13.0).reshape(4, 3)


def same(what, found, expected):
    assert np.array_equal(np.asarray(found), expected), f"{what}: {found} instead of {expected}"


def check_ply_by_numpy(path):
    """The body of the PLY file by its documented layout, without any PLY library."""
    with open(path, "rb") as file:
        header, body = file.read().split(b"end_header\n", 1)
    names = [line.split()[-1].decode() for line in header.splitlines() if line.startswith(b"property double")]
    vertex = np.dtype([(name, "<f8") for name in names[:-1]])
    face = np.dtype([("n", "u1"), ("corners", "<i4", 3), (names[-1], "<f8")])
    vertices = np.frombuffer(body, vertex, len(POINTS))
    faces = np.frombuffer(body, face, len(TRIANGLES), vertices.nbytes)
    assert vertices.nbytes + faces.nbytes == len(body)
    same("PLY points", np.stack([vertices[axis] for axis in "xyz"], axis=1), POINTS)
    same("PLY thickness", vertices["thickness"], POINT_THICKNESS)
    same("PLY velocity", np.stack([vertices["velocity_" + axis] for axis in "xyz"], axis=1), VELOCITY)
    same("PLY corners", faces["corners"], TRIANGLES)
    same("PLY face thickness", faces["thickness"], CELL_THICKNESS)


def main():
    with tempfile.TemporaryDirectory() as folder:
        environment = dict(os.environ, SHEET_READBACK_FOLDER=folder)
        subprocess.run([sys.argv[1], "--gtest_filter=MeshExport.WritesFilesForReadback"], env=environment, check=True,
                       stdout=subprocess.DEVNULL)
        read = {ending: meshio.read(f"{folder}/mesh.{ending}") for ending in ("vtu", "obj", "off")}
        read["ply"] = meshio.read(f"{folder}/points.ply")
        for ending, mesh in read.items():
            same(ending + " points", mesh.points, POINTS)
            same(ending + " cells", mesh.cells_dict["triangle"], TRIANGLES)
        same("VTU thickness", read["vtu"].point_data["thickness"], POINT_THICKNESS)
        same("VTU velocity", read["vtu"].point_data["velocity"], VELOCITY)
        same("VTU cell thickness", read["vtu"].cell_data["thickness"][0], CELL_THICKNESS)
        same("PLY thickness", read["ply"].point_data["thickness"], POINT_THICKNESS)
        check_ply_by_numpy(f"{folder}/mesh.ply")
        assert len(meshio.read(f"{folder}/mesh.stl").cells_dict["triangle"]) == len(TRIANGLES)
        sets = ElementTree.parse(f"{folder}/mesh.pvd").getroot().findall("Collection/DataSet")
        assert [(s.get("timestep"), s.get("file")) for s in sets] == [("0", "mesh.vtu"), ("0.25", "mesh.vtu")]


main()
