// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/rigid_group.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>

namespace sheet::collide {

namespace {

struct Body {
  double mass = 0;
  Vector3 center = Vector3::Zero();
  Matrix3 inertia = Matrix3::Zero(); // about the center
};

Body body_of(std::span<const std::uint32_t> members, std::span<const double> mass, std::span<const Vector3> x) {
  Body body;
  const Vector3 origin = x[members.front()];
  for (const std::uint32_t v : members) {
    body.mass += mass[v];
    body.center += mass[v] * (x[v] - origin);
  }
  body.center = origin + body.center / body.mass;
  for (const std::uint32_t v : members) {
    const Vector3 r = x[v] - body.center;
    body.inertia += mass[v] * (r.squaredNorm() * Matrix3::Identity() - r * r.transpose());
  }
  return body;
}

// ω with inertia ω = l, without a part about axes of nearly no inertia.
Vector3 rate_of(const Matrix3& inertia, const Vector3& l) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> axes(inertia);
  Vector3 rate = Vector3::Zero();
  for (Eigen::Index i = 0; i < 3; ++i)
    if (const double moment = axes.eigenvalues()[i]; moment > 1e-9 * axes.eigenvalues()[2])
      rate += axes.eigenvectors().col(i).dot(l) / moment * axes.eigenvectors().col(i);
  return rate;
}

RigidStep about(const Matrix3& turn, const Vector3& from, const Vector3& to) { return {turn, to - turn * from}; }

} // namespace

Sets::Sets(std::size_t vertices) : parent_(vertices) { std::iota(parent_.begin(), parent_.end(), 0U); }

std::uint32_t Sets::root(std::uint32_t v) const {
  while (parent_[v] != v)
    v = parent_[v];
  return v;
}

void Sets::join(std::uint32_t a, std::uint32_t b) {
  const std::uint32_t first = root(a), second = root(b), top = std::min(first, second);
  parent_[std::max(first, second)] = top;
  for (std::uint32_t v : {a, b}) // shortens the way for the next time
    while (parent_[v] != v) {
      const std::uint32_t next = parent_[v];
      parent_[v] = top;
      v = next;
    }
}

std::vector<std::vector<std::uint32_t>> Sets::all() const {
  std::map<std::uint32_t, std::vector<std::uint32_t>> sets;
  for (std::uint32_t v = 0; v < parent_.size(); ++v)
    if (const std::uint32_t r = root(v); r != v) {
      auto& members = sets[r];
      if (members.empty())
        members.push_back(r);
      members.push_back(v);
    }
  std::vector<std::vector<std::uint32_t>> list;
  for (auto& [first, members] : sets)
    list.push_back(std::move(members));
  return list;
}

std::optional<RigidStep> momentum_motion(std::span<const std::uint32_t> members, std::span<const double> mass,
                                         std::span<const Vector3> start, std::span<const Vector3> end) {
  const Body body = body_of(members, mass, start);
  Vector3 shift = Vector3::Zero(), angular = Vector3::Zero();
  for (const std::uint32_t v : members) {
    const Vector3 way = end[v] - start[v];
    shift += mass[v] / body.mass * way;
    angular += mass[v] * (start[v] - body.center).cross(way);
  }
  const Vector3 turn = rate_of(body.inertia, angular);
  const double angle = turn.norm();
  if (!(angle < 1.5))
    return std::nullopt;
  const Matrix3 rotation =
      angle > 0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Matrix3(Matrix3::Identity());
  return about(rotation, body.center, body.center + shift);
}

std::optional<RigidStep> common_motion(std::span<const std::uint32_t> members, std::span<const Vector3> start,
                                       std::span<const Vector3> end) {
  const auto n = static_cast<double>(members.size());
  Vector3 from = Vector3::Zero(), to = Vector3::Zero();
  for (const std::uint32_t v : members) {
    from += start[v] / n;
    to += end[v] / n;
  }
  double extent = 0;
  Matrix3 covariance = Matrix3::Zero();
  for (const std::uint32_t v : members) {
    extent = std::max({extent, (start[v] - from).norm(), (end[v] - start[v]).norm()});
    covariance += (end[v] - to) * (start[v] - from).transpose();
  }
  const auto fits = [&](const RigidStep& step) {
    return std::all_of(members.begin(), members.end(),
                       [&](std::uint32_t v) { return (step(start[v]) - end[v]).norm() <= 1e-9 * extent; });
  };
  const RigidStep shift{Matrix3::Identity(), to - from};
  if (fits(shift))
    return shift;
  const Eigen::JacobiSVD<Matrix3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vector3 signs(1, 1, svd.matrixU().determinant() * svd.matrixV().determinant() < 0 ? -1 : 1);
  const RigidStep turned = about(svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose(), from, to);
  if (fits(turned))
    return turned;
  return std::nullopt;
}

std::optional<RigidStep> common_shift(std::span<const std::uint32_t> members, std::span<const Axes> fixed,
                                      std::span<const double> mass, std::span<const Vector3> start,
                                      std::span<const Vector3> end) {
  double longest = 0;
  for (const std::uint32_t v : members)
    longest = std::max(longest, (end[v] - start[v]).norm());
  RigidStep step;
  for (int a = 0; a < 3; ++a) {
    double sum = 0, masses = 0;
    std::optional<double> prescribed;
    for (const std::uint32_t v : members) {
      const double way = end[v][a] - start[v][a];
      sum += mass[v] * way;
      masses += mass[v];
      if (!has_axis(fixed[v], a))
        continue;
      if (prescribed && std::abs(*prescribed - way) > 1e-9 * longest)
        return std::nullopt;
      prescribed = way;
    }
    step.shift[a] = prescribed.value_or(sum / masses);
  }
  return step;
}

Momentum momentum(std::span<const std::uint32_t> members, std::span<const double> mass,
                  std::span<const Vector3> positions, std::span<const Vector3> velocities, const Vector3& center) {
  Momentum sum;
  for (const std::uint32_t v : members) {
    sum.linear += mass[v] * velocities[v];
    sum.angular += mass[v] * (positions[v] - center).cross(velocities[v]);
  }
  return sum;
}

RigidVelocity rigid_velocity(std::span<const std::uint32_t> members, std::span<const double> mass,
                             std::span<const Vector3> positions, const Momentum& wanted, const Vector3& center) {
  const Body body = body_of(members, mass, positions);
  return {body.center, wanted.linear / body.mass,
          rate_of(body.inertia, wanted.angular - (body.center - center).cross(wanted.linear))};
}

void add_momentum(std::span<const std::uint32_t> members, std::span<const double> mass,
                  std::span<const Vector3> positions, std::span<Vector3> velocities, Momentum wanted,
                  const Vector3& center) {
  const RigidVelocity velocity = rigid_velocity(members, mass, positions, wanted, center);
  for (const std::uint32_t v : members)
    velocities[v] += velocity(positions[v]);
}

} // namespace sheet::collide
