#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# Scenes as users write them: too much of something, something left out, something that cannot be.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
  cat > disk.toml << 'END'
[sheet]
shape = "disk"
radius = 1
edge_length = 0.4
thickness = 0.01
[material]
viscosity = 100
density = 1000
END
}

@test "1: more holds than a frame has bits for are refused, by every program" {
  cp disk.toml many.toml
  for _ in $(seq 65); do
    printf '[[hold]]\nregion = "rim"\n' >> many.toml
  done
  run -3 sheet-init many.toml -o many.sheet
  [[ $output == *"hold: 65 tables [[hold]]; a scene may have 64"* ]]
  run -3 sheet-init --check many.toml
  sheet-init disk.toml | sheet-print | grep -v '^| ' | sed '/^array scene /r '<(sed 's/^/| /' many.toml) |
    sheet-parse > many.sheet
  run -3 sheet-collide many.sheet -o out.sheet
  run -3 sheet-step --dt 0.01 many.sheet -o out.sheet
}

@test "1: a scene may have any number of solids: the last of 131 does what it does alone" {
  { cat disk.toml; printf '[environment]\ngravity = [0, 0, -9.81]\n[tear]\nbelow = 1e-6\n[contact]\nadhesion = "1 Pa"\n'; } > alone.toml
  cp alone.toml many.toml
  for i in $(seq 130); do
    printf '[[solid]]\nshape = "sphere"\ncenter = [9, 0, %d]\nradius = 0.1\n' "$i" >> many.toml
  done
  for scene in alone many; do
    printf '[[solid]]\nshape = "plane"\ncenter = [0, 0, -0.01]\nnormal = [0, 0, 1]\nsurface_velocity = [0.5, 0, 0]\n' >> $scene.toml
    sheet-init $scene.toml | sheet-loop -q --steps 20 --keep 1 -o $scene.sheet -- \
      'sheet-remesh --edge-length 0.3 | sheet-tear | sheet-step --dt 5e-3 | sheet-collide'
    sheet-select --last $scene.sheet | sheet-print > $scene.txt
    sheet-render $scene.sheet --frames -1 --look contacts --ppm --size 64x36 --samples 2 --eye 0,0,5 > $scene.ppm
  done
  sheet-diff --ignore touch --ignore scene --ignore provenance alone.sheet many.sheet
  grep -q '^array touch vertex uint64 1 ' alone.txt
  grep -q '^array touch vertex uint64 3 ' many.txt
  [[ $(sed -n '/^array touch /,/^array /p' many.txt | grep -c '^0 0 4$') -gt 9 ]]
  cmp alone.ppm many.ppm
  # bits of solids that the scene does not have hold nothing
  sheet-print many.sheet | sed 's/^0 0 4$/0 0 8/' | sheet-parse | sheet-select --last > wrong.sheet
  sheet-step --dt 5e-3 wrong.sheet | sheet-collide -q -o out.sheet
}

@test "3: what a hold has let go is remeshed like what nothing ever held" {
  remeshed() { # SCENE: a second after its start, with edges twice as long
    sheet-init "$1" --set sheet.edge_length=0.1 | sheet-print | sed 's/^time 0$/time 1/' | sheet-parse |
      sheet-remesh --edge-length 0.2
  }
  remeshed disk.toml > free.sheet
  { cat disk.toml; printf '[[hold]]\nregion = "rim"\naxes = "z"\nuntil = 0.5\n[[hold]]\nregion = "rim"\nuntil = 2\n'; } > holds.toml
  remeshed holds.toml > held.sheet
  sed '/^until = 2/s/2/1/' holds.toml > released.toml
  remeshed released.toml > released.sheet
  sheet-diff --ignore hold --ignore scene --ignore provenance free.sheet released.sheet
  run -1 sheet-diff --ignore hold --ignore scene --ignore provenance free.sheet held.sheet
  sheet-print held.sheet | sed -n '/^array hold /,/^array /p' | grep '^[0-9]*$' | sort -u | tr '\n' ' ' > bits
  [[ $(cat bits) == '0 2 ' ]]
}

@test "4: a bath carries what is under its surface and does not pull what is above it" {
  { cat disk.toml; printf '[environment]\ngravity = [0, 0, -9.81]\nbath = {density = 2000, level = -0.05}\n'; } > raft.toml
  after() { # SECONDS KEY=VALUE...: the mean height
    sheet-init raft.toml "${@:2}" | sheet-loop -q --until "$1" --keep last -- sheet-step | sheet-print |
      awk '/^array position /{n = 1; next} /^array /{n = 0} n{sum += $3; ++m} END{printf "%.5f\n", sum / m}'
  }
  [[ $(after 0.01) == -0.00049 ]] # it falls
  below() { awk -v a="$1" -v b="$2" 'BEGIN{exit !(a < b)}'; }
  below "$(after 0.01 --set environment.bath.clings=true)" -0.004
  # Under the surface it rises by its lift less its weight, as much as that, with what the bath resists.
  [[ $(after 0.01 --set environment.bath.level=0.05) == 0.00048 ]]
  sheet-init --check raft.toml | grep -q 'bath .* which carries what is under its surface'
}

