#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# sheet-run: from a scene to stream, film, picture, table and health, in one command that goes on where it was.

bats_require_minimum_version 1.5.0

setup() {
  mkdir "$BATS_TEST_TMPDIR/a folder"
  cd "$BATS_TEST_TMPDIR/a folder" || exit
  cat > 'my scene.toml' << 'END_OF_SCENE'
[sheet]
shape = "disk"
radius = "10 mm"
edge_length = "3 mm"
thickness = "2 mm"
center = [0, "20 mm", 0]
[material]
viscosity = "10 Pa*s"
density = "1400 kg/m^3"
[environment]
gravity = [0, "-9.81 m/s^2", 0]
[[solid]]
shape = "plane"
END_OF_SCENE
}

# In the folder slow: a stage with which a ring takes a while.
make_slow() {
  mkdir slow
  printf '#!/bin/sh\n/usr/bin/python3 "%s/spoiler_stage.py" 1000000 0.1 | %s "$@"\n' "$BATS_TEST_DIRNAME" \
    "$(command -v sheet-remesh)" > slow/sheet-remesh
  chmod +x slow/sheet-remesh
}

@test "a scene becomes a folder of all, by commands that are told and that can be pasted" {
  sheet-run 'my scene.toml' --quality draft --until 0.1 --fps 40 2> log
  cd 'my scene-draft'
  for file in run.sheet run.csv picture.png film.mp4 health.txt check.txt foretold.txt; do [[ -s $file ]]; done
  [[ $(sheet-print run.sheet | grep -c '^frame$') == 5 && $(wc -l < run.csv) == 6 ]]
  [[ $(ffprobe -v error -count_frames -show_entries stream=width,nb_read_frames -of csv=p=0 film.mp4) == 320,5 ]]
  grep -q 'film.mp4' ../log
  grep -q 'Reynolds' check.txt
  cd ..
  # what it printed makes the same stream
  sed -n 's/^  \(sheet-\(init\|loop\)\)/\1/p' log > commands
  [[ $(wc -l < commands) == 2 ]]
  mv 'my scene-draft' made
  mkdir 'my scene-draft'
  bash -e commands 2> /dev/null
  cmp 'my scene-draft/run.sheet' made/run.sheet
}

@test "draft, normal and fine differ in edges and steps as --help says, and --check tells the same" {
  mean_edge() { sheet-init --check --quality "$1" 'my scene.toml' | sed -n 's/.*Edges are \([0-9.e-]*\) m long.*/\1/p'; }
  awk -v d="$(mean_edge draft)" -v n="$(mean_edge normal)" -v f="$(mean_edge fine)" \
    'BEGIN {exit !(d / n > 1.6 && d / n < 2.4 && n / f > 1.6 && n / f < 2.4)}'
  tolerance() { sheet-init --ring --quality "$1" 'my scene.toml' | sed -n 's/.*--tolerance \([0-9.]*\).*/\1/p'; }
  [[ $(tolerance normal) == '' ]]
  awk -v d="$(tolerance draft)" -v f="$(tolerance fine)" 'BEGIN {exit !(d / f > 9.9 && d / f < 10.1)}'
  sheet-init --check --quality fine 'my scene.toml' | grep -q "below $(tolerance fine) of an edge"
}

@test "interrupted, the same command goes on: byte for byte the straight run; called again it does nothing" {
  options=(--quality draft --until 0.2 --fps 40)
  sheet-run -q 'my scene.toml' "${options[@]}" -o straight
  make_slow
  PATH=$PWD/slow:$PATH sheet-run 'my scene.toml' "${options[@]}" -o run 2> log &
  whole=$!
  for _ in {1..200}; do
    [[ ! -s run/run.sheet || $(stat -c %s run/run.sheet) -le $(stat -c %s straight/first.sheet) ]] || break
    sleep 0.1
  done
  kill -TERM $whole
  code=0
  wait $whole || code=$?
  [[ $code == 143 ]]
  grep -q 'the same command again goes on' log
  sheet-check -q run/run.sheet
  [[ ! -e run/film.mp4 && $(stat -c %s run/run.sheet) -lt $(stat -c %s straight/run.sheet) ]]
  # from elsewhere: the scene is the same, however it is called
  folder=$PWD
  (cd / && sheet-run -q "$folder/my scene.toml" "${options[@]}" -o "$folder/run")
  cmp run/run.sheet straight/run.sheet
  made=$(stat -c %y run/{film.mp4,picture.png})
  sheet-run -q 'my scene.toml' "${options[@]}" -o run
  [[ $(stat -c %y run/{film.mp4,picture.png}) == "$made" ]]
}

