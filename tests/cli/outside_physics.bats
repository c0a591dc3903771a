#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# What the pages promise of the physics.

bats_require_minimum_version 1.5.0

@test "5: angular momentum drifts by no more than docs/speed-error.md says" {
  below() { awk -v a="$1" -v b="$2" 'BEGIN{exit !(a < b)}'; }
  below "$("$SHEET_SOURCE/tests/cli/outside_spin" sheet-step)" 6e-4
  below "$("$SHEET_SOURCE/tests/cli/outside_spin" 'sheet-step --tolerance 0.001')" 1e-4
  below "$("$SHEET_SOURCE/tests/cli/outside_spin" 'sheet-remesh --smooth | sheet-step')" 6e-3
  grep -q '4.6e-4 of it with the default steps' "$SHEET_SOURCE/docs/speed-error.md"
}
