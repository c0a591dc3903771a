#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# sheet-loop --stop-when: runs that end by what is measured.

bats_require_minimum_version 1.5.0
ring='sheet-step --dt 0.01'

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
  cat > falling.toml << 'END'
[sheet]
shape = "rectangle"
size = [1, 1]
segments = [2, 2]
thickness = "10 mm"
plane = "xz"
[material]
viscosity = 100
density = 1000
[environment]
gravity = [0, -9.81, 0]
END
  sheet-init falling.toml > first.sheet
}

# usage: last COLUMN FILE
last() {
  sheet-info --csv "$2" | awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) at = i } END { print $at }'
}

@test "a run ends after the first step in which the condition holds, with that frame" {
  run --separate-stderr bash -c "sheet-loop -i first.sheet --until 1 --keep last --stop-when 'y_min < -0.1 m' -- '$ring' > run.sheet"
  [ "$status" -eq 0 ]
  [[ $stderr == *"stopped at step 15, t = 0.15"*", as --stop-when says: y_min is -0.1"*" m"* ]]
  # g t²/2 is 96 mm after 14 steps, 110 mm after 15.
  [ "$(last step run.sheet)" = 15 ]
  sheet-check run.sheet
}

@test "what stopped goes on from there without the condition, and with it is at its end" {
  sheet-loop -q -i first.sheet -o run.sheet --until 0.3 --fps 10 --stop-when 'y_min < -10 cm' -- "$ring"
  sheet-loop -q -i first.sheet -o straight.sheet --until 0.2 --fps 10 -- "$ring"
  cp run.sheet again.sheet
  sheet-loop -q --resume again.sheet --until 0.3 --stop-when 'y_min < -10 cm' -- "$ring"
  cmp run.sheet again.sheet
  sheet-loop -q --resume run.sheet --until 0.2 --fps 10 -- "$ring"
  cmp <(sheet-select --last run.sheet | sheet-print) <(sheet-select --last straight.sheet | sheet-print)
}

@test "the first of several conditions, counts, and no other end" {
  run --separate-stderr bash -c "sheet-loop -i first.sheet --stop-when 'vertices >= 20' --stop-when 'thickness_min<=1' -- '$ring' > run.sheet"
  [ "$status" -eq 0 ]
  [[ $stderr == *"thickness_min is 0.01 m"* ]]
  [ "$(last step run.sheet)" = 0 ]
  run --separate-stderr bash -c "sheet-loop -i first.sheet --steps 9 --stop-when 'vertices > 20' -- 'sheet-remesh --edge-length 0.2 | $ring' > run.sheet"
  [ "$status" -eq 0 ]
  [[ $stderr == *"stopped at step 1, "*"vertices is "* ]]
}

@test "what cannot be asked is refused, with what can" {
  refused() { # CONDITION WORDS
    run --separate-stderr sheet-loop -i "${3:-first.sheet}" --until 1 --stop-when "$1" -o not.sheet -- "$ring"
    [ "$status" -eq 2 ]
    [[ $stderr == *"--stop-when: "*"$2"* ]]
    [ ! -e not.sheet ]
  }
  refused 'y_top > 1' '"y_top" is not measured; what is: vertices, triangles, area,'
  refused 'y_max = 1' '"y_max = 1" is no condition such as "y_max > 40 mm"'
  refused 'y_max > 1 kg' 'expected a length such as "2.5 mm", got a mass (kg)'
  refused 'y_max >' 'expected a length'
  sed '/density/d; /gravity/d; /environment/d' falling.toml > light.toml
  printf '[model]\ninertia = false\n' >> light.toml
  sheet-init light.toml > light.sheet
  refused 'kinetic_energy > 1 J' 'kinetic_energy is not known of the frame at step 0' light.sheet
}
