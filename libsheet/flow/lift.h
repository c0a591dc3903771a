// SPDX-License-Identifier: GPL-3.0-or-later
// How far what has taken up a layer moves. SI units.
#pragma once
#include <span>
#include <vector>

#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/types.h"
#include "libsheet/sheet/contact_spring.h"

namespace sheet::flow {

// Lets vertices stay whose way would take their triangles into others, decided exactly (triangle_pair.h), or past them,
// or nearer than half way to a border that is welded onto them: folds leave no room there. Returns how many stay. x
// [m], ways [m]: of the mesh's vertices; taken: triangles that go, and do not count; welds: where the borders are.
std::size_t keep_clear(const Connectivity& mesh, const std::vector<bool>& taken, std::span<const Vector3> x,
                       std::span<const ContactSpring> welds, std::vector<Vector3>& ways);

} // namespace sheet::flow
