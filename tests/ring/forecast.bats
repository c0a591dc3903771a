#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# What sheet-init --check says of a run before it, against the run: within a factor of three.

bats_require_minimum_version 1.5.0

setup() {
  scenes=$BATS_TEST_DIRNAME/../everyday
  cd "$BATS_TEST_TMPDIR"
}

# usage: of_ring NAME: what foretell has left
of_ring() { sed -n "s/^$1 //p" ring.txt; }

# usage: foretell SCENE OPTION...: sets frames, megabytes and steps, and leaves the ring in ring.txt. --check says the same.
foretell() {
  sheet-init --ring "${@:2}" "$1" > ring.txt
  frames=$(of_ring frames) megabytes=$(of_ring megabytes) steps=$(of_ring steps)
  local words
  words=$(sheet-init --check "${@:2}" "$1" | grep '^  To expect: ')
  [[ $words =~ ([0-9]+)\ frames,\ about\ ([0-9.]+)\ MB\;\ about\ ([0-9]+)\ steps,\ ([0-9.]+)\ s\ of\ computing ]]
  awk -v f="$frames" -v m="$megabytes" -v n="$steps" -v s="$(of_ring seconds)" -v told="${BASH_REMATCH[*]:1}" '
    function far(a, b, most) { return a > b * (1 + most) || b > a * (1 + most) }
    BEGIN { split(told, t, " "); exit f != t[1] || far(m, t[2], 0.06) || far(n, t[3], 0.06) || far(s, t[4], 0.5) }'
}

# usage: run_ring: what foretell left, to run.sheet
run_ring() {
  eval "$(of_ring first) -q -o first.sheet"
  sheet-loop -q -i first.sheet -o run.sheet --until "$(of_ring until)" --fps "$(of_ring fps)" -- "$(of_ring stages)"
}

# usage: alike WHAT FORETOLD SEEN
alike() {
  awk -v what="$1" -v a="$2" -v b="$3" 'BEGIN {printf "%s: foretold %s, seen %s\n", what, a, b; exit !(a < 3 * b && b < 3 * a)}'
}

@test "megabytes a frame, of each everyday scene" {
  for scene in "$scenes"/*.toml; do
    foretell "$scene" --until 0.02 --fps 50
    [[ $frames == 2 ]]
    run_ring
    alike "$scene" "$(awk -v m="$megabytes" 'BEGIN {print m / 2}')" \
      "$(sheet-select --last run.sheet | wc -c | awk '{print $1 / 1e6}')"
    rm run.sheet
  done
}

@test "frames, steps and megabytes of everyday scenes that are quick" {
  for name in honey-drop honey-spoon honey-roller batter-tray glass-pear waffle-iron slime-fork pancake-flip; do
    foretell "$scenes/$name.toml" --until "$(sed -n '1s/^# until //p' "$scenes/$name.toml")"
    run_ring
    [[ $(sheet-info --csv run.sheet | tail -n +2 | wc -l) == "$frames" ]]
    alike "$name, MB" "$megabytes" "$(wc -c < run.sheet | awk '{print $1 / 1e6}')"
    alike "$name, steps" "$steps" "$(sheet-info --csv run.sheet | awk -F , '
      NR == 1 {for (i = 1; i <= NF; i++) if ($i == "step") at = i} {last = $at} END {print last}')"
    rm run.sheet
  done
}

@test "vertices that flow in count until their inflow ends, and until they leave; finer steps are more" {
  scene=$scenes/curtain-belt.toml
  at() { foretell "$scene" --until 2 "$@"; }
  at
  long=$megabytes all=$steps
  at --set inflow.until=0.2
  awk -v a="$long" -v b="$megabytes" 'BEGIN {exit !(b < a / 2)}'
  [[ $steps -lt $all ]]
  at --set 'outflow.0.point=[0.03, 0, 0]' --set 'outflow.0.normal=[1, 0, 0]'
  awk -v a="$long" -v b="$megabytes" 'BEGIN {exit !(b < a / 2)}'
  at --quality fine
  [[ $steps -gt $((2 * all)) ]]
}
