// SPDX-License-Identifier: GPL-3.0-or-later
// Waves that compression is about to make, before they are to be seen.
#pragma once
#include <vector>

#include "libsheet/remesh/flow_error.h"
#include "libsheet/scene/scene.h"

namespace sheet::remesh {

// In each triangle the number k [1/m] of the wave that grows fastest there, 0 where none matters. Compression
// P = -2 μ h (e + tr E) - 2 γ > 0, e the least rate of stretching, makes waves grow at the rate
//   (P k² - ρ_b g) / (D k⁴) on a bath (docs/model.md, V15 with P + 2 γ for P), fastest at k² = 2 ρ_b g / P,
//   P / (2 D k²) by inertia, at k⁶ = ρ h P / (2 D²),
// D = μ h³ / 3. What matters grows five times faster than the sheet deforms, and a quarter as fast as the waves in the
// fastest twentieth of the sheet.
[[nodiscard]] std::vector<double> buckling_wavenumbers(const Scene& scene, const std::vector<TriangleRates>& rates);

} // namespace sheet::remesh
