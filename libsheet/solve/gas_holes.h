// SPDX-License-Identifier: GPL-3.0-or-later
// Where enclosed gas can leave: the rims of what encloses it that nothing closes. SI units.
//
// A rim is closed at vertices that a hold or an inlet prescribes, that touch a solid, that lie on another layer, that
// are under the level of a bath, and that were on a free rim when the run began, which the cap closes (array
// gas.sealed). Elsewhere gas flows through the gap between the rim and the nearest solid, or the bath, and no more than
// through the area that the open part of the rim goes round, closed by a chord.
#pragma once
#include <span>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/scene/scene.h"
#include "libsheet/solid/solids.h"

namespace sheet {

struct GasHoles {
  double area = 0;                 // of all together [m²]
  Vector3 place = Vector3::Zero(); // the middle of the widest one's rim [m]
  double widest = 0;               // its area [m²]
};

struct RimClearances {
  std::vector<double> with_bath; // of each vertex [m]
  std::vector<double> without;   // as if there were no bath; empty: the same
  std::vector<double> depths;    // under the level, less than 0 above it [m]; as long as `without`
};

// Of those rims, the height over the nearest solid or bath at each vertex; 0 where it is closed or on no rim, infinite
// where there is neither. solids: the scene's; null only if it has none.
[[nodiscard]] RimClearances rim_clearances(const Scene& scene, const formats::Frame& frame, const Connectivity& mesh,
                                           const solid::Solids* solids);

// Those of a part in which the gas has that pressure [Pa]. Of weight [Pa/m], its density times gravity, a bath holds it
// if it is not above weight x depth where the rim is least deep under the level, and if the part is hollow: it holds
// more than a tenth of the ball of its area, so that what has burst and lies in the bath encloses nothing.
[[nodiscard]] std::span<const double> clearances_at(const RimClearances& clearances, const Connectivity& mesh,
                                                    std::span<const Vector3> positions, std::span<const char> part,
                                                    double weight, double pressure);

// The holes in a part of the sheet (of each triangle, whether it counts; empty: all do).
[[nodiscard]] GasHoles gas_holes(const Connectivity& mesh, std::span<const Vector3> positions,
                                 std::span<const double> clearances, std::span<const char> part);

// What still encloses gas of a part that has holes: its pieces without any, and of the others the one that holds most.
// The rest has come off.
[[nodiscard]] std::vector<char> still_enclosing(const Connectivity& mesh, std::span<const Vector3> positions,
                                                std::span<const double> clearances, std::span<const char> part);

// Marks the rims of what encloses gas that are open in a first frame, or closed by a bath only: they count as closed
// from then on.
void seal_open_rims(const Scene& scene, formats::Frame& frame, const solid::Solids* solids);

} // namespace sheet
