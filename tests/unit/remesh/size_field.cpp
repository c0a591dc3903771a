// SPDX-License-Identifier: GPL-3.0-or-later
// Adaptive lengths: what the flow asks for.
#include <cmath>

#include <gtest/gtest.h>

#include "libsheet/remesh/buckling.h"
#include "libsheet/remesh/size_field.h"
#include "libsheet/scene/read.h"
#include "libsheet/shape/shapes.h"
#include "tests/support/remesh/flows.h"
#include "tests/support/remesh/options.h"

namespace sheet::remesh {
namespace {

using test::edges;

using Velocity = std::function<Vector3(const Vector3&)>;
formats::Frame moving(const TriangleMesh& mesh, double thickness, const Velocity& velocity) {
  formats::Frame frame = test::frame_of(mesh, thickness);
  const auto x = positions(std::as_const(frame));
  for (std::size_t v = 0; v < frame.vertices; ++v)
    velocities(frame)[v] = velocity(x[v]);
  return frame;
}

FlowError error_of(const formats::Frame& frame) {
  const EditableSheet sheet(frame);
  return flow_error(sheet, triangle_rates(sheet), true);
}

// Largest and smallest over the vertices for which `counts`.
std::pair<double, double> range(const formats::Frame& frame, const std::vector<double>& values,
                                const std::function<bool(const Vector3&)>& counts) {
  std::pair<double, double> found = {1e300, -1e300};
  for (std::size_t v = 0; v < frame.vertices; ++v)
    if (counts(positions(frame)[v]))
      found = {std::min(found.first, values[v]), std::max(found.second, values[v])};
  return found;
}

const auto inside = [](const Vector3& x) { return std::abs(x[0]) < 0.7 && std::abs(x[1]) < 0.7; };

TEST(FlowError, TurningAndShiftingAreNoFlow) {
  const formats::Frame frame = moving(make_sphere(1, edges(0.2)), 0.01, [](const Vector3& x) -> Vector3 {
    return Vector3(1, 2, 3).cross(x) + Vector3(4, 5, 6);
  });
  const FlowError error = error_of(frame);
  EXPECT_LT(error.mean, 1e-12);
  EXPECT_LT(range(frame, error.gradient, [](const Vector3&) { return true; }).second, 1e-11);
}

// u = x²/2: E = x, |∇E| = 1; w = x³/6: K = -x, |∇K| = 1.
TEST(FlowError, GradientsOfStretchingAndBending) {
  constexpr double h = 0.1;
  const TriangleMesh mesh = make_rectangle(2, 2, edges(0.05));
  const formats::Frame stretched = moving(mesh, h, [](const Vector3& x) { return Vector3(x[0] * x[0] / 2, 0, 0); });
  const formats::Frame bent = moving(mesh, h, [](const Vector3& x) { return Vector3(0, 0, std::pow(x[0], 3) / 6); });
  for (const auto& [frame, exact] : {std::pair(&stretched, std::sqrt(h)), {&bent, std::sqrt(h * h * h / 12)}}) {
    const std::vector<double> gradient = error_of(*frame).gradient;
    const auto [least, most] = range(*frame, gradient, inside);
    EXPECT_GT(least, 0.7 * exact);
    EXPECT_LT(most, 1.5 * exact);
    double sum = 0, count = 0;
    for (std::size_t v = 0; v < gradient.size(); ++v)
      if (inside(positions(*frame)[v])) {
        sum += gradient[v];
        ++count;
      }
    EXPECT_NEAR(sum / count, exact, 0.1 * exact);
  }
  EXPECT_NEAR(error_of(stretched).mean, std::sqrt(h / 3), 0.01 * std::sqrt(h));
  // bending that is not asked for does not count
  const EditableSheet sheet(bent);
  EXPECT_LT(flow_error(sheet, triangle_rates(sheet), false).mean, 1e-12);
}

// A sphere that grows stretches and bends evenly: nothing to be resolved.
TEST(FlowError, EvenGrowthIsEven) {
  const formats::Frame frame = moving(make_sphere(1, edges(0.1)), 0.1, [](const Vector3& x) { return x; });
  const FlowError error = error_of(frame);
  EXPECT_NEAR(error.mean, std::sqrt(0.1 * 2 + 1e-3 / 12 * 2), 0.01);
  EXPECT_LT(range(frame, error.gradient, [](const Vector3&) { return true; }).second, 0.3 * error.mean);
}

SizeOptions adaptive(double edge_length) {
  SizeOptions options;
  options.edge_length = edge_length;
  options.chord_error = 1;
  return options;
}

TEST(SizeField, AtRestEdgesAreAsLongAsAskedFor) {
  const formats::Frame frame = test::frame_of(make_rectangle(2, 2, edges(0.1)), 0.01);
  const EditableSheet sheet(frame);
  const SizeField size(sheet, nullptr, adaptive(0.1));
  for (std::uint32_t v = 0; v < frame.vertices; ++v)
    EXPECT_DOUBLE_EQ(size.at(v), 0.1);
}

// Bending that varies on one side only: short edges there, about as many triangles as asked for.
TEST(SizeField, TrianglesStandWhereTheFlowVaries) {
  const formats::Frame frame = moving(make_rectangle(2, 2, edges(0.05)), 0.01, [](const Vector3& x) {
    return Vector3(0, 0, x[0] > 0 ? 1 - std::cos(10 * x[0]) : 0);
  });
  const EditableSheet sheet(frame);
  const SizeField size(sheet, nullptr, adaptive(0.1));
  double count = 0, waves = 0, wavy = 0, still = 1;
  for (std::uint32_t v = 0; v < frame.vertices; ++v) {
    double area = 0;
    sheet.mesh().for_fan(v, [&](std::uint32_t side) { area += sheet.shape(Mesh::triangle_of(side)).area / 3; });
    count += area / (size.at(v) * size.at(v));
    const double x = sheet.at(v)[0];
    if (x > 0.2) {
      waves += area * size.at(v);
      wavy += area;
    }
    if (x < -0.5)
      still = std::min(still, size.at(v));
  }
  EXPECT_LT(waves / wavy, 0.09);
  EXPECT_GT(still, 0.13);
  EXPECT_NEAR(count, 400, 80);
}

// The least and the greatest length with so many inner faces at every vertex.
std::pair<double, double> sizes(const formats::Frame& frame, SizeOptions options, double inner_faces) {
  const EditableSheet sheet(frame);
  options.inner_faces.assign(frame.vertices, inner_faces);
  const SizeField size(sheet, nullptr, options);
  std::vector<double> at(frame.vertices);
  for (std::uint32_t v = 0; v < at.size(); ++v)
    at[v] = size.at(v);
  return range(frame, at, [](const Vector3&) { return true; });
}

// A sphere's curvature asks for a tenth of its radius, and what is buried for no more than the edges that it has.
TEST(SizeField, WhatLiesBetweenLayersNeedsNoFineEdges) {
  constexpr double edge = 0.2;
  const formats::Frame frame =
      moving(make_sphere(1, edges(edge)), 0.01, [](const Vector3&) { return Vector3::Zero(); });
  SizeOptions options;
  options.edge_length = edge;
  options.chord_error = 0.1 * 0.1 / 8;
  const auto [low, high] = sizes(frame, options, 0);
  EXPECT_NEAR(low, 0.1, 0.01);
  EXPECT_NEAR(high, 0.1, 0.01);
  EXPECT_EQ(sizes(frame, options, 1), std::pair(low, high)); // one face is outside
  EXPECT_NEAR(sizes(frame, options, 1.5).first, (low + edge) / 2, 1e-12);
  EXPECT_EQ(sizes(frame, options, 2), std::pair(edge, edge));
}

// Jumps of thickness count as far as nothing lies on the sheet: there by half the thickness for a fifth.
TEST(SizeField, WhatLiesOnALayerNeedsNoEvenThickness) {
  constexpr double edge = 0.1;
  formats::Frame frame = test::frame_of(make_rectangle(2, 2, edges(edge)), 0.01);
  const auto volume = volumes(frame);
  for (std::size_t t = 0; t < volume.size(); ++t)
    if (positions(frame)[triangles(frame)[t][0]][0] > 0)
      volume[t] *= 2;
  const SizeOptions options = adaptive(edge);
  const double low = sizes(frame, options, 0).first;
  EXPECT_GT(low, 0.3 * edge);
  EXPECT_LT(low, 0.5 * edge);
  EXPECT_NEAR(sizes(frame, options, 0.25).first, low / 0.75, 1e-12);
  EXPECT_EQ(sizes(frame, options, 1).first, edge);
}

// V15: k² = 2 ρ_b g / P, P = 4 μ h e, in the half that is compressed.
TEST(Buckling, WavesOfACompressedStripOnABath) {
  const Scene scene =
      parse_scene("[sheet]\nshape = \"rectangle\"\nplane = \"xy\"\nsize = [2, 2]\nsegments = [2, 2]\nthickness = 0.01\n"
                  "[material]\nviscosity = 1000\ndensity = 1\n[environment]\ngravity = [0, 0, -10]\n"
                  "bath = {density = 1000, level = 0}\n[model]\ninertia = false\n",
                  "test");
  const formats::Frame frame = moving(make_rectangle(2, 2, edges(0.1)), 0.01,
                                      [](const Vector3& x) { return Vector3(x[0] < 0 ? -2 * x[0] : x[0], 0, 0); });
  const EditableSheet sheet(frame);
  const std::vector<double> k = buckling_wavenumbers(scene, triangle_rates(sheet));
  for (std::uint32_t t = 0; t < k.size(); ++t) {
    const Corners& c = sheet.mesh().corners(t);
    const double left = std::min({sheet.at(c[0])[0], sheet.at(c[1])[0], sheet.at(c[2])[0]});
    const double right = std::max({sheet.at(c[0])[0], sheet.at(c[1])[0], sheet.at(c[2])[0]});
    if (right <= 0) {
      EXPECT_NEAR(k[t], std::sqrt(2 * 1000 * 10 / (4 * 1000 * 0.01 * 2)), 1e-9);
    }
    if (left >= 0) {
      EXPECT_EQ(k[t], 0);
    }
  }
}

} // namespace
} // namespace sheet::remesh
