// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/overlapping.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "libsheet/geometry/area.h"
#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/landing.h"
#include "libsheet/plan/way_of_sheet.h"
#include "libsheet/scene/brief.h"
#include "libsheet/shape/build.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/triangle_distance.h"

namespace sheet {

namespace {

using formats::Frame;

// The least distance of some of a sheet's vertices from another one, of those that lie before its faces, not beside its
// rim [m].
double face_to_face(const Frame& sheet, const Frame& other) {
  constexpr double before = 0.7; // cosine between the way there and the normal
  const auto x = positions(other);
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t v : probes_of(sheet))
    for (const Corners& c : triangles(other)) {
      const Vector3 way =
          positions(sheet)[v] - solid::nearest_on_triangle(positions(sheet)[v], {x[c[0]], x[c[1]], x[c[2]]}).point;
      const double distance = way.norm();
      if (distance < least &&
          std::abs(way.dot(TriangleArea(x[c[0]], x[c[1]], x[c[2]]).normal.normalized())) >= before * distance)
        least = distance;
    }
  return least;
}

} // namespace

std::string overlapping_warning(const Scene& scene) {
  constexpr double apart = 0.75; // of the mean thickness
  std::vector<std::optional<Frame>> sheets;
  for (std::size_t i = 0; i < scene.sheets.size(); ++i)
    sheets.push_back(scene.sheets[i].enters || scene.sheets.size() < 2
                         ? std::nullopt
                         : std::optional(build_sheet(scene, i, Notes::silent)));
  double worst = apart;
  std::string warning;
  for (std::size_t i = 0; i < sheets.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (!sheets[i] || !sheets[j] ||
          !way_of_sheet(*sheets[i], Vector3::Zero()).intersects(way_of_sheet(*sheets[j], Vector3::Zero())))
        continue;
      const double thickness =
          (measured(*sheets[i]).thickness.value_or(0) + measured(*sheets[j]).thickness.value_or(0)) / 2;
      const double distance = std::min(face_to_face(*sheets[i], *sheets[j]), face_to_face(*sheets[j], *sheets[i]));
      if (!(distance < worst * thickness))
        continue;
      worst = distance / thickness;
      warning =
          fmt::format("sheets {} and {} (from 0) start in each other: their middles are {} m apart, and should be "
                      "{} m, half of each one's thickness: what overlaps stays so, and lies as one layer",
                      j, i, scene::brief(distance), scene::brief(thickness));
    }
  return warning;
}

} // namespace sheet
