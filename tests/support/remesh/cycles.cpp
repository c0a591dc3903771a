// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/remesh/cycles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "libsheet/shape/shapes.h"
#include "tests/support/remesh/options.h"

namespace sheet::test {

namespace {

using std::numbers::pi;

// [Neumaier 1974]
class Sum {
public:
  void add(double x) {
    const double t = sum_ + x;
    rest_ += std::abs(sum_) >= std::abs(x) ? (sum_ - t) + x : (x - t) + sum_;
    sum_ = t;
  }
  [[nodiscard]] double value() const { return sum_ + rest_; }

private:
  double sum_ = 0, rest_ = 0;
};

} // namespace

Account account_of(const formats::Frame& frame) {
  const auto x = positions(frame);
  const auto u = velocities(frame);
  const auto triangle = triangles(frame);
  const auto v = volumes(frame);
  Sum volume, area, enclosed, speed, energy, momentum[3], angular[3];
  Account a;
  a.thickness_min = 1e300;
  for (std::size_t t = 0; t < triangle.size(); ++t) {
    const Corners& c = triangle[t];
    const double size = 0.5 * (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).norm();
    volume.add(v[t]);
    area.add(size);
    enclosed.add((x[c[0]] + x[c[1]] + x[c[2]])[2] / 6 * (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]])[2]);
    a.thickness_min = std::min(a.thickness_min, v[t] / size);
    a.thickness_max = std::max(a.thickness_max, v[t] / size);
    for (const std::uint32_t i : c) {
      if (u.empty())
        continue;
      const Vector3 p = v[t] / 3 * u[i], l = x[i].cross(p);
      speed.add(p.norm());
      energy.add(v[t] / 6 * u[i].squaredNorm());
      for (int k = 0; k < 3; ++k) {
        momentum[k].add(p[k]);
        angular[k].add(l[k]);
      }
    }
  }
  a.volume = volume.value();
  a.area = area.value();
  a.enclosed = enclosed.value();
  a.speed_sum = speed.value();
  a.kinetic_energy = energy.value();
  for (int k = 0; k < 3; ++k) {
    a.momentum[k] = momentum[k].value();
    a.angular_momentum[k] = angular[k].value();
  }
  return a;
}

TriangleMesh torus(double radius, double tube, std::uint32_t around, std::uint32_t across) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const double a = 2 * pi * (i + 0.5 * (j % 2)) / around, b = 2 * pi * j / across;
      const double r = radius + tube * std::cos(b);
      mesh.positions.emplace_back(r * std::cos(a), r * std::sin(a), tube * std::sin(b));
    }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return (i % around) * across + j % across; };
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const std::uint32_t o = j % 2; // odd rows are shifted by half a step
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + o, j + 1)});
      mesh.triangles.push_back({at(i + 1, j), at(i + o + 1, j + 1), at(i + o, j + 1)});
    }
  return mesh;
}

TriangleMesh wrinkled(double edge_length, double height, double side) {
  TriangleMesh mesh = make_rectangle(side, side, edges(edge_length));
  for (Vector3& x : mesh.positions)
    x[2] = height * std::sin(8 * pi * x[0]) * std::cos(14 * pi * x[1]);
  return mesh;
}

TriangleMesh joined(TriangleMesh mesh, const TriangleMesh& other, const Vector3& shift) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vector3& x : other.positions)
    mesh.positions.push_back(x + shift);
  for (TriangleIndices t : other.triangles) {
    for (std::uint32_t& v : t)
      v += first;
    mesh.triangles.push_back(t);
  }
  return mesh;
}

TriangleMesh two_caps(double edge_length, double gap) {
  const TriangleMesh cap = make_cap(1, pi / 3, edges(edge_length));
  return joined(cap, cap, {0, 0, gap});
}

TriangleMesh z_fold(double edge_length, double gap) {
  // three layers of length 1, joined by half circles whose diameter is the gap
  TriangleMesh mesh = make_rectangle(3 + pi * gap, 0.5, edges(edge_length));
  const double bend = pi * gap / 2;
  for (Vector3& x : mesh.positions) {
    double s = x[0] + (3 + pi * gap) / 2;
    if (s < 1) {
      x = {s, x[1], 0};
    } else if (s < 1 + bend) {
      const double a = (s - 1) / (gap / 2);
      x = {1 + gap / 2 * std::sin(a), x[1], gap / 2 * (1 - std::cos(a))};
    } else if (s < 2 + bend) {
      x = {1 - (s - 1 - bend), x[1], gap};
    } else if (s < 2 + 2 * bend) {
      const double a = (s - 2 - bend) / (gap / 2);
      x = {-gap / 2 * std::sin(a), x[1], gap + gap / 2 * (1 - std::cos(a))};
    } else {
      x = {s - 2 - 2 * bend, x[1], 2 * gap};
    }
  }
  return mesh;
}

std::uint64_t cycle(formats::Frame& frame, remesh::Options options) {
  const double length = options.size.edge_length;
  options.size.edge_length = length / 2;
  std::uint64_t edits = remesh::remesh(frame, nullptr, options).edits();
  options.size.edge_length = length;
  edits += remesh::remesh(frame, nullptr, options).edits();
  return edits;
}

} // namespace sheet::test
