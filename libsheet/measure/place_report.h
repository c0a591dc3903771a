// SPDX-License-Identifier: GPL-3.0-or-later
// What a sheet is at chosen places, as CSV: along cuts, and over time at a point. SI units. Quantities are those of
// quantities/fields.h that have a value in between, as far as the first frame has them; nan where a later one does not.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "libsheet/measure/report.h"

namespace sheet {

// Planes and points as cut_plane.h reads them; throws Error (usage).
//
// Two rows for each triangle that a plane cuts, where it goes in and where it comes out: frame, time; cut, curve (each
// from 0), s along the curve from its begin; x, y, z; quantities (cut.h tells the order). As a triangle has one
// thickness, it is drawn as steps, and the rule of the trapezoid over s is exact.
[[nodiscard]] std::unique_ptr<Report> make_cut_report(const std::vector<std::string>& planes);

// A row a frame and point: frame, time; point (from 0), distance to the nearest place of the sheet; its x, y, z;
// quantities.
[[nodiscard]] std::unique_ptr<Report> make_point_report(const std::vector<std::string>& points);

} // namespace sheet
