// SPDX-License-Identifier: GPL-3.0-or-later
// How long edges shall be, at each vertex [m]: the same everywhere, or by what the sheet does.
#pragma once
#include <optional>
#include <vector>

#include "libsheet/remesh/editable_sheet.h"
#include "libsheet/scene/scene.h"

namespace sheet::remesh {

struct SizeOptions {
  double edge_length = 0;                   // [m], positive; with `chord_error` only the bounds' default
  std::optional<double> chord_error;        // adaptive: the distance that an edge may have from the curved sheet [m]
  std::optional<double> min_edge, max_edge; // bounds [m]; absent: edge_length; adaptive: a quarter, four times
  // Error(usage) if a value is not positive and finite, or the upper bound is below twice the lower one while adaptive.
  void check() const;
};

// Adaptive length at a vertex, the least of these, but not below 2 h, within the bounds, growing by at most 0.4 of the
// distance:
// - sqrt(8 ε / |k|): chord error of the largest principal curvature k [Cohen-Steiner, Morvan 2003];
// - l τ E / |Δe|: the jump of the strain rate e from triangle to triangle (uniform stretching is exact), l the edges
// now, E
//   the mean rate at which the sheet deforms, bending counted, turning as a whole not;
// - l τ h / |Δh|: the jump of the thickness;
// - an eighth of the wave about to buckle where compression exceeds surface tension, P = -4 μ h e - 2 γ > 0, and it
// grows
//   five times faster than the sheet deforms: k² = 2 ρ_b g / P on a bath (VALIDATION.md V15), k⁶ = ρ h P / (2 D²) by
//   inertia, D = μ h³ / 3.
class SizeField {
public:
  SizeField(const EditableSheet& sheet, const Scene* scene, const SizeOptions& options);
  [[nodiscard]] double at(std::uint32_t v) const { return size_.empty() ? uniform_ : size_[v]; }
  [[nodiscard]] double along(std::uint32_t a, std::uint32_t b) const { return 0.5 * (at(a) + at(b)); }
  [[nodiscard]] double shortest() const;
  // A vertex between two others, or one that takes the place of two.
  void set_between(std::uint32_t v, std::uint32_t a, std::uint32_t b);

private:
  double uniform_;
  std::vector<double> size_;
};

} // namespace sheet::remesh
