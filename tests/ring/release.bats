#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# A sheet comes off solids where the scene says so ([contact] adhesion), and not before.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
}

# usage: scene GRAVITY HEIGHT VELOCITY NORMAL MOTION ADHESION: a flat square, 2 mm thick, and a plate
scene() {
  cat << END
[sheet]
shape = "rectangle"
size = [0.1, 0.1]
edge_length = 0.02
thickness = 0.002
center = [0, $2, 0]
velocity = [0, $3, 0]
[material]
viscosity = 100
density = 1000
[environment]
gravity = [0, $1, 0]
[[solid]]
shape = "plane"
normal = [0, $4, 0]
motion = {kind = "translating", velocity = [$5]}
[contact]
self = false
$6
END
}

# usage: run_scene UNTIL SCENE...: the least y at the end
run_scene() {
  local until=$1
  scene "${@:2}" > scene.toml
  sheet-init scene.toml |
    sheet-loop -q --until "$until" --fps 10 -o run.sheet -- 'sheet-step --dt 5e-3 | sheet-collide'
  sheet-check run.sheet
  sheet-info --csv run.sheet | awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "y_min") k = i } { y = $k } END { print y }'
}

# usage: near VALUE WANTED TOLERANCE
near() {
  awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN { d = a - b; exit !(d <= t && d >= -t) }' || { echo "$1, wanted $2"; return 1; }
}

@test "a patch thrown at a plate from below hangs there as long as its weight over its area is below the adhesion" {
  # 1000 kg/m3 * 9.81 m/s2 * 2 mm = 19.62 Pa
  under=(-9.81 -0.003 1 -1 "[0, 0, 0, 0]")
  near "$(run_scene 0.3 "${under[@]}" "adhesion = 19.63")" -0.001 1e-9
  near "$(run_scene 0.3 "${under[@]}" "")" -0.001 1e-9
  # it hits the plate in the first step and comes off in the second, at 0.01 s, to fall freely
  near "$(run_scene 0.3 "${under[@]}" "adhesion = 19.61")" "$(awk 'BEGIN { print -0.001 - 9.81 * 0.29 ^ 2 / 2 }')" 1e-6
  near "$(run_scene 0.3 "${under[@]}" "adhesion = 0")" "$(awk 'BEGIN { print -0.001 - 9.81 * 0.29 ^ 2 / 2 }')" 1e-6
}

@test "a sheet leaves a floor that speeds away where its mass over its area, times the acceleration beyond gravity's, is above the adhesion" {
  # the floor goes down at 20 m/s2 from 0.1 s on: (20 - 9.81) m/s2 * 1000 kg/m3 * 2 mm = 20.38 Pa; at 0.3 s it is 0.4 m down
  floor=(-9.81 0.002 -1 1 "[0, 0, 0, 0], [0.1, 0, 0, 0], [0.3, 0, -4, 0]")
  near "$(run_scene 0.3 "${floor[@]}" "adhesion = 20.39")" -0.399 1e-9
  near "$(run_scene 0.3 "${floor[@]}" "")" -0.399 1e-9
  # off after the first step, at the 0.1 m/s that it has been given
  falls=$(awk 'BEGIN { print 0.001 - 20 * 0.005 ^ 2 / 2 - 0.1 * 0.195 - 9.81 * 0.195 ^ 2 / 2 }')
  near "$(run_scene 0.3 "${floor[@]}" "adhesion = 20.37")" "$falls" 1e-6
  near "$(run_scene 0.3 "${floor[@]}" "adhesion = 0")" "$falls" 1e-6
}
