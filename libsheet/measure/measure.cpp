// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/measure/measure.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Geometry>

#include "libsheet/base/error.h"
#include "libsheet/base/log.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/faces.h"
#include "libsheet/scene/drop_densities.h"
#include "libsheet/scene/frame_liquids.h"
#include "libsheet/scene/free_faces.h"
#include "libsheet/scene/inner_faces.h"
#include "libsheet/scene/read.h"
#include "libsheet/sheet/enclosures.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

namespace {

using Eigen::Vector3d;

class Sum {
public:
  void add(double x) {
    const double total = sum_ + x;
    rest_ += std::abs(sum_) >= std::abs(x) ? (sum_ - total) + x : (x - total) + sum_;
    sum_ = total;
  }
  [[nodiscard]] double value() const { return std::isfinite(rest_) ? sum_ + rest_ : sum_; }

private:
  double sum_ = 0, rest_ = 0;
};

class VectorSum {
public:
  void add(const Vector3d& x) {
    for (int i = 0; i < 3; ++i)
      sums_[i].add(x[i]);
  }
  [[nodiscard]] Vector3d value() const { return {sums_[0].value(), sums_[1].value(), sums_[2].value()}; }

private:
  std::array<Sum, 3> sums_;
};

// fmin and fmax pass over the NaN that stands for nothing yet.
void widen(double& least, double& greatest, double x) {
  least = std::fmin(least, x);
  greatest = std::fmax(greatest, x);
}

// Returns the range of the thickness, of the areas and volumes that are summed here.
Range measure_triangles(const formats::Frame& frame, Measurements& m) {
  Range thickness;
  const auto x = positions(frame);
  const auto corners = triangles(frame);
  const auto v = volumes(frame);
  Sum area, volume;
  for (std::size_t t = 0; t < corners.size(); ++t) {
    const std::array<Vector3d, 3> side = {x[corners[t][2]] - x[corners[t][1]], x[corners[t][0]] - x[corners[t][2]],
                                          x[corners[t][1]] - x[corners[t][0]]};
    const double twice_area = side[0].cross(side[1]).norm();
    area.add(twice_area / 2);
    volume.add(v[t]);
    widen(thickness.least, thickness.greatest, v[t] / (twice_area / 2));
    double longest = 0; // squared
    for (std::size_t i = 0; i < 3; ++i) {
      // tan = |a × b| / (a·b) is accurate for every angle
      widen(m.angle_min, m.angle_max, std::atan2(twice_area, -side[(i + 1) % 3].dot(side[(i + 2) % 3])));
      longest = std::max(longest, side[i].squaredNorm());
    }
    m.aspect_max = std::fmax(m.aspect_max, std::sqrt(3) / 2 * longest / twice_area);
  }
  m.area = area.value();
  m.volume = volume.value();
  if (!corners.empty())
    thickness.mean = m.volume / m.area;
  return thickness;
}

// Precondition: the area is measured.
void measure_distribution(const formats::Frame& frame, const std::vector<double>& thickness, Measurements& m) {
  const auto x = positions(frame);
  const auto corners = triangles(frame);
  std::vector<std::uint32_t> order; // from thin to thick
  for (std::uint32_t t = 0; t < corners.size(); ++t)
    if (!std::isnan(thickness[t]))
      order.push_back(t);
  if (order.empty())
    return;
  std::ranges::stable_sort(order, {}, [&](std::uint32_t t) { return thickness[t]; });
  const auto middle = [&](const Corners& c) { return Vector3d((x[c[0]] + x[c[1]] + x[c[2]]) / 3); };
  m.thinnest_at = middle(corners[order.front()]);
  m.thickest_at = middle(corners[order.back()]);
  std::size_t passed = 0;
  double area = 0;
  for (std::size_t i = 0; i < percents.size(); ++i) {
    while (passed < order.size() && (passed == 0 || area < percents[i] / 100.0 * m.area)) {
      const Corners& c = corners[order[passed++]];
      area += (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).norm() / 2;
    }
    m.thickness_percentiles[i] = thickness[order[passed - 1]];
  }
}

// Mean of values, one a triangle or vertex, by area.
double mean_by_area(const formats::Frame& frame, const Field& field, const std::vector<double>& values) {
  const auto x = positions(frame);
  const auto corners = triangles(frame);
  Sum area, sum;
  for (std::size_t t = 0; t < corners.size(); ++t) {
    const Corners& c = corners[t];
    const double size = (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).norm() / 2;
    area.add(size);
    sum.add(size *
            (field.where == formats::Place::triangle ? values[t] : (values[c[0]] + values[c[1]] + values[c[2]]) / 3));
  }
  return sum.value() / area.value();
}

void measure_fields(const formats::Frame& frame, const Range& thickness, Measurements& m) {
  for (const Field& field : fields()) {
    if (!field.in_figures)
      continue;
    m.fields.push_back({&field, {}});
    Range& range = m.fields.back().range;
    m.has[static_cast<std::size_t>(field.needs)] |= has(frame, field);
    if (field.name == "thickness") {
      range = thickness;
      measure_distribution(frame, values_of(frame, field), m);
    }
    if (field.name == "thickness" || frame.triangles == 0 || !has(frame, field))
      continue;
    const std::vector<double> values = values_of(frame, field);
    for (const double value : values)
      widen(range.least, range.greatest, value);
    range.mean = mean_by_area(frame, field, values);
  }
}

void measure_edges(const formats::Frame& frame, std::span<const Side> sides, Measurements& m) {
  const auto x = positions(frame);
  Sum length;
  std::uint64_t edges = 0;
  for_each_edge(sides, [&](std::span<const Side> edge) {
    const double l = (x[edge[0].high] - x[edge[0].low]).norm();
    widen(m.edge.least, m.edge.greatest, l);
    length.add(l);
    ++edges;
  });
  if (edges > 0)
    m.edge.mean = length.value() / static_cast<double>(edges);
}

void measure_motion(const formats::Frame& frame, const Densities& densities, Measurements& m) {
  Sum energy;
  VectorSum momentum, angular;
  const auto x = positions(frame);
  const auto u = velocities(frame);
  if (!u.empty()) {
    const auto corners = triangles(frame);
    const auto v = volumes(frame);
    for (std::size_t t = 0; t < corners.size(); ++t) {
      const double mass = densities.of(t) * v[t] / 3;
      for (const std::uint32_t c : corners[t]) {
        energy.add(mass / 2 * u[c].squaredNorm());
        momentum.add(mass * u[c]);
        angular.add(mass * x[c].cross(u[c]));
      }
    }
  }
  m.kinetic_energy = energy.value();
  m.momentum = momentum.value();
  m.angular_momentum = angular.value();
}

// Of the enclosures. In the first frame there is none yet, but a canonical scene that says so.
void measure_gas(const formats::Frame& frame, Measurements& m) {
  const auto pressure = of_enclosures(frame, "gas.pressure");
  const formats::Array* scene = frame.find("scene");
  m.has[static_cast<std::size_t>(Needs::gas)] =
      !pressure.empty() ||
      (scene != nullptr && scene->text().find("pressure = {law = \"gas\"") != std::string_view::npos);
  if (pressure.empty())
    return;
  m.gas_pressure = std::ranges::max(pressure);
  m.gas_amount = m.gas_escaped = 0;
  for (const double amount : of_enclosures(frame, "gas.amount"))
    m.gas_amount += amount;
  for (const double escaped : of_enclosures(frame, "gas.escaped"))
    m.gas_escaped += escaped;
}

} // namespace

