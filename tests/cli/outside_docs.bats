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

@test "23: every command of every page runs" {
  "$SHEET_SOURCE/pipelines/meshes"
  ln -s "$SHEET_SOURCE/out" .
  sheet-init --example | sed 's/^edge_length = .*/edge_length = 0.1/' > scene.toml
  pages | while read -r page; do
    "$SHEET_SOURCE/tests/cli/doc_commands.py" "$SHEET_SOURCE/$page" > commands
    [[ -s commands ]] || continue
    rm -f run.mp4
    sheet-init scene.toml --set sheet.edge_length=0.2 -o a.sheet
    sheet-loop -q -i a.sheet --steps 13 -o run.sheet -- 'sheet-step --dt 1e-5'
    {
      echo 'set -eo pipefail'
      echo 'sheet-render() { command sheet-render "$@" --size 32x18 --samples 2; }'
      cat commands
    } > script
    bash script > printed 2> log || { echo "$page"; cat commands log; false; }
  done
  [[ $("$SHEET_SOURCE/tests/cli/doc_commands.py" "$SHEET_SOURCE/README.md" | wc -l) -ge 6 ]]
}

@test "23: the example's own command runs" {
  command=$(grep -m1 '^    sheet-init' formats/python/example_stage.py | sed 's#./example_stage.py#formats/python/example_stage.py#')
  bash -o pipefail -c "$command"
  sheet-check --no-intersections windy.sheet
}

@test "24: every page and every program's help has the stages of a ring in one order" {
  {
    for page in $(pages); do
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
