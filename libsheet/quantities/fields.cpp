// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/quantities/fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include <Eigen/Geometry>

#include "libsheet/base/error.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/dihedral.h"
#include "libsheet/geometry/vertex_shares.h"
#include "libsheet/material/flow_curve.h"
#include "libsheet/material/shifted_liquid.h"
#include "libsheet/scene/frame_liquids.h"
#include "libsheet/scene/read.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {
namespace {

using formats::Frame;
using formats::Place;

std::vector<double> thickness(const Frame& frame) {
  const auto x = positions(frame);
  const auto corners = triangles(frame);
  std::vector<double> h;
  for (std::size_t t = 0; t < corners.size(); ++t) {
    const Corners& c = corners[t];
    h.push_back(volumes(frame)[t] / (0.5 * (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).norm()));
  }
  return h;
}

std::vector<double> mean_curvature(const Frame& frame) {
  const auto x = positions(frame);
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  const std::vector<double> area = vertex_shares(x.size(), mesh.triangles, [&](std::uint32_t t) {
    const Corners& c = mesh.triangles[t];
    return 0.5 * (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).norm();
  });
  std::vector<double> bend(x.size(), 0);
  std::vector<bool> rim(x.size(), false);
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    const auto [a, b] = mesh.edges[e];
    if (mesh.on_rim(e)) {
      rim[a] = rim[b] = true;
      continue;
    }
    std::array<std::uint32_t, 2> apex{};
    for (std::size_t side = 0; side < 2; ++side)
      for (const std::uint32_t v : mesh.triangles[mesh.edge_triangles[e][side]])
        if (v != a && v != b)
          apex[side] = v;
    const double lb = (x[b] - x[a]).norm() * dihedral_angle(x[a], x[b], x[apex[0]], x[apex[1]]);
    bend[a] += lb;
    bend[b] += lb;
  }
  for (std::size_t v = 0; v < x.size(); ++v)
    bend[v] = rim[v] || !(area[v] > 0) ? 0 : bend[v] / (4 * area[v]);
  return bend;
}

std::vector<double> speed(const Frame& frame) {
  std::vector<double> result(frame.vertices, 0);
  const auto v = velocities(frame);
  for (std::size_t i = 0; i < v.size(); ++i)
    result[i] = v[i].norm();
  return result;
}

std::vector<double> contacts(const Frame& frame) {
  std::vector<double> result(frame.vertices, 0);
  const auto touched = touched_solids(frame);
  for (std::size_t v = 0; v < touched.size(); ++v)
    result[v] = touched[v] != no_solid ? 1 : 0;
  if (const formats::Array* springs = frame.find("contact_vertex"))
    for (const std::uint32_t v : springs->values<std::uint32_t>())
      result[v] = 2;
  return result;
}

// Precondition: the frame has the array.
std::vector<double> sheet_numbers(const Frame& frame) {
  const auto numbers = frame.find("sheet")->values<std::uint32_t>();
  return {numbers.begin(), numbers.end()};
}

struct Law {
  double rest_rate = 0; // [1/s]
  FlowCurve curve;
  ViscosityShift shift; // by temperature
};

// Of the liquids of a frame's scene, where their viscosities are more than one number.
struct Laws {
  std::optional<Scene> scene;
  std::vector<Law> of; // by the liquids' numbers
};

// Null where there are none, or no scene that can be read. Remembers the last.
const Laws* laws_of(const Frame& frame) {
  thread_local std::string text;
  thread_local Laws laws;
  const formats::Array* scene = frame.find("scene");
  if (scene == nullptr)
    return nullptr;
  if (scene->text() != text) {
    laws = {};
    text = scene->text();
    try {
      laws.scene = scene::parse_scene(text, "the frame's scene");
      const std::vector<Liquid> liquids = scene::liquids_of(*laws.scene);
      if (liquids.size() > 1 || !liquids[0].law.newtonian() || !liquids[0].temperature_law.constant())
        for (const Liquid& liquid : liquids)
          laws.of.push_back({rest_rate(liquid), FlowCurve(liquid), ViscosityShift(liquid.temperature_law)});
    } catch (const Error&) { // that of another version of these programs: others say so
    }
  }
  return laws.of.empty() ? nullptr : &laws;
}

// 0 where nothing moves yet.
std::vector<double> strain_rates(const Frame& frame) {
  const auto x = positions(frame);
  const auto v = velocities(frame);
  const auto corners = triangles(frame);
  std::vector<double> rates(corners.size(), 0);
  if (!v.empty())
    for (std::size_t t = 0; t < corners.size(); ++t) {
      const auto [a, b, c] = corners[t];
      rates[t] = std::sqrt(strain_rate({x[a], x[b], x[c]}, {v[a], v[b], v[c]}).squared);
    }
  return rates;
}