Measurements measure(const formats::Frame& frame, const std::optional<Densities>& densities) {
  Measurements m;
  for (const Vector3d& x : positions(frame))
    for (int i = 0; i < 3; ++i)
      widen(m.low[i], m.high[i], x[i]);
  measure_fields(frame, measure_triangles(frame, m), m);
  m.part_at_rest = part_at_rest(frame);
  if (knows_drops(frame)) {
    m.has[static_cast<std::size_t>(Needs::drops)] = true;
    m.drops = static_cast<double>(read_drops(frame).size());
    m.drop_volume = volume_of_drops(frame);
  }
  measure_gas(frame, m);
  const std::vector<Side> sides = sorted_sides(triangles(frame), frame.vertices);
  measure_edges(frame, sides, m);
  if (densities)
    measure_motion(frame, *densities, m);
  m.topology = find_topology(triangles(frame), frame.vertices, sides);
  return m;
}

const Range& Measurements::range_of(std::string_view field) const {
  return std::ranges::find(fields, field, [](const FieldRange& f) { return f.field->name; })->range;
}

namespace {

// Σ ρ c V T of triangles and drops [J]; NaN without temperatures. Precondition: the scene has heat.
double heat_of(const formats::Frame& frame, const Scene& scene) {
  const auto temperature = temperatures(frame), volume = volumes(frame);
  if (temperature.empty())
    return absent;
  const FrameLiquids liquids(scene, frame);
  Sum warmth;
  for (std::size_t t = 0; t < volume.size(); ++t)
    warmth.add(liquids.relative_density(t) * volume[t] * temperature[t]);
  const std::vector<Drop> drops = read_drops(frame);
  const std::vector<double> densities = scene::densities_of(drops, scene);
  for (std::size_t i = 0; i < drops.size(); ++i)
    warmth.add(densities[i] / scene.material.density * drops[i].volume * drops[i].temperature);
  return scene.material.density * scene.heat->specific_heat * warmth.value();
}

// Of each triangle [N/m]; empty if all have that of [material].
std::vector<double> tensions(const formats::Frame& frame, const Scene& scene) {
  const auto temperature = temperatures(frame);
  const FrameLiquids liquids(scene, frame);
  std::vector<double> of;
  if (liquids.several() || !(temperature.empty() || scene.material.surface_tension_slope == 0))
    for (std::size_t t = 0; t < frame.triangles; ++t)
      of.push_back(temperature.empty() ? liquids.of(t).surface_tension
                                       : liquids.of(t).surface_tension_at(temperature[t]));
  return of;
}

// Of all faces: both sides of the middle surface, whose area is given, but for those that lie on other layers, and what
// rims and slopes have beyond them [J].
double surface_energy(const formats::Frame& frame, const Scene& scene, double area) {
  const std::vector<double> tension = tensions(frame, scene), inner = inner_faces(scene, frame);
  const auto x = positions(frame);
  const auto corners = triangles(frame);
  double beyond = 0;
  if (scene.model.faces) {
    const Connectivity mesh = connect(frame.vertices, corners);
    beyond = extra_area(mesh, x, volumes(frame), scene::free_faces(scene, frame, mesh), tension);
  }
  if (tension.empty() && inner.empty())
    return scene.material.surface_tension * (2 * area + beyond);
  Sum sum;
  for (std::size_t t = 0; t < corners.size(); ++t) {
    const Corners& c = corners[t];
    const double faces = inner.empty() ? 2 : 2 - (inner[c[0]] + inner[c[1]] + inner[c[2]]) / 3;
    sum.add((tension.empty() ? 1 : tension[t]) * faces / 2 * (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).norm());
  }
  return tension.empty() ? scene.material.surface_tension * (sum.value() + beyond) : sum.value() + beyond;
}

} // namespace

