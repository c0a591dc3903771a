// SPDX-License-Identifier: GPL-3.0-or-later
// Terms of a liquid that is as warm everywhere are those of the liquid that it is at that temperature.
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "libsheet/energy/area_loads.h"
#include "libsheet/energy/assembly.h"
#include "libsheet/energy/hinge.h"
#include "libsheet/energy/membrane.h"
#include "libsheet/energy/mid_edge_shell.h"
#include "libsheet/energy/stage_setup.h"
#include "libsheet/energy/surface_tension.h"
#include "libsheet/energy/wall_drag.h"
#include "libsheet/material/shifted_liquid.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

constexpr double cold = 300;

std::vector<FlowLaw> warm_laws() {
  using enum FlowLawKind;
  return {{},
          {.kind = power, .flow_index = 0.4, .rest_rate = 0.2},
          {.kind = carreau, .flow_index = 0.3, .infinite_viscosity = 0.2, .time_constant = 1.5},
          {.kind = bingham, .yield_stress = 3, .rest_rate = 0.2}};
}

Liquid thermal(const FlowLaw& law) {
  Liquid liquid{.viscosity = 2, .density = 3, .surface_tension = 0.7, .law = law};
  liquid.temperature_law = {
      .kind = TemperatureLawKind::arrhenius, .reference_temperature = 320, .activation_energy = 5e4};
  liquid.surface_tension_slope = -0.01;
  return liquid;
}

// A crumpled sphere that moves.
State warm_crumpled() {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&](double size) -> Vector3 {
    const double a = uniform(engine), b = uniform(engine);
    return size * Vector3(a, b, uniform(engine));
  };
  State s = test::at_rest(test::icosphere(1), 0.3);
  for (Vector3& x : s.positions)
    x += vector(0.1);
  for (Vector3& v : s.velocities)
    v = vector(1);
  return s;
}

void touch_warm_wall(Stage& stage) {
  stage.sites.clear();
  stage.site_of.assign(stage.vertices(), no_index);
  StageLiquid& of = stage.liquids[0];
  of.wall_flow = of.liquid.law.newtonian() ? nullptr : std::make_shared<const WallFlow>(of.liquid);
  for (std::uint32_t v = 1; v < stage.vertices(); v += 3) {
    WallSite site;
    site.vertex = v;
    site.normal = Vector3::UnitY();
    site.stuck = site.carried = stage.start->positions[v];
    site.slip_length = 0.05;
    stage.site_of[v] = static_cast<std::uint32_t>(stage.sites.size());
    stage.sites.push_back(std::move(site));
  }
}

// Energy and gradient of the terms that viscosity and tension make, a little way into the stage.
std::pair<double, Eigen::VectorXd> evaluated(const State& state, const Liquid& liquid) {
  Stage stage = first_stage(state, liquid, 0.05, 0.05, true);
  touch_warm_wall(stage);
  Terms terms;
  terms.push_back(make_term(MidEdgeShell(AreaLoads{.tension = SurfaceTension()})));
  terms.push_back(make_term(Membrane()));
  terms.push_back(make_term(WallDrag()));
  for (const auto& term : terms)
    term->begin(stage);
  Unknowns u = stage.begin;
  for (Eigen::Index i = 0; i < u.size(); ++i)
    u[i] += 0.03 * std::sin(static_cast<double>(17 * i));
  Assembly assembly(state.mesh, terms, true);
  std::vector<std::uint32_t> order(state.positions.size());
  std::iota(order.begin(), order.end(), 0);
  assembly.set_order(order);
  Constraints constraints;
  constraints.held.assign(assembly.unknowns(), 0);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(u.size());
  const double value = assembly.gradient(terms, u, constraints, gradient).value;
  return {value, gradient};
}

TEST(Temperature, OfOneNumberMakesTheLiquidAtThatTemperature) {
  for (const FlowLaw& law : warm_laws()) {
    const State isothermal = warm_crumpled();
    State state = isothermal;
    state.temperatures.assign(state.volumes.size(), cold);
    const Liquid liquid = thermal(law);
    const auto [value, gradient] = evaluated(state, liquid);
    const auto [wanted, wanted_gradient] = evaluated(isothermal, at_temperature(liquid, cold));
    EXPECT_NEAR(value, wanted, 1e-9 * std::abs(wanted)) << static_cast<int>(law.kind);
    EXPECT_LE((gradient - wanted_gradient).norm(), 1e-9 * wanted_gradient.norm()) << static_cast<int>(law.kind);
    const auto [other, ignored] = evaluated(isothermal, liquid); // at the reference
    EXPECT_GT(std::abs(other - wanted), 1e-2 * std::abs(wanted)) << static_cast<int>(law.kind);
  }
}

TEST(Temperature, PredictsFromItsRate) {
  State state = warm_crumpled();
  state.temperatures.assign(state.volumes.size(), cold);
  state.temperature_rates.assign(state.volumes.size(), -20);
  const Stage stage = first_stage(state, thermal({}), 0.05, 0.05, false);
  EXPECT_DOUBLE_EQ(stage.temperatures[3], cold - 1);
  EXPECT_DOUBLE_EQ(stage.shift[3], ViscosityShift(thermal({}).temperature_law).factor(cold - 1));
  state.temperature_rates.assign(state.volumes.size(), -1e6); // no prediction is good
  EXPECT_DOUBLE_EQ(first_stage(state, thermal({}), 0.05, 0.05, false).temperatures[3], 0.9 * cold);
}

TEST(Temperature, AbsentNothingIsKept) {
  const Stage stage = first_stage(warm_crumpled(), {.viscosity = 2}, 0.05, 0.05, false);
  EXPECT_TRUE(stage.shift.empty());
  EXPECT_TRUE(stage.temperatures.empty());
}

} // namespace
} // namespace sheet
