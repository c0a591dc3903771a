#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# The default ring, steps chosen by their error, in a scene that touches itself and folds.

bats_require_minimum_version 1.5.0

@test "honey on a tilted plate does not stall" {
  sheet-init "$BATS_TEST_DIRNAME/../../pipelines/honey/scene.toml" |
    sheet-loop --until 0.25 --fps 25 -- 'sheet-remesh --smooth | sheet-emit | sheet-step -v --tolerance 0.001 | sheet-collide' \
      > "$BATS_TEST_TMPDIR/honey.sheet" 2> "$BATS_TEST_TMPDIR/log"
  # Before sharp folds held their directors: stuck at 0.1884 s, with steps of nanoseconds and hundreds of iterations.
  sed -n 's/^sheet-step: step .* dt = \([^ ]*\) s, \([0-9]*\) Newton.*/\1 \2/p' "$BATS_TEST_TMPDIR/log" |
    awk '{ if ($1 < 5e-6) short++; iterations += $2 } END { print NR, short + 0, iterations; exit !(NR > 100 && NR < 2500 &&
         short + 0 == 0 && iterations < 4 * NR) }'
  run ! grep -q warning "$BATS_TEST_TMPDIR/log"
  sheet-check "$BATS_TEST_TMPDIR/honey.sheet"
}
