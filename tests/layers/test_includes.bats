#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# The check of the layers itself: it must see what it is there to see.

setup() {
  mkdir -p "$BATS_TEST_TMPDIR/root"/{formats/cpp,libsheet/{sheet,solve,measure,new},tools}
  cd "$BATS_TEST_TMPDIR/root" || exit
  echo 'int main() {}' > tools/sheet-x.cpp
}
check() { "$BATS_TEST_DIRNAME/includes" "$PWD"; }

@test "this repository" {
  "$BATS_TEST_DIRNAME/includes"
}
@test "an allowed include" {
  echo '#include "libsheet/sheet/sheet.h"' > libsheet/solve/a.cpp
  run check
  [[ $status == 0 && $output == "" ]]
}
@test "a layer above" {
  echo '#include "libsheet/solve/newton.h"' > libsheet/measure/a.h
  run check
  [[ $status == 1 && $output == *"libsheet/measure/a.h:1: measure must not include libsheet/solve/newton.h"* ]]
}
@test "the library in formats" {
  echo '#include "libsheet/base/error.h"' > formats/cpp/a.cpp
  run check
  [[ $status == 1 && $output == *"formats must not include"* ]]
}
@test "a heavy library in a header, and in a wrong layer" {
  echo '#include <CGAL/Surface_mesh.h>' > libsheet/measure/a.h
  echo '#  include <cholmod.h>' > libsheet/sheet/a.cpp
  run check
  [[ $status == 1 && $output == *"must not stand in a header"* && $output == *"CHOLMOD belongs to: linear"* ]]
}
@test "an unknown layer" {
  echo '#include <vector>' > libsheet/new/a.h
  run check
  [[ $status == 1 && $output == *"not known"* ]]
}
@test "a header without a guard" {
  echo '#include <vector>' > libsheet/measure/a.h
  run check
  [[ $status == 1 && $output == *"libsheet/measure/a.h: without #pragma once"* ]]
}
@test "a name whose include is missing" {
  printf '%s\n' '#include <vector>' 'std::vector<double> a(std::max(1, 2)); // std::sort' > libsheet/measure/a.cpp
  echo '#include <Eigen/Core>' > libsheet/sheet/b.h
  printf '%s\n' '#include "libsheet/sheet/b.h"' 'Eigen::Index i;' 'auto s = fmt::format("");' > libsheet/solve/a.cpp
  run "$BATS_TEST_DIRNAME/direct_includes" "$PWD"
  [[ $status == 1 && ${#lines[@]} == 2 ]]
  [[ ${lines[0]} == "libsheet/measure/a.cpp:2: std::max without <algorithm>" ]]
  [[ ${lines[1]} == "libsheet/solve/a.cpp:3: fmt::format without <fmt/...>" ]]
}
