#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# A stage of one's own: formats/python/example_stage.py in the ring, behind sheet-step and in its place.

bats_require_minimum_version 1.5.0

setup_file() {
  cd "$BATS_FILE_TMPDIR" || exit
  sheet-init "$BATS_TEST_DIRNAME/../../pipelines/catenary/scene.toml" --set 'sheet.segments=[8, 4]' -o start.sheet
}

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
  cp "$BATS_FILE_TMPDIR/start.sheet" .
  stage=$(realpath "$BATS_TEST_DIRNAME/../../formats/python/example_stage.py")
}

momentum_x() { sheet-select --last "$1" | sheet-info --csv | tail -1 | cut -d, -f11; }

@test "without options it passes frames bit for bit, as sheet-pass does" {
  sheet-loop -q -i start.sheet --steps 4 -o run.sheet -- 'sheet-step --dt 0.01'
  "$stage" --no-provenance < run.sheet > passed.sheet
  cmp run.sheet passed.sheet
  sheet-loop -q -i start.sheet --steps 4 -o own.sheet -- "sheet-step --dt 0.01 | $stage --no-provenance"
  sheet-loop -q -i start.sheet --steps 4 -o pass.sheet -- 'sheet-step --dt 0.01 | sheet-pass --no-provenance'
  sheet-diff --ignore provenance own.sheet pass.sheet
}

@test "it replaces any stage of a ring" {
  sheet-loop -q -i start.sheet --steps 4 -o first.sheet -- "$stage --no-provenance | sheet-step --dt 0.01"
  sheet-loop -q -i start.sheet --steps 4 -o last.sheet -- "sheet-step --dt 0.01 | $stage --no-provenance"
  sheet-diff --ignore provenance first.sheet last.sheet
  sheet-loop -q -i start.sheet --steps 4 -o alone.sheet -- "$stage --wind 0.5" # no physics at all
  sheet-check alone.sheet
  [[ $(sheet-print alone.sheet | sed -n 's/^step //p' | tr '\n' ' ') == '0 1 2 3 4 ' ]]
  sheet-print alone.sheet | tail -n +2 | grep -q '4 example_stage.py (1.0) --wind 0.5'
}

@test "--wind moves the sheet: its momentum is that of the wind" {
  sheet-loop -q -i start.sheet --steps 1 --keep last -o windy.sheet -- "$stage --wind 0.5"
  # 0.1 kg/m^3 * 0.06 m^3 * 0.5 m/s
  awk -v p="$(momentum_x windy.sheet)" 'BEGIN {exit !(p > 0.003 * (1 - 1e-12) && p < 0.003 * (1 + 1e-12))}'
  sheet-loop -q -i start.sheet --steps 4 --keep last -o calm.sheet -- 'sheet-step --dt 0.01'
  sheet-loop -q -i start.sheet --steps 4 --keep last -o windy.sheet -- "sheet-step --dt 0.01 | $stage --wind 0.1"
  sheet-check windy.sheet
  awk -v c="$(momentum_x calm.sheet)" -v w="$(momentum_x windy.sheet)" 'BEGIN {exit !(w > 1e-4 && c < 1e-9 && c > -1e-9)}'
}

@test "exit codes: usage 2, truncated and foreign input 4, full disk 6, a reader that has gone 0" {
  run -2 "$stage" --breeze 1
  size=$(stat -c %s start.sheet)
  for cut in 0 1 100 1000 $((size - 64)) $((size - 1)); do
    run -4 bash -c 'head -c "$1" start.sheet | "$2" > out.sheet' _ "$cut" "$stage"
    [[ $output == *"example_stage.py: "* && $output != *Traceback* ]]
  done
  run -4 bash -c 'head -c 1000 /dev/zero | "$1" > out.sheet' _ "$stage"
  run -6 bash -c '"$1" < start.sheet > /dev/full' _ "$stage"
  [[ $output != *Traceback* ]]
  run -0 bash -c '(sleep 0.2; "$1" < start.sheet; echo $? > code) | true; cat code' _ "$stage"
  [[ $output == 0 ]]
  run -4 sheet-loop -q -i start.sheet --steps 3 -o run.sheet -- "sheet-step --dt 0.01 | head -c 3000 | $stage"
  [[ $output == *"$stage"*"exit code 4"* || $output == *"cut short"* ]]
}
