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

# A ball, or a cap held at its rim, that gas blows up until it tears.
burst() { # SHAPE HOLD
  printf '[sheet]\n%s\nedge_length = "6 mm"\nthickness = "1 mm"\n[material]\nviscosity = "50 Pa*s"\ndensity = 1400\nsurface_tension = 0.08\n[environment]\npressure = {law = "gas", value = "3 kPa", more_volume = "2 l"}\n%s\n[tear]\nbelow = "0.7 mm"\n' "$1" "$2"
}
dome=$'shape = "cap"\nradius = "30 mm"\nangle = "70 deg"' ball=$'shape = "sphere"\nradius = "20 mm"'
held=$'[[hold]]\nregion = "rim"'
# What is enclosed and what has escaped is the same in all frames but the first, which tells none.
sum_of_gas() {
  sheet-info --csv "$1" | awk -F, 'NR == 1 {for (i = 1; i <= NF; ++i) at[$i] = i}
    NR > 2 {sum = $at["gas_amount"] + $at["gas_escaped"]; if (NR == 3) first = sum; d = sum - first; if (d > 1e-13 * first || d < -1e-13 * first) exit 1}'
}
last_of() { sheet-info --csv "$1" | awk -F, -v name="$2" 'NR == 1 {for (i = 1; i <= NF; ++i) if ($i == name) k = i} {v = $k} END {print v}'; }

@test "a balloon and a dome burst: the runs end, the gas is gone, and where and when is told" {
  burst "$ball" "" > ball.toml
  burst "$dome" "$held" > dome.toml
  for name in ball dome; do
    sheet-init $name.toml -o $name.sheet
    sheet-loop -q -i $name.sheet --until 0.15 --fps 100 -o $name.run -- 'sheet-remesh --smooth | sheet-tear | sheet-step'
    awk -v p="$(last_of $name.run gas_pressure)" -v e="$(last_of $name.run gas_escaped)" 'BEGIN {exit !(p == 0 && e > 0)}'
    sum_of_gas $name.run
    sheet-info --health $name.run | grep -q 'gas escapes: gas has left .* through holes of up to .* at (.*) m, t = '
  done
}

@test "gas: what is not open loses none, whatever rims it has" {
  burst "$dome" "" | sed '/^\[tear\]/,$d' > free.toml # free when the scene starts: the cap closes it
  burst "$dome" "$held" | sed '/^\[tear\]/,$d' > held.toml
  for name in free held; do
    sheet-init $name.toml -o $name.sheet
    sheet-loop -q -i $name.sheet --until 0.02 --fps 100 -o $name.run -- 'sheet-remesh --smooth | sheet-step'
    [[ $(last_of $name.run gas_escaped) == 0 ]]
  done
}

@test "gas: a dome that is let go loses it, and set down it keeps what is left" {
  { burst "$dome" "$held" | sed '/^\[tear\]/,$d'; printf 'until = "0.01 s"\n[[solid]]\nshape = "plane"\nnormal = [0, 1, 0]\ncenter = [0, "5 mm", 0]\n'; } |
    sed 's/value = "3 kPa", more_volume = "2 l"/value = "20 Pa"/; s/^\[environment\]/&\ngravity = [0, -9.81, 0]/; s/"50 Pa/"500 Pa/' > down.toml
  sheet-init down.toml -o down.sheet
  sheet-loop -q -i down.sheet --until 0.2 --fps 50 -o down.run -- 'sheet-remesh --smooth | sheet-step | sheet-collide'
  sum_of_gas down.run
  # In free fall it has no pressure; on the plane, from 0.06 s on, the gas bears a weight of 20.5 Pa, or a part of it, and
  # the tension, 4 gamma/r = 10.7 Pa at most.
  sheet-info --csv down.run | awk -F, 'NR == 1 {for (i = 1; i <= NF; ++i) at[$i] = i}
    NR > 1 {p = $at["gas_pressure"]; e = $at["gas_escaped"]} NR == 4 && !(p < 1 && e > 0) || NR == 5 && !(lost = e) || NR > 5 && e != lost {bad = 1}
    END {exit bad || !(p > 10 && p < 31.2)}'
}
