#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# pipelines/design: the thickness from which another one comes out.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_DIRNAME/../.." || exit
  t=$BATS_TEST_TMPDIR
  cp pipelines/designing/dome/* "$t"
}

# usage: measured FIELD < FRAME: what sheet-info says of it
measured() { sheet-info --json | python3 -c "import json, sys; print(json.load(sys.stdin)[-1]['measurements']$1)"; }

@test "an even wall comes out of a blown dome, and the same command goes on" {
  sed -i 's/^edge_length.*/edge_length = "3 mm"/' "$t/scene.toml"
  run -0 --separate-stderr pipelines/design "$t/design.toml" -o "$t/out"
  [[ $output == *"thickness = {radial = [[0, 0.00"* && -s $t/out/design.png ]]
  before=$output
  # The scene with the thickness that was found, run by hand.
  found=$(sed -n 's/^thickness = //p' "$t/out/design.txt")
  for thickness in "" "--set=sheet.thickness=$found"; do
    sheet-init "$t/scene.toml" ${thickness:+"$thickness"} |
      sheet-loop -q --until 20 --keep last -- 'sheet-remesh --smooth | sheet-step' > "$t/end.sheet"
    measured "['thickness_p']['95']" < "$t/end.sheet"
    measured "['thickness_p']['5']" < "$t/end.sheet"
  done > "$t/ends"
  # even: 95 % of the area over 5 %
  paste -sd ' ' "$t/ends" | awk '{ print; exit !($1 / $2 > 1.25 && $3 / $4 < 1.1 && $3 < 1.06e-3 && $4 > 0.94e-3) }'
  find "$t/out" -name 'run-*' -exec stat -c '%n %Y %Z' {} + | sort > "$t/before"
  run -0 --separate-stderr pipelines/design "$t/design.toml" -o "$t/out"
  [[ $output == "$before" ]]
  find "$t/out" -name 'run-*' -exec stat -c '%n %Y %Z' {} + | sort | cmp - "$t/before"
}

@test "an even wall comes out of a pane that sticks to its mould" {
  pipelines/meshes dish-mould.off
  run -0 --separate-stderr pipelines/design pipelines/designing/dish/design.toml -o "$t/out"
  [[ ${lines[0]} == "run 1: 3."*" to 4."*"; rows within 15 %" ]]
  python3 -c "
import json
found = json.load(open('$t/out/design.json'))
assert found['found'] and found['runs'] <= 3 and 4.6e-3 < found['thickness'][0] < 4.8e-3, found"
}

@test "what is not reached is said" {
  sed -i 's/^edge_length.*/edge_length = "4 mm"/' "$t/scene.toml"
  printf 'within = 0.001\nruns = 1\n' >> "$t/design.toml"
  run -1 --separate-stderr pipelines/design "$t/design.toml" -o "$t/out"
  [[ $output == *"not within 0.1 %; the best is"* ]]
}

@test "places are those of the sheet before it was turned and put in its place" {
  printf '%s\n' '[sheet]' 'shape = "rectangle"' 'size = [2, 1]' 'edge_length = 0.2' 'plane = "yz"' 'center = [1, 2, 3]' \
    'rotation = {axis = [1, 2, 3], angle = "40 deg"}' 'thickness = 0.1' '[material]' 'viscosity = 1' 'density = 1' > "$t/turned.toml"
  for rows in '{along="z",rows=[[-0.5,0.1],[0,0.3],[0.5,0.2]]}' '{along="y",rows=[[-1,0.1],[1,0.3]]}' \
    '{radial=[[0,0.1],[1,0.3]]}'; do
    sheet-init "$t/turned.toml" --set "sheet.thickness=$rows" > "$t/turned.sheet"
    PYTHONPATH=pipelines:formats/python /usr/bin/python3 - "$t/turned.sheet" << 'END'
import sys
import numpy, sheetstream
from designing.profile import Outcome, Profile, mark
frame = sheetstream.Run(sys.argv[1])[0]
profile = Profile.of(frame.scene(), "scene")
mark(frame)
outcome = Outcome.of(frame, profile)
places = profile.place_of(frame.scene(), frame["position"][frame["triangle"]].mean(axis=1))
assert numpy.abs(numpy.interp(places, profile.places, profile.thickness) - frame.thickness()).max() < 1e-12
assert numpy.abs(outcome.thickness - frame.thickness()).max() < 1e-15
assert 0.1 < outcome.rows.min() and outcome.rows.max() < 0.3
END
  done
}

@test "what is wrong is told, with its place" {
  wrong() { # SED-COMMAND FILE MESSAGE
    cp pipelines/designing/dome/* "$t"
    sed -i "$1" "$t/$2"
    run -3 pipelines/design "$t/design.toml" -o "$t/wrong"
    [[ $output == *"$3"* ]] || { echo "$output"; return 1; }
  }
  wrong 's/^until.*//' design.toml 'until when?'
  wrong 's/^ring.*//' design.toml 'missing key "ring"'
  wrong 's/^fps/fbs/' design.toml 'unknown key "fbs"; known: scene'
  wrong 's/"1 mm"/"1 kg"/' design.toml 'target: expected a length such as "1 mm", or rows'
  wrong 's/"1 mm"/[[0, 1], [0, 2]]/' design.toml 'target: expected a length such as "1 mm", or rows'
  wrong 's/scene.toml/scenes.toml/' design.toml 'scenes.toml'
  wrong '/^thickness/,/^  /d; s/^edge_length.*/&\nthickness = "1 mm"/' scene.toml 'the scene takes one [sheet] whose thickness has the rows'
  wrong 's/"4 mm", /"0.01 mm", "1.5 mm"], ["0.02 mm", /' scene.toml 'no part of the sheet starts around the row at'
}
