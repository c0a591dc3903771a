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

@test "23: the example's own command runs" {
  command=$(grep -m1 '^    sheet-init' formats/python/example_stage.py | sed 's#./example_stage.py#formats/python/example_stage.py#')
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