void measure_energies(const formats::Frame& frame, const Scene& scene, Measurements& measured) {
  if (scene.environment.gravity && scene.material.density > 0) {
    const auto x = positions(frame);
    const auto corners = triangles(frame);
    const auto v = volumes(frame);
    const FrameLiquids liquids(scene, frame);
    Vector3d moment = Vector3d::Zero(); // of volume, by densities over that of the scene's own liquid [m⁴]
    for (std::size_t t = 0; t < corners.size(); ++t)
      moment += liquids.relative_density(t) * v[t] / 3 * (x[corners[t][0]] + x[corners[t][1]] + x[corners[t][2]]);
    measured.gravity_energy = -scene.material.density * scene.environment.gravity->dot(moment);
  }
  const std::vector<Liquid> liquids = scene::liquids_of(scene);
  if (std::ranges::any_of(liquids, [](const Liquid& liquid) { return liquid.surface_tension > 0; }))
    measured.surface_energy = surface_energy(frame, scene, measured.area);
  if (scene.heat)
    measured.heat = heat_of(frame, scene);
}

std::optional<Densities> SceneDensity::of(const formats::Frame& frame) {
  const formats::Array* scene = frame.find("scene");
  if (scene == nullptr)
    return {};
  if (scene->text() != text_) {
    text_ = scene->text();
    scene_.reset();
    try {
      Scene said = parse_scene(text_, "the frame's scene");
      (void)FrameLiquids(said, frame);
      if (said.material.density > 0)
        scene_ = std::move(said);
    } catch (const Error& error) {
      log::warning("no density: {}", error.what());
    }
  }
  if (!scene_)
    return {};
  const FrameLiquids liquids(*scene_, frame);
  if (!liquids.several())
    return scene_->material.density;
  std::vector<double> densities;
  for (std::size_t t = 0; t < frame.triangles; ++t)
    densities.push_back(liquids.density(t));
  return Densities(std::move(densities));
}

void SceneDensity::measure_heat(const formats::Frame& frame, Measurements& measured) {
  (void)of(frame);
  if (scene_ && scene_->heat)
    measured.heat = heat_of(frame, *scene_);
}

} // namespace sheet
