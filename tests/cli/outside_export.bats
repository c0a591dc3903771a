#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# Exported meshes keep what a user's frames hold.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
  cat > text << 'END'
sheet-text 1.0
frame
time 0
step 0
vertices 4
triangles 2
edges 0
array position vertex float64 3 m interpolate
0 0 0
1 0 0
0 1 0
1 1 0
array triangle triangle uint32 3 1 drop
0 1 2
1 3 2
array volume triangle float64 1 m^3 conserve
0.1
0.1
END
  cat >> text << 'END'
array thickness vertex float64 1 m interpolate
7
7
7
7
array x vertex float64 1 1 copy
1
2
3
4
array bits vertex uint64 1 1 copy
9007199254740993
0
1
18446744073709551615
array vertex_indices triangle float64 1 1 copy
5
6
array velocity_x vertex float64 1 1 copy
8
8
8
8
array velocity vertex float64 3 m/s interpolate
0 0 0
0 0 0
0 0 0
0 0 0
end
END
  sed 's/^time 0/time 1.25/' text | sheet-parse -o a.sheet
}

@test "26: an array called thickness keeps its numbers, integers their bits, a file its time" {
  sheet-export a.sheet -o a.vtu
  for name in thickness thickness.array bits.low32 bits.high32 TimeValue; do
    grep -aq "Name=\"$name\"" a.vtu
  done
  grep -aq 'TimeValue.*>1.25<' a.vtu
  /usr/bin/python3 - << 'END'
import meshio
data = meshio.read("a.vtu").point_data
assert list(data["thickness.array"].ravel()) == [7, 7, 7, 7], data
bits = [int(low) | int(high) << 32 for low, high in zip(data["bits.low32"].ravel(), data["bits.high32"].ravel())]
assert bits == [9007199254740993, 0, 1, 18446744073709551615], bits
END
}

@test "26: no two properties of a PLY element have one name" {
  sheet-export a.sheet -o a.ply
  sed '/^end_header/q' a.ply | tr -d '\0' | grep -a '^element\|^property' > header
  awk '/^element/{kind = $2} /^property/{if (seen[kind " " $NF]++) exit 1}' header
  grep -q 'property double x_2' header
  grep -q 'property double vertex_indices_2' header
  sheet-export --help | grep -q meshio
}

# Two layers, 30 x 30 x 2 mm, that touch.
two_layers() {
  sheet-parse -o layers.sheet << 'END'
sheet-text 1.0
frame
time 0.5
step 1
vertices 8
triangles 4
edges 0
array position vertex float64 3 m interpolate
0 0 0
0.03 0 0
0.03 0.03 0
0 0.03 0
0 0 0.002
0.03 0 0.002
0.03 0.03 0.002
0 0.03 0.002
array triangle triangle uint32 3 1 drop
0 1 2
0 2 3
4 5 6
4 6 7
array volume triangle float64 1 m^3 conserve
9e-7
9e-7
9e-7
9e-7
array velocity vertex float64 3 m/s interpolate
1 0 0
1 0 0
1 0 0
1 0 0
2 0 0
2 0 0
2 0 0
2 0 0
end
END
}

@test "43: --union makes one closed body of layers, with the liquid's volume and its velocities" {
  two_layers
  for ending in ply obj off stl glb vtu vdb; do
    sheet-export --union layers.sheet -o "a.$ending"
    sheet-export --union --threads 1 layers.sheet -o "one.$ending"
    cmp "a.$ending" "one.$ending"
  done
  /usr/bin/python3 - << 'END'
import meshio
import numpy as np

mesh = meshio.read("a.vtu")
x, faces = mesh.points, mesh.cells_dict["triangle"]
sides = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
assert len(np.unique(sides, axis=0)) == len(sides)
assert set(map(tuple, sides)) == set(map(tuple, sides[:, ::-1]))
volume = np.einsum("ij,ij->", x[faces[:, 0]], np.cross(x[faces[:, 1]], x[faces[:, 2]])) / 6
assert abs(volume / 3.6e-6 - 1) < 1e-6, volume
assert len(x) - len(sides) // 2 + len(faces) == 2, "one part without holes"
speed = mesh.point_data["velocity"][:, 0]
assert np.allclose(speed[x[:, 2] < 0], 1) and np.allclose(speed[x[:, 2] > 0.002], 2)
for ending in ("ply", "obj", "off", "stl"):
    other = meshio.read(f"a.{ending}")
    assert len(other.cells_dict["triangle"]) == len(faces), ending
END
}

