#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# The scripts pipelines/NAME/run, small: interrupted and resumed, each gives the same streams as run straight, and the last
# frame of each is a closed surface as one body; each stage of the bunny can be replaced by one of one's own in Python.
# What stands before a test's colon is the CTest that it belongs to, ring.pipelines.SCENE, so that several run at the same
# time.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_DIRNAME/../.." || exit
  export FILM=no
}

# interrupted SIGNAL STREAM PIPELINE [OPTION...]: runs the pipeline straight, and again with the ring ended by the signal
# after a quarter of its stream and the script run once more. All streams are the same, byte for byte, and their last
# frames closed as one body.
interrupted() {
  local signal=$1 stream=$2 pipeline=$3
  shift 3
  OUT=$BATS_TEST_TMPDIR/straight "pipelines/$pipeline/run" "$@"
  local size whole resumed=$BATS_TEST_TMPDIR/resumed
  whole=$(stat -c %s "$BATS_TEST_TMPDIR/straight/$stream.sheet")
  export OUT=$resumed
  # The ring stands still while it is looked at; where the machine is busy it may end between two looks: then once more.
  local script ring code=0
  for _ in 1 2 3 4 5; do
    rm -rf "$resumed"
    "pipelines/$pipeline/run" "$@" > "$BATS_TEST_TMPDIR/log" 2>&1 &
    script=$!
    ring=""
    while kill -0 "$script" 2> /dev/null; do
      ring=${ring:-$(pgrep -f "sheet-loop --resume $resumed/$stream.sheet " || true)}
      if [[ -n $ring ]] && kill -STOP "$ring" 2> /dev/null; then
        size=$(stat -c %s "$resumed/$stream.sheet" 2> /dev/null || echo 0)
        ((size <= whole / 4)) || kill "-$signal" "$ring"
        kill -CONT "$ring" 2> /dev/null || true
        ((size <= whole / 4)) || break
      fi
      sleep 0.005
    done
    code=0
    wait "$script" || code=$?
    [[ $code == 0 ]] || break
  done
  [[ $code == 130 || $code == 137 ]]
  (($(stat -c %s "$resumed/$stream.sheet") < whole))
  "pipelines/$pipeline/run" "$@"
  local made
  for made in "$BATS_TEST_TMPDIR"/straight/*.sheet; do
    cmp "$made" "$resumed/${made##*/}"
    # The spheres of the contraction end so small that round slabs are wider than they.
    [[ $pipeline == contraction ]] || /usr/bin/python3 tests/ring/one_body.py "$made"
  done
}

@test "bunny: interrupted and resumed = straight" {
  interrupted INT run bunny 0.15 0.6
}

@test "catenary: killed and resumed = straight" {
  interrupted KILL plain catenary 0.2 0.4
}

@test "balloon: interrupted and resumed = straight" {
  interrupted INT thin-falling balloon 0.25 100
}

@test "contraction: killed and resumed = straight" {
  interrupted KILL set2 contraction 0.25 100
}

@test "folding: interrupted and resumed = straight" {
  interrupted INT run folding 0.025 0.4
}

@test "ice cream: killed and resumed = straight" {
  interrupted KILL run ice-cream 0.02 0.1
}

@test "enrobing: interrupted and resumed = straight" {
  interrupted INT run enrobing 0.02 0.3
}

@test "tearing: interrupted and resumed = straight" {
  interrupted INT run tearing 0.05 0.06
}

@test "curtain: killed and resumed = straight" {
  interrupted KILL run curtain 0.12 0.4
}

@test "rupture: interrupted and resumed = straight" {
  interrupted INT fine rupture 0.002 2
}

@test "bubble: killed and resumed = straight" {
  interrupted KILL sideways bubble 0.0009 0.05
}

