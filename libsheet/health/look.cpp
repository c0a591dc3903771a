// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/health/look.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>
#include <numbers>
#include <numeric>

#include "libsheet/geometry/area.h"
#include "libsheet/geometry/disjoint_sets.h"
#include "libsheet/scene/scales.h"
#include "libsheet/scene/solid_width.h"
#include "libsheet/sheet/drops.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::health {

namespace {

using formats::Frame;

constexpr double degrees = 180 / std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double tall = 2;             // thicker than so many edges: no sheet
constexpr double least_crushed = 0.01; // of the volume: less is a rim or a crumb
constexpr std::size_t least_row = 8;   // triangles of a strand: fewer are at corners of rims

struct Triangle {
  Vector3 normal, middle;
  double area, longest, smallest_angle; // [m²], [m], [rad]
};

// By the angle between two sides, found where it is least: opposite the shortest side.
double least_angle_of(const TriangleArea& t, double area) {
  const std::array<double, 3> squares{t.edge[0].squaredNorm(), t.edge[1].squaredNorm(), t.edge[2].squaredNorm()};
  const auto i = static_cast<std::size_t>(std::ranges::min_element(squares) - squares.begin());
  const double dot = -t.edge[(i + 1) % 3].dot(t.edge[(i + 2) % 3]);
  return std::atan2(2 * area, dot);
}

struct Surface {
  std::vector<Triangle> triangles;
  double area = 0, volume = 0;
};

Surface surface_of(const Frame& frame) {
  const auto x = positions(frame);
  Surface surface;
  surface.triangles.reserve(frame.triangles);
  for (const Corners& c : triangles(frame)) {
    const TriangleArea t(x[c[0]], x[c[1]], x[c[2]]);
    const double longest =
        std::sqrt(std::max({t.edge[0].squaredNorm(), t.edge[1].squaredNorm(), t.edge[2].squaredNorm()}));
    surface.triangles.push_back(
        {t.normal, (x[c[0]] + x[c[1]] + x[c[2]]) / 3, t.area, longest, least_angle_of(t, t.area)});
    surface.area += t.area;
  }
  const auto v = volumes(frame);
  surface.volume = std::accumulate(v.begin(), v.end(), 0.0);
  return surface;
}

// The worst of the triangles that are beyond the kind's limit, and the share of the area of all of those.
class Worst {
public:
  explicit Worst(Trouble trouble) : kind_(kind_of(trouble)) {}

  void see(double value, const Triangle& triangle) {
    const double limit = kind_.noted.worst;
    if (kind_.least ? value >= limit : value <= limit)
      return;
    area_ += triangle.area;
    ++number_;
    if (number_ == 1 || (kind_.least ? value < value_ : value > value_)) {
      value_ = value;
      place_ = triangle.middle;
    }
  }

