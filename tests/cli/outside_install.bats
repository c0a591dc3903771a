#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# What cmake --install puts into a system is all that a user needs there.

bats_require_minimum_version 1.5.0

@test "27: programs, man pages, the Python module, the specification and the licences are installed" {
  cd "$BATS_TEST_TMPDIR"
  DESTDIR=$PWD/root cmake --install "$SHEET_BUILD" > log
  share=$(dirname "$(find root -name sheet.md)")
  [[ $(find root -name 'sheet-*' -path '*/bin/*' | wc -l) == 20 && $(find root -name '*.1.gz' | wc -l) == 20 ]]
  cmp "$share/sheet.md" "$SHEET_SOURCE/formats/sheet.md"
  cmp "$share/LICENSE" "$SHEET_SOURCE/LICENSE"
  cmp "$share/LICENSE.formats" "$SHEET_SOURCE/formats/LICENSE"
  make_grid 3 > grid.sheet
  PYTHONPATH=$(dirname "$(find root -type d -name sheetstream)") /usr/bin/python3 "$share/examples/example_stage.py" --no-provenance < grid.sheet |
    sheet-diff - grid.sheet
}

@test "an installed program finds what it loads for a mesh, and says what is missing without it" {
  cd "$BATS_TEST_TMPDIR"
  cmake --install "$SHEET_BUILD" --prefix "$PWD/usr" --component programs > log
  printf '%s\n' OFF '4 4 0' '0 0 0' '1 0 0' '0 1 0' '0 0 1' '3 0 2 1' '3 0 1 3' '3 0 3 2' '3 1 2 3' > tetrahedron.off
  cat > scene.toml << 'END'
[material]
viscosity = "10 Pa s"
density = "1000 kg/m^3"
[sheet]
shape = "rectangle"
size = ["1 m", "1 m"]
center = ["0 m", "0 m", "3 m"]
edge_length = "100 mm"
thickness = "10 mm"
[[solid]]
shape = "mesh"
file = "tetrahedron.off"
END
  export SHEET_CACHE_DIR=
  usr/bin/sheet-init --check scene.toml
  rm usr/lib/sheet/modules/sheet-level-sets.so
  run ! usr/bin/sheet-init --check scene.toml
  [[ $output == *"level sets cannot be loaded"*"$PWD/usr/lib/sheet/modules/sheet-level-sets.so"* ]]
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