@test "bubble: waves around are counted, and a body of revolution has none" {
  sheet-init pipelines/bubble/fine.toml -o "$BATS_TEST_TMPDIR/round.sheet" --set sheet.perturbation.amplitude=1e-9
  pipelines/bubble/wrinkles "$BATS_TEST_TMPDIR/round.sheet" "$BATS_TEST_TMPDIR/round.csv"
  awk -F, 'NR == 2 { exit !($4 < 1e-6) }' "$BATS_TEST_TMPDIR/round.csv"
  PYTHONPATH=formats/python /usr/bin/python3 - "$BATS_TEST_TMPDIR" << 'END'
import sys

import numpy as np
import sheetstream

frame = next(iter(sheetstream.read(open(sys.argv[1] + "/round.sheet", "rb"))))
position = frame["position"]
angle = np.arctan2(position[:, 2], position[:, 0])
position *= 1 + 0.02 * np.cos(7 * angle)[:, None]
frame["position"] = position
with open(sys.argv[1] + "/wavy.sheet", "wb") as file:
    writer = sheetstream.Writer(file)
    writer.write(frame)
    writer.end()
END
  run -0 pipelines/bubble/wrinkles "$BATS_TEST_TMPDIR/wavy.sheet" "$BATS_TEST_TMPDIR/wavy.csv"
  [[ $output == *", 7 around;"* ]]
}

@test "pancake: interrupted and resumed = straight" {
  interrupted INT run pancake 0.01 2
}

@test "honey: killed and resumed = straight" {
  interrupted KILL run honey 0.006 1
}

@test "honey: runs the farther the warmer its plate" {
  OUT=$BATS_TEST_TMPDIR/plates pipelines/honey/plates 0.006 3
  awk -F, 'FNR == 1 { for (i = 1; i <= NF; ++i) if ($i == "x_max") x = i } { far[FILENAME] = $x }
    END { exit !(far[ARGV[1]] < 0.97 * far[ARGV[2]] && far[ARGV[2]] < 0.8 * far[ARGV[3]]) }' \
    "$BATS_TEST_TMPDIR"/plates/plate{5,20,60}.csv
}

@test "honey: falls from a spoon as fast as a thread of its flux" {
  OUT=$BATS_TEST_TMPDIR/spoon pipelines/honey/spoon 0.005 0.9
  [[ $(cat "$BATS_TEST_TMPDIR/spoon/spoon-steady.txt") =~ ^speed\ within\ ([0-9.]+)\  ]]
  awk -v off="${BASH_REMATCH[1]}" 'BEGIN { exit !(off < 9) }'
}

@test "tearing: strands part into drops, without sharp angles" {
  OUT=$BATS_TEST_TMPDIR/strands pipelines/tearing/strands 0.02 0.17
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
    { angle = $column["angle_min_degrees"]; if (NR == 2 || angle < least) least = angle }
    END { exit !(least > 10 && $column["drops"] > 0 && $column["step"] < 300) }' \
    "$BATS_TEST_TMPDIR/strands/strands.csv"
}

@test "spin: interrupted and resumed = straight" {
  interrupted INT run spin 0.01 1.2
}

@test "glass-mould: killed and resumed = straight" {
  interrupted KILL slip glass-mould 0.015 60
}

@test "glass-pane: interrupted and resumed = straight" {
  interrupted INT cools glass-pane 0.015 20
}

@test "redraw: killed and resumed = straight" {
  interrupted KILL w50 redraw 0.01 20 50
}

@test "float-glass: interrupted and resumed = straight" {
  interrupted INT held float-glass 0.5 100 40
}

@test "lava: killed and resumed = straight" {
  interrupted KILL cools lava 0.08 6
}

@test "chocolate-shell: interrupted and resumed = straight" {
  interrupted INT sets chocolate-shell 0.008 0.3
}

@test "bottle: interrupted and resumed = straight" {
  interrupted INT bottle bottle 0.006 0.08 0.03
}

@test "enrobing, truffle after truffle: more leaves than comes; gone on with = straight" {
  export FILM=no
  OUT=$BATS_TEST_TMPDIR/straight pipelines/enrobing/line 0.04 1.25 2
  OUT=$BATS_TEST_TMPDIR/resumed pipelines/enrobing/line 0.04 0.5 2
  OUT=$BATS_TEST_TMPDIR/resumed pipelines/enrobing/line 0.04 1.25 2
  cmp "$BATS_TEST_TMPDIR"/{straight,resumed}/line.sheet
  awk -F, 'NR > 1 && $6 > most { most = $6 } END { exit !($6 < 0.8 * most) }' "$BATS_TEST_TMPDIR/straight/line.csv"
}

