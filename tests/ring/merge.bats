#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# Layers that become one.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
  ring='sheet-remesh --smooth | sheet-step --tolerance 0.01 | sheet-collide'
}

# usage: disks THICKNESS EDGE [X,Y]...: disks of that thickness and edge length, in mm, with their centers there
disks() {
  local thickness=$1 edge=$2 center i=0
  shift 2
  for center; do
    ((++i))
    cat << END
[[sheet]]
name = "s$i"
shape = "disk"
radius = "50 mm"
edge_length = "$edge mm"
thickness = "$thickness mm"
plane = "xz"
center = ["${center%,*} mm", "${center#*,} mm", 0]
END
  done
  cat << END
[material]
viscosity = "10 Pa*s"
density = "1000 kg/m^3"
[environment]
gravity = [0, "-9.81 m/s^2", 0]
[[solid]]
shape = "plane"
normal = [0, 1, 0]
contact = "flow"
[contact]
self = true
END
}

# usage: merging AFTER: a [merge] table for the scene on standard input
merging() {
  cat
  printf '[merge]\nafter = "%s"\n' "$1"
}

# usage: run_ring NAME UNTIL RING
run_ring() {
  sheet-init "$1.toml" | sheet-loop -q --until "$2" --fps 5 -o "$1.sheet" -- "$3"
  sheet-check "$1.sheet"
}

# usage: last NAME COLUMN
last() { sheet-info --csv "$1.sheet" | awk -F, -v column="$2" 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i } END { print $at[column] }'; }

spread() { /usr/bin/python3 "$BATS_TEST_DIRNAME/spread.py" "$1.sheet" | cut -d ' ' -f 3; }

# usage: near A B PART
near() { awk -v a="$1" -v b="$2" -v part="$3" 'BEGIN { print a, b, a / b > "/dev/stderr"; d = a / b - 1; exit !(d < part && d > -part) }'; }

@test "two disks that become one spread as one, in as few steps" {
  disks 4 5 0,2 > one.toml
  disks 2 5 0,1 0,3 | merging '0.3 s' > two.toml
  run_ring one 8 "$ring"
  run_ring two 8 "sheet-merge | $ring"
  near "$(spread two)" "$(spread one)" 0.01
  near "$(last two volume)" "$(last one volume)" 1e-14
  echo "steps $(last two step)"
  (($(last two step) <= 60))
}

@test "four disks that become one spread as one, in as few steps" {
  disks 8 5 0,4 > one.toml
  disks 2 5 0,1 0,3 0,5 0,7 | merging '0.1 s' > four.toml
  run_ring one 8 "$ring"
  run_ring four 8 "sheet-merge | $ring"
  near "$(spread four)" "$(spread one)" 0.015
  echo "steps $(last four step), triangles $(last four triangles)"
  (($(last four step) <= 60 && $(last four triangles) < $(last one triangles) + 100))
}

@test "of two disks that overlap by half little is left in two layers, and what stays is welded" {
  disks 2 5 0,1 50,3 | merging '0.3 s' > half.toml
  run_ring half 4 "sheet-merge | $ring"
  /usr/bin/python3 "$BATS_TEST_DIRNAME/two_layers.py" half.sheet | awk '{ print > "/dev/stderr"; exit !($1 > 0.2 && $2 < 0.15) }'
  sheet-select --last half.sheet | sheet-print | grep -A 100000 contact_since | grep -q '^-inf$'
}

@test "a pile of ten layers is one in the end" {
  disks 5 3 0,2.5 > one.toml
  disks 0.5 3 0,0.25 0,0.75 0,1.25 0,1.75 0,2.25 0,2.75 0,3.25 0,3.75 0,4.25 0,4.75 | merging '0.1 s' > pile.toml
  run_ring one 0.6 "$ring"
  run_ring pile 0.6 "sheet-merge | $ring" # the last two after 0.45 s
  echo "triangles $(last pile triangles), of one $(last one triangles)"
  (($(last pile triangles) < 3000))
}

@test "layers that would become one later are as they are without" {
  disks 2 8 0,1 0,3 > never.toml
  disks 2 8 0,1 0,3 | merging '1000 s' > late.toml
  run_ring never 1 "$ring"
  run_ring late 1 "sheet-merge | $ring"
  sheet-print never.sheet | grep -v '^|' > never.txt # scene and provenance are text
  sheet-print late.sheet | awk '/^(array|frame|end)/ { dates = /contact_since/ } !dates && !/^\|/' > late.txt
  cmp never.txt late.txt
}

@test "runs that merge are the same for any number of threads, and resumed" {
  disks 2 6 0,1 30,3 | merging '0.1 s' > part.toml
  sheet-init part.toml -o first.sheet
  for threads in 1 2 3 7; do
    sheet-loop -q -i first.sheet --until 0.6 --fps 10 -o run$threads.sheet -- "sheet-merge --threads $threads | sheet-remesh --smooth --threads $threads | sheet-step --threads $threads | sheet-collide --threads $threads"
    cmp run1.sheet run$threads.sheet
  done
  sheet-print run1.sheet | grep -q merge.volume
  sheet-loop -q -i first.sheet --until 0.2 --fps 10 -o half.sheet -- "sheet-merge | sheet-remesh --smooth | sheet-step | sheet-collide"
  sheet-loop -q --resume half.sheet --until 0.6 --fps 10 -- "sheet-merge | sheet-remesh --smooth | sheet-step | sheet-collide"
  cmp run1.sheet half.sheet
}

@test "a strip of two that have become one where they overlap is pulled as one that is thicker there" {
  for name in a b; do
    cat << END
[[sheet]]
name = "$name"
shape = "rectangle"
size = ["60 mm", "20 mm"]
edge_length = "4 mm"
thickness = "2 mm"
plane = "xy"
center = ["$([[ $name == a ]] && echo 30 || echo 70) mm", 0, "$([[ $name == a ]] && echo 0 || echo 2) mm"]
END
  done > lap.toml
  cat >> lap.toml << 'END'
[material]
viscosity = "100 Pa*s"
[model]
inertia = false
forces = true
[[hold]]
sheet = "a"
region = "x_min"
kind = "pinned"
axes = "xz"
[[hold]]
sheet = "b"
region = "x_max"
kind = "pinned"
axes = "xz"
motion = {kind = "translating", velocity = ["30 mm/s", 0, 0]}
[contact]
self = true
[merge]
after = "0.02 s"
END
  sheet-init lap.toml | sheet-loop -q --until 1 --fps 10 -o lap.sheet -- "sheet-merge | $ring"
  sheet-check lap.sheet
  /usr/bin/python3 "$BATS_TEST_DIRNAME/lap_joint.py" lap.sheet
}
