// SPDX-License-Identifier: GPL-3.0-or-later
// V43: sheets that air holds back.
#include <algorithm>
#include <array>

#include "tests/validation/setup.h"

namespace sheet::validation {

namespace {

constexpr double water = 1000, air = 1.2, weight = 9.81;          // [kg/m³], [m/s²]
constexpr double across = 1.2, along = 0.01, thinnest = 0.05e-3;  // coefficients of drag and friction, [m]
constexpr std::array thicknesses{thinnest, 0.2e-3, 1e-3, 2.5e-3}; // of sets 1 to 4 [m]

} // namespace

// Sets 1 to 4: a level sheet falls from rest, v = V tanh(g t/V), V² = 2 ρ h g/(C_n ρ_a), until g t = 2 V. Set 5: one is
// thrown along itself, v = v0/(1 + k v0 t), k = C_t ρ_a/(2 ρ h), until it has lost half of its speed. Error: the
// speed's greatest deviation at the end of a step, over V or v0. More: V [m/s].
Result v43(const Settings& s) {
  const bool thrown = s.set == 5;
  const double h = thrown ? thinnest : thicknesses[static_cast<std::size_t>(s.set) - 1];
  const double terminal = std::sqrt(2 * water * h * weight / (across * air)), start_speed = 5;
  const double loss = along * air / (2 * water * h) * start_speed; // [1/s]
  State start = film(make_rectangle(1, 1, mesh_options(s, 1)), h);
  Model m;
  m.liquid.density = water;
  m.air = OuterFlow{.density = air, .drag = across, .friction = along};
  if (thrown)
    std::ranges::fill(start.velocities, Vector3(0, start_speed, 0));
  else
    m.gravity = Vector3(0, 0, -weight);
  const double scale = thrown ? start_speed : terminal;
  double worst = 0;
  Run run(std::move(start), m, s, 1);
  run.advance(thrown ? 1 / loss : 2 * terminal / weight, s.steps, [&](const State& at) {
    const double exact =
        thrown ? start_speed / (1 + loss * at.time) : terminal * std::tanh(weight * at.time / terminal);
    for (const Vector3& v : at.velocities) {
      const double off = ((thrown ? v.y() : -v.z()) - exact) / scale;
      worst = std::abs(off) > std::abs(worst) ? off : worst;
    }
  });
  Result result = run.result(1 + worst);
  result.more = {{"terminal_speed", terminal}};
  return result;
}

} // namespace sheet::validation