@test "coating: killed while a second sheet is there, and resumed = straight" {
  interrupted KILL coating coating 0.006 0.24 0.05
}

@test "lanes: interrupted while layers become one, and resumed = straight" {
  interrupted INT run lanes 0.005 0.2 0.05
}

@test "pool: killed while layers become one, and resumed = straight" {
  interrupted KILL run pool 0.01 1.5 0.05
}

@test "truffle: interrupted and resumed = straight" {
  interrupted INT run truffle 0.005 0.8 0.05
}

@test "film-casting: killed and resumed = straight" {
  interrupted KILL free film-casting 0.02 1 0.5
  # The profile is that of one place along the film, from edge to edge.
  awk -F, 'NR > 1 { x += $6 > 0.19 - 1e-12 && $6 < 0.19 + 1e-12; low = $8 < low ? $8 : low; high = $8 > high ? $8 : high }
    END { exit !(NR > 10 && x == NR - 1 && low < -0.05 && high > 0.05) }' "$BATS_TEST_TMPDIR/straight/across.csv"
}

@test "film-casting: what is cooled on its way necks in less" {
  OUT=$BATS_TEST_TMPDIR/cooled pipelines/film-casting/cooled 0.02 3 "0 800"
  awk -F, 'NR == 2 { hot = $2 } NR == 3 { cold = $2; warmth = $4 } END { exit !(cold > 1.05 * hot && warmth > 80 && warmth < 130) }' \
    "$BATS_TEST_TMPDIR/cooled/cooled.csv"
}

@test "bottle: what cools is blown more slowly" {
  OUT=$BATS_TEST_TMPDIR/cooled FILM=no pipelines/bottle/cooled 0.008 1
  awk -F, 'FNR == 1 { for (i = 1; i <= NF; ++i) if ($i == "area") c = i } { area[FILENAME] = $c } END {
    exit !(area[ARGV[1]] < 0.9 * area[ARGV[2]] && area[ARGV[1]] > 0.006) }' \
    "$BATS_TEST_TMPDIR/cooled/cooled.csv" "$BATS_TEST_TMPDIR/cooled/hot.csv"
}

@test "ice-shelf: killed and resumed = straight" {
  interrupted KILL tongue ice-shelf 4000 200
}

@test "enrobing: what has a yield stress stretches less than what has none" {
  OUT=$BATS_TEST_TMPDIR/out FILM=no pipelines/enrobing/casson 0.04 0.2
  awk -F, 'FNR == 1 { for (i = 1; i <= NF; ++i) if ($i == "area") c = i } { area[FILENAME] = $c } END {
    exit !(area[ARGV[1]] < area[ARGV[2]] && area[ARGV[1]] > 0.05) }' \
    "$BATS_TEST_TMPDIR/out/casson.csv" "$BATS_TEST_TMPDIR/out/newtonian.csv"
}

@test "ketchup: interrupted and resumed = straight, and it stands where the sauce runs on" {
  interrupted INT ketchup ketchup 0.012 3
  awk -F, 'END { exit !($2 > 90 && $2 < $4 && $3 > 1.2 * $2) }' "$BATS_TEST_TMPDIR/straight/radii.csv"
}

@test "lithosphere: interrupted and resumed = straight" {
  interrupted INT run lithosphere 3
}

@test "drape: interrupted and resumed = straight" {
  interrupted INT run drape 0.1 0.25
}

@test "annulus: killed and resumed = straight, and it turns as it should" {
  interrupted KILL fine annulus 0.02 8
  awk -F, 'NR == 10 { exit !($1 == 8 && $2 > 0.00399 && $2 < 0.00401) }' "$BATS_TEST_TMPDIR/straight/run-waves.csv"
}

@test "annulus: waves grow as theory says, the closer the finer" {
  OUT=$BATS_TEST_TMPDIR/growth run -0 pipelines/annulus/growth 0.0075 0.06
  grep -q "steps 0.1: highest with [67] crests (theory 6)" <<< "$output"
  # Growth over theory's of the six crests that grow fastest, for edges of 7.5 and of 5.25 mm.
  awk -F, '$3 == 0.1 && $4 == 6 { off[$2] = $5 / $6 - 1 } END { exit !(off[0.0075] < 0.25 && off[0.00525] < 0.12 && off[0.00525] > 0.05) }' \
    "$BATS_TEST_TMPDIR/growth/growth.csv"
}

