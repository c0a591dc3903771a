#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# Files that a mistake would destroy: input and output at once, two writers, a typo, a full disk.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
  cat > scene.toml << 'END'
[sheet]
shape = "mesh"
file = "mesh.obj"
thickness = 0.01
[material]
viscosity = 100
density = 1000
[environment]
gravity = [0, -9.81, 0]
END
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n' > mesh.obj
  sheet-init scene.toml -o a.sheet
}

# usage: keeps FILE CODE COMMAND...: the command ends with the code and leaves the file as it is.
keeps() {
  cp "$1" before
  run "-$2" timeout 20 "${@:3}"
  cmp "$1" before
}

@test "9: no program writes a file that it reads, whatever the file is called" {
  ln -s a.sheet symbolic.sheet
  ln a.sheet hard.sheet
  for name in a.sheet ./a.sheet "$PWD/a.sheet" symbolic.sheet hard.sheet; do
    for program in info pass step emit tear collide remesh select print; do
      keeps a.sheet 2 "sheet-$program" a.sheet -o "$name"
      [[ $output == *"$name is input and output at once"* ]]
    done
    keeps a.sheet 2 sheet-info --csv a.sheet a.sheet -o "$name"
    keeps a.sheet 2 sheet-export --format obj a.sheet -o "$name"
    keeps a.sheet 2 sheet-loop --steps 1 -i a.sheet -o "$name" -- sheet-pass
    keeps a.sheet 2 sheet-loop --steps 1 -i a.sheet -o b.sheet --checkpoint "$name" -- sheet-pass
    keeps a.sheet 2 sheet-loop --steps 1 --resume a.sheet --checkpoint "$name" -- sheet-pass
    keeps a.sheet 2 sheet-step --dt 0.01 --failed "$name" a.sheet -o b.sheet
    keeps a.sheet 2 bash -c 'sheet-info < a.sheet 1<> "$1"' _ "$name"
  done
  sheet-print a.sheet > a.txt
  keeps a.txt 2 sheet-parse a.txt -o a.txt
}

@test "9: no program writes one file twice at once" {
  keeps a.sheet 2 sheet-loop --steps 1 -i a.sheet -o b.sheet --checkpoint ./b.sheet -- sheet-pass
  [[ $output == *'./b.sheet is output twice at once'* || $output == *'b.sheet is output twice at once'* ]]
  run -2 sheet-step --dt 0.01 --failed b.sheet a.sheet -o b.sheet
}

@test "9: sheet-init spares the scene and every mesh that it names" {
  keeps scene.toml 2 sheet-init scene.toml -o scene.toml
  keeps mesh.obj 2 sheet-init scene.toml -o mesh.obj
  keeps scene.toml 2 sheet-init --check scene.toml -o scene.toml
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n' > solid.obj
  printf '[[solid]]\nshape = "mesh"\nfile = "solid.obj"\n[contact]\n' >> scene.toml
  keeps solid.obj 2 sheet-init scene.toml -o solid.obj
}

@test "9: sheet-render spares the picture of the surroundings" {
  sheet-render a.sheet -o e.png --size 32x18 --samples 2
  keeps e.png 2 sheet-render a.sheet --environment e.png -o e.png --size 32x18 --samples 2
  [[ $output == *'e.png is input and output at once'* ]]
}

@test "10: a file has one writer at a time, and the message says who" {
  sheet-pass a.sheet -o run.sheet
  sheet-loop --steps 5 --resume run.sheet -- 'sleep 60 | cat' 2> /dev/null 3>&- &
  writer=$!
  sleep 1
  for command in "sheet-loop --steps 5 --resume run.sheet -- sheet-pass" "sheet-pass a.sheet -o run.sheet" \
    "sheet-loop --steps 5 -i a.sheet -o run.sheet -- sheet-pass" "sheet-info a.sheet -o run.sheet" \
    "sheet-select --last a.sheet -o run.sheet" "sheet-init scene.toml -o run.sheet"; do
    keeps run.sheet 6 bash -c "$command"
    [[ $output == *'run.sheet is being written by process '*' (sheet-loop): wait until it has ended'* ]]
  done
  kill "$writer"
  wait "$writer" || true
}

