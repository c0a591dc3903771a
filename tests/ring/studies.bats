#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# The studies that are sweeps, small: convergence, folds, the sheared ring.

bats_require_minimum_version 1.5.0

setup() {
  cd "$BATS_TEST_DIRNAME/../.." || exit
  t=$BATS_TEST_TMPDIR
}

@test "arithmetic of scripts: numbers by name, rows of CSV with columns by name" {
  [[ $(pipelines/reckon 'e * 0.7' 'u / 4' e=0.005 u=1) == '0.0035 0.25' ]]
  [[ $(pipelines/reckon -f '[%d,%d]' '0.4 / e + 0.5' 'sqrt(4)' e=0.03) == '[13,2]' ]]
  run -2 pipelines/reckon 'e * 0.7' f=1
  printf 'a [m],kind,b\n1,x,\n2,y,3\n' > "$BATS_TEST_TMPDIR/rows.csv"
  PYTHONPATH=pipelines /usr/bin/python3 - "$BATS_TEST_TMPDIR/rows.csv" << 'END'
import math, sys, columns
rows = columns.read(sys.argv[1])
assert [row["a"] for row in rows] == [1, 2] and [row["kind"] for row in rows] == ["x", "y"], rows
assert math.isnan(rows[0]["b"]) and rows[1]["b"] == 3, rows
assert columns.slope([(0, 1), (1, 3), (2, 5)]) == 2 and math.isnan(columns.slope([(0, 1)]))
END
}

@test "convergence: a balloon's area, extrapolated, against the closed form; orders are two" {
  run -0 pipelines/convergence/run pipelines/balloon/scene.toml --measure end.area --edges 0.3,0.2,0.14 --steps 0.04,0.02,0.01 \
    --set 'sheet.edge_length={edge}' --until 0.32 --fps 25 -o "$t/study" -- 'sheet-step --dt {step}'
  # r = r_0 (1 - p r_0 t / (4 mu h_0))^(-1/3) [V1]: the finest run is 1.5 % off.
  awk '/^edges: order/ { edges = $3 + 0 } /^steps: order/ { steps = $3 + 0 } /^end.area/ { value = $3; bar = $5; finest = $8 + 0 }
    END { exact = 16 * atan2(1, 1) * 0.2 ^ (-2 / 3); off = value - exact; if (off < 0) off = -off
      exit !(edges > 1.6 && edges < 2.4 && steps > 1.6 && steps < 2.4 && off < bar && off < (exact - finest) / 5 && finest < 0.99 * exact) }' \
    <<< "$output" || { echo "$output"; false; }
  [[ -s $t/study/convergence.png && $(wc -l < "$t/study/convergence.csv") == 10 ]]
  run -3 pipelines/convergence/run pipelines/balloon/scene.toml --measure end.are --edges 0.3,0.2,0.14 --steps 0.04,0.02,0.01 \
    --set 'sheet.edge_length={edge}' --until 0.32 --fps 25 -o "$t/study" -- 'sheet-step --dt {step}'
  [[ $output == *"no column end.are;"* ]]
  run -2 pipelines/convergence/run pipelines/balloon/scene.toml --measure end.area --edges 0.3,0.2 --steps 0.04,0.02,0.01 --until 0.32 -- 'sheet-step'
}

@test "Richardson: order and limit of made-up values; values that do not fall into line get a wide bar" {
  /usr/bin/python3 - << 'END'
import importlib.machinery, importlib.util
loader = importlib.machinery.SourceFileLoader("study", "pipelines/convergence/run")
study = importlib.util.module_from_spec(importlib.util.spec_from_loader("study", loader))
loader.exec_module(study)
for p in (1, 1.5, 2, 4):
    lengths = [0.01, 0.015, 0.021]
    order, correction, bar = study.richardson(lengths, [3 + 7 * e**p for e in lengths])
    assert abs(order - p) < 1e-6 and abs(correction + 7 * 0.01**p) < 1e-9 and abs(bar - 1.25 * abs(correction)) < 1e-12
assert study.richardson([1, 2, 4], [1.0, 1.1, 1.0]) == (None, 0.0, 3 * (1.1 - 1.0))
END
}

@test "folds: a line a run, the longer the higher the slot" {
  OUT=$t/folds run -0 pipelines/fold-diagram/run 0.008 3 2 2
  awk -F, '!/^#/ { n++; if ($2 < 0.04) low = $4; else high = $4 } END { exit !(n >= 2 && high > low) }' "$t/folds/law.csv"
  [[ -s $t/folds/law.png && -s $t/folds/period.png ]]
}

@test "the sheared ring: waves above the threshold, none below it" {
  OUT=$t/ring run -0 pipelines/annulus-diagram/run 0.02 0.008,0.036 0.0728,0.1456
  awk '/^rate/ { gsub(/[,:]/, ""); if ($2 == 0.036 && $4 == 0.0728) high = $6; if ($2 == 0.008 && $4 == 0.1456) low = $6 }
    END { exit !(high > 5 * low && low < 0.1) }' <<< "$output" || { echo "$output"; false; }
  [[ -s $t/ring/diagram.png && -s $t/ring/loop.png ]]
}

@test "neck-in: a film as wide as it is long keeps half of its width at a draw ratio of 5, a narrow one less" {
  OUT=$t/neck run -0 pipelines/film-casting/neck-in 1,2 5 4
  awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i }
    NR > 1 { if ($c["aspect"] == 1) one = $c["width_at_roll"]; else two = $c["width_at_roll"] }
    END { exit !(one > 0.48 && one < 0.54 && two > 0.45 && two < one) }' "$t/neck/neck-in/results.csv"
  [[ -s $t/neck/neck-in.png ]]
}

@test "draw resonance: theory is the closed equation's of a Newtonian film; a film that thins swings as theory says" {
  # n = 1: (1 - z1) (Ei(z0) - Ei(z1)) = e^z1 - e^z0, z0 = λ/ln D, z1 = z0/D, from a = ds/dz, s = f + A z + B (z Ei(z) -
  # e^z), of the equations in resonance.py with z = λ e^(-x ln D)/ln D.
  PYTHONPATH=pipelines:pipelines/film-casting /usr/bin/python3 << 'END'
import numpy as np, resonance
draw, frequency = resonance.critical(1)
assert abs(draw - 20.217988) < 1e-6 and abs(frequency - 14.011093) < 1e-6, (draw, frequency)
slot = 1j * frequency / np.log(draw)
roll = slot / draw
place, weight = np.polynomial.legendre.leggauss(40)
between = np.log(draw) / 2 * np.sum(weight * np.exp(roll * np.exp(np.log(draw) / 2 * (place + 1))))  # ∫ e^z/z dz
assert abs((1 - roll) * between - np.exp(roll) + np.exp(slot)) < 1e-10
END
  OUT=$t/cast run -0 pipelines/film-casting/critical 0.8 0.04 1600
  # With four times shorter edges within 1 % (docs/scenes/film-casting.md).
  awk -F, 'END { exit !($2 / $4 > 0.96 && $2 / $4 < 1.04 && $3 / $5 > 0.98 && $3 / $5 < 1.02) }' "$t/cast/critical.csv"
  [[ -s $t/cast/critical.png ]]
}
