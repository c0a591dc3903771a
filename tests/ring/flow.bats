#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# Layers on each other where liquid flows.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
}

# usage: layers THICKNESS [CENTER]...: a scene of disks of that thickness, in mm, at these heights, on a plate
layers() {
  local thickness=$1 center name=a
  shift
  for center; do
    cat << END
[[sheet]]
name = "$name"
shape = "disk"
radius = "50 mm"
edge_length = "6 mm"
thickness = "$thickness mm"
plane = "xz"
center = [0, "$center mm", 0]
END
    name=b
  done
  cat << END
[material]
viscosity = "10 Pa*s"
density = "1000 kg/m^3"
[environment]
gravity = [0, "-9.81 m/s^2", 0]
[[solid]]
shape = "plane"
normal = [0, 1, 0]
contact = "flow"
[contact]
self = true
END
}

# usage: spread SCENE: how far the liquid spreads in 4 s
spread() {
  sheet-init "$1" | sheet-loop -q --until 4 --fps 5 -o "$1.sheet" -- 'sheet-remesh --smooth | sheet-step --tolerance 0.01 | sheet-collide'
  sheet-check "$1.sheet"
  /usr/bin/python3 "$BATS_TEST_DIRNAME/spread.py" "$1.sheet" | cut -d ' ' -f 3
}

@test "two layers on each other spread as one of their thickness together" {
  layers 4 2 > one.toml
  layers 2 1 3 > two.toml
  one=$(spread one.toml) two=$(spread two.toml)
  awk -v one="$one" -v two="$two" 'BEGIN { print one, two > "/dev/stderr"; exit !(one > 5e-4 && two > 0.8 * one && two < 1.2 * one) }'
}

# Its rim is 3.7 mm thick after 0.4 s, on a plate 3.5 mm. On springs as stiff as the mean of both liquids it bounced, and
# was pressed out to a film.
@test "honey spreads on a layer of another liquid, a thousand times as viscous" {
  layers 8 4 11 > on-dough.toml
  sheet-init on-dough.toml --set sheet.1.thickness='4 mm' --set sheet.1.radius='30 mm' --set sheet.1.edge_length='4 mm' \
    --set sheet.0.material.viscosity=10000 --set sheet.0.material.density=1000 |
    sheet-loop -q --until 0.4 --keep last -- 'sheet-remesh --smooth | sheet-step --tolerance 0.01 | sheet-collide' > last.sheet
  sheet-info --csv last.sheet > last.csv
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i }
    END { print $at["step"], $at["thickness_min"]; exit !($at["step"] < 100 && $at["thickness_min"] > 2e-3) }' last.csv
}

@test "honey pours on a plate: it folds, and flows down in layers" {
  FILM=no OUT=$BATS_TEST_TMPDIR "$BATS_TEST_DIRNAME/../../pipelines/honey/pour" 0.005 1
  sheet-info --csv poured.sheet > poured.csv
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i } END { print $at["x_max"]; exit !($at["x_max"] > 0.01) }' poured.csv
}