@test "4: pictures show the bath" {
  { cat disk.toml; printf '[environment]\ngravity = [0, 0, -9.81]\nbath = {density = 2000, level = -0.2}\n'; } > raft.toml
  sheet-init raft.toml | sheet-render --size 64x36 --samples 8 --ppm > bath.ppm
  grep -v bath raft.toml > ground.toml
  sheet-init ground.toml | sheet-render --size 64x36 --samples 8 --ppm > ground.ppm
  colour() { # of the lower left corner: blue less red
    /usr/bin/python3 -c 'import sys; b = open(sys.argv[1], "rb").read()[-64 * 3:]; print(b[2] - b[0] > 20)' "$1"
  }
  [[ $(colour bath.ppm) == True && $(colour ground.ppm) == False ]]
}

box_mesh() { # SIZE: a cube as OBJ
  awk -v s="$1" 'BEGIN{for (i = 0; i < 8; ++i) print "v", s * (i % 2), s * (int(i / 2) % 2), s * int(i / 4)
    print "f 1 3 4\nf 1 4 2\nf 5 6 8\nf 5 8 7\nf 1 2 6\nf 1 6 5\nf 3 7 8\nf 3 8 4\nf 1 5 7\nf 1 7 3\nf 2 4 8\nf 2 8 6"}'
}

@test "16: a field of too many voxels is refused with their number" {
  box_mesh 0.1 > box.obj
  { cat disk.toml; printf '[contact]\n[[solid]]\nshape = "mesh"\nfile = "box.obj"\ncenter = [0, 0, -1]\nvoxel_size = "5 um"\n'; } > box.toml
  sheet-init disk.toml | sheet-step --dt 1e-3 | sheet-print | grep -v '^| ' |
    sed '/^array scene /r '<(sed 's/^/| /' box.toml) | sheet-parse > box.sheet
  run -3 timeout 20 sheet-collide box.sheet -o out.sheet
  [[ $output == *'solid 0 (box.obj): voxel_size = 5e-06 m makes a field of 2.9e+10 voxels, more than 1e+07'* ]]
  sheet-print box.sheet | sed 's/5 um/5 mm/' | sheet-parse | sheet-collide -o out.sheet
}

@test "17: a solid, a mesh or a picture that is a pipe or a device is refused by every program at once" {
  mkfifo fifo.obj fifo.vdb fifo.png
  ln -s /dev/zero zero.obj
  for file in fifo.obj fifo.vdb zero.obj; do
    { cat disk.toml; printf '[contact]\n[[solid]]\nshape = "mesh"\nfile = "%s"\n' $file; } > solid.toml
    run -3 timeout 20 sheet-init solid.toml
    sheet-init disk.toml | sheet-step --dt 1e-3 | sheet-print | grep -v '^| ' |
      sed '/^array scene /r '<(sed 's/^/| /' solid.toml) | sheet-parse > solid.sheet
    run -6 timeout 20 sheet-collide solid.sheet -o out.sheet
    [[ $output == *"$file: it is not a file but a "* ]]
    [[ $file == *.vdb ]] || run -6 timeout 20 sheet-render solid.sheet -o out.png --size 32x18 --samples 2
    [[ $output == *"$file: it is not a file but a "* ]]
  done
  run -6 timeout 20 sheet-render solid.sheet --environment fifo.png -o out.png --size 32x18 --samples 2
  printf '[sheet]\nshape = "mesh"\nfile = "fifo.obj"\nthickness = 1\n[material]\nviscosity = 1\ndensity = 1\n' > mesh.toml
  run -3 timeout 20 sheet-init mesh.toml
}

@test "6: sheet-loop says before the first step what the scene wants and no stage does" {
  cat disk.toml - > all.toml << 'END'
[contact]
[tear]
below = 0.001
[[solid]]
shape = "sphere"
radius = 1
center = [0, 0, -5]
[inflow]
region = "rim"
velocity = [0, -1, 0]
thickness = 0.01
END
  sheet-init all.toml -o all.sheet
  run -0 --separate-stderr sheet-loop -i all.sheet --steps 0 -o out.sheet -- 'sheet-step --dt 0.01'
  [[ $stderr == *'without sheet-tear [tear] parts nothing'*'without sheet-emit [inflow] lets nothing in'* ]]
  [[ $stderr == *'without sheet-collide the sheet passes through every [[solid]] and itself'* ]]
  ring='sheet-remesh --smooth | sheet-tear | sheet-emit | sheet-step | sheet-collide'
  [[ $stderr == *"the ring of this scene: '$ring'"* ]]
  mkdir mine
  ln -s "$(command -v sheet-pass)" mine/sheet-tear
  for pipeline in "$ring" 'sheet-emit | mine/sheet-tear | sheet-step --dt 1 | sheet-collide' cat; do
    run -0 --separate-stderr sheet-loop -i all.sheet --steps 0 -o out.sheet -- "$pipeline"
    [[ $stderr != *without* ]]
  done
  sheet-init disk.toml | sheet-loop --steps 0 -- sheet-step 2> log > out.sheet
  [[ ! -s log ]]
}