@test "11: a mistake leaves an earlier result as it is, and no empty file" {
  head -c 300 a.sheet > bad.sheet
  sheet-loop -q --steps 3 -i a.sheet -o run.sheet -- sheet-pass
  keeps run.sheet 2 sheet-loop --steps 5 -i a.sheet -o run.sheet -- 'sheet-pass; x'
  keeps run.sheet 2 sheet-loop --steps 5 -i a.sheet -o run.sheet -- 'sheet-pas'
  [[ $output == *'in the step after step 0, t = 0 s; nothing was written'* ]]
  keeps run.sheet 2 sheet-loop --steps 5 -i a.sheet -o run.sheet -- 'sheet-pass --nonsense'
  keeps run.sheet 4 sheet-loop --steps 5 -i bad.sheet -o run.sheet -- sheet-pass
  keeps run.sheet 2 sheet-loop --steps 5 --resume run.sheet -- 'sheet-pass | sheet-pas'
  keeps run.sheet 3 sheet-init bad.sheet -o run.sheet
  keeps run.sheet 3 sheet-parse scene.toml -o run.sheet
  for program in info 'info --csv' 'info --json' pass step emit tear collide remesh select 'select --last' print; do
    options=
    [[ $program != step ]] || options='--dt 0.1'
    # shellcheck disable=SC2086 # words
    keeps run.sheet 4 sheet-$program $options bad.sheet -o run.sheet
    # shellcheck disable=SC2086
    run -4 sheet-$program $options bad.sheet -o new.sheet
    [[ ! -e new.sheet ]]
  done
  echo earlier > one.png
  keeps one.png 2 sheet-render run.sheet -o one.png --size 32x18 --samples 2
  cp one.png one.obj
  keeps one.obj 2 sheet-export run.sheet -o one.obj
  keeps run.sheet 0 sheet-loop -q --steps 3 --resume run.sheet -- sheet-pass
  sheet-loop -q --steps 5 -i a.sheet -o run.sheet -- sheet-pass
  [[ $(sheet-print run.sheet | grep -c '^frame$') == 6 ]]
}

@test "12: --resume does not go on from the checkpoint of another run" {
  sheet-init scene.toml --set material.viscosity=7 -o b.sheet
  sheet-loop -q --steps 3 -i a.sheet -o run.sheet -- sheet-pass
  sheet-loop -q --steps 9 -i b.sheet --checkpoint newer.sheet -o other.sheet -- sheet-pass
  sheet-loop -q --steps 1 -i b.sheet --checkpoint older.sheet -o other.sheet -- sheet-pass
  sheet-init scene.toml --set sheet.thickness=0.02 -o c.sheet
  sheet-loop -q --steps 9 -i c.sheet --checkpoint same_scene.sheet -o other.sheet -- 'sheet-remesh --edge-length 3'
  for checkpoint in newer older same_scene; do
    cp $checkpoint.sheet checkpoint.sheet
    keeps run.sheet 2 sheet-loop --steps 20 --resume run.sheet --checkpoint checkpoint.sheet -- sheet-pass
    [[ $output == *'--checkpoint checkpoint.sheet holds a frame of another run than run.sheet'* ]]
    cmp checkpoint.sheet $checkpoint.sheet
  done
  cp run.sheet newest.sheet
  sheet-loop -q --steps 6 --resume newest.sheet --checkpoint own.sheet -- sheet-pass
  sheet-loop -q --steps 9 --resume run.sheet --checkpoint own.sheet -- sheet-pass
  sheet-print run.sheet | grep -q '^step 9$'
}

# usage: full COMMAND...: runs it where files may not grow beyond 8 KiB, as on a full disk
full() {
  run -6 bash -c 'ulimit -f 8; "$@"' _ "$@"
}

