// SPDX-License-Identifier: GPL-3.0-or-later
// Arrays on their way through remeshing: those of strangers, holds, contact springs.
#include <cmath>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include "libsheet/remesh/remesh.h"
#include "libsheet/shape/shapes.h"
#include "tests/support/remesh/cycles.h"
#include "tests/support/remesh/flows.h"
#include "tests/support/remesh/options.h"

namespace sheet::remesh {
namespace {

using formats::Array;
using formats::Place;
using formats::Transfer;
using formats::Type;

formats::Frame disk(double edge_length) {
  MeshOptions options;
  options.edge_length = edge_length;
  return test::frame_of(make_disk(1, options), 0.01);
}

using test::options;

double sum(const Array& array) {
  const auto v = array.values<double>();
  return std::accumulate(v.begin(), v.end(), 0.0);
}

std::uint64_t edge_count(const formats::Frame& frame) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Corners& t : triangles(frame))
    for (std::size_t i = 0; i < 3; ++i)
      edges.insert(std::minmax(t[i], t[(i + 1) % 3]));
  return edges.size();
}

TEST(Arrays, OfStrangersGoByTheirRules) {
  for (const double wanted : {0.05, 0.3}) {
    formats::Frame frame = disk(0.1);
    frame.edges = edge_count(frame);
    for (const Place place : {Place::vertex, Place::triangle, Place::edge})
      for (const Transfer rule : {Transfer::drop, Transfer::copy, Transfer::interpolate, Transfer::conserve}) {
        const std::string name = std::string(formats::name_of(place)) + "_" + std::string(formats::name_of(rule));
        Array array = formats::make_array(name, place, Type::float64, 1, "1", rule, frame.rows_at(place));
        const auto values = array.values<double>();
        for (std::size_t i = 0; i < values.size(); ++i)
          values[i] = static_cast<double>(1 + i % 7);
        frame.put(std::move(array));
      }
    const formats::Frame before = frame;
    ASSERT_GT(remesh(frame, nullptr, options(wanted)).edits(), 100U);
    ASSERT_EQ(formats::find_form_error(frame), "");
    ASSERT_EQ(formats::find_value_error(frame), "");
    for (const Place place : {Place::vertex, Place::triangle, Place::edge}) {
      const std::string prefix = std::string(formats::name_of(place)) + "_";
      EXPECT_EQ(frame.find(prefix + "drop"), nullptr);
      const Array &copied = *frame.find(prefix + "copy"), &mixed = *frame.find(prefix + "interpolate"),
                  &kept = *frame.find(prefix + "conserve");
      EXPECT_EQ(copied.rows, frame.rows_at(place));
      for (const double v : copied.values<double>())
        EXPECT_EQ(v, std::round(v));
      for (const double v : mixed.values<double>()) {
        EXPECT_GE(v, 1 - 1e-12);
        EXPECT_LE(v, 7 + 1e-12);
      }
      const double total = sum(*before.find(prefix + "conserve"));
      EXPECT_NEAR(sum(kept), total, 1e-12 * total) << prefix;
    }
  }
}

// Sum of the array's rows times volumes.
double by_volume(const formats::Frame& frame, const char* name) {
  const auto volume = volumes(frame), value = frame.find(name)->values<double>();
  return std::inner_product(volume.begin(), volume.end(), value.begin(), 0.0);
}

TEST(Arrays, MeansKeepWhatVolumesCarry) {
  for (const double wanted : {0.05, 0.3}) {
    formats::Frame frame = disk(0.1);
    Array wave = formats::make_standard_array("temperature", frame.triangles), even = wave;
    even.name = "even";
    for (std::size_t t = 0; t < frame.triangles; ++t) {
      const Corners& c = triangles(frame)[t];
      const double x = (positions(frame)[c[0]] + positions(frame)[c[1]] + positions(frame)[c[2]]).x() / 3;
      wave.values<double>()[t] = 400 + 100 * std::sin(4 * x);
      even.values<double>()[t] = 350;
      volumes(frame)[t] *= 1.5 + std::cos(5 * x);
    }
    frame.put(wave);
    frame.put(even);
    const double before = by_volume(frame, "temperature");
    ASSERT_GT(remesh(frame, nullptr, options(wanted)).edits(), 100U);
    ASSERT_EQ(formats::find_value_error(frame), "");
    EXPECT_NEAR(by_volume(frame, "temperature"), before, 1e-13 * before);
    for (const double t : frame.find("temperature")->values<double>()) {
      EXPECT_GT(t, 295);
      EXPECT_LT(t, 505);
    }
    for (const double t : frame.find("even")->values<double>())
      EXPECT_NEAR(t, 350, 1e-9);
  }
}

TEST(Arrays, ALinearFieldStaysLinearInsideAFlatSheet) {
  formats::Frame frame = disk(0.1);
  Array array =
      formats::make_array("height", Place::vertex, Type::float64, 1, "m", Transfer::interpolate, frame.vertices);
  for (std::size_t v = 0; v < frame.vertices; ++v)
    array.values<double>()[v] = positions(std::as_const(frame))[v][0];
  frame.put(std::move(array));
  ASSERT_GT(remesh(frame, nullptr, options(0.04)).splits, 1000U);
  const auto height = frame.find("height")->values<double>();
  for (std::size_t v = 0; v < frame.vertices; ++v)
    EXPECT_NEAR(height[v], positions(std::as_const(frame))[v][0], 1e-3);
}

