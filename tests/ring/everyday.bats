#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# tests/bench/everyday, on scenes that are quick, and not to their end: a row for each, of all columns, and what is wrong.

bats_require_minimum_version 1.5.0

setup() {
  SHEET_BIN=$(dirname "$(command -v sheet-step)")
  export SHEET_BIN
  everyday=$BATS_TEST_DIRNAME/../bench/everyday
}

# usage: column NAME, of the second line of the table
column() {
  awk -F '\t' -v name="$1" 'NR == 1 {for (i = 1; i <= NF; i++) at[$i] = i} NR == 2 {print $at[name]}' table
}

@test "scenes that are fine: a row each, in which time, speed and thickness are theirs" {
  cd "$BATS_TEST_TMPDIR"
  "$everyday" --until 0.1 --out . honey-drop honey-spoon > table
  [[ $(wc -l < table) == 3 && $(awk -F '\t' '{print NF}' table | sort -u) == 13 ]]
  [[ $(column scene) == honey-drop && $(column time) == 0.1 && $(column check) == valid && $(column verdict) == ok ]]
  # It fell from 30 mm to half its thickness: sqrt(25/35) of a fall from its upper side, less what the last frames before
  # it lands miss.
  awk -v s="$(column speed)" -v a="$(column angle)" -v h="$(column thinnest)" \
    'BEGIN {exit !(s > 0.6 && s < 1 && a > 10 && a <= 60 && h > 7 && h < 10)}'
}

@test "a scene that is not done in time, and one that does too many steps, are said to be wrong" {
  cd "$BATS_TEST_TMPDIR"
  run -1 --separate-stderr "$everyday" --limit 0.5 --out . disk-sphere
  echo "$output" > table
  [[ $(column verdict) == "not at its end: 0.5 s" ]]
  run -1 --separate-stderr "$everyday" --until 0.1 --fps 9000 --out . honey-drop # each frame ends a step
  echo "$output" > table
  [[ $(column verdict) == "many steps" ]]
}
