// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "libsheet/energy/pressure.h"
#include "libsheet/energy/stage_setup.h"
#include "libsheet/geometry/area.h"
#include "libsheet/geometry/capped_volume.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

constexpr GasLaw air{.amount = 2e-3, .ambient = 1e5, .exponent = 1.4};

TEST(Gas, PressesAsItsAmountSays) {
  EXPECT_DOUBLE_EQ(gas_in(air, 2e-3, air.amount, 1).pressure, 0);
  EXPECT_NEAR(gas_in(air, 1e-3, air.amount, 1).pressure, 1e5 * (std::pow(2, 1.4) - 1), 1e-8);
  const double amount = amount_of_gas(air, 250, 1e-3);
  EXPECT_NEAR(gas_in(air, 1e-3, amount, 1).pressure, 250, 1e-9);
  EXPECT_TRUE(std::isnan(gas_in(air, 0, air.amount, 1).pressure));
}

// The leak's equation, and the stiffness with it against a central difference.
TEST(Gas, LeaksAsFastAsItPresses) {
  GasLaw law = air;
  for (const double leak : {0.0, 1e-9, 1e-7, 1e-3})
    for (const double volume : {0.3e-3, 2e-3, 9e-3}) {
      law.leak = leak;
      constexpr double tau = 0.1;
      const Gas gas = gas_in(law, volume, law.amount, tau);
      EXPECT_NEAR(gas.amount + leak * tau * gas.pressure, law.amount, 1e-14 * (law.amount + leak * tau * law.ambient));
      const double d = 1e-4 * volume;
      const double slope =
          (gas_in(law, volume + d, law.amount, tau).pressure - gas_in(law, volume - d, law.amount, tau).pressure) /
          (2 * d);
      EXPECT_NEAR(-slope / gas.stiffness, 1, 1e-6);
    }
}

// The orifice's equation, and the stiffness with it against a central difference, outward and inward.
TEST(Gas, LeavesThroughAHoleAsFromAnOrifice) {
  GasLaw law = air;
  for (const double hole : {1e-9, 1e-6, 1e-4, 1e-2})
    for (const double leak : {0.0, 1e-8})
      for (const double volume : {0.3e-3, 1.999e-3, 2.001e-3, 9e-3}) {
        law.hole = hole;
        law.leak = leak;
        constexpr double tau = 1e-3;
        const Gas gas = gas_in(law, volume, law.amount, tau);
        const double speed = std::copysign(std::sqrt(2 * std::abs(gas.pressure) / 1.2), gas.pressure);
        EXPECT_NEAR(gas.escaped, 0.61 * hole * speed * tau, 1e-14 * law.amount);
        EXPECT_NEAR(gas.amount + gas.escaped + leak * tau * gas.pressure, law.amount, 1e-14 * law.amount);
        EXPECT_NEAR(gas.pressure, 1e5 * (std::pow(gas.amount / volume, 1.4) - 1), 1e-9 * 1e5);
        const double d = 1e-5 * volume;
        const double slope =
            (gas_in(law, volume + d, law.amount, tau).pressure - gas_in(law, volume - d, law.amount, tau).pressure) /
            (2 * d);
        EXPECT_NEAR(-slope / gas.stiffness, 1, 1e-4) << hole << ' ' << volume;
      }
  law.hole = 1e-4;
  EXPECT_EQ(gas_in(law, law.amount, law.amount, 1).pressure, 0);
}

// What is open has the pressure outside, and as much gas as room.
TEST(Gas, IsThatOutsideWhereItIsOpen) {
  GasLaw law = air;
  law.open = true;
  const Gas gas = gas_in(law, 1.5e-3, law.amount, 1);
  EXPECT_EQ(gas.pressure, 0);
  EXPECT_DOUBLE_EQ(gas.amount, 1.5e-3);
  EXPECT_DOUBLE_EQ(gas.escaped, 0.5e-3);
  EXPECT_EQ(gas_in(law, -1, law.amount, 1).amount, 0);
  EXPECT_EQ(mean_pressure(law, 1e-3, -1e-3, law.amount, 1), 0);
}

