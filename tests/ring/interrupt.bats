#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# Interrupted anywhere: whole frames on disk, a message that says what happened where, the right exit code, and
# straight run = interrupted and resumed run, byte for byte.

run_options=(--steps 60 --keep 10)
bats_require_minimum_version 1.5.0

setup_file() {
  cd "$BATS_FILE_TMPDIR" || exit
  make_grid 60 > start.sheet
  accident=true sheet-loop -q -i start.sheet --steps 60 --keep 10 -o straight.sheet -- 'sheet-pass | accident_at 35 | sheet-pass'
}

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
  cp "$BATS_FILE_TMPDIR/start.sheet" .
  straight=$BATS_FILE_TMPDIR/straight.sheet
}

# usage: ring_with_accident COMMAND [OPTION]...: runs the ring; at step 35 its middle stage runs COMMAND, which knows the
# stage's process id as $stage and the ring's as $(ring). Leaves the exit code in $code, messages in `log`.
ring_with_accident() {
  export accident="ring() { until [ -s ring.pid ]; do sleep 0.01; done; cat ring.pid; }; $1"
  shift
  code=0
  rm -f ring.pid
  sheet-loop -i start.sheet "${run_options[@]}" "$@" -- 'sheet-pass | accident_at 35 | sheet-pass' 2> log &
  echo $! > ring.pid
  wait $! || code=$?
  unset accident
}

resumed_equals_straight() {
  accident=true sheet-loop -q --resume run.sheet "${run_options[@]}" -- 'sheet-pass | accident_at 35 | sheet-pass'
  cmp run.sheet "$straight"
}

whole_frames() { # FILE COUNT: so many whole frames and nothing behind them
  sheet-print "$1" 2> print.log > text || [[ $(cat print.log) == *"no end mark"* ]]
  [[ $(grep -c '^frame$' text) == "$2" ]]
}

@test "SIGINT to sheet-loop: the stream ends well, exit by the signal, resume gives the straight run" {
  ring_with_accident 'kill -INT $(ring); sleep 10' -o run.sheet
  [[ $code == 130 ]]
  grep -q 'interrupted in the step after step 35, t = 0 s; 4 whole frames kept; go on with --resume run.sheet' log
  sheet-pass run.sheet > /dev/null
  whole_frames run.sheet 4
  resumed_equals_straight
}

@test "kill -9 of a stage: the stage is named, whole frames, resume gives the straight run" {
  ring_with_accident 'kill -9 $stage' -o run.sheet
  [[ $code == 1 ]]
  grep -q 'stage "accident_at 35" was ended by signal 9 (Killed) in the step after step 35' log
  run -4 sheet-pass run.sheet -o copy.sheet
  whole_frames run.sheet 4
  resumed_equals_straight
}

@test "kill -9 of sheet-loop: whole frames, no stage stays behind, resume gives the straight run" {
  ring_with_accident 'kill -9 $(ring)' -o run.sheet
  [[ $code == 137 ]]
  for _ in $(seq 300); do
    left=$(pgrep -r R,S,D -f 'accident_at 35' || true)
    [[ -n $left ]] || break
    sleep 0.1
  done
  [[ -z $left ]]
  whole_frames run.sheet 4
  resumed_equals_straight
}

@test "a stage that fails with an exit code of its own: the ring passes it on" {
  ring_with_accident 'kill -TERM $stage' -o run.sheet
  [[ $code == 1 ]]
  grep -q 'signal 15' log
  code=0
  sheet-loop -i start.sheet --steps 5 -o other.sheet -- 'sheet-pass | sheet-pass --nonsense' 2> log || code=$?
  [[ $code == 2 ]]
  grep -q 'stage "sheet-pass --nonsense" failed with exit code 2 in the step after step 0' log
}

@test "a stage that does not exist, one that ends too early, one that talks nonsense" {
  run -2 sheet-loop -i start.sheet --steps 5 -o run.sheet -- 'sheet-pass | nonesuch | sheet-pass'
  [[ $output == *'stage "nonesuch" was not found'* ]]
  run -4 sheet-loop -i start.sheet --steps 5 -o run.sheet -- 'sheet-pass | head -c 100000'
  [[ $output == *'cut short'* ]]
  run -4 sheet-loop -i start.sheet --steps 5 -o run.sheet -- 'sheet-pass | tr S T'
  [[ $output == *'not a sheet stream'* ]]
}

@test "without a pipeline --resume takes the frames' own, with its options; one that is given wins, and is theirs then" {
  pipeline='sheet-pass --threads 1 | sheet-remesh --edge-length=0.3 | sheet-pass'
  sheet-loop -q -i start.sheet --steps 60 --keep 7 -o once.sheet -- "$pipeline"
  sheet-loop -q -i start.sheet --steps 14 --keep 7 -o run.sheet -- "$pipeline"
  sheet-loop --resume run.sheet --steps 60 2> log
  cmp run.sheet once.sheet
  grep -q 'the ring is that of run.sheet: --keep 7 -- ' log
  sheet-loop -q --resume run.sheet --steps 61 --keep 1 -- 'sheet-pass | sheet-pass'
  sheet-loop --resume run.sheet --steps 62 2> log
  grep -q "the ring is that of run.sheet: --keep 1 -- 'sheet-pass | sheet-pass'" log
  sheet-loop -q --resume run.sheet --steps 63 --keep 7 -- "$pipeline"
  sheet-loop --resume run.sheet --steps 64 2> log
  grep -q 'the ring is that of run.sheet: --keep 7 -- ' log
  [[ $(sheet-select --last run.sheet | sheet-print | grep -c '^| [0-9]* sheet-loop') == 2 ]]
}

