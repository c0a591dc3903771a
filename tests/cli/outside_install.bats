#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# What cmake --install puts into a system is all that a user needs there.

bats_require_minimum_version 1.5.0

@test "27: programs, man pages, the Python module, the specification and the licences are installed" {
  cd "$BATS_TEST_TMPDIR"
  DESTDIR=$PWD/root cmake --install "$SHEET_BUILD" > log
  share=$(dirname "$(find root -name sheet.md)")
  [[ $(find root -name 'sheet-*' -path '*/bin/*' | wc -l) == 18 && $(find root -name '*.1.gz' | wc -l) == 18 ]]
  cmp "$share/sheet.md" "$SHEET_SOURCE/formats/sheet.md"
  cmp "$share/LICENSE" "$SHEET_SOURCE/LICENSE"
  cmp "$share/LICENSE.formats" "$SHEET_SOURCE/formats/LICENSE"
  make_grid 3 > grid.sheet
  PYTHONPATH=$(dirname "$(find root -type d -name sheetstream)") /usr/bin/python3 "$share/examples/example_stage.py" --no-provenance < grid.sheet |
    sheet-diff - grid.sheet
}

@test "27: a C++ program outside finds the readers and reads a stream with them" {
  cd "$BATS_TEST_TMPDIR"
  cmake --install "$SHEET_BUILD" --prefix "$PWD/usr" --component formats-dev > log
  grep -q 'lib/python3/dist-packages/sheetstream/__init__.py' log
  local more=()
  if grep -q 'SHEET_SANITIZE:BOOL=ON' "$SHEET_BUILD/CMakeCache.txt"; then # the readers need its runtime
    more=(-DCMAKE_CXX_FLAGS=-fsanitize=address,undefined)
  fi
  cmake -S "$SHEET_SOURCE/formats/cpp/example" -B example -DCMAKE_PREFIX_PATH="$PWD/usr" "${more[@]}" > log 2>&1 || { cat log; false; }
  cmake --build example > log 2>&1 || { cat log; false; }
  make_grid 3 > grid.sheet
  [[ $(example/least_volume < grid.sheet) == "0 1e-06" ]] # as sheet-print shows them
  run -1 example/least_volume < <(head -c 300 grid.sheet)
  [[ $output == *"standard input"* ]]
}
