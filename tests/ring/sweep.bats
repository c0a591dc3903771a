#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# pipelines/sweep on this machine: tables, plans, engines plain and parallel, failures, interruptions, results.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_DIRNAME/../.." || exit
  t=$BATS_TEST_TMPDIR
  { printf '\xef\xbb\xbf'; cat; } > "$t/table.csv" << 'END' # some programs begin text so
material.viscosity,sheet.thickness [mm],dt
"50 Pa*s",1,0.01
100,2,0.01
"0.15 kPa*s",3,0.02
100,4,0.02
END
}

# usage: sweep NAME [OPTION...]: the table, shortly, with that engine; results in $t/NAME
sweep() {
  local folder=$1
  shift
  pipelines/sweep "$t/table.csv" --scene pipelines/catenary/scene.toml --until 0.1 --fps 20 -o "$t/$folder" "$@" -- "${ring:-sheet-step --dt {dt\}}"
}

# usage: same NAME NAME: every result of one sweep equals that of the other, byte for byte, and all are there
same() {
  (cd "$t/$1" && find runs -name run.sheet -o -name result.json -o -name scene.toml -o -name numbers.csv | sort) > "$t/files"
  [[ $(wc -l < "$t/files") == $((4 * ($(wc -l < "$t/table.csv") - 1))) ]]
  while read -r file; do cmp "$t/$1/$file" "$t/$2/$file" || return 1; done < "$t/files"
}

@test "engines plain and parallel give the same bytes, and what is done is not done again" {
  sweep plain --engine plain
  sweep parallel --engine parallel
  same plain parallel
  find "$t/plain/runs" -type f -exec stat -c '%n %Y %Z' {} + | sort > "$t/before"
  sweep plain --engine parallel --threads 2
  find "$t/plain/runs" -type f -exec stat -c '%n %Y %Z' {} + | sort | cmp - "$t/before"
}

@test "results: parameters with units, state, steps, measures of the user's own" {
  sweep run --engine plain --measure 'echo "sag [mm] $(wc -l < numbers.csv)"; echo "rows {dt}"'
  /usr/bin/python3 - "$t/run/results.csv" << 'END'
import csv, sys
rows = list(csv.DictReader(open(sys.argv[1])))
assert [r["material.viscosity [Pa*s]"] for r in rows] == ["50", "100", "150", "100"], rows  # SI, whatever the row's unit
assert [r["sheet.thickness [mm]"] for r in rows] == ["1", "2", "3", "4"]
assert [r["steps"] for r in rows] == ["10", "10", "6", "6"]
assert all(r["state"] == "done" and r["exit_code"] == "0" and r["sag [mm]"] == "4" and r["rows"] == r["dt"] for r in rows)
assert all(abs(float(r["end.volume [m^3]"]) - 1e-3 * float(r["sheet.thickness [mm]"])) < 1e-15 for r in rows)
assert all(float(r["max.thickness_max [m]"]) >= float(r["end.thickness_max [m]"]) and float(r["seconds [s]"]) > 0 for r in rows)
END
  run -0 pipelines/sweep status "$t/run"
  [[ $output == "4 runs: 4 done, 0 running, 0 interrupted, 0 failed, 0 waiting" ]]
  [[ $(tail -1 "$t/run/runs/000/000/numbers.csv") == 2,0.1,* ]]
}