@test "14: a full disk leaves no half of a file, and no draft" {
  make_grid 40 > large.sheet
  mkdir out
  full sheet-export large.sheet -o out/%d.vtu
  full sheet-render large.sheet -o out/%d.exr --size 320x180 --samples 2
  full sheet-loop -i large.sheet --steps 2 --checkpoint out/c.sheet -o /dev/null -- sheet-pass
  [[ -z $(ls -A out) ]]
  echo old > out/0.vtu
  full sheet-export large.sheet -o out/%d.vtu
  [[ $(cat out/0.vtu) == old ]]
  rm out/0.vtu
  ln -s real.obj out/link.obj
  echo > out/real.obj
  sheet-export large.sheet -o out/link.obj
  [[ -L out/link.obj && $(wc -c < out/real.obj) -gt 8192 ]]
  sheet-export large.sheet --format obj -o - | cmp - out/real.obj
}

@test "a sheet starts from the last frame of a stream, of another run or out of numpy" {
  export PYTHONPATH=$SHEET_SOURCE/formats/python
  /usr/bin/python3 - << 'END'
import numpy, sheetstream
a = numpy.arange(24) * numpy.pi / 12
ring = [(numpy.cos(x) * r, numpy.sin(x) * r, h) for x in a for r, h in ((0.1, 0.0), (0.1, 0.05))]  # a tube
faces = [f for i in range(0, 48, 2) for f in ((i, (i + 2) % 48, (i + 3) % 48), (i, (i + 3) % 48, i + 1))]
frame = sheetstream.make_frame(ring, faces, thickness=numpy.linspace(0.001, 0.002, 48))
frame.arrays["lab.dye"] = sheetstream.Array(numpy.linspace(0, 1, 48), "vertex", "1", "interpolate")
sheetstream.write("tube.sheet", [frame])
END
  start() { # STREAM [ARRAY]
    printf '[sheet]\nshape = "mesh"\nfile = "%s"\nthickness = {data = "thickness", place = "face"}\narrays = ["%s"]
[material]\nviscosity = 1\ndensity = 1000\n[environment]\ngravity = [0, 0, -9.81]\n' "$1" "${2:-lab.dye}"
  }
  run -3 sheet-step --dt 0.001 tube.sheet -o none.sheet
  [[ $output == *'has no scene'*'of a scene whose [sheet] has shape = "mesh" and this stream as its file' ]]
  start tube.sheet > first.toml
  sheet-init first.toml | sheet-loop -q --steps 3 -o ended.sheet -- 'sheet-step --dt 0.001'
  start ended.sheet > second.toml
  sheet-init second.toml -o second.sheet
  /usr/bin/python3 - << 'END'
import numpy, sheetstream
old, new = sheetstream.Run("ended.sheet")[-1], sheetstream.Run("second.sheet")[0]
for name in ("position", "velocity", "triangle", "lab.dye"):
    numpy.testing.assert_array_equal(old[name], new[name])
numpy.testing.assert_allclose(new["volume"], old["volume"], rtol=1e-14)
assert (new.time, new.step) == (0, 0) and abs(new["velocity"]).max() > 0.02
END
  start ended.sheet lab.die > third.toml
  run -3 sheet-init third.toml
  [[ $output == *'ended.sheet: there is no array "lab.die"'*'sheet-info lists them'* ]]
  head -c -100 ended.sheet > cut.sheet
  start cut.sheet > fourth.toml
  run -3 sheet-init fourth.toml
  [[ $output == *cut.sheet*'sheet-select --last takes the last whole frame'* ]]
  start fourth.sheet > fifth.toml
  run -3 sheet-init fifth.toml
  [[ $output == *'there is no "fourth.sheet"'* ]]
}

