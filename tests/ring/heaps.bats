#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# Layers that lie on each other have no faces between them: tension sees one body.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
}

# usage: disk HEIGHT THICKNESS: [[sheet]] of 20 mm radius, in mm
disk() {
  cat << END
[[sheet]]
name = "at $1 mm"
shape = "disk"
radius = "20 mm"
edge_length = "2 mm"
thickness = "$2 mm"
center = [0, "$1 mm", 0]
END
}

# usage: last FILE COLUMN: of the last frame
last() {
  sheet-select --last "$1" | sheet-info --csv | awk -F, -v name="$2" '
    NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) c = i } END { print $c }'
}

# A free disk of viscous liquid shrinks as A0/(1 + 2 γ t/(3 μ h0)); N layers that each had a tension of their own would
# do so N times as fast.
@test "layers contract as one body" {
  cat > liquid.toml << 'END'
[material]
viscosity = "10 Pa*s"
density = "1000 kg/m^3"
surface_tension = "0.06 N/m"
[[solid]]
shape = "plane"
contact = "slip"
[contact]
self = true
END
  { disk 0.5 1; disk 1.5 1; disk 2.5 1; cat liquid.toml; } > layers.toml
  { disk 1.5 3; cat liquid.toml; } > body.toml
  for scene in layers body; do
    sheet-init "$scene.toml" | sheet-loop -q --until 0.2 --fps 100 -o $scene.sheet -- 'sheet-step | sheet-collide'
    sheet-check $scene.sheet
  done
  awk -v layers="$(last layers.sheet area)" -v body="$(last body.sheet area)" 'BEGIN {
    law = 3.14159265 * 0.02 ^ 2 / (1 + 2 * 0.06 * 0.2 / (3 * 10 * 0.003))
    print "layers over the law", layers / 3 / law, "one body over it", body / law
    exit !(layers / 3 / law > 0.97 && layers / 3 / law < 1.03 && body / law > 0.99 && body / law < 1.01) }'
}

# Leaves folds.toml: honey, 28 mm high, 17 mm wide, in ten legs of 3 mm.
folds() {
  awk 'BEGIN {
    pi = 3.14159265358979; legs = 10; leg = 14; thick = 3; edge = 2; wide = 40; n = 0
    for (k = 0; k < legs; ++k) {
      side = k % 2 ? -1 : 1
      for (i = 0; i <= 7; ++i) { x[n] = side * leg * (i / 7 - 0.5); y[n++] = thick * (k + 0.5) }
      if (k < legs - 1) { x[n] = side * (leg + thick) / 2; y[n++] = thick * (k + 1) } # round the bend
    }
    rows = wide / edge
    for (i = 0; i < n; ++i) for (j = 0; j <= rows; ++j) print "v", x[i] / 1e3, y[i] / 1e3, (j * edge - wide / 2) / 1e3
    for (i = 0; i < n - 1; ++i) for (j = 0; j < rows; ++j) {
      a = i * (rows + 1) + j + 1; c = a + rows + 1
      if ((i + j) % 2) print "f", a, c, a + 1 "\nf", a + 1, c, c + 1
      else print "f", a, c, c + 1 "\nf", a, c + 1, a + 1
    }
  }' > folds.obj
  cat > folds.toml << 'END'
[sheet]
shape = "mesh"
file = "folds.obj"
thickness = "3 mm"
[material]
viscosity = "6 Pa*s"
density = "1400 kg/m^3"
surface_tension = "0.06 N/m"
[environment]
gravity = [0, "-9.81 m/s^2", 0]
[[solid]]
shape = "plane"
contact = "flow"
[contact]
self = true
END
}

# 2 γ is 1 % of the thrust ρ g H²/2 of its weight, and 20 γ would be 14 %.
@test "a heap of folds slumps as if it had no tension" {
  folds
  for tension in 0.06 0; do
    sheet-init folds.toml --set material.surface_tension=$tension |
      sheet-loop -q --until 0.4 --fps 25 -o $tension.sheet -- 'sheet-remesh --smooth | sheet-step | sheet-collide'
    sheet-check $tension.sheet
  done
  # 13 mm high and 12 without tension; with one on every face 16.
  awk -v with="$(last 0.06.sheet y_max)" -v without="$(last 0.sheet y_max)" 'BEGIN {
    print with, without; exit !(with < 1.1 * without && with > 0.95 * without && without < 0.014) }'
}

@test "adaptive edges within a heap: the same bits on 1 and 2 threads, and resumed = straight" {
  folds
  sheet-init folds.toml -o start.sheet
  # usage: go THREADS OPTION...: from there, or on
  go() {
    sheet-loop -q --fps 50 "${@:2}" -- \
      "sheet-remesh --smooth --adaptive 1e-4 | sheet-step --threads $1 | sheet-collide --threads $1"
  }
  go 1 -i start.sheet --until 0.12 -o straight.sheet
  go 1 -i start.sheet --until 0.06 -o resumed.sheet
  go 1 --resume resumed.sheet --until 0.12
  go 2 -i start.sheet --until 0.12 -o two.sheet
  sheet-diff straight.sheet resumed.sheet
  sheet-diff --ignore provenance straight.sheet two.sheet
}

