// SPDX-License-Identifier: GPL-3.0-or-later
// Small sheets to draw.
#pragma once
#include <cmath>
#include <functional>
#include <numbers>

#include "libsheet/render/surface.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::render::test {

using V = Eigen::Vector3d;

// A grid of n x n squares over the unit square, put in place by `shape` of (s, t), of even thickness [m].
inline formats::Frame grid(int n, double thickness, const std::function<V(double, double)>& shape) {
  std::vector<V> x;
  std::vector<Corners> triangles;
  std::vector<double> volume;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      x.push_back(shape(static_cast<double>(i) / n, static_cast<double>(j) / n));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto v = static_cast<std::uint32_t>(j * (n + 1) + i), w = v + static_cast<std::uint32_t>(n) + 1;
      triangles.push_back({v, v + 1, w + 1});
      triangles.push_back({v, w + 1, w});
    }
  for (const Corners& t : triangles)
    volume.push_back(thickness / 2 * (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).norm());
  return make_frame(x, triangles, volume);
}

// Level, 1 m wide, seen from above on its positive side.
inline formats::Frame flat(int n, double thickness) {
  return grid(n, thickness, [](double s, double t) { return V(s - 0.5, 0, 0.5 - t); });
}

// A trough with steep walls.
inline formats::Frame trough(int n, double thickness) {
  return grid(n, thickness, [](double s, double t) {
    const double a = std::numbers::pi * (s - 0.5);
    return V(0.5 * std::sin(a), -0.5 * std::cos(a), 0.5 - t);
  });
}

// A sphere of radius 0.5 without its poles' last bits, its positive side outwards.
inline formats::Frame ball(int n, double thickness) {
  return grid(n, thickness, [](double s, double t) {
    const double a = 2 * std::numbers::pi * s, p = 0.02 + (std::numbers::pi - 0.04) * (1 - t);
    return V(0.5 * std::sin(p) * std::sin(a), 0.5 * std::cos(p), 0.5 * std::sin(p) * std::cos(a));
  });
}

// A box around the sheet, and a camera that sees all of a box.
inline Box box_of(const formats::Frame& frame) {
  Box box;
  const std::vector<double> h = vertex_thickness(frame);
  for (std::size_t v = 0; v < h.size(); ++v)
    for (const double side : {-0.5, 0.5})
      box.add(positions(frame)[v] + side * h[v] * V::Ones());
  return box;
}

inline Camera frame_box(const Box& box, const CameraOptions& options, const V& up, double aspect, double margin) {
  ViewFit fit(options, up, aspect, {margin, margin, margin, margin});
  for (int corner = 0; corner < 8; ++corner)
    fit.add(V((corner & 1) != 0 ? box.high.x() : box.low.x(), (corner & 2) != 0 ? box.high.y() : box.low.y(),
              (corner & 4) != 0 ? box.high.z() : box.low.z()),
            0);
  return fit.camera(box.middle(), 0);
}

} // namespace sheet::render::test
