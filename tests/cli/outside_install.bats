#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# What cmake --install puts into a system is all that a user needs there.

bats_require_minimum_version 1.5.0

@test "27: programs, man pages, the Python module, the specification and the licences are installed" {
  cd "$BATS_TEST_TMPDIR"
  DESTDIR=$PWD/root cmake --install "$SHEET_BUILD" > log
  share=$(dirname "$(find root -name sheet.md)")
  [[ $(find root -name 'sheet-*' -path '*/bin/*' | wc -l) == 17 && $(find root -name '*.1' | wc -l) == 17 ]]
  cmp "$share/sheet.md" "$SHEET_SOURCE/formats/sheet.md"
  cmp "$share/LICENSE" "$SHEET_SOURCE/LICENSE"
  cmp "$share/LICENSE.formats" "$SHEET_SOURCE/formats/LICENSE"
  make_grid 3 > grid.sheet
  PYTHONPATH=$(dirname "$(find root -type d -name sheetstream)") /usr/bin/python3 "$share/examples/example_stage.py" --no-provenance < grid.sheet |
    sheet-diff - grid.sheet
}
