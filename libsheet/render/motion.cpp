// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/motion.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "libsheet/sheet/sheet.h"

namespace sheet::render {
namespace {

// Of the point nearest to x in the plane of a triangle, kept within it.
Vector3 weights_in(const std::array<Vector3, 3>& corner, const Vector3& x) {
  const Vector3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  const double square = normal.squaredNorm();
  if (!(square > 0))
    return Vector3::Constant(1.0 / 3);
  Vector3 weights;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3 &a = corner[(i + 1) % 3], &b = corner[(i + 2) % 3];
    weights[static_cast<Eigen::Index>(i)] = std::max(0.0, (b - a).cross(x - a).dot(normal) / square);
  }
  return weights / weights.sum();
}

} // namespace

formats::Frame moved(const formats::Frame& frame, double later) {
  formats::Frame result = frame;
  const auto v = velocities(frame);
  const auto x = positions(result);
  for (std::size_t i = 0; i < v.size(); ++i)
    x[i] += later * v[i];
  return result;
}

double pixels_moved(const formats::Frame& frame, const Scene* scene, const std::vector<SolidMesh>& meshes,
                    double duration, const Camera& camera, int height) {
  double most = 0;
  const auto add = [&](const Vector3& before, const Vector3& after) {
    const auto a = camera.place(before - camera.eye()), b = camera.place(after - camera.eye());
    if (a && b && (*a - *b).norm() < 1) // what crosses the whole picture is no picture
      most = std::max(most, (*a - *b).cwiseProduct(Eigen::Vector2d(camera.aspect(), 1)).norm() * height);
  };
  const auto x = positions(frame);
  const auto v = velocities(frame);
  for (std::size_t i = 0; i < v.size(); ++i)
    add(x[i] - duration / 2 * v[i], x[i] + duration / 2 * v[i]);
  for (const SolidMesh& mesh : meshes) {
    const scene::Solid& solid = scene->solids[mesh.solid];
    const Eigen::Isometry3d before = motion_of(solid, frame.time - duration / 2),
                            after = motion_of(solid, frame.time + duration / 2);
    for (const Vector3& p : mesh.positions)
      add(before * p, after * p);
  }
  return most;
}

Vec velocity_at(const formats::Frame& frame, const Scene* scene, const World& world, const Hit& hit) {
  const Vector3 x = world.from_world(hit.position);
  if (hit.id == sheet_id) {
    const Corners& t = sheet::triangles(frame)[world.surface().source_triangle[hit.triangle]];
    const auto p = positions(frame);
    const auto v = velocities(frame);
    if (v.empty())
      return Vec::Zero();
    const Vector3 w = weights_in({p[t[0]], p[t[1]], p[t[2]]}, x);
    return (w[0] * v[t[0]] + w[1] * v[t[1]] + w[2] * v[t[2]]).cast<float>();
  }
  if (scene == nullptr || hit.id < first_solid_id || hit.id - first_solid_id >= scene->solids.size())
    return Vec::Zero();
  constexpr double step = 1e-5; // [s]
  const scene::Solid& solid = scene->solids[hit.id - first_solid_id];
  const Vector3 own = motion_of(solid, frame.time).inverse() * x;
  return ((motion_of(solid, frame.time + step) * own - motion_of(solid, frame.time - step) * own) / (2 * step))
      .cast<float>();
}

Picture mean_of(const std::vector<Picture>& pictures) {
  Picture mean = pictures.front();
  const auto count = static_cast<float>(pictures.size());
  for (std::size_t i = 0; i < mean.light.pixels.size(); ++i) {
    Colour sum = Colour::Zero();
    for (const Picture& picture : pictures)
      sum += picture.light.pixels[i];
    mean.light.pixels[i] = sum / count;
  }
  for (std::size_t i = 0; i < mean.alpha.size(); ++i) {
    float sum = 0;
    for (const Picture& picture : pictures)
      sum += picture.alpha[i];
    mean.alpha[i] = sum / count;
  }
  float squares = 0, worst = 0;
  mean.samples = 0;
  mean.rays = 0;
  for (const Picture& picture : pictures) {
    squares += picture.noise * picture.noise;
    worst = std::max(worst, picture.worst_noise);
    mean.samples += picture.samples;
    mean.rays += picture.rays;
  }
  mean.noise = std::sqrt(squares) / count;
  mean.worst_noise = worst / std::sqrt(count);
  return mean;
}

} // namespace sheet::render
