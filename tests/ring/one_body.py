#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The last frame of a run as one body is closed and holds the liquid: tests/ring/one_body.py RUN.sheet

Checked of `sheet-export --union`: every edge has two faces, one on either side (so none has four); with voids the volume
is that of the frame within 0.1 %; one thread and two give the same bytes. Voxels are half the median thickness, or up to
all of it where there would be very many; what is 800 times as wide as it is thick is passed over.
"""
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "formats" / "python"))
import sheetstream  # noqa: E402


def read_off(file):
    with open(file) as text:
        text.readline()  # OFF
        points, faces, _ = map(int, text.readline().split())
        numbers = np.fromfile(text, sep=" ")
    x = numbers[:3 * points].reshape(points, 3)
    return x, numbers[3 * points:].reshape(faces, 4)[:, 1:].astype(int)


def export(run, out, *options):
    last = subprocess.run(["sheet-select", "--last", run], check=True, capture_output=True).stdout
    subprocess.run(["sheet-export", "--union", *options, "-", "-o", out], check=True, input=last)


def check_closed(faces, what):
    sides = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).astype(np.int64)
    there, back = (sides[:, i] * (faces.max() + 1) + sides[:, 1 - i] for i in (0, 1))
    if len(np.unique(there)) != len(there) or not np.array_equal(np.sort(there), np.sort(back)):
        sys.exit(f"{what}: not closed, or an edge of more than two faces")


def main():
    run = sys.argv[1]
    with open(run, "rb") as stream:
        for frame in sheetstream.read(stream, run):
            pass
    corners = frame["position"][frame["triangle"]]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    volume = frame["volume"].ravel()
    median = float(np.median(volume / np.maximum(area, 1e-300)))
    if area.sum() > 6e5 * median ** 2:
        print(f"{run}: too thin for its width to be divided into voxels")
        return
    voxel = str(min(median, max(median / 2, float(area.sum() / 1e5) ** 0.5)))
    with tempfile.TemporaryDirectory() as folder:
        files = [pathlib.Path(folder) / f"{i}.off" for i in range(3)]
        export(run, files[0], "--voxel", voxel, "--keep-voids", "--threads", "1")
        export(run, files[1], "--voxel", voxel, "--keep-voids", "--threads", "2")
        export(run, files[2], "--voxel", voxel)
        if files[0].read_bytes() != files[1].read_bytes():
            sys.exit(f"{run}: as one body, two threads give other bytes than one")
        for file in files[1:]:
            x, faces = read_off(file)
            check_closed(faces, run)
            if file == files[1]:
                a, b, c = (x[faces[:, i]] for i in range(3))
                drops = frame["drop_volume"].sum() if "drop_volume" in frame else 0
                held = np.einsum("ij,ij", a, np.cross(b, c)) / 6 / (volume.sum() + drops)
                if abs(held - 1) > 1e-3:
                    sys.exit(f"{run}: as one body it holds {held:.5f} of the liquid")
                print(f"{pathlib.Path(run).name}: one body of {len(faces)} faces, {held:.7f} of the liquid")


main()
