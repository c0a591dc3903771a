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
