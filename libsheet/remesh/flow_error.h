// SPDX-License-Identifier: GPL-3.0-or-later
// Where a mesh makes errors in how the sheet deforms: the size field's measure of the flow.
#pragma once
#include <cstdint>
#include <vector>

#include "libsheet/remesh/editable_sheet.h"

namespace sheet::remesh {

// What a triangle does. Rates are tensors in its plane.
struct TriangleRates {
  TriangleShape shape;
  double thickness = 0;                 // [m]; 0: a free slot, or a triangle without area
  Matrix3 velocity = Matrix3::Zero();   // surface gradient of the velocity [1/s], not only what lies in the plane
  Matrix3 stretching = Matrix3::Zero(); // E [1/s]
  Matrix3 bending = Matrix3::Zero();    // K, of the second fundamental form [1/(m s)]
  double temperature = 0;               // [K]; 0: there is none
  std::uint32_t liquid = 0;             // its number (scene::liquids_of)
  bool bends = false;                   // K is known: no corner is on the rim, where a normal is one triangle's
};
[[nodiscard]] std::vector<TriangleRates> triangle_rates(const EditableSheet& sheet);

// How much the sheet deforms and how unevenly. Triangles with edges l have constant E and K, so where these vary they
// miss about l² g² of the power dissipated per area, 2 μ (h E:E + h³/12 K:K) without its traces [Batty et al. 2012,
// section 3.2]:
//   g² = h |∇E|² + h³/12 |∇K|²   [1/(m s²)],
// gradients from values at vertices, the means over their triangles [Zienkiewicz, Zhu 1987].
struct FlowError {
  std::vector<double> gradient; // g at each vertex; those at the rim take over what their neighbours inside have
  double mean = 0;              // of sqrt(h E:E + h³/12 K:K), root mean square over the sheet [m^½/s]
};
[[nodiscard]] FlowError flow_error(const EditableSheet& sheet, const std::vector<TriangleRates>& rates, bool bending);

} // namespace sheet::remesh
