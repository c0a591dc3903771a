// SPDX-License-Identifier: GPL-3.0-or-later
// Whether an editable mesh is what it says: gtest failures where not.
#pragma once
#include <set>

#include <gtest/gtest.h>

#include "libsheet/remesh/mesh.h"

namespace sheet::test {

inline void expect_consistent(const remesh::Mesh& mesh) {
  using remesh::Mesh;
  std::vector<std::size_t> corner_count(mesh.vertex_slots(), 0);
  std::set<std::pair<std::uint32_t, std::uint32_t>> directed;
  std::size_t triangles = 0;
  for (std::uint32_t t = 0; t < mesh.triangle_slots(); ++t) {
    if (!mesh.has_triangle(t))
      continue;
    ++triangles;
    for (std::uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
      const std::uint32_t from = mesh.from(side), to = mesh.to(side), twin = mesh.twin(side);
      ++corner_count[from];
      EXPECT_TRUE(mesh.has_vertex(from)) << from;
      EXPECT_NE(from, to);
      EXPECT_TRUE(directed.insert({from, to}).second) << from << " to " << to << " twice";
      if (twin == no_index)
        continue;
      EXPECT_EQ(mesh.twin(twin), side);
      EXPECT_EQ(mesh.from(twin), to);
      EXPECT_EQ(mesh.to(twin), from);
      EXPECT_NE(mesh.apex(twin), mesh.apex(side)) << "two triangles at the same three vertices";
    }
  }
  EXPECT_EQ(mesh.triangle_count(), triangles);
  for (const auto& [from, to] : directed)
    if (directed.contains({to, from})) {
      EXPECT_NE(mesh.twin(mesh.find_side(from, to)), no_index)
          << from << ", " << to << " is open though both sides exist";
    }
  for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) {
    if (!mesh.has_vertex(v))
      continue;
    EXPECT_EQ(mesh.degree(v), corner_count[v]) << "the fan of vertex " << v;
    bool rim = false;
    mesh.for_fan(v, [&](std::uint32_t side) {
      EXPECT_EQ(mesh.from(side), v);
      rim = rim || mesh.twin(side) == no_index;
    });
    EXPECT_EQ(mesh.on_rim(v), rim) << v;
  }
}

} // namespace sheet::test
