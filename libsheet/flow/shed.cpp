// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/shed.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <Eigen/Eigenvalues>

#include "libsheet/flow/drop.h"
#include "libsheet/flow/heat_account.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/disjoint_sets.h"
#include "libsheet/material/shifted_liquid.h"
#include "libsheet/scene/frame_liquids.h"
#include "libsheet/scene/prescribed.h"
#include "libsheet/sheet/contact_spring.h"

namespace sheet::flow {

using formats::Frame;

namespace {

constexpr std::size_t most_in_drop = 100; // triangles of a piece that becomes a drop
constexpr double most_radii = 3;          // of its ball, from its centre of mass

// Triangles that hang together across edges, of those that are chosen; each group ascending, by its first triangle.
std::vector<std::vector<std::uint32_t>> groups_of(const Connectivity& mesh, const std::vector<bool>& chosen) {
  DisjointSets sets(chosen.size());
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    if (const auto [s, t] = mesh.edge_triangles[e]; !mesh.on_rim(e) && chosen[s] && chosen[t])
      sets.join(s, t);
  std::map<std::uint64_t, std::size_t> number;
  std::vector<std::vector<std::uint32_t>> groups;
  for (std::uint32_t t = 0; t < chosen.size(); ++t)
    if (chosen[t]) {
      const auto [at, is_new] = number.try_emplace(sets.find(t), groups.size());
      if (is_new)
        groups.emplace_back();
      groups[at->second].push_back(t);
    }
  return groups;
}

// Triangles of a frame, as masses at their corners.
class Bodies {
public:
  explicit Bodies(const Frame& frame)
      : x_(positions(frame)), v_(velocities(frame)), corners_(triangles(frame)), volume_(volumes(frame)),
        temperature_(temperatures(frame)) {}

  [[nodiscard]] Drop one(std::span<const std::uint32_t> group, const FrameLiquids& liquids) const {
    Drop drop;
    drop.liquid = liquids.number(group.front());
    Vector3 moment = Vector3::Zero(), motion = Vector3::Zero();
    double warmth = 0;
    for (const std::uint32_t t : group) {
      drop.volume += volume_[t];
      for (const std::uint32_t c : corners_[t]) {
        moment += volume_[t] / 3 * x_[c];
        if (!v_.empty())
          motion += volume_[t] / 3 * v_[c];
      }
      if (!temperature_.empty())
        warmth += volume_[t] * temperature_[t];
    }
    drop.position = moment / drop.volume;
    drop.velocity = motion / drop.volume;
    drop.temperature = warmth / drop.volume;
    return drop;
  }

  [[nodiscard]] Vector3 middle(std::uint32_t t) const {
    const Corners& c = corners_[t];
    return (x_[c[0]] + x_[c[1]] + x_[c[2]]) / 3;
  }
  [[nodiscard]] const Corners& corners(std::uint32_t t) const { return corners_[t]; }
  [[nodiscard]] const Vector3& at(std::uint32_t v) const { return x_[v]; }

  // Root mean square by volume; 0 where nothing moves yet.
  [[nodiscard]] StrainRate mean_rate(std::span<const std::uint32_t> group) const {
    double sum = 0, volume = 0;
    for (const std::uint32_t t : group) {
      const auto [a, b, c] = corners_[t];
      if (!v_.empty())
        sum += volume_[t] * strain_rate({x_[a], x_[b], x_[c]}, {v_[a], v_[b], v_[c]}).squared;
      volume += volume_[t];
    }
    return {sum / volume};
  }

