// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/solids.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "libsheet/base/error.h"
#include "libsheet/base/log.h"
#include "libsheet/base/named_files.h"
#include "libsheet/base/overloaded.h"

namespace sheet::render {
namespace {

constexpr double pi = std::numbers::pi;
const double crease_cosine = std::cos(40 * pi / 180);

// Of so many solids, such that a crowd of them has no more triangles than 16 have.
int facets_of_circles(std::size_t solids) {
  constexpr double most = 192, least = 12;
  return static_cast<int>(std::max(least, most * std::min(1.0, std::sqrt(16 / static_cast<double>(solids)))));
}

// Surfaces of revolution about the y axis: a profile of points (radius, height) and normals, from top to bottom.
struct ProfilePoint {
  double radius, height, normal_radius, normal_height;
};

void revolve(const std::vector<ProfilePoint>& profile, int around, SolidMesh& mesh) {
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
void add_arc(double radius, double center, double from, double to, int around, std::vector<ProfilePoint>& profile) {
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

// A corner's normal is the mean of those of the triangles around its vertex that are not across a crease from it;
// where corners of a vertex differ, the vertex stands there once for each.
void add_normals(SolidMesh& mesh) {
  std::vector<Vector3> of_triangle;
  std::vector<std::vector<std::uint32_t>> around_vertex(mesh.positions.size()); // triangles
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    of_triangle.push_back(
        (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a])); // times twice the area
    for (const std::uint32_t v : mesh.triangles[t])
      around_vertex[v].push_back(t);
  }
  const auto smooth = [&](std::uint32_t s, std::uint32_t t) {
    const Vector3 &m = of_triangle[s], &n = of_triangle[t];
    return m.dot(n) >= crease_cosine * m.norm() * n.norm();
  };
  const std::vector<Vector3> places = std::exchange(mesh.positions, {});
  const std::vector<Corners> corners = mesh.triangles;
  std::vector<std::uint32_t> made; // at a vertex
  for (std::uint32_t v = 0; v < places.size(); ++v) {
    made.clear();
    for (const std::uint32_t t : around_vertex[v]) {
      Vector3 sum = Vector3::Zero();
      for (const std::uint32_t s : around_vertex[v])
        if (smooth(s, t))
          sum += of_triangle[s];
      const Vec normal = sum.stableNormalized().cast<float>();
      auto it = std::ranges::find_if(made, [&](std::uint32_t m) { return mesh.normals[m] == normal; });
      if (it == made.end()) {
        it = made.insert(it, static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.push_back(places[v]);
        mesh.normals.push_back(normal);
      }
      for (std::size_t i = 0; i < 3; ++i)
        if (corners[t][i] == v)
          mesh.triangles[t][i] = *it;
    }
  }
}

void add_file(const scene::SolidMesh& shape, SolidMesh& mesh) try {
  const formats::ForeignMesh file = import_named_mesh(find_named_file(shape.file, shape.checksum)).mesh;
  for (const auto& p : file.points)
    mesh.positions.push_back(shape.scale * Vector3(p[0], p[1], p[2]));
  mesh.triangles = file.triangles;
  add_normals(mesh);
} catch (const Error& error) {
  fail(error.code(),
       "[[solid]] {}: {} (the scene names it as seen from the folder in which sheet-init ran: draw from there)",
       mesh.solid, error.what());
}

// False: there is nothing to draw as a mesh.
bool add_shape(const scene::SolidShape& shape, int around, SolidMesh& mesh) {
  using namespace scene;
  std::vector<ProfilePoint> profile;
  return std::visit(
      Overloaded{[&](const Sphere& s) {
                   add_arc(s.radius, 0, 0, pi, around, profile);
                   revolve(profile, around, mesh);
                   return true;
                 },
                 [&](const SolidBox& s) {
                   add_box(s.size, mesh);
                   return true;
                 },
                 [&](const Capsule& s) {
                   add_arc(s.radius, s.length / 2, 0, pi / 2, around, profile);
                   add_arc(s.radius, -s.length / 2, pi / 2, pi, around, profile);
                   revolve(profile, around, mesh);
                   return true;
                 },
                 [&](const Cylinder& s) {
                   const double r = s.radius, y = s.height / 2;
                   revolve({{0, y, 0, 1}, {r, y, 0, 1}, {r, y, 1, 0}, {r, -y, 1, 0}, {r, -y, 0, -1}, {0, -y, 0, -1}},
                           around, mesh);
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
  const int around = facets_of_circles(scene.solids.size());
  for (std::size_t i = 0; i < scene.solids.size(); ++i) {
    const scene::Solid& solid = scene.solids[i];
    SolidMesh mesh;
    mesh.solid = i;
    if (!add_shape(solid.shape, around, mesh))
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
  constexpr double facing = -0.5; // cosine between normals
  for (Plane& plane : planes)
    plane.lets_light_in =
        std::ranges::any_of(planes, [&](const Plane& other) { return plane.normal.dot(other.normal) < facing; });
  return planes;
}

Eigen::Isometry3d motion_of(const scene::Solid& solid, double time) { return motion_between(solid.motion, 0, time); }

} // namespace sheet::render
