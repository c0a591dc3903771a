// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/measure/forces.h"

#include <limits>

#include "libsheet/base/error.h"
#include "libsheet/scene/read.h"
#include "libsheet/scene/rolls.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

std::vector<NamedForce> SceneForces::of(const formats::Frame& frame) {
  const formats::Array* text = frame.find("scene");
  if (text == nullptr)
    return {};
  if (text->text() != scene_) {
    scene_ = text->text();
    wanted_ = false;
    try {
      const Scene scene = parse_scene(scene_, "the frame's scene");
      wanted_ = scene::wants_forces(scene);
      holds_ = scene.holds.size();
      solids_ = scene.solids.size();
    } catch (const Error&) { // of which SceneDensity warns
    }
  }
  std::vector<NamedForce> forces;
  if (!wanted_)
    return forces;
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const formats::Array *held = frame.find("hold_force"), *of_solids = frame.find("solid_force");
  const auto bits = holds(frame);
  for (std::size_t i = 0; i < holds_; ++i) {
    NamedForce& sum =
        forces.emplace_back(NamedForce{"hold " + std::to_string(i), Eigen::Vector3d::Constant(held ? 0 : unknown)});
    for (std::size_t v = 0; held != nullptr && v < bits.size(); ++v)
      if ((bits[v] >> i & 1) != 0)
        sum.force += held->values<Vector3>()[v];
  }
  for (std::size_t i = 0; i < solids_; ++i) {
    const bool known = of_solids != nullptr && i < of_solids->values<Vector3>().size();
    forces.emplace_back(NamedForce{"solid " + std::to_string(i),
                                   known ? of_solids->values<Vector3>()[i] : Vector3(Vector3::Constant(unknown))});
  }
  return forces;
}

} // namespace sheet
