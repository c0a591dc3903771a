// SPDX-License-Identifier: GPL-3.0-or-later
// V14: a strip in plane strain, a circular arc of curvature k, is bent further at a steady rate by its clamped ends.
// Power over the exact D kdot² per area, for flat and for arc edges, against k l²/h (l the edge, h the thickness). CSV.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "libsheet/energy/model.h"
#include "libsheet/energy/stage_setup.h"
#include "libsheet/energy/term_table.h"
#include "libsheet/solve/newton.h"
#include "tests/support/meshes.h"

using namespace sheet;

namespace {

Vector3 on_arc(double s, double y, double k) { return {std::sin(k * s) / k, y, (1 - std::cos(k * s)) / k}; }

// Rows along the bend whose vertices are offset by half an edge, so that no edge lies along its axis.
test::Mesh bricks(int nx, int ny) {
  test::Mesh mesh;
  std::vector<std::uint32_t> start;
  for (int j = 0; j <= ny; ++j) {
    start.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    for (int i = 0; i <= nx + j % 2; ++i)
      mesh.positions.emplace_back(j % 2 ? std::clamp(i - 0.5, 0.0, 1.0 * nx) : i, j, 0);
  }
  for (int j = 0; j < ny; ++j) {
    const bool odd = j % 2; // the wider row has one vertex more
    const std::uint32_t narrow = start[j + odd], wide = start[j + !odd];
    for (std::uint32_t i = 0; i <= static_cast<std::uint32_t>(nx); ++i) {
      // each narrow vertex over its wide edge, each narrow edge over its wide vertex
      mesh.triangles.push_back(odd ? Corners{wide + i, wide + i + 1, narrow + i}
                                   : Corners{wide + i + 1, wide + i, narrow + i});
      if (i < static_cast<std::uint32_t>(nx))
        mesh.triangles.push_back(odd ? Corners{narrow + i + 1, narrow + i, wide + i + 1}
                                     : Corners{narrow + i, narrow + i + 1, wide + i + 1});
    }
  }
  return mesh;
}

double power_ratio(double thickness, double k, bool arcs, Bending bending, double shift) {
  constexpr int nx = 20, ny = 6;
  test::Mesh mesh = shift < 0 ? bricks(nx, ny) : test::rectangle(nx, ny, nx, ny, shift); // edges of about 1 m
  const test::Mesh flat = mesh;
  for (Vector3& x : mesh.positions)
    x = on_arc(x.x() - 0.5 * nx, x.y(), k);
  const State s = test::at_rest(mesh, thickness);
  Model m;
  m.liquid.viscosity = 1;
  m.inertia = false;
  m.bending = bending;
  m.arcs = arcs;
  const double step = 1e-4 * k, dt = 1;
  Hold sides;
  sides.axes = axis_bit(1);
  for (const double end : {-0.5 * nx, 0.5 * nx}) {
    Hold hold;
    for (std::uint32_t v = 0; v < flat.positions.size(); ++v)
      if (std::abs(flat.positions[v].x() - 0.5 * nx - end) < 1e-9)
        hold.vertices.push_back(v);
    for (std::uint32_t e = 0; e < s.mesh->edges.size(); ++e)
      if (std::abs(flat.positions[s.mesh->edges[e][0]].x() - 0.5 * nx - end) < 1e-9 &&
          std::abs(flat.positions[s.mesh->edges[e][1]].x() - 0.5 * nx - end) < 1e-9)
        hold.clamped_edges.push_back(e);
    hold.motion = [=](double, double) {
      RigidMotion r;
      r.rotation = Eigen::AngleAxisd(-step * end, Vector3::UnitY()).toRotationMatrix();
      r.shift = on_arc(end, 0, k + step) - r.rotation * on_arc(end, 0, k);
      return r;
    };
    hold.velocity = [](double, const Vector3&) -> Vector3 { return Vector3::Zero(); }; // where it starts and ends
    m.holds.push_back(hold);
  }
  for (std::uint32_t v = 0; v < flat.positions.size(); ++v)
    if (flat.positions[v].y() == 0 || flat.positions[v].y() == ny)
      sides.vertices.push_back(v);
  for (std::uint32_t e = 0; e < s.mesh->edges.size(); ++e)
    if (s.mesh->on_rim(e) && flat.positions[s.mesh->edges[e][0]].y() == flat.positions[s.mesh->edges[e][1]].y())
      sides.clamped_edges.push_back(e);
  m.holds.push_back(sides);

  const Terms terms = make_terms(m, s.mesh);
  LinearSystem system(s.mesh, terms, m.has_angles());
  const Stage stage = first_stage(s, m.liquid, dt, dt, m.has_angles());
  for (const auto& term : terms)
    term->begin(stage);
  Unknowns u = stage.begin;
  for (std::size_t v = 0; v < flat.positions.size(); ++v)
    u.segment<3>(static_cast<Eigen::Index>(3 * v)) =
        on_arc(flat.positions[v].x() - 0.5 * nx, flat.positions[v].y(), k + step);
  place_held(m.holds, stage, dt, u);
  system.constrain({.held = held_unknowns(m.holds, stage)}, 0);
  const Unknowns start = u;
  const NewtonReport r =
      minimize(system, terms, step_scale(s, u.size()), start, {}, evaluate_first(system, terms, u), u);
  const double exact = 0.5 * thickness * thickness * thickness / 3 * step * step * nx * ny / dt;
  return r.converged ? system.value(terms, u).value / exact : NAN;
}

} // namespace

int main() {
  std::printf("h/l,k l^2/h,mesh,flat,arcs,hinge\n");
  for (const double thickness : {1.0, 0.1, 0.01, 0.001})
    for (const double locking : {0.25, 1.0, 2.5, 10.0, 25.0}) {
      const double k = locking * thickness;
      if (k > 0.3)
        continue;
      for (const double shift : {0.0, 0.25, -1.0})
        std::printf("%g,%g,%s,%.3f,%.3f,%.3f\n", thickness, locking,
                    shift < 0   ? "bricks"
                    : shift > 0 ? "irregular"
                                : "regular",
                    power_ratio(thickness, k, false, Bending::mid_edge, shift),
                    power_ratio(thickness, k, true, Bending::mid_edge, shift),
                    power_ratio(thickness, k, false, Bending::hinge, shift));
      std::fflush(stdout);
    }
}
