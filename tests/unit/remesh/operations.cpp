// SPDX-License-Identifier: GPL-3.0-or-later
// Random edits: the mesh stays a manifold, and every single edit keeps volume, momentum and, with the ledgers, enclosed
// volume, and does not raise the kinetic energy.
#include "libsheet/remesh/operations.h"

#include <random>

#include <gtest/gtest.h>

#include "libsheet/shape/shapes.h"
#include "tests/support/remesh/consistency.h"
#include "tests/support/remesh/cycles.h"
#include "tests/support/remesh/flows.h"

namespace sheet::remesh {
namespace {

struct Sums {
  double volume = 0, energy = 0, cone = 0, ledger = 0, speed = 0;
  Vector3 momentum = Vector3::Zero();
};

Sums sums_of(const EditableSheet& sheet) {
  Sums s;
  const Mesh& mesh = sheet.mesh();
  for (std::uint32_t t = 0; t < mesh.triangle_slots(); ++t) {
    if (!mesh.has_triangle(t))
      continue;
    const Corners& c = mesh.corners(t);
    s.volume += sheet.volume(t);
    s.cone += sheet.at(c[0]).cross(sheet.at(c[1])).dot(sheet.at(c[2])) / 6;
    for (const std::uint32_t v : c) {
      s.momentum += sheet.volume(t) / 3 * sheet.velocity(v);
      s.speed += sheet.volume(t) / 3 * sheet.velocity(v).norm();
      s.energy += sheet.volume(t) / 6 * sheet.velocity(v).squaredNorm();
    }
  }
  for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v)
    if (mesh.has_vertex(v))
      s.ledger += sheet.swept(v);
  return s;
}

formats::Frame moving(const TriangleMesh& mesh) {
  formats::Frame frame = test::frame_of(mesh, 0.01);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  for (Vector3& u : velocities(frame))
    u = {number(random), number(random), number(random)};
  for (double& v : volumes(frame)) // thickness that differs by a factor of 3 between neighbours
    v *= 2 + number(random);
  return frame;
}

class RandomEdits : public testing::TestWithParam<const char*> {
protected:
  static TriangleMesh mesh() {
    MeshOptions options;
    options.edge_length = 0.2;
    const std::string name = GetParam();
    if (name == "sphere")
      return make_sphere(1, options);
    if (name == "disk")
      return make_disk(1, options);
    if (name == "tube")
      return make_tube(0.5, 1, options);
    return test::wrinkled(0.05, 0.02);
  }
};

TEST_P(RandomEdits, KeepWhatTheyMustKeep) {
  EditableSheet sheet(moving(mesh()));
  const bool closed = std::string(GetParam()) == "sphere";
  std::mt19937 random(11);
  Edit edit;
  std::array<int, 4> made{};
  int trims = 0;
  const Limits limits = {
      .thickness = 1.3, .sharpest = cosine_of_degrees(10), .gain = 0, .facing = 0.3, .intersections = true};
  Limits of_trims = limits;
  of_trims.thickness = 3;
  Sums before = sums_of(sheet);
  for (int i = 0; i < 3000; ++i) {
    const auto side = static_cast<std::uint32_t>(random() % (3 * sheet.mesh().triangle_slots()));
    if (!sheet.mesh().has_triangle(Mesh::triangle_of(side)))
      continue;
    bool proposed = true;
    const bool trim = random() % 64 == 0;
    switch (trim ? 5 : random() % 5) {
    case 0:
      propose_split(sheet, side, edit);
      break;
    case 1:
      proposed = propose_flip(sheet, side, edit);
      break;
    case 2:
      proposed = propose_collapse(sheet, side, 0.001, edit);
      break;
    case 3:
      proposed = propose_collapse(sheet, side, 0.001, edit, sheet.mesh().to(side));
      break;
    case 5:
      proposed = propose_trim(sheet, Mesh::triangle_of(side), edit);
      break;
    default:
      proposed = propose_smooth(sheet, sheet.mesh().from(side), 0.001, edit);
    }
    if (!proposed || !sheet.make(edit, trim ? of_trims : limits))
      continue;
    ++made[static_cast<std::size_t>(edit.kind)];
    trims += trim;
    const Sums now = sums_of(sheet);
    ASSERT_NEAR(now.volume, before.volume, 1e-15 * before.volume) << i;
    ASSERT_LT((now.momentum - before.momentum).norm(), 1e-14 * before.speed) << i;
    ASSERT_LT(now.energy, before.energy * (1 + 1e-13)) << i;
    if (closed) {
      ASSERT_NEAR(now.cone - now.ledger, before.cone - before.ledger, 1e-13)
          << i << " kind " << static_cast<int>(edit.kind);
    }
    before = now;
  }
  test::expect_consistent(sheet.mesh());
  for (const int count : made)
    EXPECT_GT(count, 50);
  EXPECT_EQ(trims > 0, !closed);
}

INSTANTIATE_TEST_SUITE_P(Meshes, RandomEdits, testing::Values("sphere", "disk", "tube", "wrinkled"),
                         [](const auto& named) { return std::string(named.param); });

} // namespace
} // namespace sheet::remesh
