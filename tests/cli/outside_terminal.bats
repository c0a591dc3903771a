#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# Whatever a file holds, no program sends to a terminal what would command it.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
  make_grid 3 > plain.sheet
  { sheet-print plain.sheet | sed '$d'
    printf 'array provenance frame text 1 1 copy\n| 1 sheet-x \e]0;owned\a\e[2J \302\233 ä\n'
    printf 'array scene frame text 1 1 copy\n| [sheet]\n| "\e[31mkey" = 1\n| name = "\e[31m\u009b"\nend\n'; } | sheet-parse > evil.sheet
  printf '[sheet]\nshape = "disk"\n"a\e[2Jb" = 1\n[material]\nviscosity = 1\n' > evil.toml
  cp evil.sheet $'evil\e[2J.sheet'
}

tame() { # FILE: no control characters but tab, line break and carriage return, none of C1
  run -1 env LC_ALL=C grep -aP '[\x00-\x08\x0b\x0c\x0e-\x1f\x7f]|\xc2[\x80-\x9f]' "$1"
}

@test "20: no escape sequence of a file, a name or a key reaches the terminal" {
  for command in 'sheet-info evil.sheet' 'sheet-info --csv evil.sheet evil*.sheet' 'sheet-info --json evil.sheet' \
    'sheet-check evil.sheet' 'sheet-check --json evil.sheet' 'sheet-print evil.sheet' 'sheet-init evil.toml' \
    'sheet-init --check evil.toml' 'sheet-step --dt 1 evil.sheet' 'sheet-collide evil.sheet' 'sheet-diff evil.sheet plain.sheet' \
    $'sheet-pass evil\e[2J.sheet extra' $'sheet-pass none\e[2J' $'sheet-pass --x\e[2J' $'sheet-loop --steps 1 -i evil.sheet -o o.sheet -- no\e[2J'; do
    script -qec "$command" /dev/null < /dev/null > seen || true
    tame seen
  done
  sheet-info evil.sheet | grep -q '\\x1b\]0;owned\\x07\\x1b\[2J \\u009b ä'
  sheet-print evil.sheet | sheet-parse | cmp - evil.sheet # but text stays lossless where a program reads it
}
