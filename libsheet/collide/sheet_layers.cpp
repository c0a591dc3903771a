// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/sheet_layers.h"

#include <cmath>

namespace sheet::collide {

bool SheetLayers::one(std::span<const Vector3> positions, std::span<const std::uint32_t, 4> vertices,
                      std::span<const double, 4> weights, double part, double contact_distance) const {
  const std::size_t second = weights[0] == 1 ? 1 : 2;
  const auto place = [&](std::size_t begin, std::size_t end) {
    MeshPoint at{vertices.subspan(begin, end - begin), Vector3::Zero()};
    for (std::size_t i = begin; i < end; ++i)
      at.place += std::abs(weights[i]) * positions[vertices[i]];
    return at;
  };
  return along_.within(positions, place(second, 4), place(0, second), part * contact_distance);
}

} // namespace sheet::collide
