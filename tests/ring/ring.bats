#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# sheet-loop's ordinary work: what it keeps, stamps and refuses.

bats_require_minimum_version 1.5.0
setup() { cd "$BATS_TEST_TMPDIR" || exit; make_grid 3 > start.sheet; }
steps_of() { sheet-print "$1" | sed -n 's/^step //p' | tr '\n' ' '; }

@test "frames from 0 triangles to 200 MB go round without deadlock, also where a stage answers before it has read all" {
  for n in 0 1 2 1350; do
    make_grid $n > grid.sheet
    timeout 100 sheet-loop -q -i grid.sheet --steps 2 --keep last -o run.sheet -- 'cat | sheet-pass --no-provenance | cat'
    timeout 100 sheet-pass -q run.sheet > /dev/null
  done
}

@test "--keep: every step, every n-th, the last" {
  sheet-loop -q -i start.sheet --steps 5 -o run.sheet -- cat
  [[ $(steps_of run.sheet) == "0 1 2 3 4 5 " ]]
  sheet-loop -q -i start.sheet --steps 5 --keep 2 -o run.sheet -- cat
  [[ $(steps_of run.sheet) == "0 2 4 5 " ]]
  sheet-loop -q -i start.sheet --steps 5 --keep last -o run.sheet -- cat
  [[ $(steps_of run.sheet) == "5 " ]]
}

@test "standard input and output, the last of several frames is the start" {
  sheet-loop -q -i start.sheet --steps 2 -- cat < /dev/null > two.sheet
  sheet-loop -q --steps 3 -- cat < two.sheet | sheet-print | grep -c '^frame$' > count
  [[ $(cat count) == 2 ]]
  sheet-loop -i two.sheet --steps 1 -- cat 2> log > same.sheet
  grep -q 'nothing was left to do: it starts at step 2, t = 0 s; give a later --until, or more --steps' log
}

@test "what cannot be is refused with a remedy" {
  run -2 sheet-loop -i start.sheet -- cat
  [[ $output == *'give --until SECONDS, --steps N or --stop-when CONDITION'* ]]
  run -2 sheet-loop -i start.sheet --until 1 --fps 24 -o run.sheet -- cat
  [[ $output == *'did not advance the time'* ]]
  run -2 sheet-loop -i start.sheet --steps 3 --fps -1 -- cat
  run -2 sheet-loop -i start.sheet --steps 3 --keep output -- cat
  run -2 sheet-loop -i start.sheet --steps 3 --keep 0 -- cat
  run -2 sheet-loop -i start.sheet --steps 3
  run -2 sheet-loop -i start.sheet --steps 3 -- ''
  run -2 sheet-loop -i start.sheet --step 3 -- cat
  [[ $output == *'did you mean --steps?'* ]]
  for stage in 'sheet-pass -o x' 'sheet-pass --output=x' 'sheet-remesh --edge-length 1 -ox' \
    'sheet-pass -q --output x -v'; do
    run -2 timeout 20 sheet-loop -i start.sheet --steps 3 -o run.sheet -- "sheet-pass | $stage | sheet-pass"
    [[ $output == *"stage \"$stage\" writes to a file, and the ring waits for its frames: leave that option out"* ]]
    [[ ! -e x ]]
  done
  sheet-loop -q -i start.sheet --steps 1 -o run.sheet -- 'sheet-pass -o - | sheet-pass --output /dev/stdout'
  run -2 sheet-loop -i start.sheet --steps 1 -o start.sheet -- cat
  [[ $output == *'input and output at once'* ]]
  sheet-pass -q start.sheet > /dev/null
}

@test "so many frames a second that times are one number are refused, so few that none comes are none" {
  sheet-loop -q -i start.sheet --steps 3 --fps 1e-310 -o run.sheet -- cat
  [[ $(steps_of run.sheet) == "0 3 " ]]
  sheet-print start.sheet | sed 's/^time 0$/time 1/' | sheet-parse -o late.sheet
  for fps in 1e17 1e300; do
    run -2 timeout -s KILL 20 sheet-loop -i late.sheet --steps 3 --fps "$fps" -o run.sheet -- cat
    [[ $output == *"--fps: "*" frames a second are so many at t = 1 s"*"give fewer" ]]
  done
  [[ $(steps_of run.sheet) == "0 3 " ]]
}

@test "time per stage is told, and -q is quiet" {
  run -0 sheet-loop -i start.sheet --steps 5 -o run.sheet -- 'sheet-pass | sheet-pass'
  [[ $(grep -c 'sheet-pass .* ms a step' <<< "$output") == 2 ]]
  run -0 sheet-loop -q -i start.sheet --steps 5 -o run.sheet -- 'sheet-pass | sheet-pass'
  [[ -z $output ]]
}
