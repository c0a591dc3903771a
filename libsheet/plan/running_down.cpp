// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/running_down.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/landing.h"
#include "libsheet/scene/frame_liquids.h"
#include "libsheet/scene/layer_scales.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/solids.h"

namespace sheet {

namespace {

constexpr std::size_t looked_at = 100; // vertices, about
constexpr double near_enough = 0.75;   // of the thickness: from the solid, of what lies on it
constexpr double above_a_plane = 2.5;  // likewise, of what comes down on all of it at once
constexpr double least_part = 0.5;     // of the sheet that lies
constexpr double least_slope = 0.1;    // part of gravity along the solid

} // namespace

std::optional<RunningDown> runs_down(const Scene& scene, const formats::Frame& first, double t) {
  const Vector3 gravity = scene.environment.gravity.value_or(Vector3::Zero());
  const scene::Measured sheet = measured(first);
  if (!scene::flows_on_solids(scene) || gravity.isZero(0) || !sheet.length || !sheet.thickness || !(*sheet.length > 0))
    return std::nullopt;
  const solid::Solids solids(scene);
  const auto x = positions(first);
  const std::size_t stride = std::max<std::size_t>(1, x.size() / looked_at);
  const scene::FrameLiquids liquids(scene, first);
  const std::vector<std::uint32_t> numbers = liquids.numbers_at_vertices(first);
  std::vector<bool> lying(liquids.all().size(), false);
  double lies = 0, along = 0, slip = 0, all = 0;
  for (std::size_t v = 0; v < x.size(); v += stride, ++all)
    for (std::size_t i = 0; i < solids.size(); ++i) {
      const solid::SolidPoint point = solids.at(i, x[v], first.time);
      const double reach =
          std::holds_alternative<scene::HalfSpace>(scene.solids[i].shape) ? above_a_plane : near_enough;
      if (scene.solids[i].contact != SolidContact::flow || std::abs(point.distance) > reach * *sheet.thickness)
        continue;
      const Vector3 normal =
          solids.pose(i, t).linear() * (solids.pose(i, first.time).linear().transpose() * point.normal);
      along += (gravity - gravity.dot(normal) * normal).norm();
      slip += scene.solids[i].slip_length;
      ++lies;
      lying[numbers.empty() ? 0 : numbers[v]] = true;
      break;
    }
  if (lies < least_part * all || along < least_slope * gravity.norm() * lies)
    return std::nullopt;
  const double h = *sheet.thickness;
  double speed = 0;
  for (std::size_t i = 0; i < lying.size(); ++i)
    if (const Liquid& liquid = liquids.all()[i]; lying[i])
      speed = std::max(speed, scene::speed_of_layer(liquid, liquid.density * h * along / lies, h, slip / lies));
  if (!(speed > 0) || !std::isfinite(speed))
    return std::nullopt;
  return RunningDown{speed, *sheet.length / speed};
}

std::string late_running_warning(const Scene& scene, const formats::Frame& first, double until) {
  constexpr double late = 2; // times the run
  const scene::Measured sheet = measured(first);
  const std::vector<Landing> all = landings(scene, first);
  if (all.empty() || scene.heat || !scene.holds.empty() || !scene.inflows.empty() || !sheet.length || !sheet.thickness)
    return "";
  const Vector3 gravity = *scene.environment.gravity;
  std::size_t lands = 0, solid = 0;
  double along = 0, slip = 0;
  for (const Landing& landing : all) {
    const scene::Solid& below = scene.solids[landing.solid];
    if (below.contact != SolidContact::flow)
      continue;
    const Vector3& normal = landing.there.normal;
    along += (gravity - gravity.dot(normal) * normal).norm();
    slip += below.slip_length;
    solid = lands++ == 0 ? landing.solid : std::min(solid, landing.solid);
  }
  const double n = static_cast<double>(lands), h = *sheet.thickness;
  if (n < least_part * static_cast<double>(all.size()) || along < least_slope * gravity.norm() * n)
    return "";
  const Liquid& liquid = all.front().liquid;
  const double speed = scene::speed_of_layer(liquid, liquid.density * h * along / n, h, slip / n);
  const double time = std::sqrt(2 * longest_fall(all) / gravity.norm()) + *sheet.length / 2 / speed;
  if (!std::isfinite(time) || time < late * until)
    return "";
  const double about = std::stod(fmt::format("{:.2g}", time));
  return fmt::format("the run ends, at {} s, before what lands on {} has run down, which takes some {:.10g} s: --until "
                     "{:.10g} shows that",
                     until, solid::Solids(scene).name(solid), about, about);
}

} // namespace sheet