  void add_to(std::vector<Observation>& seen, double whole_area) const {
    const double share = whole_area > 0 ? area_ / whole_area : 0;
    if (number_ > 0 && share >= kind_.noted.share)
      seen.push_back({kind_.trouble, value_, share, static_cast<double>(number_), place_});
  }

private:
  const Kind& kind_;
  std::size_t number_ = 0;
  double value_ = 0, area_ = 0;
  Vector3 place_ = Vector3::Zero();
};

// The least and the greatest thickness with which liquid of the scene begins [m]; where meshes say it, the mean of the
// sheet now.
std::pair<double, double> start_thickness(const Scene& scene, const Surface& surface) {
  std::vector<double> all;
  for (const scene::SheetTable& sheet : scene.sheets)
    if (const auto* uniform = std::get_if<double>(&sheet.thickness))
      all.push_back(*uniform);
  for (const scene::Inflow& inflow : scene.inflows)
    all.push_back(inflow.thickness);
  if (all.empty())
    all.push_back(surface.volume / surface.area);
  const auto [least, greatest] = std::ranges::minmax(all);
  return {least, greatest};
}

// With [tear] below or sites the scene itself says what becomes of thin places.
void look_for_thin(const Frame& frame, const Surface& surface, const Scene& scene, std::vector<Observation>& seen) {
  if (scene.tear && (scene.tear->below || scene.tear->inclusions))
    return;
  const double start = start_thickness(scene, surface).first;
  const auto volume = volumes(frame);
  Worst worst(Trouble::thin);
  for (std::size_t t = 0; t < frame.triangles; ++t)
    worst.see(volume[t] / (surface.triangles[t].area * start), surface.triangles[t]);
  worst.add_to(seen, surface.area);
}

// What lies on solids may be as thick as it likes.
void look_for_crushed(const Frame& frame, const Surface& surface, const Scene& scene, std::vector<Observation>& seen) {
  const double start = start_thickness(scene, surface).second;
  const auto touch = touched_solids(frame, scene.solids.size());
  const auto volume = volumes(frame);
  const auto lies = [&](std::uint32_t v) { return !touch.empty() && touch[v] != no_solid; };
  Worst worst(Trouble::crushed);
  double crushed = 0;
  for (std::size_t t = 0; t < frame.triangles; ++t) {
    const Triangle& triangle = surface.triangles[t];
    const double thickness = volume[t] / triangle.area;
    if (thickness <= tall * triangle.longest || std::ranges::all_of(triangles(frame)[t], lies))
      continue;
    if (thickness > kind_of(Trouble::crushed).noted.worst * start)
      crushed += volume[t];
    worst.see(thickness / start, triangle);
  }
  if (crushed > least_crushed * surface.volume)
    worst.add_to(seen, surface.area);
}

// Around a vertex that is on no rim each neighbour comes next in one triangle and last in another one, so that the sum
// of next less last, modulo 2^32, is 0.
std::vector<bool> on_rims(const Frame& frame) {
  std::vector<std::uint32_t> sums(frame.vertices, 0);
  for (const Corners& c : triangles(frame))
    for (std::size_t i = 0; i < 3; ++i)
      sums[c[i]] += c[(i + 1) % 3] - c[(i + 2) % 3];
  std::vector<bool> on_rim(frame.vertices);
  for (std::size_t v = 0; v < sums.size(); ++v)
    on_rim[v] = sums[v] != 0;
  return on_rim;
}

// Those of strands of one row: all corners are on rims, and no fewer than least_row hang together by sides.
std::vector<std::uint32_t> triangles_of_strands(const Frame& frame) {
  const auto corners = triangles(frame);
  const std::vector<bool> on_rim = on_rims(frame);
  std::vector<std::uint32_t> between_rims;
  for (std::uint32_t t = 0; t < corners.size(); ++t)
    if (std::ranges::all_of(corners[t], [&](std::uint32_t v) { return on_rim[v]; }))
      between_rims.push_back(t);
  struct Side {
    std::uint32_t low, high; // vertices
    std::uint64_t triangle;  // its number in between_rims
    auto operator<=>(const Side&) const = default;
  };
  std::vector<Side> sides;
  for (std::uint64_t i = 0; i < between_rims.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(corners[between_rims[i]][k], corners[between_rims[i]][(k + 1) % 3]);
      sides.push_back({low, high, i});
    }
  std::ranges::sort(sides);
  DisjointSets rows(between_rims.size());
  for (std::size_t k = 1; k < sides.size(); ++k)
    if (sides[k].low == sides[k - 1].low && sides[k].high == sides[k - 1].high)
      rows.join(sides[k].triangle, sides[k - 1].triangle);
  const std::vector<std::uint64_t> row = rows.take();
  std::vector<std::size_t> length(row.size(), 0);
  for (const std::uint64_t r : row)
    ++length[r];
  std::vector<std::uint32_t> strands;
  for (std::size_t i = 0; i < row.size(); ++i)
    if (length[row[i]] >= least_row)
      strands.push_back(between_rims[i]);
  return strands;
}

// Their width is a triangle's least height. With [tear] snap the scene says what becomes of them.
void look_for_threads(const Frame& frame, const Surface& surface, const Scene& scene, std::vector<Observation>& seen) {
  if (scene.tear && scene.tear->snap)
    return;
  const auto volume = volumes(frame);
  Worst worst(Trouble::threads);
  for (const std::uint32_t t : triangles_of_strands(frame)) {
    const Triangle& triangle = surface.triangles[t];
    worst.see(2 * triangle.area / triangle.longest / (volume[t] / triangle.area), triangle);
  }
  worst.add_to(seen, surface.area);
}

void look_for_sharp(const Surface& surface, std::vector<Observation>& seen) {
  Worst worst(Trouble::sharp);
  for (const Triangle& triangle : surface.triangles)
    worst.see(triangle.smallest_angle * degrees, triangle);
  worst.add_to(seen, surface.area);
}

// Over an edge the sheet turns by twice the angle between a triangle and the mean of those around its corner, about.
void look_for_coarse_folds(const Frame& frame, const Surface& surface, std::vector<Observation>& seen) {
  const auto corners = triangles(frame);
  std::vector<Vector3> normal(frame.vertices, Vector3::Zero());
  for (std::size_t t = 0; t < corners.size(); ++t)
    for (const auto v : corners[t])
      normal[v] += surface.triangles[t].area * surface.triangles[t].normal;
  Worst worst(Trouble::coarse_fold);
  const double half_limit = kind_of(Trouble::coarse_fold).noted.worst / degrees / 2;
  const double cosine_limit = std::cos(half_limit);
  for (std::size_t t = 0; t < corners.size(); ++t) {
    const Triangle& triangle = surface.triangles[t];
    double cosine = 1;
    for (const auto v : corners[t])
      if (const double length = normal[v].norm(); length > 0)
        cosine = std::min(cosine, triangle.normal.dot(normal[v]) / length);
    if (cosine < cosine_limit)
      worst.see(std::min(180.0, 2 * degrees * std::acos(std::max(-1.0, cosine))), triangle);
  }
  worst.add_to(seen, surface.area);
}

void look_at_solids(const Frame& frame, const Surface& surface, const Scene& scene, std::vector<Observation>& seen) {
  if (scene.solids.empty() || frame.find("touch") == nullptr)
    return;
  std::vector<double> width;
  for (const scene::Solid& solid : scene.solids)
    width.push_back(scene::width_of(solid.shape));
  const auto touch = touched_solids(frame, scene.solids.size());
  const auto corners = triangles(frame);
  Worst worst(Trouble::coarse_solid);
  for (std::size_t t = 0; t < corners.size(); ++t) {
    double least = infinity;
    for (const auto v : corners[t])
      if (touch[v] != no_solid)
        least = std::min(least, width[static_cast<std::size_t>(touch[v])]);
    worst.see(surface.triangles[t].longest / least, surface.triangles[t]);
  }
  worst.add_to(seen, surface.area);
}

// Root of the mean square over vertices [m/s].
double mean_speed(const Frame& frame) {
  if (frame.find("velocity") == nullptr)
    return 0;
  double squares = 0;
  for (const Vector3& v : velocities(frame))
    squares += v.squaredNorm();
  return std::sqrt(squares / static_cast<double>(frame.vertices));
}

// The step that the control tries next: the one taken may have been cut short by an output time. What moves faster than
// the scene's scales say, as stiff sheets do while they fall, is judged by its speed. Not judged where gas drives the
// sheet: a frame's scene has its amount, and its pressure changes.
void look_at_step(const Frame& frame, const Surface& surface, const Scene& scene, std::vector<Observation>& seen) {
  const auto& pressure = scene.environment.pressure;
  if (pressure && std::holds_alternative<scene::GasPressure>(*pressure))
    return;
  const double step = number(frame, "step_size", infinity), speed = mean_speed(frame);
  const scene::Measured whole{
      .length = std::sqrt(surface.area), .thickness = surface.volume / surface.area, .curvature = {}};
  double part = 0; // of the time of the flow: of the sheet that has the shortest one
  for (const scene::SheetTable& sheet : scene.sheets) {
    const scene::Scales scales = scene::scales_of(scene, sheet, whole);
    // what rests on a bath, or stands by its yield stress, may still bob
    const bool stands = !(scales.speed > 0);
    if (!scales.length || (stands && !scene.model.inertia))
      continue;
    const bool may_bob = scene.model.inertia && (scene.environment.bath || stands);
    const double bobs = may_bob ? std::sqrt(scales.gravity * *scales.length) : 0;
    part = std::max(part, step * std::max({scales.speed, speed, bobs}) / *scales.length);
  }
  if (part > 0 && part < kind_of(Trouble::short_steps).noted.worst)
    seen.push_back({.trouble = Trouble::short_steps, .value = part});
}

double account(const Frame& frame, std::string_view name) {
  const formats::Array* array = frame.find(name);
  return array == nullptr || array->type != formats::Type::float64 || array->rows == 0 ? 0 : array->values<double>()[0];
}

void look_for_crumbs(const Frame& frame, const Surface& surface, std::vector<Observation>& seen) {
  const double dropped = account(frame, "tear.volume");
  const double share = dropped / (dropped + surface.volume);
  if (share > kind_of(Trouble::crumbs).noted.worst)
    seen.push_back({.trouble = Trouble::crumbs, .value = share});
}

// Of what is there and what has left, less what has entered [m^3].
double total_volume(const Frame& frame) {
  const auto v = volumes(frame);
  return std::accumulate(v.begin(), v.end(), 0.0) + volume_of_drops(frame) + account(frame, "tear.volume") +
         account(frame, "outflow.volume") - account(frame, "emit.volume");
}

} // namespace

std::vector<Observation> look(const Frame& frame, const Scene* scene) {
  std::vector<Observation> seen;
  if (frame.triangles == 0)
    return seen;
  const Surface surface = surface_of(frame);
  if (!(surface.area > 0 && std::isfinite(surface.area)))
    return seen;
  look_for_sharp(surface, seen);
  look_for_coarse_folds(frame, surface, seen);
  look_for_crumbs(frame, surface, seen);
  if (scene == nullptr)
    return seen;
  look_for_thin(frame, surface, *scene, seen);
  look_for_threads(frame, surface, *scene, seen);
  look_for_crushed(frame, surface, *scene, seen);
  look_at_solids(frame, surface, *scene, seen);
  look_at_step(frame, surface, *scene, seen);
  return seen;
}

double unexplained_volume(const Frame& before, const Frame& after) {
  return total_volume(after) - total_volume(before);
}

} // namespace sheet::health
