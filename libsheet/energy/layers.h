// SPDX-License-Identifier: GPL-3.0-or-later
// Layers of a sheet that lie on each other and flow, as the contact springs between them show (contact.h): what the
// elements of contact_shear.h and contact_squeeze.h need to know of a stage. SI units.
#pragma once
#include <span>
#include <vector>

#include "libsheet/energy/stage.h"
#include "libsheet/sheet/contact_spring.h"

namespace sheet {

// Of each vertex at the predicted end of the stage.
struct LayerShares {
  std::vector<double> area, thickness; // a third of its triangles' [m²]; volume / area [m]
};
[[nodiscard]] LayerShares layer_shares(const Stage& stage);
// Of each vertex the mean of its triangles' values, such as viscosities, by volume.
[[nodiscard]] std::vector<double> vertex_means(const Stage& stage, std::span<const double> values);
// Their mean over both features of a contact.
[[nodiscard]] double mean_between(const ContactSpring& contact, std::span<const double> means);

// How a layer that is sheared by the one below it lags behind. The velocity across each is a parabola, without stress
// at the upper face of the upper one, and both, and their stresses, meet in between [Oron, Davis and Bankoff 1997,
// section II.B, for two layers of one liquid]. With means u and u' below and above, relative to the wall, the work of
// the two layers is that of the lower one alone (wall_drag.h) and μ |u' - carries u|²/(2 depth) [W/m²].
struct LayerShear {
  double carries = 1; // the lower layer's upper face over its mean, when nothing lies on it
  double depth = 0;   // [m]
  double upper = 0; // the part of the depth that is in the upper layer; of two liquids each part is sheared by its own
};
// Lower layer on a wall of the slip length b.
[[nodiscard]] LayerShear shear_on_wall(double lower, double upper, double slip_length);
// Both far from walls: within 5 % of the parabola of any number of layers on a wall.
[[nodiscard]] LayerShear shear_in_stack(double lower, double upper);

} // namespace sheet
