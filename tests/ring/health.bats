#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# sheet-loop says what goes wrong: at once if it is serious, all of it at the end, with counts that go on when a run does.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
  cat > scene.toml << 'END'
[sheet]
shape = "disk"
radius = 1
edge_length = 0.3
thickness = 0.01
[material]
viscosity = 100
density = 1000
[environment]
gravity = [0, -9.81, 0]
[[hold]]
region = "rim"
END
  sheet-init scene.toml -o first.sheet
}

spoiled() { # [OPTION]...: the ring with the stage that spoils
  sheet-loop "$@" -- "sheet-step --dt 0.001 | /usr/bin/python3 $BATS_TEST_DIRNAME/spoiler_stage.py 5"
}

@test "a healthy run is told nothing of, and its frames have no record" {
  sheet-loop -i first.sheet --steps 20 -o run.sheet -- 'sheet-step --dt 0.001' 2> log
  run ! grep -q 'wrong\|serious\|remedy' log
  run ! grep -aq 'health' run.sheet
  [[ $(sheet-info --health run.sheet) == "run.sheet: nothing went wrong that anybody noticed" ]]
}

@test "what becomes serious is told at once, once, with place, time, share and remedy; all of it at the end" {
  spoiled -i first.sheet --steps 40 --keep 10 -o run.sheet 2> log
  thin='serious: thin: the sheet is down to [0-9e.-]* of its thickness at the start, at (.*) m'
  [[ $(grep -c "^sheet-loop: $thin, t = 0.01 s; on up to [0-9.]* % of the area" log) == 1 ]]
  [[ $(grep -c "^sheet-loop:   $thin, t = 0.0[1-4] s; on up to [0-9.]* % of the area" log) == 1 ]]
  grep -q 'remedy: .*\[tear\] below' log
  grep -q 'what went wrong on the way' log
  grep -q 'volume: [0-9.]* % of the volume was won or lost in one step' log
  grep -q 'seen 6 times from t = 0.005 to 0.01 s, -[0-9.e-]* m^3 in all' log # from 1 to 1e-6 of the triangle
  # the one before the end comes first, in time and in the file
  [[ $(grep -n 'sheet-loop: serious: thin' log | cut -d: -f1) -lt $(grep -n 'what went wrong' log | cut -d: -f1) ]]
  sheet-info --health run.sheet | grep -q 'serious: thin: the sheet is down to'
  head -c -100 run.sheet > short.sheet # of a run that failed: what its whole frames say, and that it was cut short
  status=0
  sheet-info --health short.sheet > health.txt 2> log || status=$?
  [[ $status == 4 ]] && grep -q 'cut short' log
  grep -q 'short.sheet: what went wrong on the way' health.txt
  status=0
  sheet-info --json short.sheet > figures.json 2> log || status=$?
  [[ $status == 4 ]] && /usr/bin/python3 -c 'import json; json.load(open("figures.json"))[-1]["triangles"]'
  spoiled -q -i first.sheet --steps 40 --keep 10 -o quiet.sheet 2> log
  [[ ! -s log ]]
}

@test "a run that is gone on with goes on counting: byte for byte the straight one" {
  spoiled -q -i first.sheet --steps 60 --keep 5 -o straight.sheet
  spoiled -q -i first.sheet --steps 15 --keep 5 -o run.sheet
  spoiled -q --resume run.sheet --steps 60 --keep 5
  cmp run.sheet straight.sheet
  sheet-select --last run.sheet | sheet-print | grep -A1 '^array health' | grep -q '^1 11 ' # at steps 10, 15, ... 60
}

@test "to watch over a run changes nothing but the record" {
  spoiled -q -i first.sheet --steps 12 --keep last -o run.sheet
  cp first.sheet by-hand.sheet
  for _ in {1..12}; do
    sheet-step --dt 0.001 by-hand.sheet | /usr/bin/python3 "$BATS_TEST_DIRNAME/spoiler_stage.py" 5 > next.sheet
    mv next.sheet by-hand.sheet
  done
  sheet-diff --ignore provenance --ignore health by-hand.sheet run.sheet
}

