// SPDX-License-Identifier: GPL-3.0-or-later
// What floats, is held by nothing, touches no solid and has no inertia may move along the bath, and turn about the
// vertical, as it likes. How it does is then what Newton's method leaves of it: a step's correction is worked out with
// matrices of a sheet that is not yet turned so far, and turns it back too far, by six times and more from step to
// step; and where it has drifted once, the next step begins with that velocity. As nothing asks for any turn, there
// shall be none; and it drifts as fast as it did, as it would with the least inertia, or where the bath resists that,
// which rests, at most as fast. What has no weight either and touches a solid at one point, or at two, shall not turn
// about those.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "libsheet/energy/holds.h"
#include "libsheet/energy/model.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/types.h"

namespace sheet {

// The connected pieces that are free so, with what touches them.
struct FreePieces {
  std::vector<std::uint32_t> of_vertex; // of each the least vertex of its piece, or no_index; empty: none is free
  std::vector<bool> resisted;           // of each such vertex, whether the bath resists its piece's drift
};
// None where there is inertia, no bath, or air.
[[nodiscard]] FreePieces free_pieces(const Model& model, const Connectivity& mesh);

// Takes the mean turning of each piece about an axis through its middle away from its velocities; the axis has any
// length but zero.
void stop_turning(const FreePieces& free, std::span<const Vector3> positions, const Vector3& axis,
                  std::span<Vector3> velocities);

// Of each vertex at the start of a step [m], [m/s], [m³].
struct DriftStart {
  std::span<const Vector3> positions, velocities;
  std::span<const double> volumes;
};

// Moves each piece, and changes its velocities, as a whole and across the axis, such that its centre of mass has gone
// on as fast as it did, by its velocity at the start of the step times dt [s]; or as it has, but no faster, and the
// same way.
void drift_steadily(const FreePieces& free, const DriftStart& start, double dt, const Vector3& axis,
                    std::span<Vector3> positions, std::span<Vector3> velocities);

// Whether nothing but holds determines how pieces turn.
[[nodiscard]] bool turns_about_holds(const Model& model);

// Takes the mean turning of each connected piece that is held at one or two vertices about these away from its
// velocities, as seen from what holds it at the time t [s].
void stop_turning_about(const std::vector<Hold>& holds, double t, const Connectivity& mesh,
                        std::span<const Vector3> positions, std::span<Vector3> velocities);

} // namespace sheet
