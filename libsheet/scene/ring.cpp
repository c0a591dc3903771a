// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/ring.h"

#include <fmt/format.h>

namespace sheet::scene {

std::vector<RingStage> ring_of(const Scene& scene) {
  std::vector<RingStage> stages;
  if (scene.merge)
    stages.push_back({"sheet-merge", "[merge] makes nothing one"});
  stages.push_back({"sheet-remesh --smooth", ""});
  if (scene.tear)
    stages.push_back({"sheet-tear", "[tear] parts nothing"});
  if (flows_in_or_out(scene))
    stages.push_back({"sheet-emit", !scene.inflows.empty()    ? "[inflow] lets nothing in"
                                    : !scene.outflows.empty() ? "[[outflow]] lets nothing out"
                                                              : "no [[sheet]] enters"});
  stages.push_back({"sheet-step", "nothing moves"});
  const bool self = scene.contact && scene.contact->self, drops = scene.tear && scene.tear->drops;
  if (!scene.solids.empty() || self)
    stages.push_back(
        {"sheet-collide",
         fmt::format("the sheet passes through {}{}{}", scene.solids.empty() ? "" : "every [[solid]]",
                     !scene.solids.empty() && self ? " and " : "", self ? "itself, whatever [contact] says" : "")});
  else if (drops)
    stages.push_back({"sheet-collide", "drops pass through the sheet"});
  return stages;
}

std::string pipeline_of(const Scene& scene) {
  std::string pipeline;
  for (const RingStage& stage : ring_of(scene))
    pipeline += (pipeline.empty() ? "" : " | ") + stage.program;
  return pipeline;
}

std::string missing_stages(const Scene& scene, std::string_view pipeline) {
  std::string text;
  if (pipeline.find("sheet-step") == std::string_view::npos)
    return text;
  for (const RingStage& stage : ring_of(scene))
    if (!stage.without.empty() && pipeline.find(stage.program) == std::string_view::npos)
      text += fmt::format("without {} {}\n", stage.program, stage.without);
  return text.empty() ? text : text + fmt::format("the ring of this scene: '{}'", pipeline_of(scene));
}

} // namespace sheet::scene
