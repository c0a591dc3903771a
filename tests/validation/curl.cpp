// SPDX-License-Identifier: GPL-3.0-or-later
// V14: bending moment of a sheet that is being rolled up, on a square patch of a mesh. The patch lies on a cylinder, is
// half as long again as the radius, and its rim follows the exact motion (curvature k to k + dk, no stretching),
// normals too; inside it is free. The rim's uniform stretching along the arc is chosen so that it costs least, that is,
// no force pulls at the ends. Power over that of pure bending, D k̇² a unit of area, D = μ h³/3: what exceeds 1 is
// locking.
#include <algorithm>

#include "tests/validation/instant.h"

namespace sheet::validation {

namespace {

struct Roll {
  double curvature, turned; // [1/m], angle [rad] of the bending direction in the mesh
  [[nodiscard]] double along(const Vector3& x) const { return x.x() * std::cos(turned) + x.y() * std::sin(turned); }
  [[nodiscard]] Vector3 place(const Vector3& x, double k, double stretch) const {
    const double s = (1 + stretch) * along(x), y = -x.x() * std::sin(turned) + x.y() * std::cos(turned);
    return {std::sin(k * s) / k, y, (1 - std::cos(k * s)) / k};
  }
};

} // namespace

// Sets: h/edge = 1, 0.1, 0.01, 0.001 with the mesh turned by 0 (1-4), 30 (5-8), 45 degrees (9-12).
Result v14(const Settings& s) {
  const double ratio = std::pow(10.0, -((s.set - 1) % 4)), turned[3] = {0, pi / 6, pi / 4};
  const double h = ratio * s.edge, mu = 1, dt = 1;
  const Roll roll{1.5, turned[(s.set - 1) / 4]};
  const double dk = 1e-5 * roll.curvature;
  const TriangleMesh flat = make_rectangle(1, 1, mesh_options(s, 1));
  State start = film(flat, h);
  const double area = sheet_area(start);
  for (Vector3& x : start.positions)
    x = roll.place(x, roll.curvature, 0);
  Model m = viscous(mu, s);
  Hold rim;
  for (std::uint32_t e = 0; e < start.mesh->edges.size(); ++e)
    if (start.mesh->on_rim(e)) {
      rim.clamped_edges.push_back(e);
      for (const auto v : start.mesh->edges[e])
        if (std::find(rim.vertices.begin(), rim.vertices.end(), v) == rim.vertices.end())
          rim.vertices.push_back(v);
    }
  m.holds.push_back(rim);

  Result result;
  const auto power = [&](double stretch) {
    const auto middle = [&](std::uint32_t e) {
      const Edge& ends = start.mesh->edges[e];
      return roll.along(0.5 * (flat.positions[ends[0]] + flat.positions[ends[1]]));
    };
    const auto turned_by = [](double angle) -> Matrix3 {
      return Eigen::AngleAxisd(-angle, Vector3::UnitY()).toRotationMatrix();
    };
    // The rim's directors are the cylinder's normals, not those of the triangles beside it.
    const auto exact_rim = [&](Stage& stage) {
      if (stage.frames.empty())
        return;
      for (const auto e : rim.clamped_edges) {
        EdgeFrame& f = stage.frames[e];
        const Vector3 n = turned_by(roll.curvature * middle(e)) * Vector3::UnitZ();
        f.director = (n - n.dot(f.tangent) * f.tangent).normalized();
        f.binormal = f.tangent.cross(f.director);
      }
    };
    const auto place = [&](const Stage& stage, Unknowns& u) {
      for (std::uint32_t v = 0; v < flat.positions.size(); ++v) // inside: the start of the iteration
        u.segment<3>(3 * v) = roll.place(flat.positions[v], roll.curvature + dk, stretch);
      if (stage.frames.empty())
        return;
      for (const auto e : rim.clamped_edges) {
        const Edge& ends = start.mesh->edges[e];
        const Matrix3 turn = turned_by(dk * middle(e));
        const Vector3 t = (u.segment<3>(3 * ends[1]) - u.segment<3>(3 * ends[0])).normalized();
        const Vector3 brought = stage.frames[e].carried(0, t), wanted = turn * stage.frames[e].director;
        u[static_cast<Eigen::Index>(3 * stage.vertices() + e)] =
            std::atan2(brought.cross(wanted).dot(t), brought.dot(wanted));
      }
    };
    const Instant i = solve_instant(start, m, dt, place, exact_rim);
    result.seconds += i.seconds;
    result.iterations += i.iterations;
    return i.potential;
  };
  const double step = roll.curvature * dk * s.edge * s.edge / 12;
  const double none = power(0), more = power(step), less = power(-step);
  const double bend = more + less - 2 * none, slope = more - less;
  const double least = bend > 0 ? none - slope * slope / (8 * bend) : none;
  result.value = least / (0.5 * mu * h * h * h / 3 * dk * dk / dt * area);
  result.error = result.value - 1;
  result.vertices = start.positions.size();
  result.edge = mean_edge(start);
  result.steps = 1;
  result.more = {{"h_over_edge", ratio},
                 {"turned", roll.turned * 180 / pi},
                 {"k_l2_over_h", roll.curvature * s.edge / ratio},
                 {"ends_held", none / (0.5 * mu * h * h * h / 3 * dk * dk / dt * area)}};
  return result;
}

} // namespace sheet::validation
