// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/solid_width.h"

#include <algorithm>
#include <array>
#include <limits>

#include "libsheet/base/overloaded.h"

namespace sheet::scene {

double width_of(const SolidShape& shape) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return std::visit(Overloaded{[](const Sphere& s) { return s.radius; },
                               [](const SolidBox& b) {
                                 std::array<double, 3> sides{b.size.x(), b.size.y(), b.size.z()};
                                 std::ranges::sort(sides);
                                 return sides[1];
                               },
                               [](const Capsule& c) { return c.radius; }, [](const Cylinder& c) { return c.radius; },
                               [](const HalfSpace&) { return infinity; }, [](const SolidMesh&) { return infinity; }},
                    shape);
}

} // namespace sheet::scene
