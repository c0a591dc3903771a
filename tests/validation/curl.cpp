// SPDX-License-Identifier: GPL-3.0-or-later
// V14: bending moment of a sheet that is being rolled up, on a square patch of a mesh. The patch lies on a cylinder, is
// half as long again as the radius, and its rim follows the exact motion (curvature k to k + dk, no stretching),
// normals too; inside it is free. The rim's uniform stretching along the arc is chosen so that it costs least, that is,
// no force pulls at the ends. Power over that of pure bending, D k̇² a unit of area, D = μ h³/3: what exceeds 1 is
// locking. With more than one step the patch has been rolled up from the plane in so many of them, so that its inside
// and its directors are what steps have made of them; with one it is the cylinder, its directors the mean normals.
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

// A patch that is held by its rim.
class Patch {
public:
  Patch(const Settings& s, const Roll& roll, double h)
      : flat_(make_rectangle(1, 1, mesh_options(s, 1))), roll_(roll), model_(viscous(1, s)), state_(film(flat_, h)) {
    area_ = sheet_area(state_);
    Hold rim;
    for (std::uint32_t e = 0; e < state_.mesh->edges.size(); ++e)
      if (state_.mesh->on_rim(e)) {
        rim.clamped_edges.push_back(e);
        for (const auto v : state_.mesh->edges[e])
          if (std::find(rim.vertices.begin(), rim.vertices.end(), v) == rim.vertices.end())
            rim.vertices.push_back(v);
      }
    model_.holds.push_back(rim);
  }

  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] double area() const { return area_; }

  void put_on_cylinder() {
    for (Vector3& x : state_.positions)
      x = roll_.place(x, roll_.curvature, 0);
    curvature_ = roll_.curvature;
  }

  void roll_up(int steps) {
    for (int k = 1; k <= steps; ++k) {
      const double curvature = k * roll_.curvature / steps;
      state_ = bend(curvature, 0, 1.0 / steps).next;
      curvature_ = curvature;
    }
  }

  // To another curvature in the time dt.
  [[nodiscard]] Instant bend(double curvature, double stretch, double dt) const {
    // The rim's directors are the cylinder's normals, not those of the triangles beside it.
    const auto exact_rim = [&](Stage& stage) {
      for (const auto e : model_.holds[0].clamped_edges) {
        if (stage.frames.empty())
          return;
        EdgeFrame& f = stage.frames[e];
        const Vector3 n = turned_by(curvature_ * middle(e)) * Vector3::UnitZ();
        f.director = (n - n.dot(f.tangent) * f.tangent).normalized();
        f.binormal = f.tangent.cross(f.director);
      }
    };
    const auto place = [&](const Stage& stage, Unknowns& u) {
      for (std::uint32_t v = 0; v < flat_.positions.size(); ++v) // inside: the start of the iteration
        u.segment<3>(3 * v) = roll_.place(flat_.positions[v], curvature, stretch);
      for (const auto e : model_.holds[0].clamped_edges) {
        if (stage.frames.empty())
          return;
        const Edge& ends = state_.mesh->edges[e];
        const Matrix3 turn = turned_by((curvature - curvature_) * middle(e));
        const Vector3 t = (u.segment<3>(3 * ends[1]) - u.segment<3>(3 * ends[0])).normalized();
        const Vector3 brought = stage.frames[e].carried(t), wanted = turn * stage.frames[e].director;
        u[static_cast<Eigen::Index>(3 * stage.vertices() + e)] =
            std::atan2(brought.cross(wanted).dot(t), brought.dot(wanted));
      }
    };
    return solve_instant(state_, model_, dt, place, exact_rim);
  }

private:
  [[nodiscard]] double middle(std::uint32_t e) const {
    const Edge& ends = state_.mesh->edges[e];
    return roll_.along(0.5 * (flat_.positions[ends[0]] + flat_.positions[ends[1]]));
  }
  [[nodiscard]] static Matrix3 turned_by(double angle) {
    return Eigen::AngleAxisd(-angle, Vector3::UnitY()).toRotationMatrix();
  }

  TriangleMesh flat_;
  Roll roll_;
  Model model_;
  State state_;
  double area_ = 0, curvature_ = 0;
};

} // namespace

// Sets: h/edge = 1, 0.1, 0.01, 0.001 with the mesh turned by 0 (1-4), 30 (5-8), 45 degrees (9-12).
Result v14(const Settings& s) {
  const double ratio = std::pow(10.0, -((s.set - 1) % 4)), turned[3] = {0, pi / 6, pi / 4};
  const double h = ratio * s.edge, mu = 1, dt = 1;
  const Roll roll{1.5, turned[(s.set - 1) / 4]};
  const double dk = 1e-5 * roll.curvature;
  Patch patch(s, roll, h);
  if (s.steps > 1)
    patch.roll_up(s.steps);
  else
    patch.put_on_cylinder();
  Result result;
  const auto power = [&](double stretch) {
    const Instant i = patch.bend(roll.curvature + dk, stretch, dt);
    result.seconds += i.seconds;
    result.iterations += i.iterations;
    return i.potential;
  };
  const double step = roll.curvature * dk * s.edge * s.edge / 12;
  const double none = power(0), more = power(step), less = power(-step);
  const double bend = more + less - 2 * none, slope = more - less;
  const double least = bend > 0 ? none - slope * slope / (8 * bend) : none;
  const double exact = 0.5 * mu * h * h * h / 3 * dk * dk / dt * patch.area();
  result.value = least / exact;
  result.error = result.value - 1;
  result.vertices = patch.state().positions.size();
  result.edge = mean_edge(patch.state());
  result.steps = s.steps;
  result.more = {{"h_over_edge", ratio},
                 {"turned", roll.turned * 180 / pi},
                 {"k_l2_over_h", roll.curvature * s.edge / ratio},
                 {"ends_held", none / exact}};
  return result;
}

} // namespace sheet::validation