@test "7: --check refuses what sheet-init or a stage refuses" {
  fall='[environment]
gravity = [0, 0, -9.81]'
  refused() { # MESSAGE TABLES
    { cat disk.toml; printf '%s\n' "$fall" "$2"; } > scene.toml
    run -3 timeout 60 sheet-init --check scene.toml
    [[ $output == *"$1"* ]]
  }
  refused 'no vertex lies in its region: the nearest one, at (' $'[[hold]]\nregion = {sphere = {center = [9, 9, 9], radius = 1}}'
  box_mesh 0.1 | sed '$d' > open.obj
  refused 'solid 0 (open.obj)' $'[[solid]]\nshape = "mesh"\nfile = "open.obj"\ncenter = [0, 0, -1]'
  box_mesh 0.1 > box.obj
  refused 'voxels' $'[[solid]]\nshape = "mesh"\nfile = "box.obj"\ncenter = [0, 0, -1]\nvoxel_size = "1 um"'
  refused 'the sheet starts inside solid 0 (sphere)' $'[[solid]]\nshape = "sphere"\nradius = 0.5'
  refused 'move one of them' $'[[solid]]\nshape = "plane"\ncenter = [0, 0, 1]'
  [[ $output != *'is gravity'* ]]
  fall=${fall/-9.81/9.81}
  refused 'is gravity meant to pull towards -z?' $'[[solid]]\nshape = "plane"\ncenter = [0, 0, -1]'
  fall=${fall/9.81/-9.81}
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 3 4\n' > turned.obj
  sed 's/^shape.*/shape = "mesh"\nfile = "turned.obj"/; /^radius/d; /^edge_length/d' disk.toml > turned.toml
  for check in '' --check; do
    run -3 sheet-init $check turned.toml -o turned.sheet
    [[ $output == *'triangles 0 and 1 run along it in the same direction'*'turn the faces the same way'* ]]
    [ ! -e turned.sheet ]
  done
  { printf '[[sheet]]\nshape = "disk"\nradius = 1\nedge_length = 0.5\nthickness = 0.01\ncenter = [0, 0, 3]\n[[sheet]]\n'
    sed 1d turned.toml; } > second.toml # the fault has the numbers of its own file
  run -3 sheet-init second.toml -o turned.sheet
  [[ $output == *'turned.obj: edge (1, 2): triangles 0 and 1 run along it'* ]]
  # A Moebius strip of eight triangles: no turning of faces helps.
  awk 'BEGIN { n = 4; for (i = 0; i < n; ++i) { a = 6.2831853 * i / n
      for (s = -0.3; s < 0.4; s += 0.6) print "v", (1 + s * cos(a / 2)) * cos(a), s * sin(a / 2), (1 + s * cos(a / 2)) * sin(a) }
    for (i = 0; i < n; ++i) { a = 2 * i + 1; c = i < n - 1 ? a + 2 : 2; d = i < n - 1 ? a + 3 : 1
      print "f", a, a + 1, d; print "f", a, d, c } }' > strip.obj
  sed 's/turned.obj/strip.obj/' turned.toml > strip.toml
  run -3 sheet-init strip.toml -o turned.sheet
  [[ $output == *'strip.obj: edge (0, 1): triangles 0 and 7 '*'one side only'*'cut it open'*'(counted from 0)'* ]]
  # A ball smaller than a triangle, under whose corners it is not.
  refused 'the sheet starts across solid 0 (sphere): triangle ' $'[[solid]]\nshape = "sphere"\nradius = "2 mm"\ncenter = [0.013, 0.017, 0.001]'
  run -3 sheet-init scene.toml -o across.sheet
  [[ $output == *'the sheet starts across solid 0 (sphere): triangle '*' m under its surface'* ]]
  printf 'v -1 -1 0\nv 1 -1 0\nv 0 1 0\nv 0 0 -1\nv 0 0 1\nv 0 3 1\nf 1 2 3\nf 4 5 6\n' > crossing.obj
  sed 's/^shape.*/shape = "mesh"\nfile = "crossing.obj"/; /^radius/d; /^edge_length/d' disk.toml > crossing.toml
  printf '[contact]\nself = true\n' >> crossing.toml
  for check in '' --check; do
    run -3 sheet-init $check crossing.toml -o crossing.sheet
    [[ $output == *'triangles 0 and 1'* ]]
  done
  refused 'points out of the sheet' $'[inflow]\nregion = "rim"\nthickness = 0.01\nvelocity = [1, 0, 0]'
  sed -i 's/^thickness/center = [1e300, 0, 0]\nthickness/' disk.toml
  run -3 sheet-init disk.toml
  run -3 sheet-init --check disk.toml
}

@test "7: --check finds what stays in its plane, and its ring lets it fold" {
  cat > upright.toml << 'END'
[sheet]
shape = "rectangle"
size = ["60 mm", "20 mm"]
edge_length = "5 mm"
plane = "xz"
center = [0, 0, "60 mm"]
thickness = "3 mm"
[material]
viscosity = 5
density = 1300
[environment]
gravity = [0, 0, -9.81]
[[inflow]]
region = "z_max"
velocity = [0, 0, "-0.15 m/s"]
thickness = "3 mm"
[[solid]]
shape = "box"
size = ["100 mm", "40 mm", "20 mm"]
center = [0, "18 mm", 0]
END
  sheet-init --check upright.toml > text
  grep -q "all is symmetric about the sheet's plane" text
  grep -qF -- "--set 'sheet.perturbation={amplitude = \"30 um\", seed = 1}' -o first.sheet" text
  eval "$(grep -o 'sheet-init .*' text)"
  sheet-print first.sheet | grep -q 'amplitude = 3e-05'
  # told where a ring begins by hand, too, and not once it is mended
  sheet-init upright.toml -o hand.sheet 2> text
  grep -qF -- "Let it begin: --set 'sheet.perturbation={amplitude = \"30 um\", seed = 1}'" text
  eval "sheet-init upright.toml $(grep -o -- "--set '.*'" text) -o hand.sheet" 2> text
  [ ! -s text ]
  # what moves aside, or meets an edge off its middle is not symmetric
  for set in 'sheet.velocity=[0, "1 mm/s", 0]' 'solid.center=[0, "20.5 mm", 0]' \
    'solid.surface_velocity=[0, 0.1, 0]' 'inflow.velocity=[0, 0.01, -0.1]' \
    'sheet.perturbation={amplitude = "1 um", seed = 1}'; do
    sheet-init --check upright.toml --set "$set" > text
    run -1 grep 'all is symmetric' text
  done
}

