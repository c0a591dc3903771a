#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# sheet-loop --set: a scene changed within a run.

bats_require_minimum_version 1.5.0
ring='sheet-step --dt 0.005'

setup_file() {
  cd "$BATS_FILE_TMPDIR" || exit
  cat > scene.toml << 'END'
[sheet]
shape = "rectangle"
size = [1, 1]
segments = [4, 4]
thickness = "10 mm"
[material]
viscosity = 100
density = 1000
[environment]
gravity = [0, -9.81, 0]
[[hold]]
region = "x_min"
[[solid]]
shape = "sphere"
radius = 0.1
center = [0, -5, 0]
motion = {kind = "translating", velocity = [0, 0.5, 0]}
END
  sheet-init scene.toml | sheet-loop -q --fps 50 --until 0.04 -o begun.sheet -- "$ring"
  cp begun.sheet straight.sheet
  sheet-loop -q --resume straight.sheet --set 'material.viscosity=50 Pa*s' --set 'hold.0.until=70 ms' --fps 50 --until 0.1 -- "$ring"
}

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
  cp "$BATS_FILE_TMPDIR"/* .
}

provenance_of() { sheet-print "$1" | sed -n '/^array provenance/,/^array/s/^| //p'; }

@test "it is the same as the scene's text changed by hand, and frames before and after tell their scenes" {
  sheet-select --last begun.sheet | sheet-print | sed 's/^| viscosity = 100$/| viscosity = 50/
    s/^| kind = "pinned"$/&\n| until = 0.07/' | sheet-parse | sheet-loop -q --fps 50 --until 0.1 -o by-hand.sheet -- "$ring"
  sheet-select --index 3- straight.sheet -o after.sheet
  sheet-select --index 1- by-hand.sheet -o after-by-hand.sheet
  sheet-diff --ignore provenance after.sheet after-by-hand.sheet
  [[ $(sheet-print straight.sheet | grep -c '^| viscosity = 100$') == 3 ]]
  [[ $(sheet-print straight.sheet | grep -c '^| viscosity = 50$') == 3 ]]
  sheet-loop -q --resume begun.sheet --fps 50 --until 0.1 -- "$ring"
  sheet-select --index 3- begun.sheet -o unchanged.sheet
  run -1 sheet-diff -q --ignore provenance --ignore scene after.sheet unchanged.sheet # it makes a difference
}

@test "the provenance says what was changed, and when; sheet-info prints it" {
  sheet-select --last straight.sheet -o end.sheet
  sheet-info end.sheet | grep -F -- "--set 'material.viscosity=50 Pa*s'"
  provenance_of end.sheet > lines
  grep -q -- "--set 'material.viscosity=50 Pa\*s'.* # from step 8, t = 0.04 s$" lines
  [[ $(grep -c -- ' --set ' lines) == 1 ]]
}

@test "interrupted and gone on with, by the same command or without --set, it is the straight run" {
  change=(--set 'material.viscosity=50 Pa*s' --set 'hold.0.until=70 ms')
  cp begun.sheet again.sheet
  sheet-loop -q --resume again.sheet "${change[@]}" --fps 50 --until 0.08 -- "$ring"
  cp again.sheet run.sheet
  sheet-loop -q --resume run.sheet --fps 50 --until 0.1 -- "$ring"
  cmp run.sheet straight.sheet
  sheet-loop -q --resume again.sheet "${change[@]}" --fps 50 --until 0.1 -- "$ring"
  cmp again.sheet straight.sheet
}

@test "a checkpoint behind a change goes on, too" {
  cp begun.sheet run.sheet
  change=(--set 'material.viscosity=50 Pa*s' --set 'hold.0.until=70 ms' --checkpoint newest.sheet --checkpoint-every 0.0001)
  cp run.sheet straight.sheet
  accident=true sheet-loop -q --resume straight.sheet "${change[@]:0:4}" --fps 50 --until 0.1 -- "$ring | accident_at 10"
  run -1 sheet-loop -q --resume run.sheet "${change[@]}" --fps 50 --until 0.1 -- "$ring | accident_at 10"
  accident=true sheet-loop -q --resume run.sheet --checkpoint newest.sheet --fps 50 --until 0.1 -- "$ring | accident_at 10"
  cmp run.sheet straight.sheet
}

@test "what makes no sense is refused, and the stream stays as it is" {
  refused() { # CODE WORDS OPTION...
    local code=$1 words=$2
    shift 2
    run "-$code" sheet-loop --resume begun.sheet "$@" --fps 50 --until 0.1 -- "$ring"
    [[ $output == *"$words"* ]]
    cmp begun.sheet "$BATS_FILE_TMPDIR/begun.sheet"
  }
  refused 2 '[sheet] is how the run began' --set sheet.thickness=0.02
  refused 2 'the holds are those that the run began with' --set hold.1.region=x_max
  refused 2 'hold 0: its region chose' --set hold.0.region=x_max
  refused 2 'solid 0: its shape stays' --set solid.0.radius=0.2
  refused 2 'solid 0 would jump from [0, -4.98, 0] to [0, -4.96, 0]' --set 'solid.0.motion.velocity=[0, 1, 0]'
  refused 2 'the inlet is the one' --set 'inflow={region = "x_max", velocity = [1, 0, 0]}'
  refused 3 'viscosity must not be negative' --set material.viscosity=-1
  refused 3 'did you mean "viscosity"' --set material.viscocity=1
  refused 2 'expected KEY=VALUE' --set material
  run -2 sheet-loop --resume begun.sheet --set material.viscosity=1 --until 0.04 --fps 50 -- "$ring"
  [[ $output == *'the run is at its end'* ]]
  sheet-select --index 0 begun.sheet -o first.sheet
  run -2 sheet-loop -i first.sheet --set material.viscosity=1 --steps 3 -o run.sheet -- "$ring"
  [[ $output == *'give --set to sheet-init'* ]]
  [[ ! -s run.sheet ]]
  sheet-loop -q --resume begun.sheet --set 'solid.0.motion.velocity=[[0.04, 0, 0.5, 0], [0.05, 0, 0, 0]]' --fps 50 --until 0.1 -- "$ring"
}

@test "from a stream to another one, the first frame has the new scene already" {
  sheet-loop -q -i begun.sheet --set material.viscosity=50 --steps 9 -o on.sheet -- "$ring"
  [[ $(sheet-print on.sheet | grep -c '^| viscosity = 50$') == 2 ]]
}
