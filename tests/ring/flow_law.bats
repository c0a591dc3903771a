#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# What is seen of liquids that are not Newtonian, and only of those.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_TMPDIR" || exit
}

# usage: run_ring NAME LAW: a strip, clamped at both ends and pulled to twice its length in 1 s
run_ring() {
  cat > "$1.toml" << END
[sheet]
shape = "rectangle"
size = [0.1, 0.04]
edge_length = 0.02
thickness = 0.002
[material]
$2
[model]
inertia = false
[[hold]]
region = "x_min"
[[hold]]
region = "x_max"
motion = {kind = "translating", velocity = [0.1, 0, 0]}
END
  sheet-init "$1.toml" | sheet-loop -q --steps 2 -o "$1.sheet" -- 'sheet-step --dt 0.01'
}

# usage: column NAME FILE: of the last frame
column() {
  sheet-info --csv "$2" | awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) c = i } END { print $c }'
}

@test "sheet-info tells rate of strain, viscosity and the part at rest" {
  run_ring bingham $'law = "bingham"\nviscosity = 3\nyield_stress = 20'
  run_ring newtonian 'viscosity = 3'
  sheet-info --csv newtonian.sheet > csv
  sheet-info --json newtonian.sheet > json
  sheet-info newtonian.sheet > text
  ! grep -E 'viscosity|strain_rate|at.rest|rate of strain' csv json text
  # pulled by 1/s at its middle line: at least sqrt(3)/s if its sides were free, 2/s held
  python3 - "$(column strain_rate_mean bingham.sheet)" "$(column viscosity_min bingham.sheet)" \
    "$(column viscosity_max bingham.sheet)" "$(column strain_rate_max bingham.sheet)" \
    "$(column strain_rate_min bingham.sheet)" "$(column part_at_rest bingham.sheet)" << 'END'
import sys
mean, least, most, fastest, slowest, rests = map(float, sys.argv[1:])
assert 1.6 < mean < 2.4, mean
assert abs(least - (3 + 20 / fastest)) < 1e-4 * least, (least, fastest)
assert abs(most - (3 + 20 / slowest)) < 1e-4 * most, (most, slowest)
assert rests == 0
END
  sheet-info --json bingham.sheet | python3 -c 'import json, sys
m = json.load(sys.stdin)[-1]["measurements"]
assert m["part_at_rest"] == 0 and m["viscosity"]["max"] > m["viscosity"]["min"] > 3 and "min" in m["strain_rate"]'
  sheet-info bingham.sheet | grep -q '^  part at rest  *0$'
}

@test "what nothing pulls is at rest, and a run may end there" {
  run_ring bingham $'law = "bingham"\nviscosity = 3\nyield_stress = 20'
  sed 's/velocity = .*/velocity = [0, 0, 0]}/' bingham.toml > still.toml
  sheet-init still.toml | sheet-loop -q --steps 5 --stop-when 'part_at_rest > 0.99' -o still.sheet -- 'sheet-step --dt 0.01'
  [[ $(column part_at_rest still.sheet) == 1 && $(sheet-info --csv still.sheet | tail -n 1 | cut -d, -f 1) == [01] ]]
}

@test "looks and exports have them" {
  run_ring bingham $'law = "bingham"\nviscosity = 3\nyield_stress = 20'
  run_ring newtonian 'viscosity = 3'
  for look in strain_rate viscosity log_viscosity; do
    sheet-render bingham.sheet --frames -1 --look $look --size 64x36 -o $look.png
  done
  run -3 --separate-stderr sheet-render newtonian.sheet --frames -1 --look viscosity --size 64x36 -o none.png
  [[ $stderr == *"one viscosity"*"[material] law"* ]]
  sheet-export bingham.sheet -o 'bingham_%d.vtu'
  sheet-export newtonian.sheet -o 'newtonian_%d.vtu'
  grep -q 'Name="log_viscosity"' bingham_2.vtu
  grep -q 'Name="strain_rate"' bingham_2.vtu
  ! grep -q 'viscosity\|strain_rate' newtonian_2.vtu
}

@test "--check tells what flows and what stands" {
  run_ring bingham $'law = "bingham"\nviscosity = 3\nyield_stress = 20\ndensity = 1000'
  printf '[environment]\ngravity = [0, -9.81, 0]\n' >> bingham.toml
  sheet-init --check bingham.toml > told
  grep -q '^  flow law  *Bingham: stands below 20 Pa; what is above flows with 3 Pa s$' told
  grep -q '^  mu_V ' told
  grep -q '^  weight against yield = rho g L / tau_y = 19.6$' told
  grep -q '= 0.00353 m hangs: 0.04 m flow' told
}
