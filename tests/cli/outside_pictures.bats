#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# Pictures of what users have: cameras anywhere, names of any length, runs that failed, clear liquids on solids.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
  cat > disk.toml << 'END'
[sheet]
shape = "disk"
radius = 0.1
edge_length = 0.01
thickness = 0.004
center = [0, 0, 0.002]
[material]
viscosity = 100
density = 1000
[environment]
gravity = [0, 0, -9.81]
END
  small=(--size 64x36 --samples 2)
}

@test "18: a camera out of all reach is refused" {
  sheet-init disk.toml -o disk.sheet
  for eye in 1e19,0,0 0,1e30,0 1e300,0,0; do
    run -2 sheet-render disk.sheet --eye "$eye" -o a.png "${small[@]}"
    [[ $output == *'--eye is '*' m away from what there is to see'* ]]
  done
  sheet-render disk.sheet --eye 1,0,0 --target 1e19,0,0 -q -o a.png "${small[@]}"
  for target in 1e19,0,0 0,1e30,0 1e300,0,0; do
    run -2 sheet-render disk.sheet --target "$target" -o a.png "${small[@]}"
    [[ $output == *'--target is '*' m away from what there is to see'* ]]
  done
}

@test "18: a lens out of all measure is refused, one that is focused on what is far beyond is none" {
  sheet-init disk.toml -o disk.sheet
  for aperture in 1e22 1e300; do
    run -2 sheet-render disk.sheet --aperture "$aperture" -o a.png "${small[@]}"
    [[ $output == *'--aperture: a lens of '* ]]
  done
  for far in -1e12 -1e300; do
    run -0 sheet-render disk.sheet --aperture 5mm --focus="$far,$far,$far" -o "far$far.png" "${small[@]}"
  done
}

@test "18: a name that is too long is an input or output error, in every program" {
  sheet-init disk.toml -o disk.sheet
  long=$(printf 'a%.0s' {1..300})
  run -6 sheet-render disk.sheet -o "$long.png" "${small[@]}"
  run -6 sheet-render disk.sheet --environment "$long.png" -o a.png "${small[@]}"
  run -6 sheet-export disk.sheet -o "$long.obj"
  run -6 sheet-init "$long.toml"
  run -6 sheet-init disk.toml -o "$long"
  run -6 sheet-pass "$long"
  run -6 sheet-loop --steps 1 -i disk.sheet -o o.sheet --checkpoint "$long" -- sheet-pass
  run -6 sheet-loop --steps 1 --resume disk.sheet --checkpoint "$long" -- sheet-pass
}

@test "18: the last whole frame of a run that failed can be drawn" {
  sheet-init disk.toml | sheet-loop -q --steps 3 -o run.sheet -- 'sheet-step --dt 1e-3'
  head -c -100 run.sheet > cut.sheet
  run -4 sheet-render cut.sheet --frames -1 -o end.png "${small[@]}"
  sheet-render run.sheet --frames 2 -o two.png "${small[@]}"
  [[ -s end.png && -s two.png ]]
  run -4 bash -c 'sheet-select --last cut.sheet > last.sheet' # and picked
  run -4 bash -c 'sheet-select --time 0 cut.sheet > first.sheet'
  [[ $(sheet-info --csv last.sheet 2> log | tail -n 1 | cut -d , -f 1,2) == 0,0.002 ]]
  [[ $(sheet-info --csv first.sheet 2> log | tail -n 1 | cut -d , -f 1,2) == 0,0 ]]
}

