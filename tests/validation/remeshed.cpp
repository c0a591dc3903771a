// SPDX-License-Identifier: GPL-3.0-or-later
// V9 until the hole has grown tenfold, V10, V25: remeshed on the way.
#include <algorithm>

#include <fmt/core.h>

#include "libsheet/geometry/area.h"
#include "libsheet/scene/read.h"
#include "libsheet/shape/build.h"
#include "libsheet/sheet/sheet.h"
#include "tests/validation/setup.h"
#include "tests/validation/stages.h"

namespace sheet::validation {

namespace {

using formats::Frame;

double area_of(const Frame& frame) {
  const auto x = positions(frame);
  double sum = 0;
  for (const Corners& c : triangles(frame))
    sum += 0.5 * (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).norm();
  return sum;
}

double volume_of(const Frame& frame) {
  double sum = 0;
  for (const double v : volumes(frame))
    sum += v;
  return sum;
}

double sharpest_angle(const Vector3& a, const Vector3& b, const Vector3& c) { // [degrees]
  const auto at = [](const Vector3& x, const Vector3& y, const Vector3& z) {
    return std::atan2((y - x).cross(z - x).norm(), (y - x).dot(z - x));
  };
  return 180 / pi * std::min({at(a, b, c), at(b, c, a), at(c, a, b)});
}

// Area of the polygon of the vertices within `radius` of the y axis.
double ring_area(const Frame& frame, double radius) {
  std::vector<std::pair<double, Vector3>> ring;
  for (const Vector3& x : positions(frame))
    if (std::hypot(x[0], x[2]) < radius)
      ring.emplace_back(std::atan2(x[2], x[0]), x);
  std::sort(ring.begin(), ring.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector3 &a = ring[i].second, &b = ring[(i + 1) % ring.size()].second;
    sum += 0.5 * std::abs(a[0] * b[2] - a[2] * b[0]);
  }
  return sum;
}

} // namespace

// V9 remeshed: the hole grows from R0 = 0.08 to ten times that, the rim at 1 held; Ṙ = γ R (1-s²)/(μ h (1+3s²)), s = R,
// h = h0 (1-R0²)/(1-R²). Radii are those of circles with the hole's area, also R0: the first polygon has few edges.
Result v9_remeshed(const Settings& s) {
  constexpr double mu = 1, h0 = 0.01, tension = 0.02, r0 = 0.08;
  const std::string scene = fmt::format(
      "[sheet]\nshape = \"annulus\"\ninner_radius = {}\nouter_radius = 1\nedge_length = {}\nthickness = {}\nseed = {}\n"
      "[material]\nviscosity = {}\nsurface_tension = {}\n[model]\ninertia = false\nbending = false\n"
      "[[hold]]\nregion = \"outer_rim\"\n[[hold]]\nregion = {{box = [[-2, -2, -2], [2, 2, 2]]}}\naxes = \"y\"\n",
      r0, s.edge, h0, s.seed, mu, tension);
  const Frame start = build_frame(parse_scene(scene, "validation case"));
  const double hole = ring_area(start, r0 * 1.0001), whole = area_of(start) + hole, begin = std::sqrt(hole / pi);
  const auto rate = [&](double r) {
    const double q = r * r, h = h0 * (1 - begin * begin) / (1 - q);
    return tension * r * (1 - q) / (mu * h * (1 + 3 * q));
  };
  double until = 0; // when the exact hole has grown tenfold: dt = dR / Ṙ, by Simpson's rule
  constexpr int parts = 2000;
  for (int i = 0; i < parts; ++i) {
    const double a = begin * (1 + 9.0 * i / parts), b = begin * (1 + 9.0 * (i + 1) / parts);
    until += (b - a) / 6 * (1 / rate(a) + 4 / rate((a + b) / 2) + 1 / rate(b));
  }
  const Staged run = run_stages(scene, s, until);
  const double end = std::sqrt((whole - area_of(run.frame)) / pi);
  Result r = result_of(run, s, end / (10 * begin));
  r.more = {{"edits", static_cast<double>(run.edits)}, {"volume", volume_of(run.frame) / volume_of(start) - 1}};
  return r;
}

// V10: half of a film that retracts. Its momentum per width grows as 2 γ t; the speed of its edge tends to
// sqrt(2 γ/(ρ h)). A little viscosity gives the rim a width, 4 μ/(ρ U) = 0.04, which no mesh has without; at the middle
// plane the film stays at rest. Value: the momentum's worst ratio; more: that of the edge's speed at the end.
Result v10(const Settings& s) {
  constexpr double rho = 1000, h = 1e-4, tension = 0.03, length = 1, width = 0.1, until = 0.9;
  const double speed = std::sqrt(2 * tension / (rho * h)), mu = 0.01 * rho * speed;
  const std::string scene = fmt::format(
      "[sheet]\nshape = \"rectangle\"\nplane = \"xy\"\nsize = [{}, {}]\nedge_length = {}\nthickness = {}\nseed = {}\n"
      "[material]\nviscosity = {}\ndensity = {}\nsurface_tension = {}\n[model]\nbending = false\n"
      "[[hold]]\nregion = \"x_min\"\naxes = \"x\"\n[[hold]]\nregion = \"y_min\"\naxes = \"y\"\n[[hold]]\nregion = "
      "\"y_max\"\n"
      "axes = \"y\"\n[[hold]]\nregion = {{box = [[-2, -2, -2], [2, 2, 2]]}}\naxes = \"z\"\n",
      length, width, s.edge, h, s.seed, mu, rho, tension);
  double worst = 0, momentum = 0;
  const Staged run = run_stages(scene, s, until, [&](const Frame& frame) {
    const auto u = velocities(frame);
    const auto v = volumes(frame);
    momentum = 0;
    for (std::size_t t = 0; t < frame.triangles; ++t)
      for (const std::uint32_t c : triangles(frame)[t])
        momentum -= rho * v[t] / 3 * u[c][0];
    const double ratio = momentum / (2 * tension * width * frame.time) - 1;
    if (std::abs(ratio) > std::abs(worst))
      worst = ratio;
  });
  double edge = -1, edge_speed = 0;
  const auto x = positions(run.frame);
  for (const Vector3& p : x)
    edge = std::max(edge, p[0]);
  int count = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (x[i][0] > edge - 0.1 * s.edge) {
      edge_speed -= velocities(run.frame)[i][0];
      ++count;
    }
  Result r = result_of(run, s, 1 + worst);
  r.more = {{"edge_speed", edge_speed / count / speed - 1},
            {"edits", static_cast<double>(run.edits)},
            {"edge_moved", length / 2 - edge}};
  return r;
}

// V25: down an incline, a layer of thickness h overruns one of h/10 that lies ahead of it. Mass that flows through the
// front gives its speed, (q(h) - q(h/10))/(h - h/10) = 1.11 u, q = u h ~ h³ [Huppert 1982]; behind it, from the upper
// end, which is held, thickness is h (x/(3 u t))^(1/2). When the front has moved by 0.55 of the layer's length, where
// is it: by the area of what is thicker than 0.55 h. More: the greatest thickness on the way, which theory says is h,
// and the sharpest angle.
Result v25(const Settings& s) {
  constexpr double mu = 1, rho = 1, h = 0.02, length = 1, strip = 3, width = 0.3, ahead = 0.1, part = 0.55;
  const double pull = std::sqrt(0.5), speed = rho * pull * h * h / (3 * mu), until = 0.5 * length / speed;
  const std::string scene = fmt::format(
      "[sheet]\nshape = \"rectangle\"\nplane = \"xz\"\nsize = [{}, {}]\ncenter = [{}, {}, 0]\nedge_length = {}\n"
      "thickness = {}\nseed = {}\n[material]\nviscosity = {}\ndensity = {}\n[model]\nbending = false\n"
      "[environment]\ngravity = [{}, {}, 0]\n"
      "[[solid]]\nshape = \"plane\"\nnormal = [0, 1, 0]\ncontact = \"flow\"\n"
      "[[hold]]\nregion = \"x_min\"\n[[hold]]\nregion = \"z_min\"\naxes = \"z\"\n"
      "[[hold]]\nregion = \"z_max\"\naxes = \"z\"\n",
      strip, width, strip / 2, h / 2, s.edge, h, s.seed, mu, rho, pull, -pull);
  const auto touch_and_thin = [&](Frame& frame) {
    formats::Array touch = formats::make_standard_array("touch", frame.vertices);
    std::ranges::fill(touch.values<std::uint64_t>(), 1);
    frame.put(std::move(touch));
    for (std::size_t t = 0; t < frame.triangles; ++t) {
      const Corners& c = triangles(frame)[t];
      const auto x = positions(frame);
      if ((x[c[0]] + x[c[1]] + x[c[2]]).x() / 3 > length)
        volumes(frame)[t] *= ahead;
    }
  };
  double thickest = 0, least_angle = 180;
  const auto watch = [&](const Frame& frame) {
    const auto x = positions(frame);
    for (std::size_t t = 0; t < frame.triangles; ++t) {
      const Corners& c = triangles(frame)[t];
      thickest = std::max(thickest, volumes(frame)[t] / TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area);
      least_angle = std::min(least_angle, sharpest_angle(x[c[0]], x[c[1]], x[c[2]]));
    }
  };
  const Staged run = run_stages(scene, s, until, watch, touch_and_thin);
  double thick = 0;
  const auto x = positions(run.frame);
  for (std::size_t t = 0; t < run.frame.triangles; ++t) {
    const Corners& c = triangles(run.frame)[t];
    const double area = TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area;
    if (volumes(run.frame)[t] > part * h * area)
      thick += area / width;
  }
  const double exact = length + speed * until * (1 - std::pow(ahead, 3)) / (1 - ahead);
  Result r = result_of(run, s, (thick + part * part * 3 * speed * until) / exact);
  r.more = {{"thickest", thickest / h}, {"angle", least_angle}, {"edits", static_cast<double>(run.edits)}};
  return r;
}

} // namespace sheet::validation