// These two: precondition: there are laws.
std::vector<double> viscosity(const Frame& frame) {
  std::vector<double> values = strain_rates(frame);
  const Laws& laws = *laws_of(frame);
  const FrameLiquids liquids(*laws.scene, frame);
  const auto temperature = temperatures(frame);
  for (std::size_t t = 0; t < values.size(); ++t) {
    const Law& law = laws.of[liquids.number(t)];
    const ShiftedCurve curve{law.curve, temperature.empty() ? 1 : law.shift.factor(temperature[t])};
    values[t] = curve.viscosity({values[t] * values[t]});
  }
  return values;
}

std::vector<double> log_viscosity(const Frame& frame) {
  std::vector<double> values = viscosity(frame);
  for (double& value : values)
    value = std::log10(value);
  return values;
}

const std::array<Field, 10> all_fields = {{
    {"thickness", "thickness", "m", Place::triangle, thickness, amounts, true},
    {"curvature", "mean curvature", "1/m", Place::vertex, mean_curvature, two_sided, false},
    {"speed", "speed", "m/s", Place::vertex, speed, amounts, false},
    {"contacts", "contacts", "1", Place::vertex, contacts, contact_kinds, false},
    {"temperature", "temperature", "K", Place::triangle, nullptr, amounts, true, Needs::heat},
    {"deviation", "thickness less wanted", "m", Place::triangle, nullptr, two_sided, true, Needs::wanted},
    {"strain_rate", "rate of strain", "1/s", Place::triangle, strain_rates, amounts, true, Needs::law},
    {"viscosity", "viscosity", "Pa s", Place::triangle, viscosity, amounts, true, Needs::law},
    {"log_viscosity", "viscosity log10 Pa s", "1", Place::triangle, log_viscosity, amounts, false, Needs::law},
    {"sheet", "sheet", "1", Place::triangle, sheet_numbers, sheet_colours, false, Needs::sheets},
}};

// The frame's array of one number a row; null if it has none.
const formats::Array* array_of(const Frame& frame, const Field& field) {
  const formats::Array* array = frame.find(field.name);
  const bool fits = array != nullptr && array->place == field.where && array->type == formats::Type::float64 &&
                    array->components == 1;
  return fits ? array : nullptr;
}

} // namespace

std::span<const Field> fields() { return all_fields; }

const Field& field_named(std::string_view name) { return *std::ranges::find(all_fields, name, &Field::name); }

bool has(const Frame& frame, const Field& field) {
  if (field.needs == Needs::sheets)
    return frame.find("sheet") != nullptr;
  if (field.needs != Needs::law)
    return field.get != nullptr || array_of(frame, field) != nullptr;
  const Laws* laws = laws_of(frame);
  return laws != nullptr && scene::tells_liquids(*laws->scene, frame);
}

double part_at_rest(const Frame& frame) {
  constexpr double moves = 10; // times the rest rate
  const Laws* laws = laws_of(frame);
  if (laws == nullptr || std::ranges::all_of(laws->of, [](const Law& law) { return law.curve.newtonian(); }))
    return std::numeric_limits<double>::quiet_NaN();
  const FrameLiquids liquids(*laws->scene, frame);
  const std::vector<double> rates = strain_rates(frame);
  double all = 0, rests = 0;
  for (std::size_t t = 0; t < rates.size(); ++t) {
    all += volumes(frame)[t];
    rests += rates[t] < moves * laws->of[liquids.number(t)].rest_rate ? volumes(frame)[t] : 0;
  }
  return rests / all;
}

std::vector<double> values_of(const Frame& frame, const Field& field) {
  if (field.needs == Needs::law && laws_of(frame) == nullptr)
    fail(ExitCode::bad_input,
         "the frame's liquid has one viscosity, so it has no {} of its own: [material] law or viscosity_law give one",
         field.caption);
  if (field.needs == Needs::sheets && !has(frame, field))
    fail(ExitCode::bad_input, "the frame does not say which triangle is of which sheet (array \"sheet\"): sheet-init "
                              "does where the scene has "
                              "several");
  if (field.needs == Needs::wanted && !has(frame, field))
    fail(ExitCode::bad_input, "a deviation is from a wanted thickness: give --wanted, such as --wanted 2mm");
  if (field.get != nullptr)
    return field.get(frame);
  const formats::Array* array = array_of(frame, field);
  if (array == nullptr)
    fail(ExitCode::bad_input, "the frame has no array \"{}\" of one number a {}", field.name, name_of(field.where));
  const auto values = array->values<double>();
  return {values.begin(), values.end()};
}

} // namespace sheet