@test "a bad table: all that is wrong is told, with its place, and nothing is made" {
  cat > "$t/table.csv" << 'END'
material.viscosit,sheet.thickness,dt,foo
100,1 Pa,0.1,1
100,1 Pa,0.1,1
100,-1 mm,0.1,2
END
  ring='sheet-step --dt {step} | sheet-nonesuch' run -3 sweep bad --engine plain
  for told in 'there is no column step' 'column dt: unknown' 'column foo: unknown' 'there is no program "sheet-nonesuch"' \
    'table.csv:3: the same as' 'table.csv:2: --set material.viscosit=100: unknown key "viscosit" in \[material\]; did you mean "viscosity"' \
    'table.csv:2: --set sheet.thickness=1 Pa: thickness: expected a length' 'table.csv:4: .*must be positive'; do
    grep -q "$told" <<< "$output" || { echo "not told: $told"; false; }
  done
  [[ ! -e $t/bad ]]
  for header in 'sheet.thickness,sheet.thickness' 'sheet thickness' 'a,b'; do
    printf '%s\n1\n' "$header" > "$t/table.csv"
    run -3 sweep bad --engine plain
  done
  for mark in ';' '\t'; do # of spreadsheets in other languages
    printf "sheet.thickness [mm]${mark}dt\n1,5${mark}0,1\n" > "$t/table.csv"
    run -3 sweep bad
    [[ $output == *"table.csv:1: columns are separated by commas, not by "*"; numbers have a decimal point" ]]
  done
  printf 'sheet.thickness\n' > "$t/table.csv"
  run -3 sweep bad
  [[ $output == *"no rows"* ]]
}

@test "options that sheet-loop refuses are told before anything runs" {
  run -3 sweep bad --until soon
  [[ $output == *'pipelines/sweep: --until: "soon" is not a finite number'* ]]
  run -3 sweep bad --keep often
  [[ $output == *'pipelines/sweep: --keep: "often" is not'* && ! -e $t/bad ]]
}

@test "a folder that cannot be made is an input or output error, and one line" {
  true > "$t/file"
  run -6 sweep file/sweep
  [[ $output == "pipelines/sweep: $t/file/sweep"*": Not a directory" && ${#lines[@]} == 1 ]]
}

@test "TOML: grid, zip, random and Latin hypercube" {
  cat > "$t/table.toml" << 'END'
[grid]
material.viscosity = {from = "10 Pa*s", to = "1000 Pa*s", count = 3, scale = "log"}
[zip]
sheet.thickness = ["1 mm", "2 mm"]
dt = [0.01, 0.02]
[latin_hypercube]
count = 5
seed = 3
material.density = {from = 100, to = 200}
END
  plan() { pipelines/sweep "$t/table.toml" --scene pipelines/catenary/scene.toml --steps 2 -o "$t/$1" --plan -- 'sheet-step --dt {dt}'; }
  run -0 plan a
  [[ $output == "30 runs planned in "* ]]
  plan b
  cmp "$t/a/plan/000.csv" "$t/b/plan/000.csv"
  [[ $(cut -d, -f1-3 "$t/a/plan/000.csv" | sort -u | wc -l) == 6 ]]
  grep -q '^100 Pa\*s,2 mm,0.02,' "$t/a/plan/000.csv"
  cut -d, -f4 "$t/a/plan/000.csv" | sort -gu | awk '{ if ($1 < 80 + 20 * NR || $1 > 100 + 20 * NR) exit 1 } END { exit NR != 5 }'
  sed -i 's/count = 5/count = 0/; s/dt = .*/dt = [0.01]/; s/^count = 3/number = 3/; s/to = 200/to = "200 Pa"/' "$t/table.toml"
  run -3 plan c
  [[ $output == *"[zip]: lists that go together must be equally long: sheet.thickness 2, dt 1"*"[latin_hypercube] count: expected"*"material.density: expected {from"* ]]
}

@test "what fails is listed with its reason, and tried again only if asked" {
  mkdir "$t/bin"
  printf '#!/bin/sh\n[ "$1" = 0.01 ] || [ -e "%s/mended" ] || { echo "too steep" >&2; exit 5; }\nexec sheet-pass\n' "$t" > "$t/bin/steep"
  chmod +x "$t/bin/steep"
  export SHEET_BIN=$t/bin ring='sheet-step --dt {dt} | steep {dt}'
  run -5 sweep run --engine parallel
  [[ $output == *"2 done, 0 running, 0 interrupted, 2 failed"*'run 2 failed with exit code 5: sheet-loop: stage "steep 0.02" failed with exit code 5'* ]]
  [[ $(grep -c ',failed,5,' "$t/run/results.csv") == 2 ]]
  touch "$t/mended"
  run -5 sweep run
  run -0 sweep run --retry
  sweep straight --engine plain
  same straight run
}

@test "killed anywhere, the same command goes on: results are those of a sweep that nothing happened to" {
  sweep straight --engine plain
  mkdir "$t/bin"
  # Kills, once each, when the file is there: the stage itself, its ring, the worker, the driver.
  cat > "$t/bin/accident" << 'END'
#!/bin/bash
parent() { awk '{ print $4 }' "/proc/$1/stat"; }
read -r who 2> /dev/null < "$ACCIDENT" && rm "$ACCIDENT" && case $who in
  stage) kill -9 $$ ;;
  ring) kill -9 "$(parent $$)" ;;
  worker) kill -9 "$(parent "$(parent $$)")" ;;
  driver) kill -9 "$(cat "$ACCIDENT.pid")" ;;
