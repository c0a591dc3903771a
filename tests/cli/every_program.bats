#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# What every program has in common: help, version, man page, completion, refusals. PROGRAM is the one to test.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
  io=6
  [[ $PROGRAM != sheet-diff ]] || io=2 # it has the codes of diff(1)
}

@test "--help explains itself with examples, and fits the screen" {
  "$PROGRAM" --help > help
  head -1 help | grep -q "^$PROGRAM - "
  grep -q '^Usage: ' help
  grep -q '^Examples:' help
  grep -q -- '--threads' help
  [[ $(wc -L < help) -le 100 ]]
  [[ $("$PROGRAM" -h --nonsense) == "$(cat help)" ]]
}

@test "--version" {
  [[ $("$PROGRAM" --version) =~ ^$PROGRAM\ [0-9]+\.[0-9]+\.[0-9]+$ ]]
}

@test "--man renders without warnings" {
  "$PROGRAM" --man > page.1
  man --warnings -E UTF-8 -l -Tutf8 -Z page.1 2> warnings > /dev/null
  [[ ! -s warnings ]]
  MANWIDTH=200 man -E UTF-8 -l page.1 | col -b > text
  for part in NAME SYNOPSIS DESCRIPTION OPTIONS 'EXIT STATUS' EXAMPLES 'SEE ALSO'; do
    grep -q "^$part" text
  done
}

@test "--completion is a bash script that offers the options" {
  "$PROGRAM" --completion > script
  bash -n script
  source ./script
  COMP_WORDS=("$PROGRAM" --ver) COMP_CWORD=1
  "_${PROGRAM//-/_}"
  [[ " ${COMPREPLY[*]} " == *" --version "* && " ${COMPREPLY[*]} " == *" --verbose "* ]]
}

@test "an unknown option is refused with the nearest one, exit code 2" {
  run -2 --separate-stderr "$PROGRAM" --thread 1 2
  [[ $stderr == "$PROGRAM: "*"did you mean --threads?"* && $output == "" ]]
  run -2 "$PROGRAM" --threads many
  run -2 "$PROGRAM" -q -v
}

@test "an option that has nothing behind its = has an empty value, not the next word" {
  run -2 --separate-stderr "$PROGRAM" --threads= 1
  [[ $stderr == "$PROGRAM: "*"--threads: "*"nothing is given"* ]]
}

@test "an empty text in the place of a name or a value is refused with what it comes of, and nothing is written" {
  mkdir here && cd here
  run -2 --separate-stderr "$PROGRAM" ''
  [[ $stderr == "$PROGRAM: "*": nothing is given: \"\" is what a variable gives that is not set"* && $output == "" ]]
  [[ $("$PROGRAM" --help) == *--output* ]] || return 0
  run -2 --separate-stderr "$PROGRAM" -o '' none.sheet
  [[ $stderr == "$PROGRAM: "*-o*": nothing is given"* && $output == "" ]]
  [[ -z $(ls -A) ]]
}

@test "--help to a full disk is an error" {
  run "-$io" bash -c '"$PROGRAM" --help > /dev/full'
}

@test "--help to a closed standard output is an error, not silence" {
  run "-$io" bash -c '"$PROGRAM" --help >&-'
}

# The programs that read a stream from standard input when called without arguments, and what makes them write.
stream_reader() {
  case $PROGRAM in
  sheet-init | sheet-loop | sheet-diff | sheet-parse | sheet-run) return 1 ;;
  sheet-export) arguments=(--format obj -o -) ;;
  sheet-step) arguments=(--dt 0.01) ;;
  sheet-remesh) arguments=(--edge-length 1) ;;
  sheet-watch) arguments=(--port 0 -q) ;;
  sheet-render) arguments=(--ppm --size 32x18 --samples 2) ;;
  *) arguments=() ;;
  esac
}

@test "standard input closed, empty, or not a stream" {
  stream_reader || skip "reads no stream from standard input"
  run -6 bash -c '"$PROGRAM" "$@" <&- > out' _ "${arguments[@]}"
  run -4 bash -c '"$PROGRAM" "$@" < /dev/null > out' _ "${arguments[@]}"
  run -4 bash -c 'head -c 1000 /dev/zero | "$PROGRAM" "$@" > out' _ "${arguments[@]}"
  run -6 bash -c '"$PROGRAM" none.sheet "$@" > out' _ "${arguments[@]}"
}

@test "output to a full disk is exit code 6, a reader that has gone is none" {
  stream_reader || skip "reads no stream from standard input"
  [[ $PROGRAM != sheet-check ]] || skip "prints nothing if all is well"
  if [[ $PROGRAM == sheet-@(step|emit|tear|merge|collide) ]]; then # they need a scene
    sheet-init - > grid.sheet << 'END'
[sheet]
shape = "disk"
radius = 1
edge_length = 0.2
thickness = 0.01
[material]
viscosity = 100
density = 1000
END
  else
    make_grid 40 > grid.sheet
  fi
  run -6 bash -c '"$PROGRAM" "$@" < grid.sheet > /dev/full' _ "${arguments[@]}"
  [[ $output == "$PROGRAM: "* ]]
  run -0 bash -c '(sleep 0.2; "$PROGRAM" "$@" < grid.sheet; echo $? > code) | true; cat code' _ "${arguments[@]}"
  [[ $output == 0 ]]
}
