// SPDX-License-Identifier: GPL-3.0-or-later
// Liquids that are not Newtonian, bent and stretched in plane strain: what a patch of an irregular mesh dissipates that
// goes from flat to a cylinder, against integrals through the thickness.
#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "libsheet/energy/mid_edge_shell.h"
#include "libsheet/energy/stage_setup.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

constexpr double patch_thickness = 0.02, longest = 1.2; // [m]

struct Patch {
  explicit Patch(const Liquid& liquid) : state(test::at_rest(test::rectangle(longest, 1, 5, 4, 0.2), patch_thickness)) {
    stage = first_stage(state, liquid, 1, 1, true);
    shell.begin(stage);
  }

  // The potential where it has been stretched by `stretch` and bent by `curvature` [1/m], in a second.
  double operator()(double stretch, double curvature) {
    Unknowns u = stage.begin;
    const Connectivity& mesh = *state.mesh;
    const auto normal = [&](double x) { return Vector3(-std::sin(curvature * x), 0, std::cos(curvature * x)); };
    const auto along = [&](std::uint32_t v) { return (1 + stretch) * state.positions[v].x(); };
    for (std::uint32_t v = 0; v < state.positions.size(); ++v) {
      const double x = along(v);
      u.segment<3>(3 * static_cast<Eigen::Index>(v)) = Vector3(
          std::sin(curvature * x) / curvature, state.positions[v].y(), (1 - std::cos(curvature * x)) / curvature);
    }
    for (std::uint32_t e = 0; e < mesh.edges.size(); ++e) {
      const auto [a, b] = mesh.edges[e];
      const Vector3 t = (Stage::position(u, b) - Stage::position(u, a)).normalized();
      const Vector3 brought = stage.frames[e].carried(t), wanted = normal((along(a) + along(b)) / 2);
      u[static_cast<Eigen::Index>(3 * state.positions.size() + e)] =
          std::atan2(brought.cross(wanted).dot(t), brought.dot(wanted));
    }
    shell.prepare(u);
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      VectorN<12> own;
      for (std::size_t k = 0; k < 3; ++k) {
        own.segment<3>(static_cast<Eigen::Index>(3 * k)) = Stage::position(u, mesh.triangles[t][k]);
        own[static_cast<Eigen::Index>(9 + k)] =
            u[static_cast<Eigen::Index>(3 * state.positions.size() + mesh.triangle_edges[t][k])];
      }
      sum += shell.value(t, own);
    }
    return sum;
  }

  // ∂W/∂κ over the area [N].
  double moment(double stretch, double curvature) {
    const double by = 1e-4 * curvature;
    return ((*this)(stretch, curvature + by) - (*this)(stretch, curvature - by)) / (2 * by) / longest;
  }

  State state;
  Stage stage;
  MidEdgeShell shell{true};
};

// M = 4 ∫ τ(2 z κ̇) z dz over half of the thickness.
TEST(FlowBending, MomentsOfPlates) {
  constexpr double rate = 1e-3, half = patch_thickness / 2, mu = 3, yield = 4e-5; // [1/(m s)], [m], [Pa s], [Pa]
  using enum FlowLawKind;
  for (const double n : {1.0 / 3, 0.5, 1.5}) {
    Patch power({.viscosity = mu, .law = {.kind = FlowLawKind::power, .flow_index = n, .rest_rate = 1e-12}});
    const double exact = 4 * mu * std::pow(2 * rate, n) * std::pow(half, n + 2) / (n + 2);
    EXPECT_NEAR(power.moment(0, rate), exact, 0.005 * exact) << n;
    Patch plastic({.viscosity = mu,
                   .law = {.kind = herschel_bulkley, .flow_index = n, .yield_stress = yield, .rest_rate = 1e-12}});
    const double more = yield * patch_thickness * patch_thickness / 2;
    EXPECT_NEAR(plastic.moment(0, rate), exact + more, 0.005 * (exact + more)) << n;
  }
  Patch chocolate({.viscosity = mu, .law = {.kind = casson, .yield_stress = yield, .rest_rate = 1e-12}});
  const double exact = yield * patch_thickness * patch_thickness / 2 + mu * rate * std::pow(patch_thickness, 3) / 3 +
                       16.0 / 5 * std::sqrt(2 * yield * mu * rate) * std::pow(half, 2.5);
  EXPECT_NEAR(chocolate.moment(0, rate), exact, 0.005 * exact);
}

// A small bending of a sheet that is being stretched is resisted by the tangent viscosity n η.
TEST(FlowBending, OfAStretchedSheetIsTangent) {
  constexpr double n = 1.0 / 3, mu = 3, stretch = 1e-3, curvature = 1e-3;
  Patch patch({.viscosity = mu, .law = {.kind = FlowLawKind::power, .flow_index = n, .rest_rate = 1e-12}});
  const double tangent = n * mu * std::pow(2 * stretch, n - 1);
  const double exact = tangent * std::pow(patch_thickness, 3) / 3 * curvature;
  EXPECT_NEAR(patch.moment(stretch, curvature), exact, 0.01 * exact);
}

// What is ideally plastic dissipates 2 τ_y ∫ |ε̇ + z κ̇| dz: within 4 % at any mixture, four points through.
TEST(FlowBending, BendingAndStretchingOfWhatIsPlastic) {
  constexpr double yield = 4;
  Patch patch({.viscosity = 1e-9, .law = {.kind = FlowLawKind::bingham, .yield_stress = yield, .rest_rate = 1e-12}});
  for (const double place : {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.7}) { // of the neutral axis, in thicknesses
    constexpr double curvature = 1e-3;
    const double half = patch_thickness / 2, axis = place * patch_thickness;
    const double integral = axis >= half ? 2 * axis * half : half * half + axis * axis;
    const double exact = 2 * yield * curvature * integral * longest;
    EXPECT_NEAR(patch(axis * curvature, curvature), exact, 0.045 * exact) << place;
  }
}

} // namespace
} // namespace sheet