@test "sheet-loop -o keeps an earlier run beside it, once the ring runs" {
  sheet-loop -q -i a.sheet --steps 1 -o run.sheet -- sheet-pass
  cp run.sheet earlier.sheet
  run -2 sheet-loop -i a.sheet --steps 2 -o run.sheet -- nonesuch
  cmp run.sheet earlier.sheet
  [[ ! -e run.sheet~ ]]
  ln -s run.sheet link.sheet
  sheet-loop -i a.sheet --steps 2 -o link.sheet -- sheet-pass 2> log
  [[ $(grep -c 'link.sheet was there: it is kept as .*run.sheet~' log) == 1 ]]
  cmp run.sheet~ earlier.sheet
  [[ -L link.sheet && $(sheet-print run.sheet | grep -c '^frame$') == 3 ]]
  # what is read is no place for it, and an empty file is nothing to keep
  keeps run.sheet~ 2 sheet-loop -i run.sheet~ --steps 1 -o run.sheet -- sheet-pass
  true > empty.sheet
  sheet-loop -q -i a.sheet --steps 1 -o empty.sheet -- sheet-pass
  [[ ! -e empty.sheet~ ]]
  sheet-loop -q -i a.sheet --steps 1 -o run.sheet -- sheet-pass
  cmp run.sheet earlier.sheet
}

# usage: make_wild: wild.sheet, which no step can take.
make_wild() {
  sheet-print a.sheet | sed '/^array volume /i array velocity vertex float64 3 m/s interpolate\n1e29 0 0\n-1e29 0 0\n0 1e29 0\n0 0 1e29' |
    sheet-parse > wild.sheet
}

@test "a step that fails leaves its frame beside the run, and says where" {
  make_wild
  mkdir runs
  run -5 timeout 60 sheet-loop --steps 2 -i wild.sheet -o runs/run.sheet -- 'sheet-step --dt 0.01'
  [[ $output == *'the frame before it is in runs/failed-step.sheet'* ]]
  rm runs/failed-step.sheet # there it was
  cp wild.sheet runs/resumed.sheet
  run -5 timeout 60 sheet-loop --steps 2 --resume runs/resumed.sheet -- 'sheet-step --dt 0.01'
  rm runs/failed-step.sheet
  run -5 timeout 60 sheet-loop --steps 2 -i wild.sheet -o /dev/null -- 'sheet-step --dt 0.01'
  rm failed-step.sheet # not in /dev
  run -5 timeout 60 sheet-step --dt 0.01 wild.sheet -o runs/out.sheet
  rm failed-step.sheet
}

@test "19: a step that does not converge says so, also where nothing can be written" {
  make_wild
  for failed in nowhere/failed.sheet /dev/full; do
    run -5 timeout 60 sheet-step --dt 0.01 --failed "$failed" wild.sheet -o out.sheet
    [[ $output == *'did not converge'*'could not be kept: '* ]]
    run -5 timeout 60 sheet-loop --steps 2 -i wild.sheet --checkpoint "$failed" -o /dev/null -- \
      "sheet-step --dt 0.01 --failed $failed"
    [[ $output == *'the checkpoint could not be written: '*'failed with exit code 5'* ]]
  done
}

@test "19: out of memory has one exit code" {
  if grep -q 'SHEET_SANITIZE:BOOL=ON' "$SHEET_BUILD/CMakeCache.txt"; then
    skip "a sanitizer ends a program that lacks memory in its own way"
  fi
  make_grid 300 > large.sheet
  found=0
  for kilobytes in 100000 150000 200000 250000; do
    for command in "sheet-remesh --edge-length 0.1" "sheet-render --ppm --size 64x36 --samples 2" "sheet-export --format vtu -o -" \
      "sheet-info" "sheet-check"; do
      code=0
      timeout 60 bash -c "ulimit -v $kilobytes; $command large.sheet > out 2> err" || code=$?
      [[ $code == 0 || $code == 6 || $code == 127 ]]
      [[ $code != 6 ]] || { grep -q 'not enough memory' err && found=1; }
    done
  done
  [[ $found == 1 ]]
}

