#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# Pictures of what users have: cameras anywhere, names of any length, runs that failed, clear liquids on solids.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
  cat > disk.toml << 'END'
[sheet]
shape = "disk"
radius = 0.1
edge_length = 0.01
thickness = 0.004
center = [0, 0, 0.002]
[material]
viscosity = 100
density = 1000
[environment]
gravity = [0, 0, -9.81]
END
  small=(--size 64x36 --samples 2)
}

@test "18: a camera out of all reach is refused" {
  sheet-init disk.toml -o disk.sheet
  for eye in 1e19,0,0 0,1e30,0 1e300,0,0; do
    run -2 sheet-render disk.sheet --eye "$eye" -o a.png "${small[@]}"
    [[ $output == *'--eye is '*' m away from what there is to see'* ]]
  done
  sheet-render disk.sheet --eye 1,0,0 --target 1e19,0,0 -q -o a.png "${small[@]}"
}

@test "18: a name that is too long is an input or output error, in every program" {
  sheet-init disk.toml -o disk.sheet
  long=$(printf 'a%.0s' {1..300})
  run -6 sheet-render disk.sheet -o "$long.png" "${small[@]}"
  run -6 sheet-render disk.sheet --environment "$long.png" -o a.png "${small[@]}"
  run -6 sheet-export disk.sheet -o "$long.obj"
  run -6 sheet-init "$long.toml"
  run -6 sheet-init disk.toml -o "$long"
  run -6 sheet-pass "$long"
  run -6 sheet-loop --steps 1 -i disk.sheet -o o.sheet --checkpoint "$long" -- sheet-pass
  run -6 sheet-loop --steps 1 --resume disk.sheet --checkpoint "$long" -- sheet-pass
}

@test "18: the last whole frame of a run that failed can be drawn" {
  sheet-init disk.toml | sheet-loop -q --steps 3 -o run.sheet -- 'sheet-step --dt 1e-3'
  head -c -100 run.sheet > cut.sheet
  run -4 sheet-render cut.sheet --frames -1 -o end.png "${small[@]}"
  sheet-render run.sheet --frames 2 -o two.png "${small[@]}"
  [[ -s end.png && -s two.png ]]
}
