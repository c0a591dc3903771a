// SPDX-License-Identifier: GPL-3.0-or-later
// Which vertices lie on another layer of the sheet, so that a bath below does not reach them.
#pragma once
#include <span>
#include <vector>

#include "libsheet/geometry/types.h"
#include "libsheet/sheet/contact_spring.h"

namespace sheet {

// A vertex is borne where a contact spring says that it lies on a triangle, no farther aside than over it, and that one
// has its face up, so that the bath bears it with all that is above, or is borne itself. What lies on a layer that has
// its face down, the lowest one of all, is not: that one is wet on both faces (bath.h). up: against gravity. Empty:
// none.
[[nodiscard]] std::vector<char> borne_layers(std::span<const Vector3> positions, std::span<const Corners> triangles,
                                             std::span<const ContactSpring> contacts, const Vector3& up);

} // namespace sheet
