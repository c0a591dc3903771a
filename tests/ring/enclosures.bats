#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# Several sheets that enclose volumes, and sheets beside them that enclose none.

bats_require_minimum_version 1.5.0
setup() { cd "$BATS_TEST_TMPDIR" || exit; }

ball() { printf '[[sheet]]\nname = "%s"\nshape = "sphere"\nradius = %s\ncenter = [%s, 0, 0]\nedge_length = "40 mm"\nthickness = "2 mm"\n' "$@"; }
square='[[sheet]]
shape = "rectangle"
size = [0.1, 0.1]
center = [1, 0, 0]
edge_length = "30 mm"
thickness = "2 mm"
'
rest() { printf '[material]\nviscosity = 50\ndensity = 1200\n[environment]\npressure = {law = "gas", value = "100 Pa", exponent = 1.4%s}\n' "$1"; }
run_of() { # NAME: of NAME.toml, in the same steps, whatever enters
  sheet-init "$1.toml" -o "$1.sheet"
  sheet-loop -q -i "$1.sheet" --until 0.004 --fps 1000 -o "$1.run" -- 'sheet-emit | sheet-step --dt 0.0005'
}
pressures() { sheet-print "$1" | awk '/^array gas.pressure/ {split($3, n, "[][]"); for (i = 0; i < n[2]; ++i) {getline; printf "%s ", $1}; print ""}'; }
alike() { paste <(pressures one.run) <(pressures "$1") | awk '{d = $1 - $2; if (d < 0) d = -d; if (d > 1e-6) {print; exit 1}}'; }

@test "gas of two balls: each has its own, also one that enters" {
  { ball a 0.1 0; rest; } > one.toml
  { ball a 0.1 0; ball b 0.05 0.3; rest; } > two.toml
  { ball a 0.1 0; ball b 0.05 0.3; echo 'enters = "0.001 s"'; rest; } > enters.toml
  for name in one two enters; do run_of $name; done
  alike two.run
  alike enters.run
  [[ $(pressures two.run | tail -1 | wc -w) == 2 && $(pressures enters.run | head -1 | wc -w) == 1 && $(pressures enters.run | tail -1 | wc -w) == 2 ]]
}

@test "a ball and an open sheet: refused with the remedy, and so the open one stays where it is" {
  { ball a 0.1 0; rest; } > one.toml
  { ball a 0.1 0; printf '%s' "$square"; rest; } > open.toml
  run -3 sheet-init open.toml -o open.sheet
  [[ $output == *'each must enclose a volume of its own, but a [[sheet]] is open, at (0.95, 0, '*'let it act on another sheet only, such as pressure = {..., sheet = "balloon"}'* ]]
  { ball a 0.1 0; printf '%s' "$square"; rest ', sheet = "a"'; } > named.toml
  for name in one named; do run_of $name; done
  alike named.run
  sheet-print named.run | awk '/^array position/ {on = 1; next} /^array/ {on = 0} on && $1 > 0.9 && ($2 > 1e-12 || $2 < -1e-12) {print; bad = 1} END {exit bad}'
  run -3 sheet-init named.toml --set environment.pressure.sheet=nobody -o nobody.sheet
  [[ $output == *'there is no [[sheet]] "nobody"'* ]]
}
