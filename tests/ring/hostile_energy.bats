#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# Contacts that solids force on a sheet give it no more kinetic energy than it had, than its weight gives, and than the
# whole sheet has at the speed of the fastest of them.

bats_require_minimum_version 1.5.0
setup() {
  cd "$BATS_TEST_TMPDIR" || exit
  cat > tube << 'END'
[sheet]
shape = "tube"
radius = 0.05
height = 0.2
edge_length = "12 mm"
pattern = "irregular"
thickness = "1 mm"
center = [0, 0.12, 0]
perturbation = {amplitude = "3 mm", seed = 7}
[material]
viscosity = 5
density = 1200
[environment]
gravity = [0, -9.81, 0]
[contact]
self = true
[[solid]]
END
}
# SPEED UNTIL: tube.toml, and the kinetic energies of its frames against the bound; all of it falls by 0.22 m at most.
bounded() {
  sheet-init tube.toml -o first.sheet
  sheet-loop -q -i first.sheet --until "$2" --fps 1000 -o run.sheet -- 'sheet-remesh --smooth | sheet-step --dt 0.0005 | sheet-collide' 2> log
  sheet-info --csv run.sheet | awk -F, -v speed="$1" 'NR == 2 {mass = 1200 * $6; most = $10 + mass * (9.81 * 0.22 + speed * speed / 2)}
    NR > 1 && $10 > most {printf "frame %d: %g J, more than %g J\n", NR - 2, $10, most; bad = 1} END {exit bad}'
}

@test "a box that spins at 60 rad/s under a tube that falls on it" {
  { sed 's/^center.*/&\nvelocity = [0, -5, 0]/' tube
    printf 'shape = "box"\nsize = [0.06, 0.01, 0.2]\ncenter = [0, 0.01, 0]\nmotion = {kind = "rotating", axis = [0, 1, 0], rate = "60 rad/s"}\n'; } > tube.toml
  bounded 6.3 0.02
}

@test "a rod at 6 m/s through a tube that falls on the ground" {
  { sed 's/^center.*/&\nvelocity = [0, -5, 0]/' tube
    printf 'shape = "plane"\n[[solid]]\nshape = "capsule"\nradius = 0.003\nlength = 0.4\ncenter = [-0.1, 0.02, 0]\nrotation = {axis = [1, 0, 0], angle = "80 deg"}\nmotion = {kind = "translating", velocity = [6, 0, 0]}\n'; } > tube.toml
  bounded 6 0.015
}

@test "a plate that presses a tube on the ground at 2 m/s" {
  { cat tube
    printf 'shape = "plane"\n[[solid]]\nshape = "box"\nsize = [0.3, 0.02, 0.3]\ncenter = [0, 0.24, 0]\nmotion = {kind = "translating", velocity = [0, -2, 0]}\n'; } > tube.toml
  bounded 2 0.03
}

@test "sheet-collide takes energy, seen from a box that spins under a tube" {
  { sed 's/^center.*/&\nvelocity = [0, -5, 0]/' tube
    printf 'shape = "box"\nsize = [0.06, 0.01, 0.2]\ncenter = [0, 0.01, 0]\nmotion = {kind = "rotating", axis = [0, 1, 0], rate = "60 rad/s"}\n'; } > tube.toml
  sheet-init tube.toml -o first.sheet
  sheet-loop -q -i first.sheet --steps 12 --keep 1 -o run.sheet -- 'sheet-step --dt 0.002 | tee before.sheet | sheet-collide' 2> log
  /usr/bin/python3 "$BATS_TEST_DIRNAME/energy_beside.py" 1200 60 before.sheet run.sheet
}
