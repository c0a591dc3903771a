// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/change.h"

#include <algorithm>

#include "libsheet/base/error.h"
#include "libsheet/scene/read.h"
#include "libsheet/scene/write.h"

namespace sheet::scene {
namespace {

template <class... Args> [[noreturn]] void refuse(fmt::format_string<Args...> reason, Args&&... args) {
  fail(ExitCode::usage, "--set within a run: {}", fmt::format(reason, std::forward<Args>(args)...));
}

Eigen::Isometry3d pose(const Solid& solid, double t) {
  return motion_between(solid.motion, 0, t) * Eigen::Translation3d(solid.center) *
         Eigen::Isometry3d(matrix(solid.rotation));
}

void check_solid(const Solid& before, const Solid& after, std::size_t i, double t) {
  constexpr double same_place = 1e-9; // [m], and of turns
  if (before.shape != after.shape)
    refuse("solid {}: its shape stays, for the sheet may touch it", i);
  const Eigen::Matrix4d old_pose = pose(before, t).matrix(), new_pose = pose(after, t).matrix();
  if ((old_pose - new_pose).cwiseAbs().maxCoeff() > same_place * std::max(1.0, old_pose.cwiseAbs().maxCoeff()))
    refuse("solid {} would jump from [{:.6g}, {:.6g}, {:.6g}] to [{:.6g}, {:.6g}, {:.6g}], or turn, at t = {} s: its "
           "motion counts from time 0, so keep what has passed in rows, such as velocity = [[0, 1, 0, 0], [{}, 1, 0, "
           "0], [{}, 0, 0, 0]]",
           i, old_pose(0, 3), old_pose(1, 3), old_pose(2, 3), new_pose(0, 3), new_pose(1, 3), new_pose(2, 3), t, t,
           t + 0.1);
}

const GasPressure* gas_of(const Scene& scene) {
  return scene.environment.pressure ? std::get_if<GasPressure>(&*scene.environment.pressure) : nullptr;
}

// What the frame's arrays refer to must be there still.
void check_settled(const Scene& before, const Scene& after, double t) {
  if (before.sheets != after.sheets)
    refuse("[sheet] is how the run began, and stays; for another sheet begin anew with sheet-init");
  if (before.holds.size() != after.holds.size())
    refuse("the holds are those that the run began with; end one by its key until, or begin anew with sheet-init");
  for (std::size_t i = 0; i < before.holds.size(); ++i)
    if (before.holds[i].sheet != after.holds[i].sheet ||
        (before.holds[i].region != after.holds[i].region && !(before.holds[i].roll && after.holds[i].roll)))
      refuse("hold {}: its region chose what it holds when the run began, and stays, but for rolls", i);
  if (before.solids.size() != after.solids.size())
    refuse("the solids are those that the run began with");
  for (std::size_t i = 0; i < before.solids.size(); ++i)
    check_solid(before.solids[i], after.solids[i], i, t);
  const auto same_inlet = [](const Inflow& a, const Inflow& b) { return a.sheet == b.sheet && a.region == b.region; };
  if (!std::ranges::equal(before.inflows, after.inflows, same_inlet))
    refuse("the inlet is the one that the run began with; inflow.until ends it");
  const GasPressure *gas = gas_of(before), *new_gas = gas_of(after);
  if (gas && new_gas && gas->leak > 0 && gas->amount != new_gas->amount)
    refuse("the amount of gas that leaks is in the frames (gas.amount), and no longer in the scene");
  const bool as_started = gas && new_gas && !gas->amount && gas->value == new_gas->value; // the frames have amounts
  if (new_gas && !new_gas->amount && !as_started)
    refuse("the gas has a pressure at the start only; within a run its amount is given");
}

} // namespace

std::string changed_scene(std::string_view text, std::span<const std::string> sets, double t) {
  const Scene before = parse_scene(text, "the frame's scene"), after = parse_scene(text, "the frame's scene", sets);
  check_settled(before, after, t);
  return to_toml(after);
}

} // namespace sheet::scene