@test "7: --check asks about liquid that sticks where it would run, and about what folds through itself" {
  cat > pour.toml << 'END'
[sheet]
shape = "rectangle"
size = ["60 mm", "20 mm"]
edge_length = "5 mm"
plane = "xz"
center = [0, 0, "60 mm"]
thickness = "3 mm"
velocity = [0, 0, "-0.15 m/s"]
[material]
viscosity = 5
density = 1300
[environment]
gravity = [0, 0, -9.81]
[[inflow]]
region = "z_max"
velocity = [0, 0, "-0.15 m/s"]
[[solid]]
shape = "plane"
normal = [0, 0, 1]
[contact]
END
  warnings() { sheet-init --check "$@" | sed -n '/^Warnings/,/^$/p' | tr '\n' ' '; }
  asks='does liquid stay where it touches solid 0 (plane)? contact = "stick" holds it there, though'
  folds='lands on solid 0 (plane) and folds or piles up, but may pass through itself: [contact] self = true'
  run warnings pour.toml
  [[ $output == *"$asks what flows in would spread on it by about "*'contact = "flow" lets it'* && $output != *'pass through'* ]]
  for set in 'solid.contact="flow"' 'solid.surface_velocity=[0.1, 0, 0]' material.viscosity=1e7; do # nothing to ask
    run warnings pour.toml --set "$set"
    [[ $output != *'does liquid stay'* ]]
  done
  run warnings pour.toml --set contact.self=false
  [[ $output == *"what flows in $folds"* ]]
  run warnings pour.toml --set contact.self=false --set 'solid.surface_velocity=[2, 0, 0]' # which draws it away
  [[ $output != *'pass through'* ]]

  # sheets that fall, without inflow: the upright one folds, the level one does not
  sed '/^.*inflow/,/^velocity/d; /^.contact/d' pour.toml > fall.toml
  run warnings fall.toml
  [[ $output == *"the upright sheet $folds"* && $output != *'does liquid stay'* ]]
  run warnings fall.toml --set 'sheet.plane="xy"'
  [[ $output != *'pass through'* && $output != *'does liquid stay'* ]]
  # one that comes down over a ball and beyond, and two of them
  { sed 's/^plane = .*/plane = "xy"/' fall.toml; printf '[[solid]]\nshape = "sphere"\nradius = 0.01\n'; } > over.toml
  run warnings over.toml
  [[ $output == *'the sheet comes down over solid 1 (sphere) and beyond, where it may fold and pass through itself: [contact] self = true'* ]]
  run warnings over.toml --set contact.self=true
  [[ $output != *'pass through'* ]]
  sed 's/^.sheet./[[sheet]]/; s/^plane = .*/plane = "xy"/' fall.toml > two.toml
  printf '[[sheet]]\nshape = "disk"\nradius = 0.02\nedge_length = 0.005\nthickness = 0.002\ncenter = [0, 0, 0.2]\nplane = "xy"\n' >> two.toml
  run warnings two.toml
  [[ $output == *'the sheets may pass through each other and themselves: [contact] self = true keeps them apart'* ]]
  slope=(--set 'sheet.plane="xy"' --set 'solid.normal=[1, 0, 1.7]' --until 2)
  run warnings fall.toml "${slope[@]}" # 8 mm, less than three thicknesses
  [[ $output != *'does liquid stay'* ]]
  run warnings fall.toml "${slope[@]}" --set 'sheet.thickness="6 mm"' # 1300 * 9.81 * 0.507 * 36e-6 / 15 * 2
  [[ $output == *"$asks down its slope a layer as thick as the sheet would run about 0.03 m within 2 s"* ]]
  run warnings fall.toml "${slope[@]}" --set 'sheet.thickness="6 mm"' --set 'solid.contact="flow"'
  [[ $output != *'does liquid stay'* ]]
}

@test "7: --check proposes times that the scene needs" {
  proposes() { # UNTIL FPS SET...
    sheet-init --check disk.toml "${@:3}" | grep -q -- "--until $1 --fps $2 --"
  }
  cat >> disk.toml << 'END'
[environment]
gravity = [0, 0, -9.81]
[[solid]]
shape = "plane"
normal = [0, 0, 1]
center = [0, 0, -5]
motion = {kind = "translating", velocity = [[0, 0, 0, 0], [8, 0, 0, 0.01], [9, 0, 0, 0]]}
END
  proposes 9.9 24 # what moves comes to rest
  proposes 5.7 24 --set solid.motion='{kind = "fixed"}' # four times the fall, and five times of the flow
  proposes 5200 0.01 --set solid.motion='{kind = "fixed"}' --set material.viscosity=1e7
  # 50 to 250 frames, at the rate of films where that gives so many
  proposes 0.05 1000 --until 0.05
  proposes 1 50 --until 1
  proposes 2.1 24 --until 2.1
  proposes 10.4 24 --until 10.4
  proposes 11 5 --until 11
  proposes 30 2 --until 30
  proposes 120 2 --until 120 # as the solid moves within the first 9 s
  proposes 120 0.5 --until 120 --set solid.motion='{kind = "fixed"}'
}