# usage: of_two SCENE: radii of the cylinder that has the second moment, of each sheet, and of the upper one's rim mean and
# standard deviation, at the start and at the end [mm]
of_two() {
  PYTHONPATH=$BATS_TEST_DIRNAME/../../formats/python /usr/bin/python3 - "$1" << 'END'
import sys, numpy, sheetstream
run = sheetstream.Run(sys.argv[1])
for frame in run[0], run[-1]:
    place, radii = 1e3 * frame["position"][:, [0, 2]], []
    for sheet in 0, 1:
        own = frame["sheet"] == sheet
        corner, volume = place[frame["triangle"][own]], frame["volume"][own]
        square = ((corner**2).sum(axis=(1, 2)) + (corner.sum(axis=1) ** 2).sum(axis=1)) / 12
        radii.append((2 * (square * volume).sum() / volume.sum()) ** 0.5)
    upper = frame["triangle"][frame["sheet"] == 1]
    edges, count = numpy.unique(numpy.sort(upper[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0, return_counts=True)
    rim = numpy.hypot(*place[numpy.unique(edges[count == 1])].T)
    print(*radii, rim.mean(), rim.std())
END
}

# Chocolate of 3 Pa s on dough of 60, 6 mm thick each, of 20 and 40 mm. By lubrication of two layers, which knows no
# stretching, the lower one's radius grows by 0.88 mm in 1.2 s, and the upper one's by 5.8. When what thickness does to
# heights jerked the layers, single springs drew them out, and springs stayed where layers had met, these were 1.2 and
# 2.9 mm, the rim was 1.5 mm beside its mean and 0.2 mm thin, and it took 161 steps.
@test "a layer spreads on another one, and stays round" {
  { disk 3 6; disk 9.3 6; } | sed 's/"2 mm"/"3 mm"/; s/name = .*//' > upon.toml
  sed -i '0,/"20 mm"/s//"40 mm"/' upon.toml
  awk '{ print } /^center/ { print "[sheet.material]\nviscosity = \"" (++n == 1 ? 60 : 3) " Pa*s\"\ndensity = \"1000 kg/m^3\"" }
    END { print "[environment]\ngravity = [0, \"-9.81 m/s^2\", 0]\n[[solid]]\nshape = \"plane\"\ncontact = \"flow\"\n[contact]\nself = true" }' \
    upon.toml > lies.toml
  for tolerance in 0.0096 0.01 0.0104; do
    sheet-init lies.toml | sheet-loop -q --until 1.2 --fps 5 -o lies.sheet -- \
      "sheet-remesh --smooth | sheet-step --tolerance $tolerance | sheet-collide"
    sheet-check lies.sheet
    of_two lies.sheet > radii.txt
    echo "$(tr '\n' ' ' < radii.txt) $(last lies.sheet thickness_min) m thin, $(last lies.sheet step) steps"
    (($(last lies.sheet step) <= 60))
    awk -v h="$(last lies.sheet thickness_min)" 'NR == 1 { lower = $1; upper = $2 }
      END { exit !($1 - lower > 0.8 && $1 - lower < 1 && $2 - upper > 4.9 && $2 - upper < 6 && $4 < 0.7 && h > 8e-4) }' \
      radii.txt
  done
}

# Ten layers of 3 mm, and five of 6, are a column 30 mm high: when each change of thickness was a blow in the next step,
# which springs and dampers held, its radius after 0.4 s was 21 and 20 mm where it has to be 27.4, its height 16.
@test "a stack of layers slumps as one body" {
  /usr/bin/python3 "$BATS_TEST_DIRNAME/stokes_slump.py" 0.015 0.03 6 1400 0.2 0.4 > law.txt
  for layers in 10 5; do
    awk -v n=$layers 'BEGIN {
      h = 30 / n
      for (k = 0; k < n; ++k)
        printf "[[sheet]]\nname = \"s%d\"\nshape = \"disk\"\nradius = \"15 mm\"\nedge_length = \"%g mm\"\nthickness = \"%g mm\"\nplane = \"xz\"\ncenter = [0, \"%g mm\", 0]\n", k, n == 10 ? 2 : 3, h, h * (k + 0.5)
      print "[material]\nviscosity = \"6 Pa*s\"\ndensity = \"1400 kg/m^3\"\n[environment]\ngravity = [0, \"-9.81 m/s^2\", 0]"
      print "[[solid]]\nshape = \"plane\"\ncontact = \"flow\"\n[contact]\nself = true" }' > stack.toml
    sheet-init stack.toml | sheet-loop -q --until 0.4 --fps 5 -o stack.sheet -- \
      'sheet-remesh --smooth | sheet-step --tolerance 0.01 | sheet-collide'
    sheet-check stack.sheet
    PYTHONPATH=$BATS_TEST_DIRNAME/../../formats/python /usr/bin/python3 - << 'END' | tee seen.txt
import numpy, sheetstream
for frame in sheetstream.Run("stack.sheet"):
    place, triangle, volume = frame["position"], frame["triangle"], frame["volume"]
    corner = place[triangle][:, :, [0, 2]]
    square = ((corner**2).sum(axis=(1, 2)) + (corner.sum(axis=1) ** 2).sum(axis=1)) / 12
    radius = (2 * (square * volume).sum() / volume.sum()) ** 0.5
    sides = place[triangle[:, 1:]] - place[triangle[:, :1]]
    thickness = volume / (numpy.linalg.norm(numpy.cross(sides[:, 0], sides[:, 1]), axis=1) / 2)
    center = place[triangle].mean(axis=1)
    top = (center[:, 1] + thickness / 2)[numpy.hypot(center[:, 0], center[:, 2]) < 0.005].max()
    print(frame.time, top, radius)
END
    paste <(tail -n 2 seen.txt) law.txt | awk '{ print; if (!($2 / $5 > 0.92 && $2 / $5 < 1.08 && $3 / $6 > 0.95 && $3 / $6 < 1.05)) exit 1 }'
  done
}
