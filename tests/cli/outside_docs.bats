#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# What the pages say can be typed, and they say one thing.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
  for folder in formats pipelines tests; do
    ln -s "$SHEET_SOURCE/$folder" .
  done
}

# The pages of the repository.
pages() { (cd "$SHEET_SOURCE" && ls README.md docs/*.md docs/scenes/*.md); }

# usage: run_commands NAME: runs the script `commands`; every program in it must end well, also within pipes.
run_commands() {
  {
    echo 'set -eo pipefail'
    for program in "$SHEET_BUILD"/bin/sheet-*; do
      program=$(basename "$program")
      local more=
      [[ $program != sheet-render ]] || more='--size 32x18 --samples 2'
      echo "$program() { command $program \"\$@\" $more || ended $program \$? \"\$*\"; }"
    done
    cat << 'END'
ended() { [[ $1 == sheet-diff && $2 == 1 ]] || echo "$*" >> failures; return "$2"; }
less() { cat > /dev/null; }
paraview() { :; }
END
    cat commands
  } > script
  rm -f failures run.mp4 bunny.mp4
  bash script > printed 2> log && [[ ! -e failures ]] || { echo "$1"; cat commands log failures; false; }
}

# What the commands start from.
prepare_files() {
  sheet-init --example | sed 's/^edge_length = .*/edge_length = 0.1/' > scene.toml
  cp scene.toml a.toml
  cp scene.toml bunny.toml
  sed 's/^edge_length = .*/edge_length = 0.1/' pipelines/curtain/scene.toml > curtain.toml
  sheet-init scene.toml --set sheet.edge_length=0.2 -o a.sheet
  sheet-print a.sheet > hand-written.txt
  cp a.sheet b.sheet
  sheet-loop -q -i a.sheet --steps 13 -o run.sheet -- 'sheet-step --dt 1e-5'
}

@test "23: every command of every page runs" {
  "$SHEET_SOURCE/pipelines/meshes"
  ln -s "$SHEET_SOURCE/out" .
  pages | while read -r page; do
    "$SHEET_SOURCE/tests/cli/doc_commands.py" "$SHEET_SOURCE/$page" > commands
    [[ -s commands ]] || continue
    prepare_files
    run_commands "$page"
  done
  [[ $("$SHEET_SOURCE/tests/cli/doc_commands.py" "$SHEET_SOURCE/README.md" | wc -l) -ge 6 ]]
}

@test "the quickstart builds every program, and Blender's add-on" {
  mkdir -p clone/{pipelines/bunny,tests,bin}
  cp "$SHEET_SOURCE/pipelines/quickstart" clone/pipelines/
  ln -s "$SHEET_SOURCE/tools" clone/
  for program in clone/{pipelines/bunny/run,tests/install,bin/cmake}; do
    printf '#!/bin/sh\necho "$@"\n' > "$program"
    chmod +x "$program"
  done
  PATH=$PWD/clone/bin:$PATH clone/pipelines/quickstart > told
  targets=" $(sed -n 's/^--build .*--target //p' told) "
  for program in "$SHEET_BUILD"/bin/sheet-*; do
    [[ $targets == *" ${program##*/} "* ]]
  done
  [[ $targets == *' blender_add_on '* ]]
  grep -q "^  export PATH=.*/clone/build/bin:" told
}

@test "README's commands run in a shell that knows nothing of the programs" {
  ln -s "$SHEET_BUILD" build
  prepare_files
  {
    grep -m1 '^    export PATH=' "$SHEET_SOURCE/README.md"
    echo 'set -eo pipefail'
    "$SHEET_SOURCE/tests/cli/doc_commands.py" "$SHEET_SOURCE/README.md" | grep -v '^sheet-run\|ffmpeg'
  } > commands
  grep -q "sheet-emit" commands
  env -i HOME="$HOME" PATH=/usr/bin:/bin bash commands
}

@test "23: every example of every program's help runs" {
  local program told=0
  for program in "$SHEET_BUILD"/bin/sheet-*; do
    prepare_files
    "$program" --help | sed -n '/^Examples:/,$s/^  sheet-/    sheet-/p' > help
    "$SHEET_SOURCE/tests/cli/doc_commands.py" help > commands
    [[ $(wc -l < commands) == "$(wc -l < help)" && -s commands ]]
    run_commands "$program"
    told=$((told + $(wc -l < commands)))
  done
  [[ $told -ge 30 ]]
}

@test "every liquid of docs/liquids.md is one that a scene may have" {
  awk -v RS= '/^    \[material\]/ { print > ("liquid" ++n ".toml") }' "$SHEET_SOURCE/docs/liquids.md"
  for liquid in liquid*.toml; do
    {
      printf '[sheet]\nshape = "disk"\nradius = "50 mm"\nedge_length = "10 mm"\nthickness = "5 mm"\n'
      cat "$liquid"
      printf '[environment]\ngravity = [0, "-9.81 m/s^2", 0]\n[[solid]]\nshape = "plane"\ncontact = "flow"\n'
    } > scene.toml
    sheet-init --check scene.toml > told
    # Nothing drives what stands by its yield stress.
    grep -q -e '^  V ' -e 'A layer of .* and this length stands' told
    ! grep -q '^law = ' <(sed 's/^ *//' "$liquid") || grep -q '^  flow law  ' told
  done
  [[ -e liquid8.toml ]]
}

@test "23: the example's own command runs" {
  command=$(sed -n '/^    sheet-init/,/> windy.sheet$/p' formats/python/example_stage.py | tr -s ' \n' ' ' | sed 's#./example_stage.py#formats/python/example_stage.py#')
  bash -o pipefail -c "$command"
  sheet-check --no-intersections windy.sheet
}

@test "24: every page and every program's help has the stages of a ring in one order" {
  {
    for page in $(pages) pipelines/common.sh $(cd "$SHEET_SOURCE" && ls pipelines/*/run); do
      sed "s#^#$page: #" "$SHEET_SOURCE/$page"
    done
    for program in init loop step remesh tear emit collide; do
      "sheet-$program" --help | sed "s#^#help of $program: #"
    done
  } | grep -E 'sheet-[a-z]+[^|]*\|' | awk '
    BEGIN { split("remesh tear emit step collide", names); for (i in names) place["sheet-" names[i]] = i }
    { where = $1; n = split($0, parts, "[|`]"); last = 0
      if ($0 ~ /^[^ ]*:? *\|/) next # a table
      for (i = 1; i <= n; ++i)
        if (match(parts[i], /sheet-(remesh|tear|emit|step|collide)/)) {
          now = place[substr(parts[i], RSTART, RLENGTH)]
          if (now < last) { print $0; bad = 1 }
          last = now
        } else if (parts[i] ~ /sheet-(loop|init)/) last = 0
    }
    END { exit bad }'
}