esac
exec sheet-pass
END
  chmod +x "$t/bin/accident"
  export SHEET_BIN=$t/bin ACCIDENT=$t/accident ring='sheet-step --dt {dt} | accident'
  sweep straight2 --engine plain
  for engine in plain parallel; do
    for who in stage ring worker driver; do
      echo $who > "$t/accident"
      (echo "$BASHPID" > "$t/accident.pid"; exec pipelines/sweep "$t/table.csv" --scene pipelines/catenary/scene.toml --until 0.1 --fps 20 \
        -o "$t/$engine-$who" --engine $engine -- "$ring") && code=0 || code=$?
      [[ $code != 0 && ! -e $t/accident ]]
      sweep "$engine-$who" --engine $engine
      same straight2 "$engine-$who"
    done
  done
}

@test "a run that somebody is at is waited for, not done twice" {
  sweep run --plan
  mkdir -p "$t/run/runs/000/001"
  (exec 9> "$t/run/runs/000/001/lock"; flock 9; touch "$t/locked"; sleep 3; touch "$t/let-go") &
  until [[ -e $t/locked ]]; do sleep 0.05; done
  run -0 pipelines/sweep status "$t/run"
  [[ $output == *"1 running, 0 interrupted"* ]]
  sweep run --engine plain
  [[ -e $t/let-go ]]
}

@test "the meshes that a scene names go along: the folder alone is enough" {
  pipelines/meshes
  mkdir "$t/elsewhere"
  printf 'scale\n0.5\n0.7\n' > "$t/table.csv"
  pipelines/sweep "$t/table.csv" --scene pipelines/bunny/scene.toml --set 'sheet.segments=[8,8]' --set 'solid.0.scale={scale}' \
    --steps 2 -o "$t/run" --plan -- 'sheet-step --dt 0.002 | sheet-collide'
  mv "$t/run" "$t/elsewhere/moved"
  pipelines/sweep work --threads 1 "$t/elsewhere/moved" "0 1"
  [[ -e $t/elsewhere/moved/runs/000/001/result.json ]]
  grep -q 'file = "../../../inputs/[0-9a-f]*-bunny00.off"' "$t/elsewhere/moved/runs/000/001/scene.toml"
}