@test "7: the ring that --check proposes follows faces that cool long before the middle" {
  proposes_modes() { # SET...
    sheet-init --check crust.toml "$@" | grep -q -- '--set heat.profile=3 -o first.sheet'
  }
  { cat disk.toml; printf '[heat]\nspecific_heat = 1000\nconductivity = 1\ntemperature = 1400\nambient = 300\ntransfer = 1000\n'; } > crust.toml
  proposes_modes
  run -1 proposes_modes --set heat.transfer=10
  run -1 proposes_modes --set heat.profile=4
  { sheet-init --ring crust.toml | grep first; } | grep -q -- '--set heat.profile=3'
}

@test "7: --check judges sheets by what they are and by what drives them" {
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n' > mesh.obj
  printf '[sheet]\nshape = "mesh"\nfile = "mesh.obj"\nthickness = 0.01\n[material]\nviscosity = 100\ndensity = 1000\n' > mesh.toml
  printf '[environment]\ngravity = [0, 0, -9.81]\n' >> mesh.toml
  sheet-init --check mesh.toml > text
  run -1 grep 'nothing drives' text
  grep -q 'V .* speed: the fastest drive: gravity' text
  # glass that falls into a mould
  { cat disk.toml; printf '[environment]\ngravity = [0, 0, -9.81]\n[[solid]]\nshape = "plane"\nnormal = [0, 0, 1]\ncenter = [0, 0, -1]\n'; } > glass.toml
  sheet-init --check glass.toml --set material.viscosity=1e9 > text
  run -1 grep 'inertia = false gives the same motion' text
  grep -q '^Left out: what sticks to a solid does not spread on it; ' text
  # what floats is not driven by its weight
  { cat disk.toml; printf '[environment]\ngravity = [0, 0, -9.81]\nbath = {density = 2000}\n[[hold]]\nregion = "rim"\n'
    printf 'motion = {kind = "translating", velocity = ["1 mm/s", 0, 0]}\n'; } > raft.toml
  sheet-init --check raft.toml | grep -q 'V *0.001 m/s *speed: the fastest drive: a moving hold'
}

@test "7: --check prints a ring that runs" {
  { cat disk.toml; printf '[environment]\ngravity = [0, 0, -9.81]\n[contact]\n[[solid]]\nshape = "plane"\nnormal = [0, 0, 1]\n'
    printf 'center = [0, 0, -1]\n[tear]\nbelow = 1e-5\n'; } > "a b.toml"
  sheet-init --check "a b.toml" --set 'material.viscosity=50 Pa*s' > text
  sed -n '/^The ring to run/,$p' text | grep '^  sheet-' | head -2 | sed 's/--until [0-9.]*/--until 0.02/' > ring
  [[ $(wc -l < ring) == 2 && $(cat ring) == *"-- 'sheet-remesh --smooth | sheet-tear | sheet-step | sheet-collide'"* ]]
  bash -e ring 2> log
  run -1 grep without log
  sheet-check run.sheet
  sheet-print run.sheet | grep -q 'viscosity = 50'
}

@test "25: a scene by segments is remeshed with its own edges, also after an interruption" {
  printf '[sheet]\nshape = "rectangle"\nsize = [1, 1]\nsegments = [8, 8]\nthickness = 0.01\n[material]\nviscosity = 100\ndensity = 1000\n[environment]\ngravity = [0, 0, -9.81]\n[[hold]]\nregion = "x_min"\n' > segments.toml
  sheet-init segments.toml -o first.sheet
  ring='sheet-remesh --smooth | sheet-step --dt 0.01'
  sheet-loop -q -i first.sheet --steps 40 --keep 20 -o once.sheet -- "$ring"
  sheet-loop -q -i first.sheet --steps 20 --keep 20 -o twice.sheet -- "$ring"
  sheet-loop -q --resume twice.sheet --steps 40 --keep 20 -- "$ring"
  cmp once.sheet twice.sheet
  [[ $(sheet-select --last once.sheet | sheet-info --json | /usr/bin/python3 -c 'import json, sys; print(json.load(sys.stdin)[0]["triangles"] != 128)') == True ]]
}

@test "25: --set adds a first solid, and the next one" {
  sheet-init disk.toml --set solid.0.shape=plane --set solid.0.center='[0, 0, -1]' --set solid.1.shape=sphere \
    --set solid.1.radius=0.1 --set solid.1.center='[0, 0, -5]' | sheet-print > text
  [[ $(grep -c '^| \[\[solid\]\]' text) == 2 ]]
  run -3 sheet-init disk.toml --set solid.1.shape=plane
  run -2 sheet-init disk.toml --set solid.0.shape=plane --set solid.2.shape=plane
}

