// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/mesh_width.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace sheet {

namespace {

constexpr int places = 500, lines_across = 4;
constexpr double tips = 0.02;    // of the places
constexpr double nothing = 1e-6; // of the solid's size: nearer than that is on its surface

// The i-th of evenly spread numbers between 0 and 1 [van der Corput 1935].
double spread(int i, int base) {
  double number = 0;
  for (double digit = 1.0 / base; i > 0; i /= base, digit /= base)
    number += digit * (i % base);
  return number;
}

// From a point inside along a unit vector to the surface [m], and the normal there.
struct WayOut {
  double length;
  Vector3 normal;
};
WayOut way_out(const solid::SolidDistance& solid, const Vector3& from, const Vector3& along, double skin) {
  constexpr int most = 200;
  solid::Near near = solid.nearest(from);
  double length = 0;
  for (int i = 0; i < most && -near.distance > skin; ++i) {
    length -= near.distance;
    near = solid.nearest(from + length * along);
  }
  return {length, near.normal};
}

// Through a point inside along a unit vector, between walls that face away from each other; else infinite: a corner is
// not narrow because lines cut it off [m].
double chord(const solid::SolidDistance& solid, const Vector3& from, const Vector3& along, double skin) {
  constexpr double opposite = -0.7; // of the normals' product
  const WayOut ahead = way_out(solid, from, along, skin), back = way_out(solid, from, -along, skin);
  return ahead.normal.dot(back.normal) < opposite ? ahead.length + back.length
                                                  : std::numeric_limits<double>::infinity();
}

// At a place on the surface with this outward normal [m]; infinite at an edge.
double width_at(const solid::SolidDistance& solid, const Vector3& place, const Vector3& normal, double skin) {
  const Vector3 below = place - 3 * skin * normal;
  if (-solid.nearest(below).distance < 2.5 * skin)
    return std::numeric_limits<double>::infinity();
  const double through = way_out(solid, below, -normal, skin).length;
  const Vector3 middle = below - through / 2 * normal;
  const Vector3 first = normal.unitOrthogonal(), second = normal.cross(first);
  double across = std::numeric_limits<double>::infinity();
  for (int k = 0; k < lines_across; ++k) {
    const double angle = std::numbers::pi * k / lines_across;
    across = std::min(across, chord(solid, middle, std::cos(angle) * first + std::sin(angle) * second, skin));
  }
  return std::max(through, across);
}

} // namespace

double narrow_width(const solid::SolidDistance& solid) {
  const solid::Box3 box = solid.bounds();
  const double skin = nothing * box.diagonal().norm();
  std::vector<double> widths;
  for (int i = 1; i <= places; ++i) {
    const Vector3 x = box.min() + box.sizes().cwiseProduct(Vector3(spread(i, 2), spread(i, 3), spread(i, 5)));
    const solid::Near near = solid.nearest(x);
    widths.push_back(width_at(solid, x - near.distance * near.normal, near.normal, skin));
  }
  const auto narrow = widths.begin() + static_cast<std::ptrdiff_t>(tips * places);
  std::ranges::nth_element(widths, narrow);
  return *narrow;
}

} // namespace sheet
