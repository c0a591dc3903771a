# SPDX-License-Identifier: GPL-3.0-or-later
"""What a program gets of each frame of a run: rows of time, points, cells, least, mean and greatest thickness [m]. Mean: all
volume over all area, as sheet-info has it. READERS has all programs; one that is missing raises Missing."""
import base64
import csv
import json
import pathlib
import re
import shutil
import subprocess
import tempfile

import numpy as np

import sheetstream

here = pathlib.Path(__file__).resolve().parent
root = here.parents[1]
THREE = pathlib.Path("/usr/share/javascript/three")
FIGURES = ("time", "points", "cells", "least", "mean", "greatest")


class Missing(Exception):
    """The program is not here."""


def shell(command):
    done = subprocess.run(["bash", "-ec", "set -o pipefail; " + command], capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(done.stdout + done.stderr)
    return done.stdout


def row(time, points, triangles, thickness):
    """Thickness of triangles; areas come from the points."""
    a, b, c = (np.asarray(points, float)[np.asarray(triangles)[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    return [time, len(points), len(triangles), thickness.min(), (thickness * area).sum() / area.sum(), thickness.max()]


def sheet_info(run):
    rows = csv.DictReader(shell(f"sheet-info --csv {run}").splitlines())
    names = ("time", "vertices", "triangles", "thickness_min", "thickness_mean", "thickness_max")
    return [[float(each[name]) for name in names] for each in rows]


def python(run):
    return [row(frame.time, frame["position"], frame["triangle"], frame.thickness()) for frame in sheetstream.Run(run)]


def by_meshio(run):
    try:
        import meshio
    except ImportError as error:
        raise Missing("meshio") from error
    import sheetstream.meshio
    meshes = (sheetstream.meshio.read(run, frame=i) for i in range(len(sheetstream.Run(run))))
    return [row(mesh.field_data["time"][0], mesh.points, mesh.cells_dict["triangle"], mesh.cell_data["thickness"][0])
            for mesh in meshes if isinstance(mesh, meshio.Mesh)]


def vtk(run):
    try:
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
    except ImportError as error:
        raise Missing("vtkmodules") from error
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        shell(f"sheet-export {run} -o {folder}/%04d.vtu")
        for file in sorted(pathlib.Path(folder).glob("*.vtu")):
            reader = vtkXMLUnstructuredGridReader()
            reader.SetFileName(str(file))
            reader.Update()
            grid = reader.GetOutput()
            rows.append(row(grid.GetFieldData().GetArray("TimeValue").GetValue(0), vtk_to_numpy(grid.GetPoints().GetData()),
                            vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 3),
                            vtk_to_numpy(grid.GetCellData().GetArray("thickness"))))
    return rows


def in_blender(how, file):
    """What in_blender.py says there."""
    if not shutil.which("blender"):
        raise Missing("blender")
    done = shell(f"blender -b --factory-startup --python-exit-code 1 --python {here}/in_blender.py -- {how} {root} {file}")
    return json.loads(re.search(r"^rows (.*)$", done, re.M)[1])


def blender(run):
    return in_blender("run", run)


def glb_files(run, folder):
    shell(f"sheet-export {run} -o {folder}/%04d.glb")
    return sorted(pathlib.Path(folder).glob("*.glb"))


def gltf_in_blender(run):
    with tempfile.TemporaryDirectory() as folder:
        glb_files(run, folder)
        return in_blender("gltf", folder)


def gltf_in_three(run):
    """three.js's own loader, in Chromium."""
    from browser import Browser
    if not (THREE / "examples/js/loaders/GLTFLoader.js").exists():
        raise Missing("libjs-three")
    rows = []
    with tempfile.TemporaryDirectory() as folder, Browser(800, 600) as browser:
        for name in ("three.min.js", "examples/js/loaders/GLTFLoader.js"):
            shutil.copy(THREE / name, folder)
        page = pathlib.Path(folder) / "gltf.html"
        for file in glb_files(run, folder):
            packed = base64.b64encode(file.read_bytes()).decode()
            page.write_text((here / "gltf.html").read_text().replace("{{GLB}}", packed))
            browser.open(page)
            rows.append(browser.js("window.row"))
    return rows


READERS = {"sheet-info": sheet_info, "sheetstream, Python": python, "meshio": by_meshio, "VTK, of `.vtu`": vtk,
           "Blender, by the add-on": blender, "Blender, of `.glb`": gltf_in_blender, "three.js, of `.glb`": gltf_in_three}