@test "25: a solid's mesh is found from elsewhere, and one that has changed is told" {
  mkdir -p project/scenes/meshes project/out else/meshes
  box_mesh 0.1 > project/scenes/meshes/box.obj
  { cat disk.toml; printf '[[solid]]\nshape = "mesh"\nfile = "meshes/box.obj"\ncenter = [0, 0, -1]\n'; } > project/scenes/box.toml
  (cd project && sheet-init scenes/box.toml | sheet-step --dt 1e-3 -o out/box.sheet)
  collided() { (cd "$1" && sheet-collide "$BATS_TEST_TMPDIR/project/out/box.sheet" -o out.sheet); }
  local folder
  for folder in project project/scenes project/out project/scenes/meshes; do
    collided $folder
    (cd $folder && sheet-render out.sheet -o out.png --size 32x18 --samples 2 -q)
  done
  collided else # it is found from the stream
  astray() { (cd else && sheet-collide box.sheet -o out.sheet); }
  cp project/out/box.sheet else/
  run -6 astray
  [[ $output == *'there is no such file'* ]]
  box_mesh 0.11 > else/meshes/box.obj # has the name and is another
  run -3 astray
  [[ $output == *'meshes/box.obj: it has changed since sheet-init ran'* ]]
  cp else/meshes/box.obj project/scenes/meshes/
  run -3 collided project
  cd project
  run -3 sheet-render out/box.sheet -o out.png --size 32x18 --samples 2
  cd ..
  # a scene that says which file it means
  echo 'checksum = "0123456789abcdef"' >> project/scenes/box.toml
  run -3 sheet-init project/scenes/box.toml
  [[ $output == *'checksum: "project/scenes/meshes/box.obj" has '* ]]
}

@test "25: a pipeline's --help says what it does and does nothing" {
  for run in "$SHEET_SOURCE"/pipelines/*/run; do
    OUT=$PWD/out run -0 timeout 10 "$run" --help
    [[ $output == *"pipelines/"*"/run"* && $output != *"set -"* && ! -e out ]]
  done
}

@test "a pipeline refuses arguments that are too many, and lengths that are none, before it runs anything" {
  export OUT=$PWD/out
  mapfile -t scripts < <(cd "$SHEET_SOURCE" && grep -lr 'common.sh"' pipelines --include=* | grep -v '^pipelines/own/')
  ((${#scripts[@]} > 40))
  for script in "${scripts[@]}"; do
    run -2 timeout 10 "$SHEET_SOURCE/$script" 1 1 1 1 1 1
    [[ $output == "$script: argument 1 is one too many: ["*"] (see --help)" && ! -e out ]]
    grep -qF "$script [EDGE" "$SHEET_SOURCE/$script" || continue
    for edge in 0 -0.1 x '5 mm' 1e 0x1; do
      run -2 timeout 10 "$SHEET_SOURCE/$script" "$edge"
      [[ $output == "$script: EDGE: $edge is not a number above 0 (see --help)" && ! -e out ]]
    done
  done
  run -2 timeout 10 "$SHEET_SOURCE/pipelines/bursting/run" 0.1 x 3 -- --engine plain
  [[ $output == "pipelines/bursting/run: UNTIL: x is not a number above 0"* ]]
}

@test "scripts for runs tell how they are called, and what is wrong, without a traceback" {
  cd "$SHEET_SOURCE"
  for script in account folds height-map mid-span radius reckon meshes quickstart gallery film sweep fit design own/run \
    speed-error speed-error-page speed-error-plots speed-error-split; do
    run -0 timeout 10 "pipelines/$script" --help
    [[ $output == *pipelines/* ]]
    [[ $script != @(sweep|fit|design|film) ]] || continue
    code=0
    timeout 10 "pipelines/$script" nonesuch nonesuch '' &> "$BATS_TEST_TMPDIR/log" < /dev/null || code=$?
    [[ $code == [26] ]]
    grep -q "^pipelines/$script: \|--quick" "$BATS_TEST_TMPDIR/log"
    ! grep -q 'Traceback\|line [0-9]*:' "$BATS_TEST_TMPDIR/log"
  done
  for script in tests/install tests/run packaging/make packaging/try; do
    run -0 timeout 10 "$script" --help
    [[ $output == *"$script "* ]]
  done
  run -2 timeout 10 tests/install --alll
  run -2 timeout 10 packaging/make --nonsense
  run -6 pipelines/account none.sheet
  [[ $output == 'pipelines/account: none.sheet: No such file or directory' ]]
  run -4 pipelines/account README.md
  [[ $output == 'pipelines/account: README.md: frame 0, byte 0: not a sheet stream'* ]]
  run -2 pipelines/folds none.sheet low a.csv b.csv
  [[ $output == 'pipelines/folds: BELT: low is not a number' ]]
  run -2 pipelines/reckon '1 / e' e=0
  [[ $output == 'pipelines/reckon: 1 / e with e=0: '*'division by zero' ]]
  run -2 pipelines/reckon e=x
  [[ $output == 'pipelines/reckon: e=x: x is not a number' ]]
  run -2 pipelines/own/run --until
  [[ $output == 'pipelines/own/run: --until needs a value'* ]]
  OUT=$BATS_TEST_TMPDIR/own run -2 pipelines/own/run tests/everyday/more/stir.toml a/stir.toml
  [[ $output == 'pipelines/own/run: two scenes are called stir,'* ]]
}

@test "25: a run goes on with another scene as sheet-print's help says" {
  sheet-init disk.toml -o run.sheet
  sheet-print --help | tr -s ' \n' ' ' | grep -q "viscosity = 50/' | sheet-parse > b.sheet another scene, to go on with"
  sheet-print run.sheet | sed 's/viscosity = 100/viscosity = 50/' | sheet-parse > on.sheet
  sheet-step --dt 0.01 on.sheet | sheet-print | grep -q '^| viscosity = 50$'
  sheet-step --help | tr -s ' \n' ' ' | grep -q 'better choice unless steps must be equal'
}

@test "a [[hold]] that drives the sheet into a solid ends the run, with vertex, hold, solid and time" {
  { cat disk.toml; printf '[[hold]]\nregion = "rim"\n[[solid]]\nshape = "sphere"\nradius = 0.2\ncenter = [-1.3, 0, 0]\nmotion = {kind = "translating", velocity = [1, 0, 0]}'; } > driven.toml
  sheet-init driven.toml -o driven.sheet
  for dt in 0.01 0.002; do
    run -3 sheet-loop -i driven.sheet --until 0.2 -o driven.run -- "sheet-step --dt $dt | sheet-collide"
    [[ $output == *'at t = 0.1'*' s, vertex '*', which [[hold]] number 0 (from 0) holds, is '*' m inside '*'sphere'*': end that hold before (until), or lead it or the solid another way'* ]]
  done
}

@test "hinges cannot clamp, and say so" {
  { cat disk.toml; printf '[[hold]]\nregion = "rim"\nkind = "clamped"\n'; } > clamped.toml
  sheet-init clamped.toml -o clamped.sheet
  for kind in hinge hinge-paper; do
    run -2 sheet-step --dt 0.01 --bending $kind clamped.sheet
    [[ $output == *'[[hold]] number 0 (from 0) clamps; take --bending mid-edge, or kind = "pinned"'* ]]
  done
}

@test "25: sheet-collide's warnings say whether to worry and what to do" {
  warned() { # TABLES: a step of the disk with them
    { cat disk.toml; printf '[contact]\n%s\n' "$1"; } > warned.toml
    run -0 --separate-stderr bash -c 'sheet-init warned.toml | sheet-step --dt 0.05 | sheet-collide -o out.sheet'
    echo "$stderr"
  }
  down='motion = {kind = "translating", velocity = [0, 0, -1]}'
  awk 'BEGIN{for (k = 0; k < 2; ++k) { for (i = 0; i < 4; ++i) print "v", i % 2, int(i / 2), k * 0.0101
    print "f", 1 + 4 * k, 2 + 4 * k, 4 + 4 * k; print "f", 1 + 4 * k, 4 + 4 * k, 3 + 4 * k } }' > layers.obj
  sed -i 's/^shape.*/shape = "mesh"\nfile = "layers.obj"/; /^radius/d; /^edge_length/d' disk.toml
  warned "$(printf '[[hold]]\nregion = {box = [[-1, -1, -1], [2, 2, 1]]}\n%s\n[[solid]]\nshape = "sphere"\nradius = 0.1\ncenter = [0.6, 0.4, -0.12]' "$down")"
  [[ $stderr == *'triangles come too close to solids; if that comes back step after step, take shorter steps'* ]]
  warned "$(printf '[[hold]]\nregion = {box = [[-1, -1, -0.001], [2, 2, 0.001]]}\n[[hold]]\nregion = {box = [[-1, -1, 0.009], [2, 2, 0.02]]}\n%s' "$down")"
  [[ $stderr == *'stay behind'*'; if that comes back step after step, '*'too little room'* ]]
}

