// SPDX-License-Identifier: GPL-3.0-or-later
// How the lips of a crack part.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "libsheet/flow/fans.h"
#include "libsheet/flow/tear_cuts.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/types.h"

namespace sheet::flow {

// Where the vertices of the fans go [m]: one that has come apart moves into its fan, by a thousandth of the way to the
// nearest opposite side. x: of the old vertices; dropped: triangles that do not count.
[[nodiscard]] std::vector<Vector3> open_cracks(const Fans& fans, const std::vector<bool>& dropped,
                                               std::span<const Vector3> x);

// The same, but a lip that would move into another layer stays where it is, if nothing else is left there, or moves by
// a tenth, and so on. mesh: of the old vertices.
[[nodiscard]] std::vector<Vector3> open_clear_cracks(const Connectivity& mesh, const Fans& fans,
                                                     const std::vector<bool>& dropped, std::span<const Vector3> x);

// The old vertices at which triangles, opened so, meet others that they did not meet before.
[[nodiscard]] std::vector<bool> crossing_at(const Connectivity& mesh, std::span<const Vector3> x, const Fans& fans,
                                            std::span<const Vector3> opened, const std::vector<bool>& dropped);

// In a crumpled sheet a lip may move into another layer. Where triangles at an opened vertex meet others that they did
// not meet before, takes back the cuts at that vertex, but none beside a dropped triangle; returns how many it took.
std::size_t leave_crossing_whole(const Connectivity& mesh, std::span<const Vector3> x, const Fans& fans,
                                 std::span<const Vector3> opened, TearCuts& cuts);

} // namespace sheet::flow
