#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# The ring with real physics: straight run = interrupted and resumed run, byte for byte, whatever the step control, and the
# same bits with one thread and with two.

bats_require_minimum_version 1.5.0

options=(--until 0.1 --fps 50)
adaptive='sheet-step --tolerance 1e-3'
fixed='sheet-step --dt 0.003'

setup_file() {
  cd "$BATS_FILE_TMPDIR" || exit
  sheet-init "$BATS_TEST_DIRNAME/../../pipelines/catenary/scene.toml" --set 'sheet.segments=[8, 4]' -o start.sheet
  accident=true sheet-loop -q -i start.sheet "${options[@]}" -o adaptive.sheet -- "$adaptive | accident_at 11"
  accident=true sheet-loop -q -i start.sheet "${options[@]}" -o fixed.sheet -- "$fixed | accident_at 11"
}

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
  cp "$BATS_FILE_TMPDIR"/*.sheet .
  # The ring's process id, and those of its stages of a name, for an accident.
  ring='ring() { until [ -s ring.pid ]; do sleep 0.01; done; cat ring.pid; }
    stages() { pgrep -x "$1" -P "$(ring)"; }'
}

# usage: interrupted_equals_straight STRAIGHT STEP_COMMAND ACCIDENT EXIT_CODE
interrupted_equals_straight() {
  local code=0
  rm -f ring.pid
  accident="$ring; $3" sheet-loop -i start.sheet "${options[@]}" -o run.sheet -- "$2 | accident_at 11" 2> log &
  echo $! > ring.pid
  wait $! || code=$?
  [[ $code == "$4" ]]
  grep -q 'in the step after step 1[01], t = 0.0[0-9]* s' log
  is_beginning_of "$1"
  accident=true sheet-loop -q --resume run.sheet "${options[@]}" -- "$2 | accident_at 11"
  cmp run.sheet "$1"
}

# usage: is_beginning_of STRAIGHT: run.sheet is shorter, holds whole frames, and they are the first ones of the straight run
is_beginning_of() {
  local frames
  frames=$(sheet-print run.sheet 2> /dev/null | grep -c '^frame$')
  ((frames > 0 && frames < 6))
  cmp <({ sheet-print run.sheet 2> /dev/null || true; } | grep -v '^end$') <(sheet-select --first "$frames" "$1" | sheet-print | grep -v '^end$')
}

@test "the sheet moves, steps end at the output times, and the volume stays" {
  for run in adaptive fixed; do
    sheet-check $run.sheet
    sheet-info --csv $run.sheet | cut -d, -f2,6 > rows
    [[ $(tr '\n' ' ' < rows) == "time,volume 0,0.06 0.02,0.06 0.04,0.06 0.06,0.06 0.08,0.06 0.1,0.06 " ]]
    sheet-diff -q --ignore provenance <(sheet-select --index 0 $run.sheet) <(sheet-select --last $run.sheet) && return 1
  done
  (($(sheet-select --last fixed.sheet | sheet-print | sed -n 's/^step //p') == 35)) # ceil(0.02 / 0.003) = 7 for each of 5
}

@test "SIGINT, adaptive steps" {
  interrupted_equals_straight adaptive.sheet "$adaptive" 'kill -INT $(ring); sleep 10' 130
}

@test "SIGINT, fixed steps" {
  interrupted_equals_straight fixed.sheet "$fixed" 'kill -INT $(ring); sleep 10' 130
}

@test "kill -9 of sheet-step, adaptive steps" {
  interrupted_equals_straight adaptive.sheet "$adaptive" 'kill -9 $(stages sheet-step); sleep 10' 1
  grep -q 'stage "sheet-step --tolerance 1e-3" was ended by signal 9 (Killed)' log
}

@test "kill -9 of sheet-step, fixed steps" {
  interrupted_equals_straight fixed.sheet "$fixed" 'kill -9 $(stages sheet-step); sleep 10' 1
  grep -q 'stage "sheet-step --dt 0.003" was ended by signal 9 (Killed)' log
}

@test "one thread and two give the same bits" {
  # 960 triangles, so that there is work to share
  sheet-init "$BATS_TEST_DIRNAME/../../pipelines/catenary/scene.toml" --set 'sheet.segments=[40, 12]' -o start.sheet
  for threads in 1 2; do
    sheet-loop -q -i start.sheet --until 0.02 -o threads$threads.sheet -- "sheet-step --threads $threads"
  done
  cmp threads1.sheet threads2.sheet
}

@test "sheet-step without a scene, and with a step size that cannot be" {
  make_grid 3 > grid.sheet
  run -3 bash -o pipefail -c 'sheet-step --dt 0.01 < grid.sheet | wc -c'
  [[ $output == *scene* ]]
  run -2 sheet-step --dt 0 start.sheet
  run -2 sheet-step --dt -1 start.sheet
  run -2 sheet-step --tolerance 0 start.sheet
  run -2 sheet-step --dt 0.01 --scheme euler start.sheet
}