@test "a scene that names a mesh goes on from any folder, and is another with another mesh" {
  options=(--quality draft --fps 100 --film 64x36 -o "$BATS_TEST_TMPDIR/runs/run") # no folder of the run's has the mesh
  mkdir -p "$BATS_TEST_TMPDIR/runs" meshes scenes
  printf '%s\n' 'v 0 1 0' 'v 1 -1 -1' 'v -1 -1 -1' 'v 0 -1 1.5' 'f 1 2 3' 'f 1 3 4' 'f 1 4 2' 'f 2 4 3' > meshes/ball.obj
  sed 's|^shape = "plane"|shape = "mesh"\nfile = "../meshes/ball.obj"\nscale = 0.01\nvoxel_size = "1 mm"|' 'my scene.toml' \
    > scenes/ball.toml
  sheet-run -q scenes/ball.toml "${options[@]}" --until 0.02
  folder=$PWD
  (cd / && sheet-run -q "$folder/scenes/ball.toml" "${options[@]}" --until 0.04)
  (cd scenes && sheet-run -q ball.toml "${options[@]}" --until 0.06)
  sheet-run -q scenes/ball.toml "${options[@]::4}" --until 0.06 -o straight
  sheet-diff -q --ignore provenance straight/run.sheet "$BATS_TEST_TMPDIR/runs/run/run.sheet"
  sed -i 's/^v 0 1 0$/v 0 1.1 0/' meshes/ball.obj
  run -2 --separate-stderr sheet-run -q scenes/ball.toml "${options[@]}" --until 0.06
  [[ $stderr == *'has the run of another scene'* ]]
}

@test "--limit ends a run, shows what there is, and the same command goes on" {
  options=(--quality draft --until 0.2 --fps 40 --film no)
  sheet-run -q 'my scene.toml' "${options[@]}" -o straight
  make_slow
  begin=$SECONDS
  PATH=$PWD/slow:$PATH run -0 --separate-stderr sheet-run 'my scene.toml' "${options[@]}" --limit 1 -o run
  [[ $stderr == *'not at its end after 1 s; the same command again goes on'* ]]
  [[ $(wc -l < run/run.csv) -lt $(wc -l < straight/run.csv) && -s run/picture.png && -s run/health.txt ]]
  run -0 --separate-stderr sheet-run 'my scene.toml' "${options[@]}" --limit 100 -o run
  [[ $stderr != *'not at its end'* && $((SECONDS - begin)) -lt 60 ]]
  cmp run/run.sheet straight/run.sheet
}

@test "films and pictures have the size and the material that are asked for, or there is no film" {
  options=(--quality draft --until 0.05 --fps 40)
  wide() { ffprobe -v error -show_entries stream=width -of csv=p=0 "$1"; }
  sheet-run -q 'my scene.toml' "${options[@]}" --film 64x36 -o run
  [[ $(wide run/film.mp4) == 64 && $(wide run/picture.png) == 64 ]]
  cp run/picture.png chocolate.png
  sheet-run -q 'my scene.toml' "${options[@]}" --film 64x36 --material honey -o run
  ! cmp -s run/picture.png chocolate.png
  sheet-run -q 'my scene.toml' "${options[@]}" --film no -o run
  [[ ! -e run/film.mp4 && $(wide run/picture.png) == 320 ]]
  run -2 --separate-stderr sheet-run 'my scene.toml' --film 64
  [[ $stderr == *'--film: 64 is neither no nor a size'* ]]
  run -2 --separate-stderr sheet-run 'my scene.toml' --film 33x18
  [[ $stderr == *'--film: 33x18: width and height of a film are even'* ]]
  run -2 --separate-stderr sheet-run 'my scene.toml' --film 640x16386
  [[ $stderr == *'--film: 640x16386: sides have at most 16384 pixels'* && $(ls) == $'chocolate.png\nmy scene.toml\nrun' ]]
  run -2 --separate-stderr sheet-run 'my scene.toml' --material milk
  [[ $stderr == *'--material: milk is not one of chocolate, caramel, honey'* ]]
  run -2 --separate-stderr sheet-run 'my scene.toml' --material chocolate,milk
  [[ $stderr == *'--material: milk is not one of chocolate, caramel, honey'* ]]
}