@test "a stage's repeated warnings are told once, and counted; without a ring by the stage itself" {
  # no step is as accurate as that
  sheet-loop -i first.sheet --until 0.05 --steps 60 --keep 1 -o run.sheet -- 'sheet-step --tolerance 1e-11' 2> log
  [[ $(grep -c 'its error is about .* shorter edges there may help (told once, then counted)' log) == 1 ]]
  [[ $(grep -c 'its error is about' log) == 1 ]]
  grep -q 'steps above the tolerance: the error of a step is up to .* of an edge, and no shorter step was better, at (.*) m, t = ' log
  times=$(sed -n '/steps above the tolerance/{n;s/.*seen \([0-9]*\) times from .*/\1/p}' log)
  ((times > 3))
  sheet-select --index 1-10 run.sheet | sheet-step --tolerance 1e-11 -o again.sheet 2> log
  [[ $(grep -c 'its error is about' log) == 1 ]]
  grep -q 'sheet-step: steps above the tolerance: [0-9]* times in all' log
}

@test "what stands still over and over is told once, and counted; then it is serious" {
  # of two layers the upper is led down through the lower, which is held
  awk 'BEGIN {for (k = 0; k < 2; ++k) {for (i = 0; i < 4; ++i) print "v", i % 2, int(i / 2), k * 0.0101
    print "f", 1 + 4 * k, 2 + 4 * k, 4 + 4 * k; print "f", 1 + 4 * k, 4 + 4 * k, 3 + 4 * k}}' > layers.obj
  cat > layers.toml << 'END'
[sheet]
shape = "mesh"
file = "layers.obj"
thickness = 0.01
[material]
viscosity = 100
density = 1000
[contact]
[[hold]]
region = {box = [[-1, -1, -0.001], [2, 2, 0.001]]}
[[hold]]
region = {box = [[-1, -1, 0.009], [2, 2, 0.02]]}
motion = {kind = "translating", velocity = [0, 0, -1]}
END
  sheet-init layers.toml -o layers.sheet
  sheet-loop -i layers.sheet --steps 30 -o run.sheet -- 'sheet-step --dt 0.01 | sheet-collide' 2> log
  [[ $(grep -c '4 vertices on solids or held stay behind.*(told once, then counted)' log) == 1 ]]
  [[ $(grep -c '^sheet-loop: serious: intersections waited for: up to 4 vertices' log) == 1 ]]
  grep -q 'seen 30 times from t = 0.01 to 0.3 s, 120 vertices in all' log
}

@test "on a terminal one line tells time, step, frames and the time left, once a second; elsewhere nothing" {
  cat > slow << END
#!/bin/sh
exec sheet-loop "\$@" -i first.sheet --steps 30 --keep 4 -o run.sheet -- "/usr/bin/python3 $BATS_TEST_DIRNAME/spoiler_stage.py 1000 0.1"
END
  chmod +x slow
  script -qec './slow' /dev/null < /dev/null > seen
  lines=$(tr '\r' '\n' < seen | grep -c 'step [0-9]* of 30, t = .* s, [0-9]* frames, .* s a step, .* left' || true)
  ((lines >= 2 && lines <= 6))
  ./slow 2> log
  run ! grep -q ' left' log
  script -qec './slow -q' /dev/null < /dev/null > seen
  [[ ! -s seen ]]
}

@test "an interrupted run tells its times, the stages' summaries and its health, and ends soon" {
  sheet-loop -v -i first.sheet --steps 100000 --keep 50 -o run.sheet \
    -- "sheet-step -v --dt 1e-5 | /usr/bin/python3 $BATS_TEST_DIRNAME/spoiler_stage.py 5" 2> log &
  ring=$!
  until grep -q 'serious: thin' log; do sleep 0.1; done
  kill -INT $ring
  code=0
  wait $ring || code=$?
  ((code == 130))
  grep -q 'interrupted in the step after step' log
  grep -q 'sheet-step: [0-9]* steps (.*Newton iterations' log
  grep -q 'ms a step' log
  grep -q 'what went wrong on the way' log
  sheet-check run.sheet
}
