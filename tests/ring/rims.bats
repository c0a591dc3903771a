#!/usr/bin/env bats
# SPDX-License-Identifier: GPL-3.0-or-later
# Rims of what flows on a solid: they advance, and leave a film instead of retreating.

setup() { cd "$BATS_TEST_TMPDIR" || return; }

# A stripe 30 mm wide, 40 mm high and 4 mm thick, 10 Pa s, on an upright wall: on its own nothing flows sideways, and
# below a top that stays, where it is sqrt(ν y/(g t)) thick [Jeffreys 1930], what is y below it runs down as if it had
# no sides. At 6 s all is so thin, and its volume ends at (3/2 A sqrt(g t/ν))^(2/3), A the area of its profile.
@test "the sides of a stripe on a wall run down with it" {
  cat > stripe.toml << 'END'
[sheet]
shape = "rectangle"
size = ["30 mm", "40 mm"]
edge_length = "3 mm"
thickness = "4 mm"
center = [0, 0, "2 mm"]
rotation = {axis = [1, 0, 0], angle = "90 deg"}
[material]
viscosity = "10 Pa*s"
density = "1400 kg/m^3"
[environment]
gravity = [0, -9.81, 0]
[[solid]]
shape = "box"
size = ["200 mm", "400 mm", "10 mm"]
center = [0, "-100 mm", "-5 mm"]
contact = "flow"
[contact]
adhesion = "100 Pa"
END
  sheet-init stripe.toml |
    sheet-loop -q --until 6 --fps 1 -o stripe.sheet -- 'sheet-remesh --smooth | sheet-step | sheet-collide'
  sheet-check stripe.sheet
  # When what does not retreat was held along its rim, too, the sides were at 65 mm.
  PYTHONPATH=$BATS_TEST_DIRNAME/../../formats/python /usr/bin/python3 - << 'END'
import numpy
import sheetstream

*_, frame = sheetstream.read("stripe.sheet")
x, down = frame["position"][:, 0], 0.02 - frame["position"][:, 1]
law = (1.5 * 0.04 * 0.004 * numpy.sqrt(9.81 * 6 * 1400 / 10)) ** (2 / 3)
fronts = [down[abs(x - middle) < 3e-3].max() / law - 1 for middle in (-0.015, 0, 0.015)]
print(law, fronts, numpy.ptp(x), down.min())
assert max(map(abs, fronts)) < 0.03 and abs(numpy.ptp(x) - 0.03) < 1e-3 and abs(down.min()) < 1e-3
END
}
