// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/wetting.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "libsheet/material/driven_rate.h"
#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/brief.h"
#include "libsheet/scene/frame_liquids.h"
#include "libsheet/scene/free_faces.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/solids.h"

namespace sheet {

namespace {

using formats::Frame;
using scene::brief;

bool holds_together(const scene::Solid& solid) { return solid.contact == SolidContact::flow && !solid.contact_angle; }

// Of each vertex the solid without a contact angle that is nearer than `reach` [m], or no_solid.
std::vector<std::int32_t> near_to(const Scene& scene, const Frame& first, double reach) {
  const solid::Solids solids(scene);
  const auto x = positions(first);
  std::vector<std::int32_t> on(x.size(), no_solid);
  for (std::size_t v = 0; v < x.size(); ++v)
    for (std::size_t i = 0; i < solids.size() && on[v] == no_solid; ++i)
      if (holds_together(scene.solids[i]) && std::abs(solids.at(i, x[v], first.time).distance) < reach)
        on[v] = static_cast<std::int32_t>(i);
  return on;
}

// A solid on which the sheet has a free rim.
std::optional<std::size_t> under_a_rim(const Scene& scene, const Frame& first, const std::vector<std::int32_t>& on) {
  const Connectivity mesh = connect(first.vertices, triangles(first));
  const std::vector<double> rims = scene::free_faces(scene, first, mesh).rims;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    if (const auto [a, b] = mesh.edges[e]; rims[e] > 0 && on[a] != no_solid && on[a] == on[b])
      return static_cast<std::size_t>(on[a]);
  return std::nullopt;
}

// Whether tension moves a layer of that liquid before the end.
bool is_moved(const Liquid& liquid, double h, double until) {
  constexpr double least_moved = 0.1; // gamma t/(mu h)
  return until * driven_rate(liquid, 2 * liquid.surface_tension / h) > 2 * least_moved;
}

} // namespace

std::string wetting_warning(const Scene& scene, const Frame& first, double until) {
  constexpr double lies = 0.75, sags = 2;             // thicknesses: of what lies on a solid, of a rim that overhangs
  constexpr double steep = 0.98;                      // cosine of the slope from which on its weight makes it run
  constexpr double least_lying = 0.5, wets_well = 20; // of the sheet; [degrees]
  const double g = scene.environment.gravity.value_or(Vector3::Zero()).norm();
  if (!(g > 0) || std::ranges::none_of(scene.solids, holds_together) || first.vertices == 0)
    return {};
  const double h = *measured(first).thickness;
  const std::vector<std::int32_t> on = near_to(scene, first, lies * h);
  const auto lying = static_cast<double>(on.size()) - static_cast<double>(std::ranges::count(on, no_solid));
  const auto solid = under_a_rim(scene, first, near_to(scene, first, sags * h));
  if (!solid || lying < least_lying * static_cast<double>(on.size()))
    return {};
  const scene::FrameLiquids liquids(scene, first);
  const std::vector<std::uint32_t> numbers = liquids.numbers_at_vertices(first);
  const std::size_t there =
      static_cast<std::size_t>(std::ranges::find(on, static_cast<std::int32_t>(*solid)) - on.begin());
  const Liquid& liquid = liquids.all()[numbers.empty() ? 0 : numbers[there]];
  const double puddle = 2 * std::sqrt(liquid.surface_tension / (liquid.density * g));
  if (!(h < puddle) || !is_moved(liquid, h, until))
    return {};
  const double stands = 2 * std::asin(h / puddle) * 180 / std::numbers::pi;
  const solid::Solids solids(scene);
  const Vector3 normal = solids.at(*solid, positions(first)[there], first.time).normal;
  const bool level = normal.dot(*scene::up(scene.environment)) > steep;
  return fmt::format("without contact_angle nothing wets {}: tension keeps what {} there from spreading{} where it is "
                     "thinner than 2 sqrt(gamma / (rho g)) = {} m, and it is {} m. contact_angle = \"{:g} deg\" in its "
                     "[[solid]] lets it wet (of {:.0f} deg, one so thick would stand)",
                     solids.name(*solid), level ? "flows" : "runs down", level ? "" : " sideways", brief(puddle),
                     brief(h), std::min(wets_well, std::floor(stands / 2)), stands);
}

} // namespace sheet
