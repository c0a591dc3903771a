// SPDX-License-Identifier: GPL-3.0-or-later
// Contact springs that a change of the mesh has left without their features, and what takes their place. SI units.
#pragma once
#include "libsheet/collide/contact_springs.h"

namespace sheet::collide {

struct LooseSprings {
  std::vector<ContactSpring> without_features; // whose triangle or edges the mesh does not have
  std::vector<ContactSpring> aside; // whose features are no longer over each other: more than 60 degrees off the normal
};

// A weld whose triangle a change of the mesh has taken away is one with the nearest of those around its corners from
// now on; what it pulls stays.
void weld_anew(std::vector<ContactSpring>& springs, const Connectivity& mesh, std::span<const Vector3> positions);

// Takes them out, at these positions. Welds are never aside.
[[nodiscard]] LooseSprings take_loose(std::vector<ContactSpring>& springs, const Connectivity& mesh,
                                      std::span<const Vector3> positions);

// Gives the force of each loose spring, as it is at these positions, to the springs that share most of its vertices and
// lie within 60 degrees of its normal, by their stiffness: their rest distances and anchors change. So a pile keeps
// what carries it, and what touches has done so since the earlier of both. Forces without any such spring are lost.
void hand_over(std::span<const ContactSpring> loose, std::span<const Vector3> positions,
               std::vector<ContactSpring>& springs);

} // namespace sheet::collide
