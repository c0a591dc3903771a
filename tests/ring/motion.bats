#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# Solids and holds that move as the rows of a file say.

bats_require_minimum_version 1.5.0
rows() { /usr/bin/python3 "$BATS_TEST_DIRNAME/keyframes.py" "$@"; }

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
  cat > sheet.toml << 'END'
[sheet]
shape = "rectangle"
size = [1, 1]
edge_length = 0.1
thickness = "10 mm"
[material]
viscosity = 80
density = 1300
END
}

@test "a spoon led by a file: the stream needs the file no more, resumed is straight, nothing intersects" {
  mkdir scenes
  rows spoon > scenes/spoon.csv
  cat sheet.toml - > scenes/spoon.toml << 'END'
[environment]
gravity = [0, -9.81, 0]
[[hold]]
region = "rim"
[[solid]]
shape = "capsule"
radius = "40 mm"
length = "0.3 m"
motion = {kind = "keyframed", file = "spoon.csv"}
END
  sheet-init scenes/spoon.toml -o start.sheet
  rm -r scenes
  ring='sheet-remesh | sheet-step | sheet-collide'
  sheet-loop -q -i start.sheet --until 0.25 --fps 24 -o straight.sheet -- "$ring"
  sheet-loop -q -i start.sheet --until 0.125 --fps 24 -o run.sheet -- "$ring"
  sheet-loop -q --resume run.sheet --until 0.25 --fps 24 -- "$ring"
  cmp run.sheet straight.sheet
  sheet-check run.sheet
  sheet-print run.sheet > run.txt
  grep -q '^array touch' run.txt
}

@test "rows of a steady turn do what the turn does" {
  disk=('--set' 'sheet.shape=disk' '--set' 'sheet.radius=0.5')
  sed -i '/^size/d' sheet.toml
  hold='[[hold]]\nregion = {sphere = {center = [0, 0, 0], radius = 0.2}}\nkind = "clamped"\n'
  rows turn 4 0.1 > turn.csv
  { cat sheet.toml; printf "%b" "$hold"; echo 'motion = {kind = "rotating", axis = [0, 1, 0], rate = 4}'; } > closed.toml
  { cat sheet.toml; printf "%b" "$hold"; echo 'motion = {kind = "keyframed", file = "turn.csv"}'; } > rows.toml
  for name in closed rows; do
    sheet-init $name.toml "${disk[@]}" |
      sheet-loop -q --until 0.0875 --fps 80 -o $name.sheet -- 'sheet-step --dt 0.0125'
  done
  sheet-diff --abs 1e-10 --rel 1e-9 --ignore scene closed.sheet rows.sheet
  sheet-select --last closed.sheet -o end.sheet
  run -1 sheet-diff --abs 1e-3 --array position=1e-3 end.sheet <(sheet-select --index 0 closed.sheet)
  [[ $output == *position* ]] # it has moved
}

@test "a sheet and a solid under it, moved together by one file, stay as they are" {
  rows spoon > both.csv
  cat sheet.toml - > both.toml << 'END'
[model]
inertia = false
[[hold]]
region = "rim"
motion = {kind = "keyframed", file = "both.csv"}
[[solid]]
shape = "box"
size = [0.3, 0.1, 0.3]
center = [0, "-56 mm", 0]
rotation = {axis = [0, 1, 0], angle = "20 deg"}
motion = {kind = "keyframed", file = "both.csv"}
END
  sheet-init both.toml | sheet-loop -q --until 0.5 --fps 24 -o both.sheet -- 'sheet-step | sheet-collide'
  worst=$(rows rigid both.sheet both.csv)
  echo "$worst"
  [[ $(awk -v w="$worst" 'BEGIN {print (w > 0 && w < 1e-7)}') == 1 ]]
}