@test "a ring with commands of somebody's own is not run because a stream says so: it is told, to be pasted" {
  # a quote and a line break come back as they were
  sheet-loop -q -i start.sheet --steps 5 -o run.sheet -- "sheet-pass | bash -c 'touch ran; exec sheet-pass # it'\"'\"'s
'"
  rm ran
  cp run.sheet before.sheet
  run -2 sheet-loop --resume run.sheet --steps 10
  [[ ! -e ran ]]
  cmp run.sheet before.sheet
  eval "sheet-loop -q --resume run.sheet --steps 10 -- ${output#*as in -- }"
  [[ -e ran ]]
  [[ $(sheet-select --last run.sheet | sheet-print | grep -c '^| [0-9]* sheet-loop') == 1 ]]
}

@test "a stream that tells no pipeline is refused with what to do, and so is a resumed run without an end" {
  sheet-loop -q -i start.sheet --steps 2 --no-provenance -o run.sheet -- sheet-pass
  cp run.sheet before.sheet
  run -2 sheet-loop --resume run.sheet --steps 4
  [[ $output == *'run.sheet does not tell the pipeline that made it: give the stages behind --'* ]]
  cmp run.sheet before.sheet
  run -2 sheet-loop --resume run.sheet
  [[ $output == *'when does it end?'* ]]
  run -2 sheet-loop -i start.sheet --steps 4
  [[ $output == *'no pipeline: give the stages behind --'* ]]
}

@test "disk full: exit code 6, whole frames, resume elsewhere gives the straight run" {
  ((EUID == 0)) && mkdir small && mount -t tmpfs -o size=2m tmpfs small 2> /dev/null || skip "needs the right to mount a tmpfs"
  ring_with_accident true -o small/run.sheet || true
  cp small/run.sheet run.sheet
  umount small
  [[ $code == 6 ]]
  grep -q 'No space left on device; at step [0-9]*, t = 0 s; [0-9]* whole frames kept' log
  sheet-print run.sheet > /dev/null 2> print.log || grep -q 'no end mark' print.log
  resumed_equals_straight
}

@test "closed pipe downstream: everybody ends quietly" {
  { accident=true sheet-loop -i start.sheet "${run_options[@]}" -- 'sheet-pass | accident_at 35' 2> log; echo $? > code; } |
    head -c 700000 > /dev/null
  [[ $(cat code) == 0 ]]
  [[ ! -s log ]]
}

@test "a stage that dies behind one that waits for its next frame is seen at once" {
  for pipeline in 'sheet-pass | nonesuch' 'sheet-pass | sheet-pass --nonsense | sheet-pass' 'sheet-pass | false'; do
    make_grid 3 > small.sheet
    run timeout 20 sheet-loop -i small.sheet --steps 3 -o run.sheet -- "$pipeline"
    ((status >= 1 && status <= 2)) # 124: it waited until the time was over
  done
}

@test "checkpoint: the newest frame survives a dying stage, and resume starts from it" {
  ring_with_accident 'kill -9 $stage' -o run.sheet --checkpoint newest.sheet
  sheet-print newest.sheet | grep -q '^step 35$'
  accident='false; kill -9 $stage' # would kill a second run of step 34
  export accident
  sheet-loop -q --resume run.sheet "${run_options[@]}" --checkpoint newest.sheet -- 'sheet-pass | accident_at 34 | sheet-pass'
  cmp run.sheet "$straight" || { sheet-diff --ignore provenance run.sheet "$straight"; }
}

@test "a stream that was cut in the middle of a frame is mended by resume" {
  head -c 1000000 "$straight" > run.sheet
  resumed_equals_straight
}

@test "resume of a finished run changes nothing; of an empty file is refused" {
  cp "$straight" run.sheet
  resumed_equals_straight
  : > run.sheet
  run -3 sheet-loop --resume run.sheet "${run_options[@]}" -- cat
  [[ $output == *'holds no whole frame'* ]]
}

@test "a stream that is damaged in its middle is not resumed, and nothing of it is dropped" {
  cp "$straight" run.sheet
  printf 'x' | dd of=run.sheet bs=1 seek=500000 conv=notrunc status=none
  cp run.sheet before.sheet
  run -4 sheet-loop --resume run.sheet "${run_options[@]}" -- cat
  [[ $output == *'checksum mismatch; more follows behind it, so the file is left as it is'* ]]
  cmp run.sheet before.sheet
}
