// SPDX-License-Identifier: GPL-3.0-or-later
// What resists where heights of directors hardly do: a vertex at the flat angle of a cap that pops out of the sheet,
// all directors free to give way, over what hinges resist it with; the director of a sharp fold.
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "libsheet/energy/hinge.h"
#include "libsheet/energy/leaning.h"
#include "libsheet/energy/mid_edge_shell.h"
#include "libsheet/energy/stage_setup.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

// Stiffness of the vertex against moving along z. The mesh is flat.
double stiffness_by_directors(const State& s, std::uint32_t vertex) {
  const Stage stage = first_stage(s, {.viscosity = 1}, 0.1, 0.1, true);
  MidEdgeShell shell(false);
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
  const Stage stage = first_stage(s, {.viscosity = 1}, 0.1, 0.1, false);
  Hinge hinge(false, *s.mesh);
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
  const std::uint32_t apex = 41;   // of four triangles, each with its longest edge opposite
  constexpr double height = 0.004; // over an edge of 0.18
  const double shift = (std::sqrt(0.5) / 8 - height) * std::sqrt(0.5);
  mesh.positions[apex] += Vector3(shift, shift, 0);
  const State s = test::at_rest(mesh, 0.01);
  // Without what the shell adds for caps: 0.0007.
  EXPECT_GT(stiffness_by_directors(s, apex), 0.2 * stiffness_by_hinges(s, apex));
}

// Two triangles, folded about the edge between them by so many degrees.
State folded(double degrees) {
  const double turn = degrees * std::numbers::pi / 180;
  return test::at_rest(
      {{{0, 0, 0}, {0, 1, 0}, {1, 0.5, 0}, {-std::cos(turn), 0.5, std::sin(turn)}}, {{0, 2, 1}, {0, 1, 3}}}, 0.01);
}

bool on_rim(const State& s, std::size_t edge) {
  const auto& sides = s.mesh->edge_triangles[edge];
  return sides[0] == no_index || sides[1] == no_index;
}

// Of the director of the fold, turned by `theta`, in the sheet that is `scale` times as large as at the start.
double stiffness_of_fold(const State& s, bool arcs, double scale, double theta) {
  const Stage stage = first_stage(s, {.viscosity = 1}, 0.1, 0.1, true);
  MidEdgeShell shell(arcs);
  shell.begin(stage);
  double sum = 0;
  for (std::size_t t = 0; t < 2; ++t) {
    VectorN<12> u = VectorN<12>::Zero(), g;
    MatrixN<12> h;
    Eigen::Index own = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      u.segment<3>(static_cast<Eigen::Index>(3 * k)) = scale * s.positions[s.mesh->triangles[t][k]];
      if (!on_rim(s, s.mesh->triangle_edges[t][k]))
        own = static_cast<Eigen::Index>(9 + k);
    }
    u[own] = theta;
    shell.derivatives(t, u, g, h, false);
    sum += h(own, own);
  }
  return sum;
}

TEST(Folds, HoldTheirDirector) {
  const auto stiffness = [](double degrees) { return stiffness_of_fold(folded(degrees), false, 1, 0); };
  // By heights alone: 3e-10 of it at 179.998 degrees.
  for (const double degrees : {30.0, 90.0, 150.0, 179.0, 179.998})
    EXPECT_GT(stiffness(degrees), 0.3 * stiffness(0)) << degrees;
}

// Arcs get longer as directors lean, up to 90 degrees: there tension would be at the top of a hill.
TEST(Folds, HoldTheirDirectorUnderTension) {
  for (const double degrees : {150.0, 170.0, 180.0})
    for (const double theta : {-0.4, 0.0, 0.4})
      EXPECT_GT(stiffness_of_fold(folded(degrees), true, 1.1, theta), 0) << degrees << ", " << theta;
}

TEST(Directors, DoNotTurnOver) {
  State s = folded(60);
  const double degree = std::numbers::pi / 180;
  s.director_angles.assign(s.mesh->edges.size(), 100 * degree);
  s.director_angles[1] = -20 * degree;
  limit_leaning(s, {});
  for (std::size_t e = 0; e < s.mesh->edges.size(); ++e) {
    EXPECT_NEAR(s.director_angles[e], (e == 1 ? -20 : on_rim(s, e) ? 80 : 50) * degree, 1e-12) << e;
  }
  Hold clamp;
  clamp.clamped_edges = {0};
  s.director_angles.assign(s.mesh->edges.size(), 100 * degree);
  limit_leaning(s, {clamp});
  EXPECT_EQ(s.director_angles[0], 100 * degree);
  s = folded(170); // leaves no room
  s.director_angles.assign(s.mesh->edges.size(), 100 * degree);
  limit_leaning(s, {});
  for (std::size_t e = 0; e < s.mesh->edges.size(); ++e)
    EXPECT_NEAR(s.director_angles[e], on_rim(s, e) ? 80 * degree : 0, 1e-12) << e;
}

} // namespace
} // namespace sheet
