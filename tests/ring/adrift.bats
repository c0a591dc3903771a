#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# What floats without inertia, and nothing holds, stays where it is on its bath, and does not turn.

bats_require_minimum_version 1.5.0

# usage: raft MORE_TABLES: runs a raft that tension draws together, with other tables of the scene.
raft() {
  cd "$BATS_TEST_TMPDIR" || exit
  cat > raft.toml << END
[[sheet]]
name = "raft"
shape = "rectangle"
size = ["50 mm", "36 mm"]
edge_length = "3.6 mm"
thickness = "1 mm"
center = [0, "-1 mm", 0]
$1
[material]
viscosity = 4
density = 1300
surface_tension = 0.05
[environment]
gravity = [0, -9.81, 0]
bath = {density = 1500}
[model]
inertia = false
[contact]
self = true
END
  sheet-init raft.toml |
    sheet-loop -q --until 0.3 --fps 10 -o run.sheet -- 'sheet-remesh --smooth | sheet-step | sheet-collide'
}

# In the mean of both sides; of what begins within 30 mm of the middle.
stays() {
  sheet-select --last run.sheet | sheet-export - -o last.obj
  awk '$1 == "v" && $2 < 0.04 {
      for (k = 2; k <= 4; k += 2) { if ($k < low[k]) low[k] = $k; if ($k > high[k]) high[k] = $k }
    }
    END {
      for (k = 2; k <= 4; k += 2) { middle = (low[k] + high[k]) / 2; if (middle ^ 2 > (3e-4) ^ 2) exit 1 }
      turned = (high[2] - low[2]) / (high[4] - low[4]) / (50 / 36)
      exit !(turned > 0.97 && turned < 1.03)
    }' last.obj
}

@test "a raft without inertia does not drift" { # it went 5.2 mm
  raft ''
  stays
}

@test "nor does it beside a sheet that is held" { # likewise, and turned by itself
  raft '[[sheet]]
name = "held"
shape = "rectangle"
size = ["20 mm", "20 mm"]
edge_length = "5 mm"
thickness = "1 mm"
center = ["80 mm", "-1 mm", 0]
[[hold]]
sheet = "held"
region = "rim"'
  stays
}