@test "rows of motions and meshes of sheets go along, too, and a row may name another file" {
  mkdir "$t/scene" "$t/elsewhere"
  sheet-init pipelines/catenary/scene.toml | sheet-export - -o "$t/scene/leaf.ply"
  printf 'time, x, y, z\n0, 0, -1, 0\n1, 0, %s, 0\n' -1 > "$t/scene/still.csv"
  printf 'time, x, y, z\n0, 0, -1, 0\n1, 0, %s, 0\n' -3 > "$t/scene/moving.csv"
  cat > "$t/scene/scene.toml" << 'END'
material = {viscosity = 100, density = 1000}
[[sheet]]
shape = "mesh"
file = "leaf.ply"
thickness = 0.01
[[solid]]
shape = "sphere"
radius = 0.1
motion = {kind = "keyframed", file = "still.csv"}
[[hold]]
region = "rim"
motion = {kind = "keyframed", file = "still.csv"}
END
  printf 'solid.0.motion.file,environment.bath.drag\nstill.csv,1\nmoving.csv,1\n' > "$t/table.csv"
  pipelines/sweep "$t/table.csv" --scene "$t/scene/scene.toml" --set 'environment.gravity=[0,-9.8,0]' \
    --set environment.bath.density=1 --set environment.bath.level=-5 --steps 1 -o "$t/run" --plan -- 'sheet-step --dt 0.01'
  rm -r "$t/scene"
  mv "$t/run" "$t/elsewhere/moved"
  pipelines/sweep work --threads 1 "$t/elsewhere/moved" "0 1"
  for run in 000 001; do [[ -e $t/elsewhere/moved/runs/000/$run/result.json ]]; done
  grep -q 'times = .*places = .*-3' "$t/elsewhere/moved/runs/000/001/scene.toml"
  run -1 grep -q -- '-3' "$t/elsewhere/moved/runs/000/000/scene.toml"
  pipelines/sweep results "$t/elsewhere/moved"
  grep -q 'environment.bath.drag \[Pa\*s/m\]' "$t/elsewhere/moved/results.csv"
}

@test "Slurm that does not answer is told at once" {
  mkdir "$t/bin"
  printf '#!/bin/sh\necho "squeue: error: nobody" >&2\necho "squeue: fatal: no controller" >&2\nexit 1\n' > "$t/bin/squeue"
  printf '#!/bin/sh\nexit 1\n' > "$t/bin/sbatch"
  chmod +x "$t"/bin/*
  PATH=$t/bin:$PATH run -2 timeout 60 pipelines/sweep "$t/table.csv" --scene pipelines/catenary/scene.toml --until 0.1 \
    --fps 20 -o "$t/slurm" --engine slurm -- 'sheet-step --dt {dt}'
  [[ $output == *'Slurm does not answer here: squeue: fatal: no controller: give the command on a machine of the cluster, or take --engine parallel'* ]]
}

@test "a folder of another sweep is refused" {
  sweep run --plan
  ring='sheet-step --dt 0.02 --scheme sdirk2 | sheet-pass' run -2 sweep run --plan
  sed -i 's/50 Pa/60 Pa/' "$t/table.csv"
  run -2 sweep run --plan
  [[ $output == *"has a sweep of another table"*"--out"* ]]
  run -2 pipelines/sweep status "$t"
  [[ $output == *"no sweep is there"* ]]
}

@test "20,000 runs: all of their rows are checked, the plan is some files" {
  (echo "material.viscosity"; seq 20000) > "$t/table.csv"
  pipelines/sweep "$t/table.csv" --scene pipelines/catenary/scene.toml --set 'sheet.segments=[3,3]' --steps 1 -o "$t/run" --plan -- 'sheet-step'
  [[ $(find "$t/run" -type f | wc -l) == 22 && $(wc -l < "$t/run/plan/019.csv") == 1000 ]]
  pipelines/sweep work --threads 1 "$t/run" "19999"
  grep -q 'viscosity = 20000' "$t/run/runs/019/999/scene.toml"
}

# usage: page_commands PAGE: its commands, what stands indented and begins with pipelines/ or cat, with what belongs to cat
page_commands() {
  awk '/^    (pipelines\/[a-z-]+(\/run)? [a-z.]|cat > )/ { on = 1 }
    on { print substr($0, 5); if (/<< .END.$/) here = 1; else if (/^    END$/) here = 0; if (!here && !/\\$/) on = 0 }' "$1"
}

@test "the commands of docs/sweeps.md" {
  page_commands docs/sweeps.md > "$t/commands"
  [[ $(grep -c "^pipelines/" "$t/commands") -ge 7 ]]
  ln -s "$PWD/pipelines" "$t/pipelines"
  cd "$t"
  bash -e commands
  [[ -s sag.png && -s plane.png && -s sag.mp4 && $(wc -l < out/plane/results.csv) == 10 ]]
  run -3 pipelines/sweep plot out/plane -o none.png --x sheet.thicknes --y material.viscosity
  [[ $output == *"no column sheet.thicknes; they have run, "* ]]
}
