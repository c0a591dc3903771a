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

@test "honey pours on a plate: it folds, and flows down in layers" {
  FILM=no OUT=$BATS_TEST_TMPDIR "$BATS_TEST_DIRNAME/../../pipelines/honey/pour" 0.005 1
  sheet-info --csv poured.sheet > poured.csv
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i } END { print $at["x_max"]; exit !($at["x_max"] > 0.01) }' poured.csv
}
