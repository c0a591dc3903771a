// SPDX-License-Identifier: GPL-3.0-or-later
// The shell's kernels, in every version that this processor can run.
#include "libsheet/energy/mid_edge_kernels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "libsheet/geometry/metric.h"
#include "libsheet/material/flow_curve.h"

namespace sheet {
extern const MidEdgeKernels avx512_mid_edge, avx2_mid_edge, plain_mid_edge;
}

using namespace sheet;

namespace {

std::vector<const MidEdgeKernels*> versions() {
  std::vector<const MidEdgeKernels*> result{&plain_mid_edge};
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    result.push_back(&avx2_mid_edge);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
    result.push_back(&avx512_mid_edge);
  return result;
}

// Eight triangles whose directors lean by up to `lean` from the normals, the third with a corner of 170 degrees.
struct Batch {
  MidEdgeReference reference{};
  MidEdgeStart start{};
  MidEdgeState state{}; // at the start, directors not turned

  explicit Batch(double lean) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto vector = [&] { return Vector3(uniform(random), uniform(random), uniform(random)); };
    std::ranges::fill(start.bending, 1.0);
    for (int lane = 0; lane < lane_count; ++lane) {
      std::array<Vector3, 3> x{vector(), Vector3(2, 0, 0) + vector(), Vector3(0, 2, 0) + vector()};
      if (lane == 2)
        x = {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0.5, 0.5 * std::tan(0.087), 0)};
      const Vector3 normal = (x[1] - x[0]).cross(x[2] - x[0]).normalized();
      const Vector3 q = squared_lengths(x[0], x[1], x[2]);
      start.rate[lane] = 3;
      start.volume[lane] = 0.01 * RaisedMetric(q).area();
      for (std::size_t k = 0; k < 3; ++k) {
        const auto at = static_cast<int>(k);
        const Vector3 tangent = (x[(k + 2) % 3] - x[(k + 1) % 3]).normalized();
        const double angle = lean * uniform(random);
        const Vector3 director = std::cos(angle) * normal + std::sin(angle) * tangent.cross(normal);
        const Vector3 binormal = tangent.cross(director);
        start.metric[k][lane] = q[at];
        start.sign[k][lane] = 1;
        state.cosine[k][lane] = 1;
        for (int a = 0; a < 3; ++a) {
          start.x[3 * at + a][lane] = state.x[3 * at + a][lane] = x[k][a];
          reference.tangent[k][a][lane] = tangent[a];
          reference.director[k][a][lane] = director[a];
          reference.binormal[k][a][lane] = binormal[a];
        }
      }
    }
  }
};

double greatest(const LaneNumbers* numbers, int count) {
  double most = 0;
  for (int i = 0; i < count; ++i)
    for (const double v : numbers[i])
      most = std::max(most, std::abs(v));
  return most;
}

} // namespace

// A stage refers to where it starts: no potential there and no force, with caps and leaning directors too.
TEST(MidEdgeKernels, NothingIsToBeDoneAtTheStart) {
  for (const double lean : {0.1, 1.5})
    for (const MidEdgeKernels* kernels : versions())
      for (const double ratio : {0.0, 2.4}) { // of a second stage, whose first one left all as it was
        Batch b(lean);
        b.start.ratio = ratio;
        kernels->reference(b.start, b.state, b.reference);
        EXPECT_EQ(b.reference.folded, lean > 1);
        EXPECT_GT(b.reference.stiffness[2][2] + b.reference.stiffness[0][2] + b.reference.stiffness[1][2], 0);
        MidEdgeResult result;
        kernels->hessian(b.reference, b.state, true, nullptr, {}, result);
        const double stiffness = greatest(result.hessian, 78);
        EXPECT_GT(stiffness, 0);
        EXPECT_LT(greatest(result.gradient, 12), 1e-13 * stiffness);
        EXPECT_LT(greatest(&result.value, 1), 1e-26 * stiffness);
      }
}

// The flow curve of a Newtonian liquid, summed through the thickness, is the closed form.
TEST(MidEdgeKernels, FlowCurvesOfNewtonianLiquids) {
  const FlowCurve curve(Liquid{.viscosity = 6});
  for (const MidEdgeKernels* kernels : versions()) {
    Batch b(0.1);
    std::ranges::fill(b.start.duration, 1.0);
    for (double& stiffening : b.start.stiffening)
      stiffening = 1;
    kernels->reference(b.start, b.state, b.reference);
    for (auto& row : b.reference.stiffness) // caps are not summed
      std::ranges::fill(row, 0);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-0.1, 0.1);
    for (LaneNumbers& numbers : b.state.x)
      for (double& v : numbers)
        v += uniform(random);
    MidEdgeResult closed, summed;
    kernels->hessian(b.reference, b.state, true, nullptr, {}, closed);
    kernels->hessian(b.reference, b.state, true, nullptr, {.curve = &curve}, summed);
    const double stiffness = greatest(closed.hessian, 78);
    for (int lane = 0; lane < lane_count; ++lane) {
      EXPECT_NEAR(summed.value[lane], closed.value[lane], 1e-13 * stiffness);
      for (int i = 0; i < 12; ++i)
        EXPECT_NEAR(summed.gradient[i][lane], closed.gradient[i][lane], 1e-13 * stiffness);
      for (int i = 0; i < 78; ++i)
        EXPECT_NEAR(summed.hessian[i][lane], closed.hessian[i][lane], 1e-13 * stiffness);
    }
  }
}

TEST(MidEdgeKernels, AllVersionsAgree) {
  Batch reference(1.5);
  MidEdgeState moved = reference.state;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-0.1, 0.1);
  for (LaneNumbers& numbers : moved.x)
    for (double& v : numbers)
      v += uniform(random);
  for (int k = 0; k < 3; ++k)
    for (int lane = 0; lane < lane_count; ++lane) {
      const double angle = uniform(random);
      moved.cosine[k][lane] = std::cos(angle);
      moved.sine[k][lane] = std::sin(angle);
    }
  MidEdgeLoads loads{};
  loads.worked = true;
  for (int lane = 0; lane < lane_count; ++lane) {
    loads.tension[lane] = 2 + lane;
    loads.thrust[lane] = loads.work[lane] = 0.5;
    loads.start_area[lane] = 1;
  }
  MidEdgeResult plain;
  for (const MidEdgeKernels* kernels : versions()) {
    Batch b(1.5);
    b.start.ratio = 2.4;
    kernels->reference(b.start, moved, b.reference);
    MidEdgeResult result;
    kernels->hessian(b.reference, b.state, true, &loads, {}, result);
    if (kernels == &plain_mid_edge)
      plain = result;
    const double stiffness = greatest(plain.hessian, 78);
    for (int lane = 0; lane < lane_count; ++lane) {
      EXPECT_NEAR(result.value[lane], plain.value[lane], 1e-12 * stiffness);
      for (int i = 0; i < 12; ++i)
        EXPECT_NEAR(result.gradient[i][lane], plain.gradient[i][lane], 1e-12 * stiffness);
      for (int i = 0; i < 78; ++i)
        EXPECT_NEAR(result.hessian[i][lane], plain.hessian[i][lane], 1e-12 * stiffness);
    }
  }
}
