#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# Inflow and tearing in the ring: the account of volume, resumed runs, valid sheets.

bats_require_minimum_version 1.5.0

setup() { cd "$BATS_TEST_TMPDIR" || exit; }

# usage: curtain [--set KEY=VALUE]...: a small curtain, 0.2 m wide, 0.25 m/s
curtain() {
  sheet-init - "$@" << 'END'
[sheet]
shape = "rectangle"
plane = "xy"
size = [0.2, 0.1]
segments = [4, 2]
pattern = "structured"
thickness = "2 mm"
velocity = [0, -0.25, 0]
[material]
viscosity = 100
density = 1000
[environment]
gravity = [0, -9.81, 0]
[inflow]
region = "y_max"
velocity = [0, -0.25, 0]
END
}

# The volume [m^3] of the last frame.
volume() { sheet-select --last "$1" | sheet-info --csv | tail -1 | cut -d, -f6; }
# usage: close A B: within 1e-12 of each other, relatively
close() { awk -v a="$1" -v b="$2" 'BEGIN {exit !(a - b < 1e-12 * b && b - a < 1e-12 * b)}'; }
# usage: row ARRAY: first row of an array at place frame, of the last frame; 0 if there is none
row() { sheet-select --last "$2" | sheet-print | awk -v name="$1" '$2 == name {getline; value = $1} END {print value + 0 ? value : 0}'; }

@test "a curtain's volume is what was there and speed x thickness x width x time" {
  curtain > start.sheet
  sheet-loop -q -i start.sheet --until 0.5 --fps 20 -o run.sheet -- 'sheet-step --dt 0.01 | sheet-emit'
  sheet-check run.sheet
  close "$(volume run.sheet)" 9e-5 # 0.2 x 0.1 x 2e-3 + 0.25 x 2e-3 x 0.2 x 0.5
  close "$(row emit.volume run.sheet)" 5e-5
  # so it is at every output time behind the first half row, 0.025 m
  sheet-info --csv run.sheet | awk -F, 'NR > 1 && $2 > 0.1 {d = $6 / (4e-5 + 1e-4 * $2) - 1; if (d > 1e-12 || d < -1e-12) exit 1}'
}

@test "stopped and resumed, the same bytes; with adaptive steps, too" {
  for step in 'sheet-step --dt 0.01' 'sheet-step --tolerance 0.01'; do
    curtain > start.sheet
    sheet-loop -q -i start.sheet --until 0.5 --fps 20 -o straight.sheet -- "sheet-emit | $step"
    sheet-loop -q -i start.sheet --until 0.25 --fps 20 -o run.sheet -- "sheet-emit | $step"
    sheet-loop -q --resume run.sheet --until 0.5 --fps 20 -- "sheet-emit | $step"
    cmp run.sheet straight.sheet
  done
}

@test "the inflow quickens and ends: what has entered is the integral of its speed" {
  curtain --set 'inflow.velocity=[[0, 0, 0, 0], [0.2, 0, -0.5, 0]]' --set sheet.velocity='[0, 0, 0]' --set inflow.until=0.4 > start.sheet
  sheet-loop -q -i start.sheet --until 0.5 --fps 20 -o run.sheet -- 'sheet-step --dt 0.013 | sheet-emit'
  sheet-check run.sheet
  close "$(row emit.volume run.sheet)" 6e-5 # (0.05 m + 0.1 m) x 2e-3 m x 0.2 m
  close "$(volume run.sheet)" 1e-4
  sheet-select --last run.sheet | sheet-print | grep -c '^array inlet' > left || true
  [[ $(cat left) == 0 ]]
}

@test "a slanted curtain, a tube" {
  curtain --set 'inflow.velocity=[0.2, -0.25, 0]' > start.sheet
  sheet-loop -q -i start.sheet --until 0.3 --fps 10 -o run.sheet -- 'sheet-step --dt 0.01 | sheet-emit'
  sheet-check run.sheet
  close "$(volume run.sheet)" 7e-5
  sheet-init - > start.sheet << 'END'
[sheet]
shape = "tube"
radius = 0.05
height = 0.1
segments = [12, 4]
pattern = "structured"
thickness = "1 mm"
velocity = [0, -0.5, 0]
[material]
viscosity = 100
density = 1000
[environment]
gravity = [0, -9.81, 0]
[inflow]
region = "y_max"
velocity = [0, -0.5, 0]
END
  sheet-loop -q -i start.sheet --until 0.3 --fps 10 -o run.sheet -- 'sheet-step --dt 0.01 | sheet-emit'
  sheet-check run.sheet
  # 0.1 m in the first frame, 0.15 m entered
  close "$(volume run.sheet)" "$(sheet-select --index 0 run.sheet | sheet-info --csv | tail -1 | awk -F, '{printf "%.17g", $6 * 2.5}')"
}