@test "a film that cannot be made leaves no half of one, and the rest" {
  mkdir mine
  printf '#!/bin/sh\nfor last; do true; done\nhead -c 100 > "$last"\nexit 1\n' > mine/ffmpeg
  chmod +x mine/ffmpeg
  PATH=$PWD/mine:$PATH run -6 --separate-stderr sheet-run 'my scene.toml' --quality draft --until 0.05 --fps 40 -o run
  [[ $stderr == *'ffmpeg failed, so there is no film; the rest is in run'* && -s run/picture.png ]]
  [[ $(ls run) != *film* ]]
}

@test "folders and scenes may have names that look like options, and no file is in a folder's way unnoticed" {
  cp 'my scene.toml' ./-q.toml
  options=(--quality draft --until 0.05 --fps 40 --stream-only)
  sheet-run -q ./-q.toml "${options[@]}"
  sheet-run -q 'my scene.toml' "${options[@]}" -o -v
  [[ -s ./-q-draft/run.csv && -s ./-v/run.csv ]]
  cp 'my scene.toml' scene
  run -6 --separate-stderr sheet-run scene --until 0.05
  [[ $stderr == *'scene is a file, and the folder would have its name: give one by -o'* ]]
  for file in ring.txt foretold.txt; do # what cannot be written
    mkdir -p "$file/$file"
    run -6 --separate-stderr sheet-run 'my scene.toml' "${options[@]}" -o "$file"
    [[ $stderr == *"cannot write $file/$file"* ]]
  done
}

@test "names beyond ASCII are told as they are, and can be pasted; a folder that cannot be made is told with what to do" {
  options=(--quality draft --until 0.05 --fps 40 --film no)
  run --separate-stderr sheet-run 'my scene.toml' "${options[@]}" -o "Läufe und Bilder/größe's"
  [[ $status == 0 && $stderr == *"  sheet-loop --resume 'Läufe und Bilder/größe'\\''s/run.sheet' --until 0.05"* ]]
  [[ $stderr == *"sheet-view 'Läufe und Bilder/größe'\\''s/run.sheet' -o run.html"* ]]
  run -6 --separate-stderr sheet-run 'my scene.toml' "${options[@]}" -o 'my scene.toml/run'
  [[ $stderr == 'sheet-run: cannot make the folder my scene.toml/run (Not a directory): give one by -o where files can be written' ]]
}

@test "a film that is slower or faster than the run says by how much" {
  film() { sheet-run 'my scene.toml' --quality draft --film 64x36 "$@" 2>&1; }
  [[ $(film --until 0.02 --fps 250 -o slow) == *'film.mp4 is 10 times as slow as the run: 250 frames a second are shown at 25'* ]]
  [[ $(film --until 0.4 --fps 5 -o fast) == *'film.mp4 is 5 times as fast as the run: 5 frames a second are shown at 25'* ]]
  [[ $(film --until 0.05 --fps 40 -o life) != *'as the run'* ]]
}

@test "a folder is no scene, and a pipe none that can be read again" {
  run -6 --separate-stderr sheet-run .
  [[ $stderr == *'.: this is a folder; give a scene file in it'* ]]
  run -6 timeout 10 sheet-run <(cat 'my scene.toml') -o piped
  [[ $output == *'this is no regular file'*'save it as one' && ! -e piped ]]
}