# usage: square_scene: scene.toml, a sheet of mesh.obj.
square_scene() {
  cat > scene.toml << 'END'
[sheet]
shape = "mesh"
file = "mesh.obj"
thickness = 0.01
[material]
viscosity = 100
density = 1000
END
}

@test "--check warns of seams that are not welded, of pieces, and of needles; a good mesh has none of it" {
  square_scene
  warnings() { sheet-init --check scene.toml | sed -n '/^Warnings/,/^$/p'; }
  printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n' > mesh.obj
  run warnings
  [[ $output != *weld* && $output != *needle* ]]
  for ulp in 1 1.0000000000000002; do
    printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv %s 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\n' $ulp > mesh.obj
    run warnings
    [[ $output == *"2 edges of the sheet's border lie on each other, the first at (0.5, 0.5, 0) m"*'weld'* ]]
  done
  printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 5 0 0\nv 6 1 0\nv 5 1 0\nf 1 2 3\nf 4 5 6\n' > mesh.obj
  run warnings
  [[ $output == *"the sheet's mesh has 2 pieces that nothing joins"* ]]
  printf 'v 0 0 0\nv 1 0 0\nv 1 0.05 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n' > mesh.obj
  run warnings
  [[ $output == *"1 of the sheet's triangles are needles, the sharpest with 2.9 degrees, number 0 at (0, 0, 0) m"* ]]
}

@test "a mesh a thousand times too large is told its scale, also where it is in the way" {
  square_scene
  printf 'v -500 0 -500\nv 500 0 -500\nv 0 0 500\nf 1 3 2\n' > mesh.obj
  run -0 sheet-init --check scene.toml
  [[ $output == *'if its mesh is in millimetres, give [sheet] scale = 0.001'* ]]
  printf '[[solid]]\nshape = "sphere"\nradius = 1\n' >> scene.toml
  run -3 sheet-init --check scene.toml
  [[ $output == *'the sheet is 1.41e+03 m long: if its mesh is in millimetres, give it scale = 0.001'* ]]
  printf 'v 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 100\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' > solid.obj
  sed -i 's/^shape = "mesh"/&\nscale = 0.001\ncenter = [10, 10, 10]/; s/^shape = "sphere"/shape = "mesh"\nfile = "solid.obj"/; s/^radius.*//' scene.toml
  run -3 sheet-init --check scene.toml
  [[ $output == *'(solid.obj) is 173 m long: if its mesh is in millimetres, give it scale = 0.001'* ]]
  printf 'center = [20, 20, 20]\n' >> scene.toml
  run -0 sheet-init --check scene.toml
  [[ $output == *'Warnings'*'(solid.obj) is 173 m long: if its mesh is in millimetres, give it scale = 0.001'* ]]
}

