#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes hostile streams of a good one: frames whose checksums are right and whose contents are wrong.

    tests/cli/hostile_frames.py GOOD.sheet FOLDER

Each is the last frame of GOOD.sheet with one thing changed; FOLDER/WHAT.sheet tells by its name what that is.
"""
import copy
import pathlib
import re
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "formats" / "python"))
import sheetstream  # noqa: E402
from sheetstream import Array  # noqa: E402

sheetstream.stream.find_form_error = lambda frame: None  # the writer would refuse
good_file, folder = sys.argv[1], pathlib.Path(sys.argv[2])
folder.mkdir(parents=True, exist_ok=True)
good = list(sheetstream.read(open(good_file, "rb")))[-1]
for one in good.arrays.values():  # what was read cannot be written to
    if not isinstance(one.values, str):
        one.values = one.values.copy()


def write(name, frame):
    with open(folder / f"{name}.sheet", "wb") as file:
        writer = sheetstream.Writer(file)
        writer.write(frame)
        writer.end()


def changed(name):
    """Decorates a function that changes a frame: it is called, and the frame written. What needs an array that the
    frame does not have is left out."""
    def make(change):
        frame = copy.deepcopy(good)
        try:
            change(frame)
        except KeyError:
            return
        write(name, frame)
    return make


# Every number in its turn.
EXTREMES = {"nan": np.nan, "minus_infinite": -np.inf, "enormous": -1e300, "large": 1e29, "tiny": 5e-324}
for array in [name for name, a in good.arrays.items() if a.type == "float64" and a.rows > 0]:
    for word, number in EXTREMES.items():
        @changed(f"{array}_{word}")
        def _(f, array=array, number=number):
            f[array].flat[f[array].size // 2] = number

    @changed(f"{array}_all_zero")
    def _(f, array=array):
        f[array][...] = 0

    @changed(f"{array}_all_enormous")
    def _(f, array=array):
        f[array][...] *= 1e200

# Every set of bits, every index.
for array in [name for name, a in good.arrays.items() if a.type == "uint64"]:
    for word, bits in {"all": 2**64 - 1, "last": 2**63}.items():
        @changed(f"{array}_{word}_bits")
        def _(f, array=array, bits=bits):
            f[array][...] = bits

    @changed(f"{array}_wide")
    def _(f, array=array):
        old = f.arrays[array]
        wide = np.zeros((old.rows, 40), "u8")
        wide[:, -1] = 2**63
        f.arrays[array] = Array(wide, old.place, old.unit, old.transfer)

for array in [name for name, a in good.arrays.items() if a.type == "uint32" and a.rows > 0]:
    for word, index in {"out_of_range": good.vertices, "enormous": 2**32 - 1, "same": 0}.items():
        @changed(f"{array}_{word}")
        def _(f, array=array, index=index):
            f[array].flat[-1] = index

    @changed(f"{array}_all_same")
    def _(f, array=array):
        f[array][...] = f[array][0]

# Every array left out, of another kind, in another place.
for array in list(good.arrays):
    @changed(f"{array}_missing")
    def _(f, array=array):
        del f.arrays[array]

    @changed(f"{array}_of_bytes")
    def _(f, array=array):
        old = f.arrays[array]
        rows = old.rows if old.place != "frame" else 1
        f.arrays[array] = Array(np.zeros((rows, 2), "i1"), old.place, "1", "copy")

    @changed(f"{array}_of_the_frame")
    def _(f, array=array):
        f.arrays[array] = Array(np.zeros((1, 3)), "frame", "m", "copy")


# The mesh.
def with_triangles(frame, triangles):
    frame["triangle"] = np.array(triangles, "u4")
    frame["volume"] = np.full(len(triangles), frame["volume"][0])
    for name in [n for n, a in frame.arrays.items() if a.place == "edge"]:
        del frame.arrays[name]


@changed("mesh_turned")
def _(f):
    f["triangle"][3] = f["triangle"][3][[1, 0, 2]]


@changed("mesh_twice")
def _(f):
    with_triangles(f, [*f["triangle"], *f["triangle"]])


@changed("mesh_three_at_an_edge")
def _(f):
    with_triangles(f, [*f["triangle"], [*f["triangle"][0][:2], f.vertices - 1]])


@changed("mesh_lonely_vertices")
def _(f):
    with_triangles(f, f["triangle"][:3])


@changed("mesh_empty")
def _(f):
    with_triangles(f, np.zeros((0, 3)))


@changed("mesh_pinched")
def _(f):
    t = f["triangle"]
    apart = [u for u in t if not set(u) & set(t[0])][0]
    with_triangles(f, [*t, [apart[0], *t[0][:2][::-1]]])


@changed("mesh_one_triangle")
def _(f):
    with_triangles(f, f["triangle"][:1])


# The shape.
@changed("shape_line")
def _(f):
    f["position"][:, 1:] = 0


@changed("shape_two_points")
def _(f):
    f["position"][::2] = 0
    f["position"][1::2] = [1, 0, 0]


@changed("shape_shuffled")
def _(f):
    f["position"][...] = f["position"][::-1] * [1, 3, 2]


for exponent in (-300, -30, 12, 29):
    @changed(f"shape_times_1e{exponent}")
    def _(f, exponent=exponent):
        f["position"][...] *= 10.0**exponent


@changed("shape_thrown")
def _(f):
    f["position"][1] = [1e9, 0, 0]


@changed("shape_folded")
def _(f):
    f["position"][:, 0] = np.abs(f["position"][:, 0])


# Clocks.
for word, time in {"before": -1e300, "late": 1.7976931348623157e308, "denormal": 5e-324}.items():
    @changed(f"time_{word}")
    def _(f, time=time):
        f.time = time


@changed("step_last")
def _(f):
    f.step = 2**64 - 1


# What the scene says.
def scene(name, old, new):
    @changed(f"scene_{name}")
    def _(f):
        text = f.arrays["scene"].values
        result = re.sub(old, lambda _: new, text, count=1, flags=re.M | re.S)
        if result == text:
            raise KeyError(name)
        f.arrays["scene"] = Array(result, "frame")


scene("empty", r".*", "")
scene("is_no_toml", r".*", "[[[[[[[[")
scene("deep", r".*", "a = " + "[" * 5000)
scene("zeros", r"\A", "\x01\x02")
scene("escapes", r"\A", "# \x1b]0;title\x07\x1b[2J\n")
scene("key_escapes", r"\A", '"\\u001b[2J" = 1\n')
for key in ("viscosity", "density", "thickness", "radius", "edge_length", "below", "gravity", "adhesion", "normal", "center",
            "surface_velocity", "velocity", "until", "stiffness", "surface_tension", "level", "motion"):
    for word, value in {"negative": "-1", "enormous": "1e300", "tiny": "5e-324", "nan": "nan", "text": '"\\u0007"',
                        "list": "[1e300, -1e300, 1e300]", "zeros": "[0, 0, 0]"}.items():
        scene(f"{key}_{word}", rf"^{key} = [^\n]*", f"{key} = {value}")
scene("other_shape", r'^shape = "disk"', 'shape = "sphere"')
scene("mesh_missing", r'^shape = "plane"', 'shape = "mesh"\nfile = "nowhere.obj"')
scene("mesh_device", r'^shape = "plane"', 'shape = "mesh"\nfile = "/dev/zero.obj"')
scene("mesh_checksum", r'^shape = "plane"', 'shape = "mesh"\nfile = "../../../../../../../../x.obj"\nchecksum = "0"')
scene("without_solids", r"^\[\[solid\]\].*?(?=^\[|\Z)", "")
scene("without_holds", r"^\[\[hold\]\].*?(?=^\[|\Z)", "")
scene("many_solids", r"\Z", '\n[[solid]]\nshape = "sphere"\nradius = 0.1\ncenter = [9, 9, 9]' * 300)
scene("tiny_solid", r"\Z", '\n[[solid]]\nshape = "sphere"\nradius = 5e-324\n')
scene("enormous_solid", r"\Z", '\n[[solid]]\nshape = "box"\nsize = [1e300, 1e300, 1e-300]\ncenter = [1e300, 0, 0]\n')
scene("fast_solid", r"\Z", '\n[[solid]]\nshape = "sphere"\nradius = 0.1\ncenter = [0, 0, 3]\n'
      'motion = {kind = "translating", velocity = [0, 0, -1e25]}\n')
scene("spinning_solid", r"\Z", '\n[[solid]]\nshape = "box"\nsize = [9, 0.1, 0.1]\ncenter = [0, 0, 3]\n'
      'motion = {kind = "rotating", axis = [0, 1, 0], rate = 1e12}\n')

# Arrays that nobody knows.
@changed("unknown_critical")
def _(f):
    f.arrays["unknown"] = Array(np.zeros(f.vertices), "vertex", critical=True)


@changed("unknown_many")
def _(f):
    for i in range(1000):
        f.arrays[f"unknown{i}"] = Array(np.full(f.vertices, np.nan), "vertex", "1", "interpolate")


@changed("unknown_wide")
def _(f):
    f.arrays["unknown"] = Array(np.zeros((0, 2**31)), "frame", "1", "drop")


@changed("provenance_escapes")
def _(f):
    f.arrays["provenance"] = Array("1 sheet-\x1b[2Jinit\n2 \x1b]0;title\x07", "frame")