TEST(Arrays, HeldRimStaysWhereItIs) {
  formats::Frame frame = disk(0.1);
  Array hold = formats::make_array("hold", Place::vertex, Type::uint64, 1, "1", Transfer::common, frame.vertices);
  for (std::size_t v = 0; v < frame.vertices; ++v)
    hold.values<std::uint64_t>()[v] = positions(std::as_const(frame))[v].norm() > 1 - 1e-9 ? 2 : 0;
  frame.put(std::move(hold));
  for (Vector3& u : velocities(frame))
    u = {0, 0, 1};
  const auto held_on_chords = [](const formats::Frame& f) {
    std::size_t held = 0;
    const auto masks = holds(f);
    for (std::size_t v = 0; v < f.vertices; ++v)
      if (masks[v] != 0) {
        ++held;
        EXPECT_EQ(masks[v], 2U);
        // on a chord of the old polygon: between its inner and its outer circle
        EXPECT_GT(positions(f)[v].norm(), 0.985);
        EXPECT_LT(positions(f)[v].norm(), 1 + 1e-12);
        EXPECT_EQ(velocities(f)[v], Vector3(0, 0, 1));
      } else {
        EXPECT_LT(positions(f)[v].norm(), 0.999);
      }
    return held;
  };
  const std::size_t before = held_on_chords(std::as_const(frame));
  static_cast<void>(remesh(frame, nullptr, options(0.04)));
  const std::size_t fine = held_on_chords(std::as_const(frame));
  EXPECT_GT(fine, before * 3 / 2);
  static_cast<void>(remesh(frame, nullptr, options(0.12)));
  EXPECT_LT(held_on_chords(std::as_const(frame)), fine / 2);
}

TEST(Arrays, VerticesHeldDifferentlyDoNotMerge) {
  formats::Frame frame = disk(0.1);
  Array hold = formats::make_array("hold", Place::vertex, Type::uint64, 1, "1", Transfer::common, frame.vertices);
  for (std::size_t v = 0; v < frame.vertices; ++v) {
    const Vector3 x = positions(std::as_const(frame))[v];
    hold.values<std::uint64_t>()[v] = x.norm() > 1 - 1e-9 ? (x[0] < 0 ? 1 : 2) : 0;
  }
  frame.put(std::move(hold));
  static_cast<void>(remesh(frame, nullptr, options(1)));
  std::set<std::uint64_t> masks;
  for (const std::uint64_t mask : holds(std::as_const(frame)))
    masks.insert(mask);
  EXPECT_TRUE(masks.contains(1) && masks.contains(2) && !masks.contains(3));
}

// Springs between two layers: their strain must not change by remeshing.
TEST(Arrays, ContactSpringsAreCarriedWithoutStrain) {
  MeshOptions mesh_options;
  mesh_options.edge_length = 0.1;
  TriangleMesh mesh = make_rectangle(1, 1, mesh_options);
  const TriangleMesh layer = mesh;
  const auto shift = static_cast<std::uint32_t>(layer.positions.size());
  mesh = test::joined(mesh, layer, Vector3(0, 0, 0.05));
  formats::Frame frame = test::frame_of(mesh, 0.01);
  using Four = std::array<std::uint32_t, 4>;
  using Weights = std::array<double, 4>;
  const std::size_t count = layer.triangles.size();
  const auto put = [&](const char* name, Type type, std::uint32_t components, const char* unit) -> Array& {
    return frame.put(formats::make_array(name, Place::frame, type, components, unit, Transfer::drop, count));
  };
  put("contact_vertex", Type::uint32, 4, "1");
  put("contact_weight", Type::float64, 4, "1");
  put("contact_normal", Type::float64, 3, "1");
  put("contact_rest", Type::float64, 1, "m");
  put("contact_anchor", Type::float64, 3, "m");
  put("contact_stiffness", Type::float64, 2, "N/m");
  const auto find = [&](const char* name) -> Array& { return *frame.find(name); };
  for (std::size_t i = 0; i < count; ++i) {
    const TriangleIndices& t = layer.triangles[i];
    find("contact_vertex").values<Four>()[i] = {t[0] + shift, t[0], t[1], t[2]};
    find("contact_weight").values<Weights>()[i] = {1, -0.5, -0.25, -0.25};
    find("contact_normal").values<Vector3>()[i] = {0, 0, 1};
    find("contact_rest").values<double>()[i] = 0.06; // pressed by 0.01
    const auto x = positions(std::as_const(frame));
    const Vector3 c = x[t[0] + shift] - 0.5 * x[t[0]] - 0.25 * x[t[1]] - 0.25 * x[t[2]];
    find("contact_anchor").values<Vector3>()[i] = c + Vector3(0.002, 0, 0); // dragged by 0.002
    find("contact_stiffness").values<Eigen::Vector2d>()[i] = {3, 2};
  }
  for (const double wanted : {0.04, 0.2}) {
    formats::Frame work = frame;
    ASSERT_GT(remesh(work, nullptr, options(wanted)).edits(), 100U);
    ASSERT_EQ(formats::find_value_error(work), "");
    const std::size_t left = work.find("contact_vertex")->rows;
    EXPECT_EQ(left, count); // also those whose triangle became an edge or a point
    const auto x = positions(std::as_const(work));
    for (std::size_t i = 0; i < left; ++i) {
      const Four v = work.find("contact_vertex")->values<Four>()[i];
      const Weights w = work.find("contact_weight")->values<Weights>()[i];
      Vector3 c = Vector3::Zero();
      for (std::size_t k = 0; k < 4; ++k)
        c += w[k] * x[v[k]];
      EXPECT_NEAR(c[2] - work.find("contact_rest")->values<double>()[i], -0.01, 1e-12);
      EXPECT_NEAR((c - work.find("contact_anchor")->values<Vector3>()[i])[0], -0.002, 1e-12);
    }
  }
}

} // namespace
} // namespace sheet::remesh