@test "ice cream: frequency goes as speed, whatever the edges" {
  OUT=$BATS_TEST_TMPDIR/law run -0 pipelines/ice-cream/law 0.01 8 "1.5 3" "0.055 0.06"
  [[ $(grep -cE "goes as speed to (0\.9[0-9]*|1\.0[0-9]*)," <<< "$output") == 3 ]]
}

@test "folding: frequency goes as speed to three quarters, or nearly" {
  OUT=$BATS_TEST_TMPDIR/law run -0 pipelines/folding/law 0.005 4 "0.1 0.2" "0.07"
  [[ $(grep -cE "goes as speed to 0\.[67]" <<< "$output") == 3 ]]
}

@test "gallery: a scene that is ended ends it, it goes on from there, and what is done is not done again" {
  export OUT=$BATS_TEST_TMPDIR/gallery SHEET_BIN=$BATS_TEST_TMPDIR/bin
  mkdir "$SHEET_BIN"
  printf '#!/bin/sh\nexit 6\n' > "$SHEET_BIN/sheet-emit"
  chmod +x "$SHEET_BIN/sheet-emit"
  run pipelines/gallery --short rupture ice-cream
  [[ $status != 0 && -e $OUT/rupture/done && ! -e $OUT/ice-cream/done && $output == *"pipelines/ice-cream/run ended with"* ]]
  rm "$SHEET_BIN/sheet-emit"
  run -0 pipelines/gallery --short rupture ice-cream
  [[ $output != *"== rupture"* && $output == *"== ice-cream"* && $(wc -l < "$OUT/gallery.csv") == 5 ]]
  OUT=$BATS_TEST_TMPDIR/straight pipelines/ice-cream/run 0.02 0.05
  cmp "$BATS_TEST_TMPDIR/straight/run.sheet" "$OUT/ice-cream/run.sheet"
  run -2 pipelines/gallery nonesuch
  [[ $output == *"there is no scene nonesuch"* ]]
  run -0 pipelines/gallery --list # each has a short version
  [[ $(wc -l <<< "$output") -gt 15 && $output == *bottle* && $output != *diagram* ]]
}

@test "bunny: a stream that was made with other options is not gone on with" {
  export OUT=$BATS_TEST_TMPDIR/run
  pipelines/bunny/run 0.3 0.1
  run -2 pipelines/bunny/run 0.25 0.1
  [[ $output == *"run.sheet was made with other options"*"OUT="* ]]
}

# with_stage PROGRAM COMMAND: the bunny with that program replaced, and that stage alone.
with_stage() {
  export OUT=$BATS_TEST_TMPDIR/run SHEET_BIN=$BATS_TEST_TMPDIR/bin
  mkdir -p "$SHEET_BIN"
  printf '#!/bin/sh\nexec "%s"\n' "$PWD/$2" > "$SHEET_BIN/$1"
  chmod +x "$SHEET_BIN/$1"
  pipelines/bunny/run 0.15 0.3
  sheet-print "$OUT/run.sheet" > "$BATS_TEST_TMPDIR/text"
  [[ $(grep -c '^frame$' "$BATS_TEST_TMPDIR/text") == 9 ]]
  grep -q "${2##*/} (1.0)" "$BATS_TEST_TMPDIR/text"
  ! grep -q " $1 (" "$BATS_TEST_TMPDIR/text"
}

@test "stages: a Python stage in place of sheet-collide: nothing stops the sheet" {
  with_stage sheet-collide formats/python/example_stage.py
}

@test "stages: a Python stage in place of sheet-remesh" {
  with_stage sheet-remesh formats/python/example_stage.py
}

@test "stages: a Python clock in place of sheet-step: nothing moves" {
  with_stage sheet-step tests/ring/clock_stage.py
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "y_min") y = i } NR > 1 && $y != 0 { exit 1 } END { exit NR != 10 }' "$OUT/run.csv"
}