// The potential of flow that turns: against the midpoint rule.
TEST(Gas, MeanPressureWithAHole) {
  GasLaw law = air;
  law.hole = 1e-4;
  constexpr double tau = 1e-3;
  constexpr int parts = 20000;
  for (const auto& [from, to] : {std::pair{1.999e-3, 2.002e-3}, {2.1e-3, 1.7e-3}, {1.5e-3, 1.9e-3}}) {
    double sum = 0;
    for (int k = 0; k < parts; ++k)
      sum += gas_in(law, from + (k + 0.5) / parts * (to - from), law.amount, tau).pressure / parts;
    EXPECT_NEAR(mean_pressure(law, from, to, law.amount, tau) / sum, 1, 1e-6);
  }
}

// Against the closed form of an exponent of 1: ∫ p dΩ = p_a (m ln(Ω1/Ω0) - (Ω1 - Ω0)).
TEST(Gas, MeanPressure) {
  GasLaw law = air;
  law.exponent = 1;
  for (const double to : {0.5e-3, 0.999999e-3, 1e-3, 1.3e-3, 4e-3}) {
    const double from = 1e-3, work = 1e5 * (law.amount * std::log1p((to - from) / from) - (to - from));
    const double mean = to == from ? 1e5 : work / (to - from);
    EXPECT_NEAR(mean_pressure(law, from, to, law.amount, 1) / mean, 1, 1e-9) << to;
  }
}

TEST(CappedVolume, OfClosedAndOpenSheets) {
  const test::Mesh ball = test::icosphere(4);
  EXPECT_NEAR(capped_volume(connect(ball.positions.size(), ball.triangles), ball.positions), 4 * std::numbers::pi / 3,
              0.01);
  test::Mesh disk = test::disk(1, 8, 0.2);
  const Connectivity mesh = connect(disk.positions.size(), disk.triangles);
  EXPECT_NEAR(capped_volume(mesh, disk.positions), 0, 1e-15);
  // A paraboloid of height 1 over it holds half of the polygon's cylinder, wherever it is.
  double area = 0;
  for (const Corners& t : disk.triangles)
    area += TriangleArea(disk.positions[t[0]], disk.positions[t[1]], disk.positions[t[2]]).area;
  for (Vector3& x : disk.positions)
    x = Vector3(x.x() + 30, x.y() - 20, 7 + 1 - x.head<2>().squaredNorm());
  EXPECT_NEAR(std::abs(capped_volume(mesh, disk.positions)), area / 2, 0.03 * area);
}

// An open cylinder whose ends are driven together as pistons: the gas has the volume that is left, caps and all, though
// the caps press on nothing.
TEST(Gas, IsCompressedByRimsThatMove) {
  test::Mesh mesh = test::disk(1, 6, 0.2);
  for (Vector3& x : mesh.positions) // a cup: the disk's outer part turned up, then stretched
    x = Vector3(x.x(), x.y(), -std::pow(x.squaredNorm(), 2));
  State state = test::at_rest(mesh, 0.1);
  const double volume = capped_volume(*state.mesh, state.positions), dt = 0.1;
  for (std::size_t v = 0; v < state.positions.size(); ++v)
    state.velocities[v] = Vector3(0, 0, -2 * state.positions[v].z()); // heights shrink by a fifth in dt
  const Stage stage = first_stage(state, Liquid{}, dt, dt, false);
  PressureLaw law{.kind = PressureLaw::Kind::gas, .gas = {.amount = std::abs(volume), .ambient = 10, .exponent = 1}};
  law.gas.more_volume = volume < 0 ? -3 * volume : 0; // whichever way the disk's triangles turn
  const double whole = volume + law.gas.more_volume;
  Pressure pressure(law);
  pressure.begin(stage);
  Unknowns moved = stage.begin;
  for (std::size_t v = 0; v < state.positions.size(); ++v)
    moved.segment<3>(static_cast<Eigen::Index>(3 * v)) = stage.predicted[v];
  pressure.prepare(moved);
  EXPECT_NEAR(pressure.enclosed(), whole - 0.2 * volume, 1e-12);
  EXPECT_NEAR(pressure.pressure(), 10 * (law.gas.amount / (whole - 0.2 * volume) - 1), 1e-11);
}

} // namespace
} // namespace sheet
