// SPDX-License-Identifier: GPL-3.0-or-later
// What resists a vertex at the flat angle of a cap that pops out of the sheet, all directors free to give way, over
// what hinges resist it with.
#include <cmath>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "libsheet/energy/hinge.h"
#include "libsheet/energy/mid_edge_shell.h"
#include "libsheet/energy/stage_setup.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

// Stiffness of the vertex against moving along z. The mesh is flat.
double stiffness_by_directors(const State& s, std::uint32_t vertex) {
  const Stage stage = first_stage(s, 0.1, 0.1, true);
  MidEdgeShell shell(1, false);
  shell.begin(stage);
  const auto edges = static_cast<Eigen::Index>(s.mesh->edges.size());
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(edges + 1, edges + 1); // the edges' angles, then the vertex
  for (std::size_t t = 0; t < shell.size(); ++t) {
    VectorN<12> u = VectorN<12>::Zero(), g;
    MatrixN<12> local;
    std::array<Eigen::Index, 12> row;
    row.fill(-1);
    for (std::size_t k = 0; k < 3; ++k) {
      u.segment<3>(static_cast<Eigen::Index>(3 * k)) = s.positions[s.mesh->triangles[t][k]];
      row[9 + k] = s.mesh->triangle_edges[t][k];
      if (s.mesh->triangles[t][k] == vertex)
        row[3 * k + 2] = edges;
    }
    shell.derivatives(t, u, g, local, false);
    for (std::size_t a = 0; a < 12; ++a)
      for (std::size_t b = 0; b < 12; ++b)
        if (row[a] >= 0 && row[b] >= 0)
          h(row[a], row[b]) += local(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
  }
  const Eigen::VectorXd coupling = h.col(edges).head(edges);
  return h(edges, edges) - coupling.dot(h.topLeftCorner(edges, edges).ldlt().solve(coupling));
}

double stiffness_by_hinges(const State& s, std::uint32_t vertex) {
  const Stage stage = first_stage(s, 0.1, 0.1, false);
  Hinge hinge(1, false, *s.mesh);
  hinge.begin(stage);
  double sum = 0;
  for (std::size_t i = 0; i < hinge.size(); ++i) {
    VectorN<12> u, g;
    MatrixN<12> h;
    for (std::size_t k = 0; k < 4; ++k)
      u.segment<3>(static_cast<Eigen::Index>(3 * k)) = s.positions[hinge.nodes(i)[k]];
    hinge.derivatives(i, u, g, h, false);
    for (Eigen::Index k = 0; k < 4; ++k)
      if (hinge.nodes(i)[static_cast<std::size_t>(k)] == vertex)
        sum += h(3 * k + 2, 3 * k + 2);
  }
  return sum;
}

TEST(FlatCaps, ResistPoppingOutAsHingesDo) {
  test::Mesh mesh = test::rectangle(1, 1, 8, 8, 0);
  const std::uint32_t apex = 41;    // of four triangles, each with its longest edge opposite
  constexpr double kHeight = 0.004; // over an edge of 0.18
  const double shift = (std::sqrt(0.5) / 8 - kHeight) * std::sqrt(0.5);
  mesh.positions[apex] += Vector3(shift, shift, 0);
  const State s = test::at_rest(mesh, 0.01);
  // Without what the shell adds for caps: 0.0007.
  EXPECT_GT(stiffness_by_directors(s, apex), 0.2 * stiffness_by_hinges(s, apex));
}

} // namespace
} // namespace sheet
