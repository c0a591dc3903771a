#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# A corpus of hostile frames, with valid checksums and bad contents, through every program: no signal, no hang, no internal
# error, a message of the program's own, and nothing passed on that the next program would refuse. hostile_frames.py makes
# them of good runs, hostile_run runs the programs.

bats_require_minimum_version 1.5.0

setup() { cd "$BATS_TEST_TMPDIR" || exit; }

# usage: attack GOOD.sheet HOSTILE.sheet...
attack() {
  printf '%s\n' "${@:2}" | xargs -P 2 -n 8 "$SHEET_SOURCE/tests/cli/hostile_run" "$1" > wrong
  [[ ! -s wrong ]] || { cat wrong; false; }
}

# usage: spoil LEAST GOOD.sheet: makes the frames, at least so many.
spoil() {
  "$SHEET_SOURCE/tests/cli/hostile_frames.py" "$2" hostile
  [[ $(ls hostile | wc -l) -ge $1 ]]
}

@test "a sheet that is held, floats, and sticks to a solid" {
  cat > disk.toml << 'END'
[sheet]
shape = "disk"
radius = 1
edge_length = 0.4
thickness = 0.01
velocity = [1, 0, 0]
[material]
viscosity = 100
density = 1000
surface_tension = 0.03
[environment]
gravity = [0, 0, -9.81]
bath = {density = 2000, level = -0.9}
[[hold]]
region = {box = [[-1, -1, -1], [-0.8, 1, 1]]}
[tear]
below = 0.001
[contact]
adhesion = 10
[[solid]]
shape = "plane"
center = [0, 0, -0.006]
normal = [0, 0, 1]
END
  sheet-init disk.toml | sheet-loop -q --steps 4 --keep last -o disk.sheet -- 'sheet-step --dt 0.01 | sheet-collide'
  spoil 200 disk.sheet
  [[ -e hostile/touch_force_nan.sheet && -e hostile/director_angle_nan.sheet ]]
  attack disk.sheet hostile/*.sheet
}

@test "layers with contact springs between them" {
  awk 'BEGIN{for (k = 0; k < 2; ++k) for (j = 0; j < 4; ++j) for (i = 0; i < 4; ++i) print "v", i / 3, j / 3, k * 0.0101
    for (k = 0; k < 2; ++k) for (j = 0; j < 3; ++j) for (i = 0; i < 3; ++i) {
      a = 1 + 16 * k + 4 * j + i; print "f", a, a + 1, a + 5; print "f", a, a + 5, a + 4 } }' > layers.obj
  cat > layers.toml << 'END'
[sheet]
shape = "mesh"
file = "layers.obj"
thickness = 0.01
[material]
viscosity = 100
density = 1000
[environment]
gravity = [0, 0, -9.81]
[contact]
stiffness = 100
adhesion = 10
[[hold]]
region = {box = [[-1, -1, -0.001], [2, 2, 0.001]]}
END
  sheet-init layers.toml | sheet-loop -q --steps 3 --keep last -o layers.sheet -- 'sheet-step --dt 0.01 | sheet-collide'
  spoil 150 layers.sheet
  attack layers.sheet hostile/contact_*.sheet hostile/scene_{stiffness,adhesion,without}*.sheet
}

@test "a sheet that cools on a solid while it flows in" {
  sed 's/^until = .*//; s/0.12 s/9 s/' "$SHEET_SOURCE/tests/features/heat_pour.toml" > warm.toml
  sheet-init warm.toml | sheet-loop -q --steps 12 --keep last -o warm.sheet -- 'sheet-emit | sheet-step --dt 0.01 | sheet-collide'
  spoil 150 warm.sheet
  [[ -e hostile/temperature_nan.sheet && -e hostile/temperature_rate_large.sheet ]]
  attack warm.sheet hostile/temperature_*.sheet hostile/heat.moved_*.sheet
}

@test "a curtain that flows in" {
  cat > curtain.toml << 'END'
[sheet]
shape = "rectangle"
size = [1, 0.5]
segments = [4, 2]
thickness = 0.01
[material]
viscosity = 100
density = 1000
[environment]
gravity = [0, 0, -9.81]
[inflow]
region = "y_max"
velocity = [0, -1, 0]
END
  sheet-init curtain.toml | sheet-loop -q --steps 4 --keep last -o curtain.sheet -- 'sheet-emit | sheet-step --dt 0.05'
  spoil 100 curtain.sheet
  attack curtain.sheet hostile/inlet*.sheet hostile/mesh_*.sheet hostile/shape_*.sheet hostile/time_*.sheet hostile/scene_velocity*.sheet
}

@test "two liquids that hold gas each" {
  sheet-init "$SHEET_SOURCE/tests/features/two_liquids_gas.toml" |
    sheet-loop -q --steps 2 --keep last -o gas.sheet -- 'sheet-step --dt 0.001 | sheet-collide'
  spoil 200 gas.sheet
  [[ -e hostile/gas.amount_of_bytes.sheet && -e hostile/enclosure_enormous.sheet && -e hostile/liquid_missing.sheet ]]
  attack gas.sheet hostile/{enclosure,gas.,liquid}*.sheet
}

@test "air around what is thick without bound: rays that start too far away for Embree" {
  sheet-init "$SHEET_SOURCE/tests/features/air.toml" |
    sheet-loop -q --steps 2 --keep last -o air.sheet -- 'sheet-remesh --smooth | sheet-step --dt 0.01 | sheet-collide'
  spoil 100 air.sheet
  attack air.sheet hostile/volume_large.sheet hostile/volume_all_enormous.sheet
}

@test "what the format's corpus says is valid" {
  attack "$SHEET_SOURCE/formats/corpus/1.0/passed/0003_one_triangle.sheet" "$SHEET_SOURCE"/formats/corpus/1.0/passed/*.sheet
}
