// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets for the tests of inflow and tearing.
#pragma once
#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/base/error.h"
#include "libsheet/geometry/area.h"
#include "libsheet/scene/read.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::test {

// Columns x rows cells of size `cell` in the plane z = 0, their diagonals to and fro, `thickness` everywhere [m].
inline formats::Frame grid(std::uint32_t columns, std::uint32_t rows, double cell, double thickness) {
  std::vector<Vector3> x;
  std::vector<Corners> t;
  for (std::uint32_t j = 0; j <= rows; ++j)
    for (std::uint32_t i = 0; i <= columns; ++i)
      x.emplace_back(cell * i, cell * j, 0);
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = j * (columns + 1) + i, b = a + 1, d = a + columns + 1, c = d + 1;
      if ((i + j) % 2 == 0) {
        t.push_back({a, b, c});
        t.push_back({a, c, d});
      } else {
        t.push_back({a, b, d});
        t.push_back({b, c, d});
      }
    }
  return make_frame(x, t, std::vector<double>(t.size(), thickness * cell * cell / 2));
}

inline std::string value_error(const formats::Frame& frame) {
  const std::string form = formats::find_form_error(frame);
  return form.empty() ? formats::find_value_error(frame) : form;
}

inline double total(std::span<const double> v) { return std::accumulate(v.begin(), v.end(), 0.0); }
inline double volume_of(const formats::Frame& frame) { return total(volumes(frame)); }

inline double area(const formats::Frame& frame, std::size_t t) {
  const auto x = positions(frame);
  const Corners& c = triangles(frame)[t];
  return TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area;
}

// Of unit density [kg m/s].
inline Vector3 momentum(const formats::Frame& frame) {
  Vector3 p = Vector3::Zero();
  for (std::size_t t = 0; t < frame.triangles; ++t)
    for (const std::uint32_t v : triangles(frame)[t])
      p += volumes(frame)[t] / 3 * velocities(frame)[v];
  return p;
}

// The message of the Error that `work` throws, "" if it throws none.
template <class Work> std::string error_of(Work work) {
  try {
    work();
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

} // namespace sheet::test
