// SPDX-License-Identifier: GPL-3.0-or-later
// Inclusions (bubbles, drops, grains) that pierce a sheet where it has become as thin as they are large. They lie in
// the liquid at random, N(h) in a unit of volume that pierce a thickness of h (scene.h). So a triangle of volume V has
// the exposure X = V N(least h so far), and where that rises by dX a hole opens with probability 1 - exp(-dX). A volume
// V that thins evenly has no hole with probability exp(-V N(h)), whatever the triangles and steps: a Weibull law in
// 1/h. [Poisson's process; that bursting sheets are pierced so: Lhuissier and Villermaux 2013, J. Fluid Mech. 714.]
//
// Waiting has no memory and exposures add up, so the frame's array `tear.exposure` (triangle, rule conserve) goes
// through changes of the mesh without changing the law.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/geometry/types.h"
#include "libsheet/scene/scene.h"

namespace sheet::flow {

// Where an inclusion pierces the sheet.
struct Site {
  std::uint32_t triangle;
  Vector3 place; // in the triangle [m]
};

// N(h) [1/m³], h in metres.
[[nodiscard]] double piercing(const scene::Inclusions& inclusions, double thickness);

// Raises `tear.exposure`, which it adds to a frame without, and draws who is pierced, by the scene's seed, the frame's
// step and the triangle's number: the same for any number of threads, and in a run that is resumed. Triangles all of
// whose corners are `supported` wait: their exposure stays, until they are free. areas: of the triangles [m²]. Throws
// Error (bad_input) where an array of that name is something else.
[[nodiscard]] std::vector<Site> draw_sites(formats::Frame& frame, const scene::Inclusions& inclusions,
                                           std::span<const double> areas, const std::vector<bool>& supported);

} // namespace sheet::flow
