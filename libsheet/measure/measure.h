// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of a frame: size, thickness, motion, quality of the mesh. SI units. Sums run in the order of the triangles,
// with compensation [Neumaier 1974], so that they are the same bits whatever the number of threads.
// What does not exist is NaN: the thickness of no triangles, the momentum without a density.
#pragma once
#include <limits>
#include <optional>

#include <Eigen/Core>

#include "libsheet/measure/forces.h"
#include "libsheet/measure/topology.h"

namespace sheet {

inline constexpr double absent = std::numeric_limits<double>::quiet_NaN();

struct Range {
  double least = absent, mean = absent, greatest = absent;
};

struct Measurements {
  double area = 0;   // [m²]
  double volume = 0; // [m³]
  Range thickness;   // volume / area [m], a triangle; mean: of all volume over all area
  // Mass ρ V / 3 at each corner of a triangle, as the time step has it.
  double kinetic_energy = absent;                                       // Σ m v² / 2 [J]
  Eigen::Vector3d momentum = Eigen::Vector3d::Constant(absent);         // Σ m v [kg m/s]
  Eigen::Vector3d angular_momentum = Eigen::Vector3d::Constant(absent); // Σ m x × v, about the origin [kg m²/s]
  Eigen::Vector3d low = Eigen::Vector3d::Constant(absent);              // bounding box of all vertices [m]
  Eigen::Vector3d high = Eigen::Vector3d::Constant(absent);
  Range edge;                // lengths, each edge once [m]
  double angle_min = absent; // of the triangles' corners [rad]
  double angle_max = absent;
  double aspect_max = absent; // longest side over the altitude on it, 1 for an equilateral triangle; inf: degenerate
  Topology topology;
  std::vector<NamedForce> forces; // in scenes that ask for them
};

// Precondition: the frame obeys the format's rules (StreamReader::Values::check). `density` [kg/m³].
[[nodiscard]] Measurements measure(const formats::Frame& frame, std::optional<double> density);

// The density that the frame's scene states [kg/m³]. Remembers the last scene, which rarely changes within a stream.
class SceneDensity {
public:
  // Nothing: no scene, none that can be read (then a warning, once), or none with a density.
  [[nodiscard]] std::optional<double> of(const formats::Frame& frame);

private:
  std::string scene_;
  std::optional<double> density_;
};

} // namespace sheet
