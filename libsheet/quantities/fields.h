// SPDX-License-Identifier: GPL-3.0-or-later
// The quantities that a sheet has at each triangle or vertex: one table, from which pictures, pages, sheet-info and the
// Python package take what they show.
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/quantities/palette.h"

namespace sheet {

// What frames have that a quantity is of.
enum class Needs {
  nothing,
  law,    // a law of viscosity, by rate or temperature
  heat,   // temperatures
  wanted, // a wanted thickness (wanted.h)
  drops,  // liquid beside the sheet (sheet/drops.h)
  gas,    // enclosed and compressed (formats/sheet.md, section 5)
  sheets  // several, told by the array "sheet"
};
inline constexpr std::size_t kinds_of_needs = 7;

struct Field {
  std::string_view name;    // of sheet-render's look and of columns of CSV
  std::string_view caption; // beside a scale
  std::string_view unit;    // SI; "1": none
  formats::Place where;     // at triangles or vertices
  // The values, one a row. Null: they are the frame's array of this name, which not every frame has.
  std::vector<double> (*get)(const formats::Frame&);
  const Palette& palette;
  bool in_figures; // least, mean and greatest value are among the figures of a frame (libsheet/measure/figures.h)
  Needs needs = Needs::nothing;
};

//   thickness  volume / area of each triangle [m]
//   curvature  mean curvature at vertices [1/m], positive where the sheet bends away from its positive side:
//              H = Σ l β / (4 A), over the edges that meet there, l their lengths, β the angles between the normals at
//              them, A a third of the area around the vertex [Cohen-Steiner and Morvan 2003]; at the rim 0
//   speed      |velocity| at vertices [m/s]
//   sheet      of triangles, the number of the scene's sheet that they are of, from 0, where there are several
//   contacts   at vertices: 0 none, 1 touches a solid, 2 has a contact spring
//   temperature  of triangles, where the frame has it [K]
//   deviation    of triangles, by how much they are thicker than is wanted, where that is known [m]
// Where the frame's scene has a law of viscosity (material/flow_law.h, temperature_law.h), of each triangle:
//   strain_rate    sqrt(2 D:D) of the middle of the sheet, in its plane, by the frame's velocities [1/s]: what bending
//                  and the shear along walls add is left out
//   viscosity      the law's at that rate, and at its temperature [Pa s]
//   log_viscosity  its decimal logarithm, for pictures: it spans many decades
[[nodiscard]] std::span<const Field> fields();

// Precondition: there is one of this name.
[[nodiscard]] const Field& field_named(std::string_view name);

[[nodiscard]] bool has(const formats::Frame& frame, const Field& field);

// Volume of what is strained by less than ten times the rest rate (material/flow_curve.h), over all volume. NaN where
// the frame's liquid is Newtonian, or there is no volume.
[[nodiscard]] double part_at_rest(const formats::Frame& frame);

// Throws Error (bad_input) where the frame does not have it.
[[nodiscard]] std::vector<double> values_of(const formats::Frame& frame, const Field& field);

} // namespace sheet
