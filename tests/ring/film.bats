#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# pipelines/film: a film in parts has the same pictures as one in one go.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_DIRNAME/../.." || exit
  t=$BATS_TEST_TMPDIR
  look=(--size 80x48 --samples 2)
}

# usage: parts FILM: the parts of a film as one y4m stream
parts() {
  local part
  head -1 "$1.parts/runs/000/000/part.y4m"
  for part in "$1".parts/runs/000/*/part.y4m; do tail -n +2 "$part"; done
}

@test "parts have the bits of one process, camera, scale and ground as well, by every engine" {
  sheet-init pipelines/catenary/scene.toml | sheet-loop --until 0.4 --fps 20 -o "$t/run.sheet" -- 'sheet-step --dt 0.05'
  for option in --denoise '--look thickness'; do
    # shellcheck disable=SC2086
    sheet-render "$t/run.sheet" "${look[@]}" $option --y4m > "$t/whole.y4m"
    for engine in plain parallel; do
      # shellcheck disable=SC2086
      pipelines/film "$t/run.sheet" "$t/$engine${option// /}.mp4" --engine $engine --part 2 -- "${look[@]}" $option
      parts "$t/$engine${option// /}.mp4" | cmp - "$t/whole.y4m"
    done
    # What the option --view-of is for: without it parts do not fit together.
    # shellcheck disable=SC2086
    ! sheet-render "$t/run.sheet" "${look[@]}" $option --frames 0-1 --y4m | cmp -s - "$t/plain${option// /}.mp4.parts/runs/000/000/part.y4m"
  done
  [[ $(ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 "$t/parallel--denoise.mp4") == 9 ]]
}

@test "a film that was killed goes on; one of another stream is refused" {
  sheet-init pipelines/catenary/scene.toml | sheet-loop --until 0.4 --fps 20 -o "$t/run.sheet" -- 'sheet-step --dt 0.05'
  sheet-render "$t/run.sheet" "${look[@]}" --y4m > "$t/whole.y4m"
  pipelines/film "$t/run.sheet" "$t/a.mp4" --part 1 -- "${look[@]}" &
  until [[ -e $t/a.mp4.parts/runs/000/002/result.json ]]; do sleep 0.02; kill -0 $! || break; done
  kill -9 $!
  wait $! || true
  [[ ! -e $t/a.mp4 ]]
  stat -c %Y%i "$t/a.mp4.parts/runs/000/000/result.json" > "$t/before"
  pipelines/film "$t/run.sheet" "$t/a.mp4" --part 1 -- "${look[@]}"
  stat -c %Y%i "$t/a.mp4.parts/runs/000/000/result.json" | cmp - "$t/before"
  parts "$t/a.mp4" | cmp - "$t/whole.y4m"
  run -2 pipelines/film "$t/run.sheet" "$t/a.mp4" --part 1 -- --size 40x24
  [[ $output == *"has parts of another film"* ]]
  run -2 pipelines/film "$t/run.sheet" "$t/b.mp4" -- --turntable 24
  [[ $output == *"--turntable"*"sheet-render itself"* && ! -e $t/b.mp4.parts ]]
  run -2 bash -c "sheet-render - --view-of 0- -o $t/x.png < /dev/null"
  run -3 sheet-render "$t/run.sheet" --frames 0 --view-of 90 -o "$t/x.png"
  [[ $output == *"--view-of 90"*"no such frames"* ]]
}

@test "a stream whose scene names a mesh" {
  pipelines/meshes
  sheet-init pipelines/bunny/scene.toml --set 'sheet.segments=[8,8]' -o "$t/run.sheet"
  (cd "$t" && ln -s "$OLDPWD/out" out && "$OLDPWD/pipelines/film" run.sheet a.mp4 --engine plain -- "${look[@]}")
  [[ -e $t/a.mp4.parts/inputs/bunny00.off ]]
}
