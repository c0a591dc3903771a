// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes for the tests of solids.
#pragma once
#include <random>

#include "libsheet/solid/mesh.h"
#include "libsheet/solid/shapes.h"
#include "tests/support/falling_sheet.h"

namespace sheet::solid {

inline SolidSurface surface_of(const test::Mesh& mesh) {
  SolidSurface surface{mesh.positions, {}};
  for (const auto& t : mesh.triangles)
    surface.triangles.push_back({t[0], t[1], t[2]});
  return surface;
}

// Twelve triangles around the origin.
inline SolidSurface box_surface(const Vector3& size) {
  SolidSurface surface;
  for (int i = 0; i < 8; ++i)
    surface.points.push_back(Vector3((i & 1) - 0.5, (i >> 1 & 1) - 0.5, (i >> 2 & 1) - 0.5).cwiseProduct(size));
  surface.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                       {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return surface;
}

// A box with a closed hollow of half its size.
inline SolidSurface hollow_box(const Vector3& size) {
  SolidSurface surface = box_surface(size);
  const SolidSurface wall = box_surface(0.5 * size);
  const auto first = static_cast<std::uint32_t>(surface.points.size());
  surface.points.insert(surface.points.end(), wall.points.begin(), wall.points.end());
  for (const auto& [a, b, c] : wall.triangles)
    surface.triangles.push_back({first + a, first + c, first + b});
  return surface;
}

// Uniform in a cube around the origin.
class RandomPoints {
public:
  explicit RandomPoints(double half_side) : range_(-half_side, half_side) {}
  Vector3 next() {
    const double x = range_(generator_), y = range_(generator_), z = range_(generator_);
    return {x, y, z};
  }

private:
  std::mt19937 generator_{12345};
  std::uniform_real_distribution<double> range_;
};

struct NamedShape {
  std::string name;
  std::unique_ptr<const SolidDistance> distance;
};

inline std::vector<NamedShape> convex_shapes() {
  std::vector<NamedShape> shapes;
  shapes.push_back({"sphere", make_distance(scene::Sphere{0.7})});
  shapes.push_back({"box", make_distance(scene::SolidBox{{1, 0.6, 1.4}})});
  shapes.push_back({"capsule", make_distance(scene::Capsule{0.2, 1.1})});
  shapes.push_back({"cylinder", make_distance(scene::Cylinder{0.5, 0.8})});
  shapes.push_back({"half-space", make_distance(scene::HalfSpace{{1, 2, -0.5}})});
  return shapes;
}

inline std::vector<NamedShape> all_shapes() {
  std::vector<NamedShape> shapes = convex_shapes();
  shapes.push_back({"box, a mesh", make_distance(box_surface({1, 0.6, 1.4}), 0.05)});
  shapes.push_back({"hollow box, a mesh", make_distance(hollow_box({1, 0.8, 1.4}), 0.05)});
  shapes.push_back({"ball, a mesh", make_distance(surface_of(test::icosphere(2)), 0.05)});
  SolidSurface needle = test::needle(0.02, 0.9, 5);
  shapes.push_back({"needle, a mesh", make_distance(std::move(needle), 0.02)});
  return shapes;
}

} // namespace sheet::solid