  // The direction in which a group whose centre of mass is known is longest.
  [[nodiscard]] Vector3 axis(std::span<const std::uint32_t> group, const Vector3& center) const {
    Matrix3 spread = Matrix3::Zero();
    for (const std::uint32_t t : group)
      for (const std::uint32_t c : corners_[t])
        spread += volume_[t] / 3 * (x_[c] - center) * (x_[c] - center).transpose();
    const double size = spread.trace();
    if (!(size > 0))
      return Vector3::UnitX();
    return Eigen::SelfAdjointEigenSolver<Matrix3>(spread / size).eigenvectors().col(2);
  }

private:
  std::span<const Vector3> x_, v_;
  std::span<const Corners> corners_;
  std::span<const double> volume_, temperature_;
};

// Along the axis, from the centre.
struct Extent {
  double low = 0, high = 0;
  [[nodiscard]] double length() const { return high - low; }
};

Extent extent_of(const Bodies& bodies, std::span<const std::uint32_t> group, const Vector3& center,
                 const Vector3& axis) {
  Extent extent;
  for (const std::uint32_t t : group)
    for (const std::uint32_t c : bodies.corners(t)) {
      const double along = axis.dot(bodies.at(c) - center);
      extent.low = std::min(extent.low, along);
      extent.high = std::max(extent.high, along);
    }
  return extent;
}

// How long the pieces are into which tension parts a thread of this section, drawn at such a rate [m]; infinite without
// tension [Weber 1931]. Waves that begin to grow feel the viscosity of small changes of that rate.
double wave_on_thread(double radius, const Liquid& liquid, StrainRate rate, double temperature) {
  const bool warm = temperature > 0;
  const FlowCurve curve(liquid);
  const double shift = warm ? ViscosityShift(liquid.temperature_law).factor(temperature) : 1;
  const double viscosity = ShiftedCurve{curve, shift}.tangent_viscosity(rate);
  const double tension = warm ? liquid.surface_tension_at(temperature) : liquid.surface_tension;
  const double square = 2 * liquid.density * tension * radius;
  return 2 * std::numbers::sqrt2 * std::numbers::pi * radius * std::sqrt(1 + 3 * viscosity / std::sqrt(square));
}

// The drops of a group, in their order along it.
void add_drops(const Bodies& bodies, std::span<const std::uint32_t> group, const FrameLiquids& liquids,
               std::vector<Drop>& drops) {
  const Drop whole = bodies.one(group, liquids);
  const Vector3 axis = bodies.axis(group, whole.position);
  const Extent extent = extent_of(bodies, group, whole.position, axis);
  const double radius = std::sqrt(whole.volume / (std::numbers::pi * extent.length()));
  const double waves =
      extent.length() / wave_on_thread(radius, liquids.of(group.front()), bodies.mean_rate(group), whole.temperature);
  const auto parts = waves >= 1.5 ? static_cast<std::size_t>(std::lround(waves)) : 1;
  std::vector<std::vector<std::uint32_t>> rows(std::min(parts, group.size()));
  for (const std::uint32_t t : group) {
    const double place = (axis.dot(bodies.middle(t) - whole.position) - extent.low) / extent.length();
    const auto row = static_cast<std::size_t>(std::max(0.0, place * static_cast<double>(rows.size())));
    rows[rows.size() == 1 ? 0 : std::min(row, rows.size() - 1)].push_back(t);
  }
  for (const auto& row : rows)
    if (!row.empty())
      drops.push_back(bodies.one(row, liquids));
}

// Vertices that something holds along any axis, that touch a solid or another layer, or belong to an inlet.
std::vector<bool> bound_vertices(const Frame& frame, const Scene& scene) {
  std::vector<bool> bound;
  for (const Axes axes : scene::prescribed_axes(frame, scene, frame.time))
    bound.push_back(axes != 0);
  const std::vector<std::int32_t> touched = touched_solids(frame);
  const auto inlet = masks(frame, "inlet");
  for (std::size_t v = 0; v < bound.size(); ++v)
    bound[v] = bound[v] || touched[v] != no_solid || (!inlet.empty() && inlet[v] != 0);
  for (const ContactSpring& spring : read_springs(frame))
    for (const std::uint32_t v : spring.vertices)
      bound[v] = true;
  return bound;
}

bool is_round(const Bodies& bodies, std::span<const std::uint32_t> group, const FrameLiquids& liquids) {
  const Drop ball = bodies.one(group, liquids);
  const double farthest = most_radii * ball.radius();
  return std::ranges::all_of(group, [&](std::uint32_t t) {
    return std::ranges::all_of(bodies.corners(t), [&](std::uint32_t c) {
      return (bodies.at(c) - ball.position).squaredNorm() <= farthest * farthest;
    });
  });
}

} // namespace

Shed what_becomes_of(const Frame& frame, const std::vector<bool>& leaves, const Scene& scene) {
  Shed result{sum_of(frame, leaves, scene), {}};
  if (result.sum.triangles == 0 || !scene.tear || !scene.tear->drops)
    return result;
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  const FrameLiquids liquids(scene, frame);
  const Bodies bodies(frame);
  for (const auto& group : groups_of(mesh, leaves))
    add_drops(bodies, group, liquids, result.drops);
  return result;
}

void put_shed(const Shed& shed, const Scene& scene, Frame& frame) {
  if (shed.sum.triangles == 0)
    return;
  if (!shed.drops.empty()) {
    std::vector<Drop> drops = read_drops(frame);
    drops.insert(drops.end(), shed.drops.begin(), shed.drops.end());
    write_drops(frame, drops);
    return;
  }
  add_to_account(frame, "tear.volume", "m^3", {&shed.sum.volume, 1});
  add_to_account(frame, "tear.momentum", "kg*m/s", {shed.sum.momentum.data(), 3});
  add_heat_to_account(frame, "tear.heat", scene, shed.sum.warmth);
}

Shed shed_off(Frame& frame, std::vector<bool> leaves, const Scene& scene) {
  Shed result;
  (void)drop(frame, std::move(leaves), scene,
             [&](const std::vector<bool>& in_the_end) { result = what_becomes_of(frame, in_the_end, scene); });
  put_shed(result, scene, frame);
  return result;
}

std::vector<std::vector<std::uint32_t>> round_pieces(const Frame& frame, const Scene& scene) {
  if (!scene.tear || !scene.tear->drops || frame.triangles == 0)
    return {};
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  const auto pieces = groups_of(mesh, std::vector<bool>(frame.triangles, true));
  if (pieces.size() < 2)
    return {};
  const std::vector<bool> bound = bound_vertices(frame, scene);
  const FrameLiquids liquids(scene, frame);
  const Bodies bodies(frame);
  const auto is_free = [&](std::uint32_t t) {
    return std::ranges::none_of(mesh.triangles[t], [&](std::uint32_t v) { return bound[v]; });
  };
  const auto has_rim = [&](std::uint32_t t) {
    return std::ranges::any_of(mesh.triangle_edges[t], [&](std::uint32_t e) { return mesh.on_rim(e); });
  };
  const auto& largest =
      *std::ranges::max_element(pieces, {}, [&](const auto& piece) { return bodies.one(piece, liquids).volume; });
  std::vector<std::vector<std::uint32_t>> round;
  for (const auto& piece : pieces)
    if (&piece != &largest && piece.size() < most_in_drop && std::ranges::all_of(piece, is_free) &&
        std::ranges::any_of(piece, has_rim) && is_round(bodies, piece, liquids))
      round.push_back(piece);
  return round;
}

Shed shed_round_pieces(Frame& frame, const Scene& scene) {
  std::vector<bool> leaves(frame.triangles, false);
  for (const auto& piece : round_pieces(frame, scene))
    for (const std::uint32_t t : piece)
      leaves[t] = true;
  return std::ranges::count(leaves, true) == 0 ? Shed{} : shed_off(frame, std::move(leaves), scene);
}

} // namespace sheet::flow