@test "2: clear liquid that lies on a solid shows the solid, without dark blotches" {
  awk 'BEGIN{s = 0.3; for (i = 0; i < 8; ++i) print "v", s * (i % 2 - 0.5), s * (int(i / 2) % 2 - 1), s * (int(i / 4) - 0.5)
    print "f 1 3 4\nf 1 4 2\nf 5 6 8\nf 5 8 7\nf 1 2 6\nf 1 6 5\nf 3 7 8\nf 3 8 4\nf 1 5 7\nf 1 7 3\nf 2 4 8\nf 2 8 6"}' > box.obj
  solids=('shape = "plane"
normal = [0, 1, 0]' 'shape = "cylinder"
radius = 0.13
height = 0.05
center = [0, -0.025, 0]' 'shape = "mesh"
file = "box.obj"')
  for solid in "${solids[@]}"; do
    { sed 's/^shape = "disk"/&\nplane = "xz"/; s/^center = .*/center = [0, 0.002, 0]/; s/^gravity = .*/gravity = [0, -9.81, 0]/' disk.toml; printf '[[solid]]\n%s\n' "$solid"; } > solid.toml
    sheet-init solid.toml -o solid.sheet
    for material in chocolate caramel honey batter glass film; do
      sheet-render solid.sheet --material $material --eye 0,0.5,0.3 --target 0,0,0 --fov 15 --size 160x90 --samples 32 --ppm > a.ppm
      # the middle of the disk in blocks of 8 x 8: the darkest against the median
      /usr/bin/python3 - << 'END'
data = open("a.ppm", "rb").read()[-160 * 90 * 3:]
light = lambda x, y: sum(data[3 * (160 * y + x):3 * (160 * y + x) + 3])
blocks = sorted(sum(light(x + i, y + j) for i in range(8) for j in range(8)) for x in range(48, 112, 8) for y in range(24, 64, 8))
assert blocks[0] > 0.93 * blocks[len(blocks) // 2], blocks
END
    done
  done
}

@test "18: a clear film stands out from the ground" {
  sheet-init disk.toml --set sheet.thickness=0.0005 -o film.sheet
  for material in film honey; do
    sheet-render film.sheet --material $material --size 160x90 --samples 32 --ppm > a.ppm
    /usr/bin/python3 - << 'END'
data = open("a.ppm", "rb").read()[-160 * 90 * 3:]
light = lambda x, y: sum(data[3 * (160 * y + x):3 * (160 * y + x) + 3]) / 3
mean = lambda x, y: sum(light(x + i, y + j) for i in range(8) for j in range(8)) / 64
assert abs(mean(76, 41) - mean(2, 80)) > 12, (mean(76, 41), mean(2, 80))
END
  done
}

@test "two liquids are told apart unless --material says what they are" {
  cat > two.toml << 'END'
[environment]
gravity = [0, 0, -9.81]
END
  for x in -0.12 0.12; do
    printf '[[sheet]]\nname = "at %s"\nshape = "disk"\nradius = 0.1\nedge_length = 0.03\nthickness = 0.004\ncenter = [%s, 0, 0.002]
[sheet.material]\nviscosity = 1%s\ndensity = 1000\n' $x $x "${x#-0.}"
  done >> two.toml
  sed '/^viscosity/s/.*/viscosity = 10/' two.toml > one.toml # of two sheets
  sed -i '0,/^viscosity.*/s//viscosity = 10/' two.toml
  draw() { sheet-render "$1" "${small[@]}" --ppm "${@:2}" | sha256sum; }
  for scene in one two; do sheet-init $scene.toml -o $scene.sheet; done
  [[ $(draw two.sheet) == "$(draw two.sheet --material chocolate,batter)" ]]
  [[ $(draw two.sheet) != "$(draw two.sheet --material chocolate)" ]]
  [[ $(draw one.sheet) == "$(draw one.sheet --material chocolate)" ]]
  sheet-run -q two.toml --until 0.001 --fps 1000 --film no --quality draft -o run
  sheet-render run/run.sheet --frames -1 --size 320x180 --denoise --samples 8 -o told_apart.png
  cmp run/picture.png told_apart.png
}

@test "18: the sheet fills what the scale leaves free, in pictures of every size and shape" {
  printf '[sheet]\nshape = "sphere"\nradius = 0.1\nedge_length = 0.03\nthickness = 0.004\n[material]\nviscosity = 1\ndensity = 1\n' > sphere.toml
  sed 's/shape = "sphere"/shape = "rectangle"\nsize = [1, 0.1]/; /^radius/d' sphere.toml > wide.toml
  sed 's/shape = "sphere"/shape = "rectangle"\nsize = [0.1, 1]/; /^radius/d' sphere.toml > tall.toml
  for shape in sphere wide tall; do
    sheet-init $shape.toml -o $shape.sheet
    for size in 128x72 320x180 640x360 1280x720 400x700; do
      sheet-render $shape.sheet --look thickness --size $size --samples 1 --ppm > a.ppm
      /usr/bin/python3 - $size << 'END'
import sys
w, h = map(int, sys.argv[1].split("x"))
data = open("a.ppm", "rb").read()[-3 * w * h:]
coloured = lambda x, y: max(p := data[3 * (y * w + x):3 * (y * w + x) + 3]) - min(p) > 30
columns = [x for x in range(w) if any(coloured(x, y) for y in range(h))]
groups = [[columns[0]]]
for a, b in zip(columns, columns[1:]):
    if b - a > 2:
        groups.append([])
    groups[-1].append(b)
assert len(groups) == (1 if w == 128 else 2), [(g[0], g[-1]) for g in groups]
first, last = groups[0][0], groups[0][-1]
free = w if w == 128 else groups[1][0]
rows = [y for y in range(h) if any(coloured(x, y) for x in range(first, last + 1))]
assert last - first > 0.85 * free or rows[-1] - rows[0] > 0.75 * h, (first, last, free, rows[0], rows[-1])
END
    done
  done
}

@test "18: a sheet that has fallen far below all solids is told with what to do" {
  {
    cat disk.toml
    printf '[[solid]]\nshape = "box"\nsize = [0.1, 0.1, 0.1]\n'
  } > box.toml
  sheet-init box.toml --set 'sheet.center=[0, 0, -5]' -o fallen.sheet
  run -0 --separate-stderr sheet-render fallen.sheet -o a.png "${small[@]}"
  [[ $stderr == *'the sheet of the frame at 0 s is out of the picture: it is far below all solids'*'[[outflow]]'* ]]
}
