// SPDX-License-Identifier: GPL-3.0-or-later
// Continuous collision detection of two features whose points move on straight lines: do they come nearer than a gap?
// Never misses: "no" is given only with a proof (swept_pair.cpp); "yes" may be a false alarm, mostly of features that
// come nearer than the gap and a thousandth of it.
#pragma once
#include <array>
#include <optional>

#include "libsheet/geometry/types.h"

namespace sheet::collide {

enum class Features {
  vertex_triangle, // point 0 against the triangle 1 2 3
  edge_edge,       // the edge 0 1 against the edge 2 3
};

// Point i goes from start[i] to end[i], at the same pace, between the times 0 and 1. Lengths in any unit.
struct SweptPair {
  Features features = Features::vertex_triangle;
  std::array<Vector3, 4> start, end;
};

struct SweptOptions {
  double gap = 0;                    // distance that counts as contact, in the unit of the points; see smallest_gap
  double time_tolerance = 1e-6;      // intervals of time that are not divided further
  int budget = 4096;                 // of intervals to look at; then the rest of the time counts as a contact
  Vector3 towards = Vector3::Zero(); // the first feature from the second, roughly: tried first, if it is not zero
};

// A gap below this part of the pair's size (the largest distance of a point of one feature from one of the other) is
// taken for it: what rounding needs.
inline constexpr double smallest_gap = 1e-12;

// Cheap: by how much farther than the gap the features are from each other all the time, at least; less than they are,
// and mostly below zero, where no layers lie on each other.
[[nodiscard]] double sure_room(const SweptPair& pair, double gap);

// True only if that is positive, or the points do not move against each other.
[[nodiscard]] bool surely_apart(const SweptPair& pair, double gap);

struct ContactOrRoom {
  std::optional<double> time; // as of first_contact
  double room = 0;            // if there is none: by how much farther than the gap they are proved to be all the time
};
[[nodiscard]] ContactOrRoom contact_or_room(const SweptPair& pair, const SweptOptions& options);

// A time until which the features are surely further apart than the gap, and shortly after which they may not be; none
// if they surely are all the time. Points that do not move against each other have no contact.
[[nodiscard]] inline std::optional<double> first_contact(const SweptPair& pair, const SweptOptions& options) {
  return contact_or_room(pair, options).time;
}

} // namespace sheet::collide