@test "43: layers apart are one body if --close says so; -v tells what was done" {
  two_layers
  sheet-print layers.sheet | sed 's/ 0.002$/ 0.0025/' | sheet-parse -o apart.sheet
  euler() {
    sheet-export --union "$@" -o a.off
    awk 'NR == 2 {points = $1; faces = $2} END {print points - faces / 2}' a.off
  }
  [ "$(euler apart.sheet --close 0.1mm)" = 4 ]
  [ "$(euler apart.sheet --close 0.5mm)" = 2 ]
  sheet-export -v --union --voxel 0.4mm --close 0 apart.sheet -o a.off 2> told
  grep -q 'voxels of 0.0004 m; closing 0 m; the union holds 1[0-9][0-9]' told
}

@test "43: what contradicts --union is refused by name" {
  two_layers
  refused() {
    run -2 sheet-export layers.sheet "${@:2}"
    [[ $output == *"$1"* ]] || { echo "$output"; return 1; }
  }
  refused '--union and --solidify are two surfaces' --union --solidify -o a.ply
  refused '--voxel says how to unite layers: give --union' --voxel 1mm -o a.ply
  refused '--close says how to unite layers: give --union' --close 1mm -o a.ply
  refused '--keep-voids says how to unite layers: give --union' --keep-voids -o a.ply
  refused 'a.vdb: a level set (.vdb) is made of a closed surface: give --union' -o a.vdb
  refused '--voxel: "0": a length above 0, such as 0.3mm, is wanted' --union --voxel 0 -o a.ply
  refused '--close: "-1mm": a length of 0 or more, such as 0.3mm, is wanted' --union --close=-1mm -o a.ply
  refused '--voxel: expected a length such as "2.5 mm"' --union --voxel 3s -o a.ply
  refused '--voxel: 1e-07 m makes some' --union --voxel 0.1um -o a.ply
}

@test "what a PLY brings along is in every exported surface: at points, at faces, as texture" {
  source=$BATS_TEST_DIRNAME/../features
  cp "$source/painted.ply" .
  sed '/inflow/,$d' "$source/painted.toml" > painted.toml
  sheet-init painted.toml | sheet-loop -q --steps 3 -o run.sheet -- 'sheet-remesh --edge-length 0.012 | sheet-step --dt 0.01'
  sheet-select --last run.sheet > end.sheet
  sheet-export end.sheet -o flat.ply
  sheet-export --solidify end.sheet -o thick.ply
  sheet-export --union --voxel 1.5mm --close 0 end.sheet -o body.ply
  sheet-export --solidify end.sheet -o thick.obj
  sheet-export --solidify end.sheet -o thick.vtu
  /usr/bin/python3 - "$BATS_TEST_DIRNAME/../.." << 'END'
import os, pathlib, sys
import numpy as np
sys.path.insert(0, os.path.join(sys.argv[1], "formats/blender/sheet_blender"))
import body_files
def rows(name, element):
    head = body_files._read_header(pathlib.Path(name))
    with open(name, "rb") as file:
        file.seek(head.size)
        vertex = np.fromfile(file, head.vertex, head.vertices)
        return vertex if element == "vertex" else np.fromfile(file, head.triangle, head.triangles)
flat = rows("flat.ply", "vertex")
assert len(flat) > 60, len(flat) # it has been remeshed, and the map is that of the start
for name in ("flat.ply", "thick.ply", "body.ply"):
    at, of = rows(name, "vertex"), rows(name, "face")
    assert {"uv_0", "uv_1"} <= set(at.dtype.names) and {"material"} <= set(of.dtype.names), name
    assert set(np.unique(of["material"])) == {0, 1}, name
    assert at["uv_0"].min() >= -1e-9 and at["uv_0"].max() <= 1 + 1e-9, name
    assert np.corrcoef(at["x"], at["uv_0"])[0, 1] > 0.99, name
    middle = at["uv_0"][of[[n for n in of.dtype.names if "ind" in n][0]]].mean(axis=1)
    clear = abs(middle - 0.6) > 0.25
    assert ((middle > 0.6) == (of["material"] == 1))[clear].all(), name
thick = rows("thick.ply", "face")
assert "volume" not in thick.dtype.names
obj = open("thick.obj").read().split("\n")
count = [sum(line.startswith(word + " ") for line in obj) for word in ("v", "vt", "vn", "f")]
assert count[0] == count[1] == count[2] == 2 * len(flat) and count[3] == len(thick), count
END
}

@test "26: of a stream that was cut what is whole is exported, with the list of it" {
  cat a.sheet a.sheet a.sheet | head -c -100 > cut.sheet
  run -4 sheet-export cut.sheet -o 'f%d.vtu'
  [[ -s f0.vtu && -s f1.vtu && ! -e f2.vtu ]]
  [[ $(grep -c 'file="f[01].vtu"' f.pvd) == 2 ]]
  head -c "$(($(stat -c %s a.sheet) + 100))" cut.sheet > first.sheet
  run -4 sheet-export first.sheet -o one.obj
  [[ -s one.obj ]]
}