spotted() { sheet-init "$BATS_TEST_DIRNAME/thin_spots.toml" --set "tear.crumbs=$1"; }

@test "a sheet with thin spots is torn to pieces: no pinched vertex, no crumb, no intersection, and the volume is kept" {
  for crumbs in keep drop; do
    for remesh in 'sheet-pass' 'sheet-remesh --smooth'; do
      spotted $crumbs > start.sheet
      sheet-loop -q -i start.sheet --steps 48 --keep 1 -o run.sheet -- "sheet-step --dt 0.0025 | sheet-collide | $remesh | sheet-tear -q"
      sheet-check run.sheet
      "$BATS_TEST_DIRNAME/pieces.py" < run.sheet > pieces
      awk '$3 < 8 || $4 > 0 {bad = 1} END {exit bad || !($2 > 3)}' pieces # no crumbs, no triangle by itself, several pieces
      [[ $crumbs == keep ]] || awk -v d="$(row tear.volume run.sheet)" 'BEGIN {exit !(d > 0)}'
      close "$(awk -v v="$(volume run.sheet)" -v d="$(row tear.volume run.sheet)" 'BEGIN {printf "%.17g", v + d}')" \
        "$(volume start.sheet)"
    done
  done
}

@test "tearing makes no triangles intersect" {
  spotted keep > start.sheet
  sheet-loop -q -i start.sheet --steps 16 --keep 1 -o run.sheet -- 'sheet-step --dt 0.0025 | sheet-tear'
  sheet-step --dt 0.0025 run.sheet > stepped.sheet
  sheet-tear stepped.sheet > torn.sheet
  sheet-check stepped.sheet > before || true
  sheet-check torn.sheet > after || true
  awk '$1 != "frame" {next} NR == FNR {found[$2] = $6; next} $6 > found[$2] {exit 1}' before after
  [[ $(sheet-print stepped.sheet | grep -c '^vertices') == 17 ]]
  run ! cmp -s stepped.sheet torn.sheet
}

@test "outflow from a crumpled curtain makes no intersections" {
  gunzip -c "$BATS_TEST_DIRNAME/crumpled_curtain.sheet.gz" > before.sheet
  sheet-check before.sheet
  sheet-emit before.sheet -o after.sheet
  sheet-check after.sheet
  volume() { sheet-print "$1" | awk '/^array volume/ {on = 1; next} /^array/ {on = 0} on {sum += $1} /^array outflow.volume/ {getline; sum += $1} /^array emit.volume/ {getline; sum -= $1} END {printf "%.9g\n", sum}'; }
  [[ $(volume before.sheet) == "$(volume after.sheet)" ]]
  left() { sheet-print "$1" | sed -n '/^array outflow.volume /{n;p}'; }
  [[ $(left before.sheet) != "$(left after.sheet)" ]]
}

@test "triangles know which sheet they are of, through new meshes, steps and sheets that enter; pictures tell them apart" {
  cd "$BATS_TEST_TMPDIR" || exit
  for i in 1 2 3; do
    printf '[[sheet]]\nname = "disk %s"\nshape = "disk"\nradius = 0.0%s\nedge_length = 0.02\nthickness = 0.004\n' $i $((i + 2))
    printf 'center = [0, 0.0%s, 0]\n%s\n' $((3 * i)) "$([[ $i != 3 ]] || echo 'enters = 0.02')"
  done > disks.toml
  printf '[material]\nviscosity = 100\ndensity = 1000\n[environment]\ngravity = [0, -9.81, 0]\n[contact]\nself = true\n' >> disks.toml
  sheet-init disks.toml | sheet-loop --until 0.05 --fps 50 -o run.sheet -- \
    'sheet-remesh --edge-length 0.012 | sheet-emit | sheet-step --dt 0.01 | sheet-collide'
  PYTHONPATH=$BATS_TEST_DIRNAME/../../formats/python /usr/bin/python3 -c '
import sys, numpy as np, sheetstream
first, *_, frame = sheetstream.Reader(sys.stdin.buffer)
def volumes(frame):
    return [frame["volume"].ravel()[frame["sheet"].ravel() == i].sum() for i in range(4)]
before, after = volumes(first), volumes(frame)
assert np.allclose(before[:2], after[:2], rtol=1e-9) and before[2] == 0 < after[2] and after[3] == 0, after
of = frame["sheet"].ravel()
height = [frame["position"][frame["triangle"][of == i].ravel()][:, 1].mean() for i in range(3)]
assert height[0] < height[1] < height[2], height
' < run.sheet
  sheet-render run.sheet --frames -1 --look sheet --size 320x180 --samples 2 -o told.png
  { head -8 disks.toml; sed -n '/^.material/,$p' disks.toml; } | sheet-init - -o one.sheet
  run -3 sheet-render one.sheet --look sheet --size 32x18 -o one.png
  [[ $output == *'array "sheet"'*'where the scene has several'* ]]
}
