// SPDX-License-Identifier: GPL-3.0-or-later
// A number that changes over time, or from place to place.
#pragma once
#include <array>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "libsheet/scene/motion.h"

namespace sheet::scene {

// Rows of a place [m], increasing, and the value there: linear between rows, constant before the first and after the
// last.
using PlaceRows = std::vector<std::array<double, 2>>;
[[nodiscard]] double value_at(const PlaceRows& rows, double place);

// Over a coordinate of the world.
struct AlongAxis {
  int axis = 0;   // x, y, z
  PlaceRows rows; // two or more
  bool operator==(const AlongAxis&) const = default;
};

struct Varying {
  std::variant<Timed<double>, AlongAxis> over;

  Varying(double constant = 0) : over(Timed<double>{{{0, constant}}}) {}
  Varying(Timed<double> timed) : over(std::move(timed)) {} // of one entry or more
  Varying(AlongAxis along) : over(std::move(along)) {}
  bool operator==(const Varying&) const = default;
};

[[nodiscard]] double value_at(const Varying& varying, double t, const Eigen::Vector3d& x);
[[nodiscard]] bool is_constant(const Varying& varying);
// The least and the greatest of its values, at all times and places.
[[nodiscard]] std::pair<double, double> range_of(const Varying& varying);

} // namespace sheet::scene
