#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# What runs down a solid turns in the corner with its floor, and goes on along that.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
}

# usage: run_scene NAME UNTIL FPS: the ring that sheet-init --check proposes, from NAME.toml to NAME.csv
run_scene() {
  sheet-init "$1.toml" |
    sheet-loop -q --until "$2" --fps "$3" -o "$1.sheet" -- 'sheet-remesh --smooth | sheet-emit | sheet-step | sheet-collide'
  sheet-check "$1.sheet"
  sheet-info --csv "$1.sheet" > "$1.csv"
}

# usage: last NAME COLUMN
last() {
  awk -F, -v name="$2" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) c = i } END { print $c }' "$1.csv"
}

# usage: over_a_step: 12 mm of 5 Pa s, let in 60 mm before the edge of a step 20 mm high, down to y = 0
over_a_step() {
  cat << 'END'
[sheet]
shape = "rectangle"
size = ["60 mm", "16 mm"]
edge_length = "4 mm"
thickness = "12 mm"
center = ["-60 mm", "26 mm", 0]
velocity = ["9.6 mm/s", 0, 0]
[material]
viscosity = "5 Pa*s"
density = "1400 kg/m^3"
[environment]
gravity = [0, -9.81, 0]
[inflow]
region = "x_min"
velocity = ["9.6 mm/s", 0, 0]
[[hold]]
region = "z_min"
axes = "z"
[[hold]]
region = "z_max"
axes = "z"
[contact]
adhesion = "100 Pa"
END
}

# It is 5 mm thick on the face, at whose foot it arrives at 3.7 s: from there on the front is at
# 1.001 (g q³/(3 ν))^(1/5) t^(4/5), q the flux [Huppert 1982].
goes_on_along_the_floor() {
  run_scene "$1" 6 6
  awk -v x="$(last "$1" x_max)" -v thickest="$(last "$1" thickness_max)" 'BEGIN {
    law = 1.001*(9.81*0.0001152^3/(3*5/1400))^0.2*2.3^0.8; print x, law, thickest
    exit !(x > 0.93*law && x < 1.1*law && thickest < 0.018) }'
}

# When the floor caught what comes down only from a quarter of the thickness on, it was crushed to rags above that, as
# thick as 110 mm, and took 300 s.
@test "what flows down a step turns at its foot, and goes on along the floor" {
  over_a_step > step.toml
  printf '[[solid]]\nshape = "box"\nsize = ["200 mm", "20 mm", "100 mm"]\ncenter = ["-100 mm", "10 mm", 0]\n' >> step.toml
  printf 'contact = "flow"\n[[solid]]\nshape = "plane"\ncontact = "flow"\n' >> step.toml
  goes_on_along_the_floor step
  # The heights of the strip's sides, which a hold leads, were set back to what they had been: its front's corners stood
  # up, were run over, and folded into layers of 0.1 mm.
  sed 's/edge_length = "4 mm"/edge_length = "2 mm"/; s/"16 mm"/"8 mm"/' step.toml > finer.toml
  run ! cmp -s step.toml finer.toml
  goes_on_along_the_floor finer
  awk -v thinnest="$(last finer thickness_min)" 'BEGIN { print thinnest; exit !(thinnest > 0.001) }'
}

# The step and its floor, 100 mm wide.
@test "likewise where both are one mesh" {
  over_a_step > mesh.toml
  awk 'BEGIN {
    n = split("-0.2 -0.02 0.2 -0.02 0.2 0 0 0 0 0.02 -0.2 0.02", p, " ")
    for (z = -0.05; z < 0.1; z += 0.1)
      for (i = 1; i < n; i += 2)
        print "v", p[i], p[i + 1], z
    split("1 2 3 1 3 4 1 4 6 4 5 6", t, " ")
    for (i = 1; i <= 12; i += 3) {
      print "f", t[i], t[i + 2], t[i + 1]
      print "f", t[i] + 6, t[i + 1] + 6, t[i + 2] + 6
    }
    for (i = 1; i <= 6; ++i) {
      j = i % 6 + 1
      print "f", i, j, j + 6
      print "f", i, j + 6, i + 6
    }
  }' > step.obj
  printf '[[solid]]\nshape = "mesh"\nfile = "step.obj"\ncontact = "flow"\n' >> mesh.toml
  goes_on_along_the_floor mesh
}

# 170 mm²/s down 45 degrees onto a belt that takes it away at 30 mm/s: 5.66 mm thick, behind its front and beyond the
# foot, where its weight hardly drives it on.
@test "what slides down a chute onto a belt goes on with that" {
  cat > chute.toml << 'END'
[sheet]
shape = "rectangle"
size = ["60 mm", "12 mm"]
edge_length = "3 mm"
thickness = "6 mm"
center = ["-63.4 mm", "67.7 mm", 0]
rotation = {axis = [0, 0, 1], angle = "-45 deg"}
[material]
viscosity = "5 Pa*s"
density = "1300 kg/m^3"
[environment]
gravity = [0, -9.81, 0]
[inflow]
region = "x_min"
velocity = ["20 mm/s", "-20 mm/s", 0]
[[hold]]
region = "z_min"
axes = "z"
[[hold]]
region = "z_max"
axes = "z"
[[solid]]
shape = "plane"
normal = [1, 1, 0]
contact = "flow"
[[solid]]
shape = "plane"
contact = "flow"
surface_velocity = ["30 mm/s", 0, 0]
[contact]
adhesion = "100 Pa"
END
  run_scene chute 6.5 2
  # It piled up in the corner, 22 mm thick at 4 s.
  PYTHONPATH=$BATS_TEST_DIRNAME/../../formats/python /usr/bin/python3 - << 'END'
import numpy
import sheetstream

*_, frame = sheetstream.read("chute.sheet")
corners = frame["position"][frame["triangle"]]
area = numpy.linalg.norm(numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
x = corners[:, :, 0].mean(axis=1)
there = (x > 0.02) & (x < 0.06)
thickness = frame["volume"][there].sum() / area[there].sum()
greatest = (frame["volume"] / area).max()
print(thickness, 170e-6 / 0.03, greatest, x.max())
assert abs(thickness / (170e-6 / 0.03) - 1) < 0.02 and greatest < 0.008 and x.max() > 0.11
END
}
