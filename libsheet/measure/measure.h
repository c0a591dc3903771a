// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of a frame: size, thickness, motion, quality of the mesh. SI units. Sums run in the order of the triangles,
// with compensation [Neumaier 1974], so that they are the same bits whatever the number of threads.
// What does not exist is NaN: the thickness of no triangles, the momentum without a density.
#pragma once
#include <array>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "libsheet/measure/forces.h"
#include "libsheet/measure/topology.h"
#include "libsheet/quantities/fields.h"
#include "libsheet/scene/scene.h"

namespace sheet {

inline constexpr double absent = std::numeric_limits<double>::quiet_NaN();

struct Range {
  double least = absent, mean = absent, greatest = absent;
};

// Of a field's values. mean: by area, a third of each triangle's at its corners; of the thickness all volume over all
// area.
struct FieldRange {
  const Field* field = nullptr;
  Range range;
};

// Percentiles that are measured.
inline constexpr std::array<int, 5> percents = {1, 5, 50, 95, 99};

struct Measurements {
  double area = 0;                // [m²]
  double volume = 0;              // [m³]
  std::vector<FieldRange> fields; // those in_figures, in their order; NaN of what the frame does not have
  // For each of `percents`, the least thickness [m] of a triangle such that triangles that are not thicker have that
  // part of the area.
  std::array<double, percents.size()> thickness_percentiles;
  Eigen::Vector3d thinnest_at = Eigen::Vector3d::Constant(absent); // middle of the thinnest triangle [m]
  Eigen::Vector3d thickest_at = Eigen::Vector3d::Constant(absent);
  // Mass ρ V / 3 at each corner of a triangle, as the time step has it.
  double kinetic_energy = absent; // Σ m v² / 2 [J]
  double gravity_energy = absent; // measure_energies
  double surface_energy = absent;
  Eigen::Vector3d momentum = Eigen::Vector3d::Constant(absent);         // Σ m v [kg m/s]
  Eigen::Vector3d angular_momentum = Eigen::Vector3d::Constant(absent); // Σ m x × v, about the origin [kg m²/s]
  Eigen::Vector3d low = Eigen::Vector3d::Constant(absent);              // bounding box of all vertices [m]
  Eigen::Vector3d high = Eigen::Vector3d::Constant(absent);
  Range edge;                                 // lengths, each edge once [m]
  std::array<bool, kinds_of_needs> has{true}; // by Needs
  double heat = absent;                       // measure_energies
  double drops = absent;                      // number of balls of liquid beside the sheet (sheet/drops.h)
  double drop_volume = absent;                // of all of them, which is no part of `volume` [m³]
  double gas_amount = absent;                 // of all that is enclosed, at the pressure outside [m³]
  double gas_pressure = absent;               // the greatest, above that outside [Pa]
  double gas_escaped = absent;                // through holes [m³]
  double part_at_rest = absent;               // quantities/fields.h
  double angle_min = absent;                  // of the triangles' corners [rad]
  double angle_max = absent;
  double aspect_max = absent; // longest side over the altitude on it, 1 for an equilateral triangle; inf: degenerate
  Topology topology;
  std::vector<NamedForce> forces; // in scenes that ask for them

  Measurements() { thickness_percentiles.fill(absent); }

  // Precondition: the field is among them.
  [[nodiscard]] const Range& range_of(std::string_view field) const;
};

// Of all triangles, or of each [kg/m³].
struct Densities {
  Densities(double density) : all(density) {}
  explicit Densities(std::vector<double> densities) : each(std::move(densities)) {}
  [[nodiscard]] double of(std::size_t triangle) const { return each.empty() ? all : each[triangle]; }
  double all = 0;
  std::vector<double> each;
};

// Precondition: the frame obeys the format's rules (StreamReader::Values::check).
[[nodiscard]] Measurements measure(const formats::Frame& frame, const std::optional<Densities>& densities);

// Adds energies that need a scene [J]: of gravity, -Σ m g·x, x from the origin to the triangles' centres; of surface,
// 2 γ A, of both sides wherever they lie, and with [model] faces of rims and slopes. NaN without density, gravity,
// tension. In scenes with heat: Σ ρ c V T.
void measure_energies(const formats::Frame& frame, const Scene& scene, Measurements& measured);

// The densities that the frame's scene states. Remembers the last scene, which rarely changes within a stream.
class SceneDensity {
public:
  // Nothing: no scene, none that can be read (then a warning, once), or none with a density.
  [[nodiscard]] std::optional<Densities> of(const formats::Frame& frame);
  // Sets the heat Σ ρ c V T [J], where the scene says ρ c and the frame has temperatures.
  void measure_heat(const formats::Frame& frame, Measurements& measured);

private:
  std::string text_;
  std::optional<Scene> scene_; // that can be read and has a density
};

} // namespace sheet
