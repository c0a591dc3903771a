// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/view/packed_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "libsheet/view/packed_numbers.h"

namespace sheet::view {
namespace {

using Vectors = std::span<const Eigen::Vector3d>;

// The largest power of two that is not above `most`.
double power_of_two(double most) { return std::exp2(std::floor(std::log2(most))); }

double largest(Vectors vectors) {
  double most = 0;
  for (const Eigen::Vector3d& v : vectors)
    most = std::max(most, v.cwiseAbs().maxCoeff());
  return most;
}

// The value that so large a part of the values are below; 0 of none.
double quantile(std::vector<double> values, double part) {
  if (values.empty())
    return 0;
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

Range most_of(const std::vector<double>& values) { return {quantile(values, 0.01), quantile(values, 0.99)}; }

// The shortest edge, but no less than an eighth of the one that a tenth are shorter than: a sliver must not cost all of
// the frame its bits.
double short_edge(const formats::Frame& frame) {
  const Vectors x = positions(frame);
  std::vector<double> lengths;
  for (const Corners& t : sheet::triangles(frame))
    for (std::size_t i = 0; i < 3; ++i)
      lengths.push_back((x[t[(i + 1) % 3]] - x[t[i]]).norm());
  const double shortest = lengths.empty() ? 0 : *std::ranges::min_element(lengths);
  return std::max(shortest, quantile(std::move(lengths), 0.1) / 8);
}

// A step as long as `kept`, if that is no longer than `most` and not much shorter: differences then stay small.
double choose_step(double most, double largest_value, double kept) {
  constexpr double least_step = 1e-300, largest_step = 1e300, range = 0x1p30;
  const double least = std::max(largest_value / range, least_step),
               limit = std::min(std::max(most, 2 * least), largest_step);
  return kept <= limit && kept >= std::max(least, limit / 8) ? kept : power_of_two(limit);
}

void set_box(Vectors places, FrameDescription& d) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t v = 0; v < places.size(); ++v) {
      const double x = places[v][static_cast<Eigen::Index>(axis)];
      d.low[axis] = v == 0 ? x : std::min(d.low[axis], x);
      d.high[axis] = v == 0 ? x : std::max(d.high[axis], x);
    }
}

// Velocities and curvatures of no finite size (products of hostile numbers) become 0, what is too large the largest.
std::int32_t rounded(double steps) {
  constexpr double most = std::numeric_limits<std::int32_t>::max();
  return std::isfinite(steps) ? static_cast<std::int32_t>(std::lround(std::clamp(steps, -most, most))) : 0;
}

std::vector<std::int32_t> in_steps(Vectors vectors, double step) {
  std::vector<std::int32_t> numbers;
  for (int axis = 0; axis < 3; ++axis)
    for (const Eigen::Vector3d& v : vectors)
      numbers.push_back(rounded(v[axis] / step));
  return numbers;
}

std::vector<std::int32_t> in_steps(const std::vector<double>& values, double step) {
  std::vector<std::int32_t> numbers;
  for (const double value : values)
    numbers.push_back(rounded(value / step));
  return numbers;
}

std::vector<std::int32_t> indices(std::span<const Corners> corners) {
  std::vector<std::int32_t> numbers;
  for (const Corners& t : corners)
    numbers.insert(numbers.end(), t.begin(), t.end());
  return numbers;
}

// Triangles without area are thick beyond all numbers.
std::vector<double> logarithms(const std::vector<double>& thickness) {
  constexpr double widest = 700;
  std::vector<double> logs;
  for (const double h : thickness)
    logs.push_back(std::clamp(std::log(h), -widest, widest));
  return logs;
}

} // namespace

bool FramePacker::replace(Numbers& kept, Numbers next, bool same_mesh, PackedNumbers& packed) {
  const bool follows = same_mesh && kept.step == next.step && kept.numbers.size() == next.numbers.size();
  if (follows)
    packed.add(next.numbers, kept.numbers);
  else
    packed.add(next.numbers);
  kept = std::move(next);
  return follows;
}

bool is_packed(const Field& field) { return field.name != "thickness" && field.name != "speed"; }

FieldDescription FramePacker::pack_field(const formats::Frame& frame, const Field& field, Numbers& kept, bool same_mesh,
                                         PackedNumbers& packed) {
  FieldDescription d{.there = has(frame, field)};
  if (!d.there) {
    kept = {};
    return d;
  }
  const std::vector<double> values = values_of(frame, field);
  d.range = most_of(values);
  if (!is_packed(field))
    return d;
  if (field.palette.has_kinds()) {
    packed.add_bytes(std::vector<std::uint8_t>(values.begin(), values.end()));
    return d;
  }
  double most = 0;
  for (const double value : values)
    most = std::max(most, std::abs(value));
  d.step = choose_step(most / 4096, most, kept.step);
  d.follows = replace(kept, {d.step, in_steps(values, d.step)}, same_mesh, packed);
  return d;
}

PackedFrame FramePacker::pack(const formats::Frame& frame, std::span<const std::uint32_t> liquids) {
  const auto corners = sheet::triangles(frame);
  const Vectors x = positions(frame), v = velocities(frame);
  PackedNumbers packed;
  FrameDescription d{.time = frame.time,
                     .step = frame.step,
                     .vertices = frame.vertices,
                     .triangles = frame.triangles,
                     .same_mesh = !first_ && vertices_ == frame.vertices && std::ranges::equal(corners_, corners),
                     .moves = !v.empty(),
                     .liquids = !liquids.empty()};
  for (const double volume : volumes(frame))
    d.volume += volume;
  set_box(x, d);
  if (!d.same_mesh) {
    packed.add(indices(corners));
    corners_.assign(corners.begin(), corners.end());
    vertices_ = frame.vertices;
    first_ = false;
  }
  d.position_step = choose_step(short_edge(frame) / 512, largest(x), positions_.step);
  d.position_follows = replace(positions_, {d.position_step, in_steps(x, d.position_step)}, d.same_mesh, packed);
  const std::vector<double> h = values_of(frame, field_named("thickness"));
  replace(thickness_, {thickness_step, in_steps(logarithms(h), thickness_step)}, d.same_mesh, packed);
  if (!d.moves) {
    velocities_ = {};
  } else {
    double most = 0;
    for (const Eigen::Vector3d& velocity : v)
      most = std::max(most, velocity.norm());
    d.velocity_step = choose_step(most / 16384, most, velocities_.step);
    d.velocity_follows = replace(velocities_, {d.velocity_step, in_steps(v, d.velocity_step)}, d.same_mesh, packed);
  }
  fields_.resize(fields().size());
  for (std::size_t i = 0; i < fields().size(); ++i)
    d.fields.push_back(pack_field(frame, fields()[i], fields_[i], d.same_mesh, packed));
  if (d.liquids)
    packed.add_bytes(std::vector<std::uint8_t>(liquids.begin(), liquids.end()));
  return {d, packed.text()};
}

} // namespace sheet::view