@test "what lies in the folder under the names of a run, and is none, is told, and stays" {
  run_draft() { run "-$1" --separate-stderr sheet-run -q 'my scene.toml' --quality draft --until 0.05 --fps 40 "${@:2}"; }
  mkdir theirs
  echo theirs > theirs/run.sheet
  run_draft 2 --film no -o theirs
  [[ $stderr == "sheet-run: theirs has a run.sheet that is no run of sheet-run's: move it away, or give another folder by -o" ]]
  [[ $(ls theirs) == run.sheet && $(cat theirs/run.sheet) == theirs ]]
  mkdir -p other/run.sheet
  run_draft 2 --film no -o other
  [[ $stderr == *"no run of sheet-run's"* ]]
  mkdir -p film/film.mp4
  run_draft 6 --film 64x36 -o film
  [[ $stderr == *'cannot write film/film.mp4 '* && -z $(ls film/film.mp4) ]]
  run_draft 0 --film no -o whole
  cp whole/run.sheet straight.sheet
  : > whole/run.sheet # by a crash of the machine
  run_draft 0 --film no -o whole
  cmp whole/run.sheet straight.sheet
}

@test "a later --until makes the run longer, and the film" {
  sheet-run -q 'my scene.toml' --quality draft --until 0.05 --fps 100 -o run
  sheet-run -q 'my scene.toml' --quality draft --until 0.1 --fps 100 -o run
  [[ $(wc -l < run/run.csv) == 12 ]]
  [[ $(ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 run/film.mp4) == 11 ]]
}

@test "a first look goes on for longer with its own frames a second, though fewer would be proposed" {
  sheet-run -q 'my scene.toml' --quality draft --until 0.05 --film no -o run
  [[ $(sheet-init --ring --quality draft --until 0.1 'my scene.toml') != *'fps 1000'* ]]
  run --separate-stderr sheet-run 'my scene.toml' --quality draft --until 0.1 --film no -o run
  [[ $status == 0 && $stderr == *'run has a run with 1000 frames a second, and goes on with as many'* ]]
  [[ $(wc -l < run/run.csv) == 102 ]]
}

@test "a first look goes on for longer, though only later its solid turns what lies on it under itself" {
  sed -i 's/^shape = "plane"/shape = "cylinder"\nradius = "30 mm"\nheight = "80 mm"\ncenter = [0, "-30 mm", 0]/' 'my scene.toml'
  # A roll that turns on for ever would carry the sheet round.
  printf '%s\n' 'rotation = {axis = [1, 0, 0], angle = "90 deg"}' \
    'motion = {kind = "rotating", axis = [0, 0, 1], rate = [[0, -6], [0.4, -6], [0.41, 0]]}' >> 'my scene.toml'
  sheet-init --ring --until 0.5 'my scene.toml' | grep -q 'contact.adhesion'
  sheet-run -q 'my scene.toml' --until 0.01 --fps 100 --film no -o run
  sheet-run -q 'my scene.toml' --until 0.5 --fps 100 --film no -o run
}

