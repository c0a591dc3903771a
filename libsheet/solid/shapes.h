// SPDX-License-Identifier: GPL-3.0-or-later
// Exact signed distances of spheres, boxes, capsules, cylinders and half-spaces.
#pragma once
#include <memory>

#include "libsheet/scene/scene.h"
#include "libsheet/solid/distance.h"

namespace sheet::solid {

// The shape in its own frame: centered at the origin; capsules and cylinders along y. Their bodies are convex, so their
// signed distances are convex functions.
[[nodiscard]] std::unique_ptr<const SolidDistance> make_distance(const scene::Sphere& sphere);
[[nodiscard]] std::unique_ptr<const SolidDistance> make_distance(const scene::SolidBox& box);
[[nodiscard]] std::unique_ptr<const SolidDistance> make_distance(const scene::Capsule& capsule);
[[nodiscard]] std::unique_ptr<const SolidDistance> make_distance(const scene::Cylinder& cylinder);
[[nodiscard]] std::unique_ptr<const SolidDistance> make_distance(const scene::HalfSpace& half_space);

} // namespace sheet::solid
