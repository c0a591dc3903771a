#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# pipelines/own: scenes of one's own, foretold and seen, on those of tests/everyday that are quick; and their picture.

bats_require_minimum_version 1.5.0

setup() {
  own=$(realpath "$BATS_TEST_DIRNAME/../../pipelines/own/run")
  everyday=$(realpath "$BATS_TEST_DIRNAME/../everyday")
  SHEET_BIN=$(dirname "$(command -v sheet-step)")
  export SHEET_BIN OUT=$BATS_TEST_TMPDIR/own FILM=64x36 SAMPLES=1
  cd "$BATS_TEST_TMPDIR" || exit
}

@test "whole runs: all that is to be left, a row each, at their end, as foretold within a factor of three" {
  names=(honey-drop batter-tray slime-fork glass-pear)
  run -0 "$own" "$everyday"/{honey-drop,batter-tray,slime-fork,glass-pear}.toml
  [[ $output == *'| scene |'*'| honey-drop |'*'| glass-pear |'* ]]
  for name in "${names[@]}"; do
    for file in run.sheet film.mp4 early.png middle.png late.png run.csv health.txt check.txt run.log; do
      [[ -s own/$name/$file ]]
    done
    ! cmp -s "own/$name/early.png" "own/$name/late.png"
  done
  PYTHONPATH=$BATS_TEST_DIRNAME/../../pipelines /usr/bin/python3 - "${names[@]}" << 'END'
import sys, columns
rows = columns.read("own/own.csv")
assert [row["scene"] for row in rows] == sys.argv[1:], rows
for row in rows:
    assert abs(row["reached"] - row["until"]) < 1e-9 and 0 < row["thinnest"] < row["thickest"] and row["seconds"] > 0, row
    for what in "steps", "megabytes":
        assert 1 / 3 < row[what + "_foretold"] / row[what] < 3, (what, row)
assert {row["scene"]: row["warnings"] for row in rows}["slime-fork"] >= 1, rows
END
  "$BATS_TEST_DIRNAME/../bench/everyday-picture" picture.png own honey-drop slime-fork
  [[ $(ffprobe -v error -show_entries stream=width,height -of csv=p=0 picture.png) == 1440,540 ]]
}

@test "a scene of one's own from another folder, by options; what is over its time limit goes on" {
  mkdir scenes
  sed 's/honey/mine/' "$everyday/honey-drop.toml" > scenes/mine.toml
  cp "$everyday/disk-sphere.toml" scenes
  export FILM=no
  run -0 "$own" --quality draft --limit 0.3 --until 0.4 --fps 20 scenes/*.toml
  [[ $output == *'not at its end after 0.3 s'* && ! -e own/mine/film.mp4 && ! -e own/mine/late.png ]]
  reached() { awk -F , -v name="$1" 'NR == 1 {for (i = 1; i <= NF; i++) at[$i] = i} $1 == name {print $at["reached"]}' own/own.csv; }
  [[ $(reached mine) == 0.4 && $(reached disk-sphere) != 0.4 ]]
  run -0 "$own" --quality draft --limit 100 --until 0.4 --fps 20 scenes/*.toml
  [[ $(reached disk-sphere) == 0.4 ]]
}

@test "two liquids are told apart; a folder for results that cannot be made is told with what to do" {
  FILM=32x18 run -0 "$own" --quality draft --until 0.02 --fps 50 "$everyday/more/sauce.toml"
  [[ $output == *'sheet-render '*'--y4m'* && $output != *--material* ]]
  sheet-render own/sauce/run.sheet --frames -1 --view-of 0- --size 32x18 --samples 4 --denoise --material chocolate,batter -o apart.png
  cmp own/sauce/late.png apart.png
  touch file
  OUT=$PWD/file/none run -6 "$own" "$everyday/more/sauce.toml"
  [[ $output == *"the results go to $PWD/file/none, which cannot be made: give another folder by OUT="* ]]
}

@test "a scene that is refused does not keep others from running; its code is the last word" {
  mkdir scenes
  sed 's/viscosity/viscocity/' "$everyday/honey-drop.toml" > scenes/a.toml
  cp "$everyday/honey-drop.toml" scenes/b.toml
  export FILM=no
  run -3 "$own" --quality draft --until 0.05 --fps 20 scenes/{a,b}.toml
  [[ $output == *viscocity* && $(tail -n +2 own/own.csv | cut -d , -f 1) == b ]]
  run -2 "$own" --fast scenes/b.toml
  [[ $output == *'unknown option --fast'* ]]
}