@test "another scene, quality or rate is refused with what to do, and the folder stays as it is" {
  sheet-run -q 'my scene.toml' --quality draft --until 0.05 --fps 40 -o run
  before=$(cd run && sha256sum ./*)
  run -2 --separate-stderr sheet-run 'my scene.toml' --quality draft --until 0.05 --fps 50 -o run
  [[ $stderr == *'run has a run of another ring'*'move it away, or give another folder by -o'* ]]
  run -2 sheet-run 'my scene.toml' --until 0.05 --fps 40 -o run
  sed -i 's/viscosity = .*/viscosity = 20/' 'my scene.toml'
  run -2 --separate-stderr sheet-run 'my scene.toml' --quality draft --until 0.05 --fps 40 -o run
  [[ $stderr == *'run has the run of another scene, or of another state of this one: move it away'* ]]
  run -2 --separate-stderr sheet-run 'my scene.toml' --quality draft --until 0.05 -o run
  [[ $stderr != *'goes on with as many'* ]] # what it does not do
  [[ $(cd run && sha256sum ./*) == "$before" ]]
  # what the scene says in other words is the same
  sed -i 's/viscosity = .*/viscosity = "100 P" # as before/' 'my scene.toml'
  sheet-run -q 'my scene.toml' --quality draft --until 0.05 --fps 40 -o run
}

@test "--set changes the scene as sheet-init does, in the ring, in what is told, and in the commands" {
  options=(--quality draft --until 0.05 --fps 40 --stream-only)
  sheet-run 'my scene.toml' "${options[@]}" --set 'material.viscosity=20 Pa*s' --set=sheet.edge_length=2e-3 -o run 2> log
  sed 's/viscosity = .*/viscosity = 20/; s/edge_length = .*/edge_length = "2 mm"/' 'my scene.toml' > changed.toml
  sheet-run -q changed.toml "${options[@]}" -o same
  sheet-diff -q --ignore provenance run/run.sheet same/run.sheet
  sed 's/changed.toml/my scene.toml/' same/check.txt | diff <(grep -v 'sheet-init' run/check.txt) <(grep -v 'sheet-init' -)
  grep -q -- '--set .material.viscosity=20 Pa\*s. --set .\?sheet.edge_length=2e-3' log
  sheet-run -q 'my scene.toml' "${options[@]}" --set material.viscosity=20 --set 'sheet.edge_length=2 mm' -o run # goes on
  run -2 --separate-stderr sheet-run 'my scene.toml' "${options[@]}" -o run
  [[ $stderr == *'run has the run of another scene'* ]]
  run -3 --separate-stderr sheet-run 'my scene.toml' --set material.viscocity=20
  [[ $stderr == *'--set'*'viscocity'*'viscosity'* ]]
  run -2 --separate-stderr sheet-run 'my scene.toml' --edge-length 0.002
  [[ $stderr == *"unknown option --edge-length; what the scene says is changed by --set, as in --set 'sheet.edge_length=5 mm'"* ]]
}

@test "what is wrong with the scene is told as sheet-init tells it, and nothing is left" {
  sed -i 's/viscosity/viscocity/' 'my scene.toml'
  run -3 --separate-stderr sheet-run 'my scene.toml'
  [[ $stderr == *'my scene.toml:8:'*'viscocity'*'viscosity'* ]]
  run -6 sheet-run none.toml
  run -2 sheet-run
  [[ $(ls) == 'my scene.toml' ]]
}

@test "a run that fails leaves what there is of it, with the code of what failed" {
  mkdir mine
  printf '#!/bin/sh\n%s --steps=none 2> /dev/null; exit 5\n' "$(command -v sheet-step)" > mine/sheet-step
  chmod +x mine/sheet-step
  PATH=$PWD/mine:$PATH run -5 --separate-stderr sheet-run 'my scene.toml' --quality draft --until 0.05 --fps 40 -o run
  [[ $stderr == *'sheet-step'*'failed with exit code 5'*'the run ended too early; what there is of it is in run'* ]]
  sheet-check -q run/run.sheet
  printf '#!/bin/sh\nexit 6\n' > mine/sheet-info # also where nothing can be made of what there is
  chmod +x mine/sheet-info
  PATH=$PWD/mine:$PATH run -5 sheet-run 'my scene.toml' --quality draft --until 0.05 --fps 40 -o other
}

@test "the same run beside itself is refused, and leaves the folder to the first one" {
  options=(--quality draft --until 0.2 --fps 40 --film no -o run)
  make_slow
  PATH=$PWD/slow:$PATH sheet-run -q 'my scene.toml' "${options[@]}" 2> log &
  whole=$!
  for _ in {1..200}; do
    [[ ! -e run/progress.json ]] || break
    sleep 0.1
  done
  run -6 --separate-stderr sheet-run 'my scene.toml' "${options[@]}"
  [[ $stderr == *'run: another sheet-run is at work there: wait until it has ended, or give another folder'* ]]
  [[ ! -e run/run.csv && ! -e run/picture.png ]]
  kill -TERM $whole
  wait $whole || true
}

@test "five everyday scenes as drafts" {
  for scene in honey-drop honey-spoon honey-roller batter-tray glass-pear; do
    (cd "$BATS_TEST_DIRNAME/../everyday" && sheet-run -q "$scene.toml" --quality draft --until 0.1 --film 64x36 -o "$BATS_TEST_TMPDIR/$scene")
    sheet-check -q "$BATS_TEST_TMPDIR/$scene/run.sheet"
    [[ -s $BATS_TEST_TMPDIR/$scene/film.mp4 && -s $BATS_TEST_TMPDIR/$scene/health.txt ]]
  done
}

@test "other programs are told how far it is, and may show the stream themselves" {
  sheet-run -q 'my scene.toml' --quality draft --until 0.1 --fps 40 --stream-only
  cd 'my scene-draft'
  [[ -s run.sheet && -s run.csv && -s health.txt && ! -e picture.png && ! -e film.mp4 ]]
  python3 - << 'END'
import json
said = json.load(open("progress.json"))
assert said["state"] == "done" and said["time"] == said["until"] == 0.1, said
assert said["frames"] == 5 and said["step"] > 4 and said["steps"] is None and said["elapsed"] > 0 and said["left"] == 0, said
END
  cd ..
  code=0
  sheet-run -q 'my scene.toml' --stream-only --film no 2> log || code=$?
  [[ $code == 2 ]]
  grep -q 'exclude each other' log
}

@test "a run that is interrupted says so to other programs; a file that cannot be written does not end it" {
  make_slow
  sheet-init 'my scene.toml' > first.sheet
  PATH=$PWD/slow:$PATH sheet-loop -q -i first.sheet --until 1 -o run.sheet --progress progress.json -- 'sheet-remesh | sheet-step --dt 1e-3' 2> log &
  whole=$!
  for _ in {1..200}; do
    [[ ! -e progress.json ]] || break
    sleep 0.1
  done
  grep -q '"state": "running"' progress.json
  kill -TERM $whole
  wait $whole || true
  grep -q '"state": "interrupted"' progress.json
  sheet-loop -q -i first.sheet --steps 2 -o same.sheet -- 'sheet-step --dt 1e-3'
  for file in no/such/folder/progress.json /dev/full; do
    sheet-loop -i first.sheet --steps 2 -o short.sheet --progress "$file" -- 'sheet-step --dt 1e-3' 2> log
    [[ $(grep -c -- '--progress: ' log) == 1 ]]
    cmp short.sheet same.sheet
  done
}
@test "a sheet that flows out wholly is a good end, with film, figures and the account of volume" {
  for part in '' '[contact]\nself = true' '[tear]\nbelow = "0.1 mm"\ndrops = true' \
    '[heat]\nconductivity = 0.3\nspecific_heat = 2000\ntemperature = 400' '[[solid]]\nshape = "sphere"\nradius = "5 mm"\ncenter = ["40 mm", 0, 0]'; do
    printf "${part//%/%%}\n" > part
    sed '/^\[\[solid\]\]/,$d' 'my scene.toml' > drains.toml
    printf '%s\n' '[[outflow]]' 'point = [0, "-10 mm", 0]' 'normal = [0, -1, 0]' >> drains.toml
    cat part >> drains.toml
    rm -rf out
    run -0 --separate-stderr sheet-run drains.toml --quality draft --until 0.2 --fps 40 --film 64x36 -o out
    [[ $stderr == *'nothing is left of the sheet at step '*', so the run ends; 5.'*'e-07 m^3 have flowed out'* ]]
    [[ $stderr != *'too early'* ]]
    sheet-check -q out/run.sheet
    [[ $(wc -l < out/run.csv) -lt 9 && -s out/film.mp4 && -s out/health.txt && -s out/picture.png ]]
    sheet-info out/run.sheet > /dev/null
    sheet-run -q drains.toml --quality draft --until 0.4 --fps 40 --film 64x36 -o out # nothing more to come
    sheet-loop -q --resume out/run.sheet --until 1
  done
}