@test "rows between which a rate or a velocity changes beyond all numbers are named" {
  sheet-init --example | sed '/^\[\[solid/,$d' > scene.toml
  for row in 'kind = "rotating", axis = [0, 1, 0], rate = [[0, 0], [1e-320, 1]]' \
    'kind = "translating", velocity = [[0, 0, 0, 0], [1, 1e308, 0, 0], [2, -1e308, 0, 0]]'; do
    printf '[[solid]]\nshape = "sphere"\nradius = 0.1\ncenter = [0, -1, 0]\nmotion = {%s}\n' "$row" | cat scene.toml - > moved.toml
    run -3 sheet-init moved.toml
    [[ $output == *"moved.toml:$(wc -l < moved.toml):"*'from the row before it changes so much'*'beyond the range of numbers'* ]]
  done
}

@test "--check proposes the ring that --until and --fps ask for, and ends before pressure has blown the sheet up" {
  proposed() { sheet-init --ring "$@" | tr '\n' ' '; }
  sheet-init --example > scene.toml
  [[ $(proposed --until 0.123456789 --fps 30 scene.toml) == *'until 0.123456789 fps 30 '* ]]
  sheet-init --check --until 0.7 scene.toml | grep -q -- '--until 0.7 --fps '
  run -2 sheet-init --check --until 0 scene.toml
  run -2 sheet-init --fps 3 scene.toml
  balloon=$SHEET_SOURCE/pipelines/balloon/scene.toml
  [[ $(proposed "$balloon") == *'until 0.36 '* ]] # of 4 mu h / (p r) = 0.4 s
  sheet-init --check "$balloon" | grep -q 'blows the sheet up, to any size, within about 0.4 s: end before, at 0.36 s'
  [[ $(proposed --until 0.39 "$balloon") == *'until 0.39 '* ]]
  law='environment.pressure={law = "inverse_square", value = 0.1, reference_radius = 1}'
  sheet-init --check --set "$law" "$balloon" | grep -q 'within about 1.2 s'
  tube=(--set 'sheet.shape=tube' --set 'sheet.height=1') # 2 mu h / (p r)
  [[ $(proposed "${tube[@]}" "$balloon") == *'until 0.18 '* ]]
  # what tension holds together is not blown up
  run -0 sheet-init --check --set material.surface_tension=0.03 "$balloon"
  [[ $output != *'blows the sheet up'* ]]
}

@test "what is mended in the meshes of two sheets is told once each, with --check too" {
  printf 'v 0 0 0\nv 0.1 0 0\nv 0.1 0.1 0\nv 0 0.1 0\nv 5 5 5\nf 1 2 3\nf 1 3 4\n' > lone.obj
  printf '[[sheet]]\nshape = "mesh"\nfile = "lone.obj"\ncenter = [%s, 0, 0]\nthickness = "2 mm"\n' 0 1 > two.toml
  printf '[material]\nviscosity = 5\ndensity = 1200\n' >> two.toml
  run --separate-stderr -0 sheet-init --check two.toml
  [ "$(grep -c 'that no face uses' <<< "$stderr")" = 2 ]
}

@test "--check reads the mesh of a solid once, however much it asks of it" {
  {
    printf 'v %s\n' '-5 -1 -5' '5 -1 -5' '5 0 -5' '-5 0 -5' '-5 -1 5' '5 -1 5' '5 0 5' '-5 0 5' '9 9 9'
    printf 'f %s\n' '1 3 2' '1 4 3' '5 6 7' '5 7 8' '1 2 6' '1 6 5' '4 8 7' '4 7 3' '1 5 8' '1 8 4' '2 3 7' '2 7 6'
  } > block.obj
  sed 's/^\[material\]/center = [0, 1, 0]\n&/' disk.toml > falls.toml
  printf '[environment]\ngravity = [0, -9.81, 0]\n[[solid]]\nshape = "mesh"\nfile = "block.obj"\n' >> falls.toml
  for how in --check --no-provenance; do
    run --separate-stderr -0 sheet-init falls.toml $how -o /dev/null
    [ "$(grep -c 'that no face uses' <<< "$stderr")" = 1 ]
  done
}

@test "8: a size without its unit is doubted before its mesh is made" {
  sed 's/radius = 1/radius = 4/; s/0.4/"10 mm"/' disk.toml > large.toml
  sheet-init large.toml -o large.sheet > /dev/null 2> log &
  for _ in $(seq 100); do
    [[ ! -s log ]] || break
    sleep 0.1
  done
  kill $!
  grep -F 'disk: edge_length = 0.01 m makes 1.2e+06 triangles of 50.3 m²' log
  grep -F 'numbers without unit are metres, if a length has lost its own' log
  sed -i 's/radius = 4/radius = 40/' large.toml
  run -3 sheet-init large.toml
  [[ $output == *'numbers without unit are metres, if a length has lost its own'* ]]
}
