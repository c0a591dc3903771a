#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# sheet-collide in the ring: small versions of the scenes in tests/bench/collisions.

bats_require_minimum_version 1.5.0

scenes=$BATS_TEST_DIRNAME/../bench/collisions

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
}

# usage: contacts FILE: contact springs in the last frame
contacts() {
  sheet-select --last "$1" | sheet-info - | sed -n 's/.*contact_rest .* \([0-9]*\) bytes/\1/p' | awk '{print $1 / 8}'
}

@test "a curtain folds on itself: no intersections, the same bits for any number of threads and after an interruption" {
  sheet-init "$scenes/curtain.toml" --set 'sheet.edge_length="15 mm"' -o start.sheet
  run_ring() { sheet-loop -q -i start.sheet --until "$1" --fps 100 -o "$2" -- "sheet-step --dt 5e-3 | sheet-collide --threads $3"; }
  run_ring 0.3 one.sheet 1
  run_ring 0.3 two.sheet 2
  cmp one.sheet two.sheet
  sheet-check one.sheet
  (($(contacts one.sheet) > 10))
  # stopped amid the contacts
  run_ring 0.25 part.sheet 2
  sheet-loop -q --resume part.sheet --until 0.3 --fps 100 -- 'sheet-step --dt 5e-3 | sheet-collide --threads 1'
  cmp part.sheet one.sheet
}

@test "two strips pulled through each other's place do not pass" {
  "$scenes/make_mesh" strips 4 > strips.off
  cp "$scenes/strips.toml" .
  sheet-init strips.toml -o start.sheet
  sheet-loop -q -i start.sheet --until 0.4 --fps 50 -o run.sheet -- 'sheet-step --dt 0.02 | sheet-collide -v' 2> log
  sheet-check run.sheet
  (($(contacts run.sheet) > 10))
  grep -q '[1-9][0-9]* impulses' log # springs alone did not do it
  # without sheet-collide they do pass
  sheet-loop -q -i start.sheet --until 0.4 --fps 50 -o without.sheet -- 'sheet-step --dt 0.02'
  run -3 sheet-check without.sheet
}

@test "layers come down on a floor, rest on each other, and their springs carry their weight" {
  "$scenes/make_mesh" layers 4 > layers.off
  cp "$scenes/layers.toml" .
  sheet-init layers.toml -o start.sheet
  sheet-loop -q -i start.sheet --until 0.4 --fps 10 -o run.sheet -- 'sheet-step --dt 4e-3 | sheet-collide'
  sheet-check run.sheet
  sheet-select --last run.sheet | /usr/bin/python3 "$BATS_TEST_DIRNAME/layer_forces.py" 4 9.81 1000
  # at rest
  sheet-info --csv run.sheet | awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "kinetic_energy") k = i }
    NR > 1 { e = $k } END { exit !(e < 1e-9) }'
}

@test "plates that close on a pleated sheet squeeze it, with remeshing and without" {
  sheet-init "$scenes/press.toml" -o start.sheet
  for more in '' '| sheet-remesh --edge-length 0.005'; do
    sheet-loop -q -i start.sheet --until 0.3 --fps 100 -o run.sheet -- "sheet-step --dt 5e-3 | sheet-collide $more"
    sheet-check run.sheet
    (($(contacts run.sheet) > 10))
    sheet-info --csv run.sheet | awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i } # between the plates
      { low = $column["y_min"]; high = $column["y_max"] } END { exit !(low > 0 && high < 0.0051) }'
  done
}

@test "a sheet is wound up by a spinning cylinder, layer upon layer" {
  sheet-init "$scenes/winding.toml" --set 'sheet.edge_length="8 mm"' -o start.sheet
  sheet-loop -q -i start.sheet --until 0.8 --fps 25 -o run.sheet -- 'sheet-step --dt 5e-3 | sheet-collide'
  sheet-check run.sheet
  (($(contacts run.sheet) > 5))
}
