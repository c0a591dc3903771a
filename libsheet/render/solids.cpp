// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/solids.h"

#include <cmath>
#include <numbers>

#include "libsheet/base/error.h"
#include "libsheet/base/log.h"
#include "libsheet/base/named_files.h"
#include "libsheet/scene/overloaded.h"

namespace sheet::render {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int around = 192; // facets of a circle

// Surfaces of revolution about the y axis: a profile of points (radius, height) and normals, from top to bottom.
struct ProfilePoint {
  double radius, height, normal_radius, normal_height;
};

void revolve(const std::vector<ProfilePoint>& profile, SolidMesh& mesh) {
  for (const ProfilePoint& p : profile)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * pi * i / around, c = std::cos(angle), s = std::sin(angle);
      mesh.positions.emplace_back(p.radius * s, p.height, p.radius * c);
      mesh.normals.push_back(Vector3(p.normal_radius * s, p.normal_height, p.normal_radius * c).cast<float>());
    }
  for (std::size_t ring = 0; ring + 1 < profile.size(); ++ring) {
    if (profile[ring].radius == profile[ring + 1].radius && profile[ring].height == profile[ring + 1].height)
      continue; // a sharp edge: one place, two normals
    for (int i = 0; i < around; ++i) {
      const auto at = [&](std::size_t r, int k) { return static_cast<std::uint32_t>(r * around + k % around); };
      if (profile[ring].radius > 0)
        mesh.triangles.push_back({at(ring, i), at(ring + 1, i), at(ring, i + 1)});
      if (profile[ring + 1].radius > 0)
        mesh.triangles.push_back({at(ring, i + 1), at(ring + 1, i), at(ring + 1, i + 1)});
    }
  }
}

// The arc of a sphere from one polar angle to another, its center at the height `center`.
void add_arc(double radius, double center, double from, double to, std::vector<ProfilePoint>& profile) {
  const int steps = std::max(2, static_cast<int>(std::lround(around * std::abs(to - from) / (2 * pi))));
  for (int i = 0; i <= steps; ++i) {
    const double polar = from + (to - from) * i / steps;
    const double s = i == 0 && from == 0 ? 0 : i == steps && to == pi ? 0 : std::sin(polar);
    profile.push_back({radius * s, center + radius * std::cos(polar), s, std::cos(polar)});
  }
}

void add_box(const Vector3& size, SolidMesh& mesh) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Vector3 n = Vector3::Zero(), u = Vector3::Zero(), v = Vector3::Zero();
      n[axis] = side;
      u[(axis + 1) % 3] = side;
      v[(axis + 2) % 3] = 1;
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        mesh.positions.push_back(0.5 * size.cwiseProduct(n + a * u + b * v));
        mesh.normals.push_back(n.cast<float>());
      }
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
}

void add_file(const scene::SolidMesh& shape, SolidMesh& mesh) try {
  const formats::ForeignMesh file = import_named_mesh(shape.file).mesh;
  for (const auto& p : file.points)
    mesh.positions.push_back(shape.scale * Vector3(p[0], p[1], p[2]));
  mesh.triangles = file.triangles;
  std::vector<Vector3> sum(mesh.positions.size(), Vector3::Zero());
  for (const Corners& t : mesh.triangles) {
    const Vector3 n = (mesh.positions[t[1]] - mesh.positions[t[0]]).cross(mesh.positions[t[2]] - mesh.positions[t[0]]);
    for (const std::uint32_t v : t)
      sum[v] += n;
  }
  for (const Vector3& n : sum)
    mesh.normals.push_back(n.stableNormalized().cast<float>());
} catch (const Error& error) {
  fail(error.code(),
       "[[solid]] {}: {} (the scene names it as seen from the folder in which sheet-init ran: draw from there)",
       mesh.solid, error.what());
}

// False: there is nothing to draw as a mesh.
bool add_shape(const scene::SolidShape& shape, SolidMesh& mesh) {
  using namespace scene;
  std::vector<ProfilePoint> profile;
  return std::visit(
      Overloaded{
          [&](const Sphere& s) {
            add_arc(s.radius, 0, 0, pi, profile);
            revolve(profile, mesh);
            return true;
          },
          [&](const SolidBox& s) {
            add_box(s.size, mesh);
            return true;
          },
          [&](const Capsule& s) {
            add_arc(s.radius, s.length / 2, 0, pi / 2, profile);
            add_arc(s.radius, -s.length / 2, pi / 2, pi, profile);
            revolve(profile, mesh);
            return true;
          },
          [&](const Cylinder& s) {
            const double r = s.radius, y = s.height / 2;
            revolve({{0, y, 0, 1}, {r, y, 0, 1}, {r, y, 1, 0}, {r, -y, 1, 0}, {r, -y, 0, -1}, {0, -y, 0, -1}}, mesh);
            return true;
          },
          [](const HalfSpace&) { return false; },
          [&](const scene::SolidMesh& s) {
            if (s.file.ends_with(".vdb")) {
              log::warning("[[solid]] {}: {} is a distance field and is not drawn", mesh.solid, s.file);
              return false;
            }
            add_file(s, mesh);
            return true;
          }},
      shape);
}

} // namespace

std::vector<SolidMesh> make_solids(const Scene& scene) {
  std::vector<SolidMesh> meshes;
  for (std::size_t i = 0; i < scene.solids.size(); ++i) {
    const scene::Solid& solid = scene.solids[i];
    SolidMesh mesh;
    mesh.solid = i;
    if (!add_shape(solid.shape, mesh))
      continue;
    const Eigen::Matrix3d turn = matrix(solid.rotation);
    for (Vector3& x : mesh.positions)
      x = solid.center + turn * x;
    for (Vec& n : mesh.normals)
      n = turn.cast<float>() * n;
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

std::vector<Plane> make_planes(const Scene& scene, double time) {
  std::vector<Plane> planes;
  for (std::size_t i = 0; i < scene.solids.size(); ++i) {
    const scene::Solid& solid = scene.solids[i];
    if (const auto* shape = std::get_if<scene::HalfSpace>(&solid.shape)) {
      const Eigen::Isometry3d motion = motion_of(solid, time);
      planes.push_back({first_solid_id + static_cast<std::uint32_t>(i), motion * solid.center,
                        motion.linear() * matrix(solid.rotation) * shape->normal.stableNormalized()});
    }
  }
  return planes;
}

Eigen::Isometry3d motion_of(const scene::Solid& solid, double time) { return motion_between(solid.motion, 0, time); }

} // namespace sheet::render
