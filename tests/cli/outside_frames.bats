#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# Frames with valid checksums and bad contents: no program dies of one, hangs, or passes nonsense on.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
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
[environment]
gravity = [0, 0, -9.81]
[tear]
below = 0.001
[contact]
[[solid]]
shape = "plane"
center = [0, 0, -1]
normal = [0, 0, 1]
END
  sheet-init disk.toml | sheet-step --dt 0.01 -o disk.sheet
}

# usage: scaled ARRAY FACTOR: the disk with all values of an array multiplied
scaled() {
  sheet-print disk.sheet |
    awk -v array="$1" -v factor="$2" '/^array /{on = $2 == array; print; next}
      on && /^[-0-9]/{for (i = 1; i <= NF; ++i) $i = sprintf("%.17g", $i * factor)} {print}' | sheet-parse
}

# usage: thrown FROM METRES [start_position]: the disk with a vertex so far away
thrown() {
  sheet-print disk.sheet |
    awk -v v="$1" -v to="$2" -v start="${3:-none}" '/^array /{kind = $2; row = 0; print; next} {++row}
      (kind == "position" || kind == start) && row == v {$1 = to} {print}' | sheet-parse
}

stages=("sheet-step --dt 0.01" sheet-collide "sheet-remesh --edge-length 0.4" sheet-tear)

@test "8: positions and velocities near the end of the range are refused with their place" {
  for array in position velocity volume; do
    for factor in 1e154 1e200 1e35; do
      scaled $array $factor > large.sheet
      for stage in "${stages[@]}"; do
        run -3 timeout 20 bash -c "$stage large.sheet -o out.sheet"
        [[ $output == *"array \"$array\", row "*" is too large to compute with"* ]]
      done
    done
  done
}

@test "15: sheet-step refuses a sheet whose vertices coincide, with its place" {
  for factor in 0 1e-60 1e-200; do
    scaled position $factor > tiny.sheet
    run -3 timeout 20 sheet-step --dt 0.01 tiny.sheet -o out.sheet
    [[ $output == *'vertices '*' and '*' share an edge and lie in one place'* ]]
  done
}

@test "15: no stage writes a frame that the next one would refuse" {
  for array in position velocity volume; do
    for factor in 1e-300 1e-154 1e-60 1e-9 1e9 1e29 1e60 1e154 1e300; do
      scaled $array $factor > odd.sheet 2> /dev/null || continue
      for stage in "${stages[@]}"; do
        rm -f out.sheet
        code=0
        timeout 60 bash -c "$stage odd.sheet -o out.sheet" 2> /dev/null || code=$?
        [[ $code == [02356] ]]
        [[ $code != 0 ]] || sheet-pass out.sheet > /dev/null
      done
    done
  done
}

@test "a vertex that has been thrown far away is refused at once, with its place" {
  for far in 1e5 1e6 1e9 1e20; do
    thrown 5 $far > thrown.sheet
    run -3 timeout 10 sheet-collide thrown.sheet -o out.sheet
    [[ $output == *'in one step, the edge from vertex '*"$(printf '(%g, ' "$far")"*' has become '*'shorter steps'* ]]
    for start in none start_position; do
      thrown 5 $far $start > thrown.sheet
      run timeout 10 sheet-remesh --edge-length 0.5 thrown.sheet -o out.sheet
      [[ $status == 3 && $output == *'the edge from vertex '*"$(printf '(%g, ' "$far")"*'longer edges'* ]] ||
        [[ $status == 2 && $output == *'more than 1e+08: ask for longer edges'* ]]
      for stage in sheet-collide sheet-tear sheet-emit 'sheet-step --dt 0.01' sheet-info sheet-check; do
        timeout 10 bash -c "$stage thrown.sheet" > out 2> err || [[ $? == [1235] ]]
      done
    done
  done
  # far, and what is done about it in time
  thrown 5 100 > thrown.sheet
  timeout 20 sheet-collide thrown.sheet -o out.sheet
  timeout 20 sheet-remesh --edge-length 0.5 thrown.sheet -o out.sheet
}
