#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# A sheet whose vertices and triangles come in another order, or that is mirrored, does the same on a solid.

bats_require_minimum_version 1.5.0
# DT STEPS: plain.sheet, permuted.sheet, mirrored.sheet: a patch with edges of 2 cm falls on a ball.
runs() {
  cd "$BATS_TEST_TMPDIR" || exit
  /usr/bin/python3 "$BATS_TEST_DIRNAME/other_order.py" make "$BATS_TEST_DIRNAME/patch.obj"
  for name in plain permuted mirrored; do
    [ $name = mirrored ] && x=-0.013 || x=0.013
    printf '[sheet]\nshape = "mesh"\nfile = "%s.obj"\nthickness = "2 mm"\n[material]\nviscosity = 20\ndensity = 1200\nsurface_tension = 0.05\n[environment]\ngravity = [0, -9.81, 0]\n[[solid]]\nshape = "sphere"\nradius = 0.04\ncenter = [%s, -0.047, 0.007]\n[contact]\nself = true\n' $name $x > $name.toml
    sheet-init $name.toml -o first.sheet
    sheet-loop -q -i first.sheet --steps "$2" --keep 1 -o $name.sheet -- "sheet-step --dt $1 | sheet-collide"
  done
}

@test "until many vertices touch, but for round-off" {
  runs 0.01 7
  /usr/bin/python3 "$BATS_TEST_DIRNAME/other_order.py" compare 1e-8
}

# That is a hundredth of an edge at most (docs/model.md), 1e-3 of the patch.
@test "ten steps, within what the stopping rule of Newton's iterations leaves" {
  runs 0.01 10
  /usr/bin/python3 "$BATS_TEST_DIRNAME/other_order.py" compare 1e-3
}

@test "impulses on triangles, in a step of 0.1 s" {
  runs 0.1 1
  /usr/bin/python3 "$BATS_TEST_DIRNAME/other_order.py" compare 1e-6
}
