#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# The ring with stages as users write them.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
  make_grid 3 > grid.sheet
}

@test "21: a stage that keeps its frame to itself is named" {
  if grep -q 'SHEET_SANITIZE:BOOL=ON' "$SHEET_BUILD/CMakeCache.txt"; then
    skip "what a sanitizer writes for itself counts as a stage's output"
  fi
  for stage in 'sheet-select --last' 'sheet-select --index=-1'; do
    run timeout -s INT 9 sheet-loop -i grid.sheet --steps 3 -o run.sheet -- "sheet-pass | $stage | sheet-pass"
    [[ $output == *"stage \"$stage\" has taken its frame, gives none and does nothing"* ]]
    [[ $(grep -c 'has taken its frame' <<< "$output") == 1 ]]
  done
  # a stage that needs its time is no such stage
  run -0 timeout 30 sheet-loop -i grid.sheet --steps 1 -o run.sheet -- \
    "sheet-pass | /usr/bin/python3 -c 'import sys, time; t = time.time()
while time.time() - t < 7: pass
sys.stdout.buffer.write(sys.stdin.buffer.read1(1 << 20)); sys.stdout.flush(); sys.stdout.buffer.write(sys.stdin.buffer.read())'"
  [[ $output != *'has taken its frame'* ]]
}

@test "22: no time in sheet-loop's table is negative, also where stages work side by side" {
  make_grid 60 > large.sheet
  sheet-loop -i large.sheet --steps 2 --keep last -o run.sheet -- \
    'tee >(sheet-remesh --edge-length 0.4 > /dev/null) >(sheet-remesh --edge-length 0.4 > /dev/null)' 2> table
  [[ $(grep -c 'sheet-remesh' table) == 2 ]]
  grep 'at the same time' table
  run -1 grep -- ' -[0-9]' table
}

@test "13: a run made longer is that of one go, if it had ended at an output time as the help says" {
  printf '[sheet]\nshape = "disk"\nradius = 1\nedge_length = 0.4\nthickness = 0.01\n[material]\nviscosity = 100\ndensity = 1000\n[environment]\ngravity = [0, 0, -9.81]\n[[hold]]\nregion = "rim"\n' |
    sheet-init - -o first.sheet
  for options in 'sheet-step' 'sheet-step --dt 0.01'; do
    sheet-loop -q -i first.sheet --until 0.25 --fps 24 -o once.sheet -- "$options"
    sheet-loop -q -i first.sheet --until 0.125 --fps 24 -o twice.sheet -- "$options"
    sheet-loop -q --resume twice.sheet --until 0.25 --fps 24 -- "$options"
    cmp once.sheet twice.sheet
  done
  sheet-loop --help | tr -s '\n ' ' ' | grep -q 'if it had ended at an output time'
}