@test "a mesh that a frame names is found beside the stream, by programs and by the stages of a ring" {
  mkdir here elsewhere
  printf '%s\n' OFF '4 4 0' '-1 -1 -1' '3 -1 -1' '-1 -1 3' '0 0.5 0' '3 0 1 2' '3 0 3 1' '3 0 2 3' '3 1 3 2' > here/block.off
  cat > here/mesh.toml << 'END'
[sheet]
shape = "rectangle"
size = [1, 1]
center = [0, 3, 0]
edge_length = 0.3
thickness = 0.01
[material]
viscosity = 10
density = 1000
[environment]
gravity = [0, -9.81, 0]
[[solid]]
shape = "mesh"
file = "block.off"
END
  (cd here && sheet-init mesh.toml -o first.sheet)
  cd elsewhere
  sheet-loop -q -i ../here/first.sheet -o run.sheet --steps 1 -- 'sheet-step --dt 0.001 | sheet-collide'
  mv run.sheet ../here
  sheet-loop -q --resume ../here/run.sheet --steps 2 -- 'sheet-step --dt 0.001 | sheet-collide'
  sheet-render -q ../here/run.sheet --frames -1 --ppm --size 16x9 --samples 1 > picture.ppm
  run -6 bash -c 'sheet-collide < ../here/run.sheet > out.sheet' # nothing says where that stream is
  [[ $output == *'block.off: there is no such file'* ]]
  echo >> ../here/block.off
  run -3 sheet-collide ../here/run.sheet -o out.sheet
  [[ $output == *'here/block.off: it has changed since sheet-init ran'* ]]
}

@test "sheet-select and sheet-render read and mean the same by a list of frames" {
  sheet-init "$SHEET_SOURCE/pipelines/catenary/scene.toml" --set 'sheet.segments=[8, 4]' | sheet-loop -q --steps 5 -o six.sheet -- sheet-pass
  drawn() { sheet-render -v six.sheet "--frames=$1" --ppm --size 16x9 --samples 1 2>&1 > /dev/null | sed -n 's/.*: frame \([0-9]*\): .*/\1/p' | tr '\n' ' '; }
  picked() { sheet-select "$2=$1" six.sheet | sheet-print | sed -n 's/^step //p' | tr '\n' ' '; }
  for list in 0 -1 0,2 '4, 0 , 2' 1-3 4- -3- -3--2 2--2 -9- 3-99 -2-4; do
    [[ -n $(drawn "$list") ]]
    [[ $(drawn "$list") == "$(picked "$list" --index)" && $(drawn "$list") == "$(picked "$list" --frames)" ]]
  done
  for list in 3-1 x 1-x 1, ,1 '1 2' 1:2; do
    run -2 sheet-render six.sheet "--frames=$list" --ppm --size 16x9
    run -2 sheet-select "--index=$list" six.sheet
  done
  run -3 sheet-render six.sheet --frames=6-9 --ppm --size 16x9
  run -3 sheet-select --index=6-9 six.sheet
}

@test "a stream, a scene, and what is compressed are told by what they are, where another kind is wanted" {
  cp scene.toml a.toml
  sheet-print a.sheet > a.txt
  refused() { # CODE MESSAGE COMMAND...
    run "-$1" "${@:3}"
    [[ $output == *"$2"* ]] || { echo "$output"; false; }
  }
  refused 4 'this is text: of a scene, sheet-init makes the first frame' sheet-info a.toml
  refused 4 'there is nothing to go on with' sheet-loop --steps 1 --resume a.toml -- sheet-pass
  refused 6 '-o FILE begins one' sheet-loop --steps 1 --resume none.sheet -- sheet-pass
  for file in a.sheet a.txt; do
    refused 3 "$file: this is a sheet stream, not a scene" sheet-init "$file"
    refused 3 "$file: this is a sheet stream, not a scene" sheet-run "$file"
  done
  for program in gzip xz bzip2; do
    for file in a.sheet a.toml a.txt; do
      "$program" -c "$file" > "$file.packed"
    done
    refused 4 "this is $program-compressed: read it through $program -dc" sheet-info a.sheet.packed
    refused 3 "a.toml.packed: it is compressed: $program -dc OLD > NEW" sheet-init a.toml.packed
    refused 3 "it is compressed: $program -dc OLD > NEW" sheet-parse a.txt.packed
  done
}
