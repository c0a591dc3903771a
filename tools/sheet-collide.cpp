// SPDX-License-Identifier: GPL-3.0-or-later
// sheet-collide: nothing passes through anything, a frame a step.
#include "libsheet/base/filter.h"
#include "libsheet/collide/collide_stage.h"

int main(int argc, char** argv) {
  sheet::Tool tool(
      "sheet-collide", "keep a sheet from passing through solids and itself",
      "Stands behind sheet-step. Moves the end of each step to where the sheet has not passed through itself on its "
      "way, and sets up the springs that hold touching layers in the next step. Acts where the scene has "
      "solids, [contact] self = true or drops; else frames pass unchanged. What touches a solid is held by it, or "
      "along "
      "its normal alone where the solid's contact is \"flow\" or \"slip\", until the tension is above the scene's "
      "[contact] "
      "adhesion. Drops stay on solids and baths that they meet, and are taken up by the sheet, with their momentum.\n"
      "If no triangles intersect at the start of a step, none do at its end. Where a hold asks for something else, the "
      "held vertices stay behind, with a warning. -v tells how often each means was needed, and the time of each "
      "part.");
  sheet::FilterOptions filter;
  sheet::declare_filter_options(tool, filter);
  tool.example("sheet-init a.toml | sheet-loop --until 2 --fps 24 -- 'sheet-step | sheet-collide' > run.sheet",
               "two seconds of a sheet that meets itself");
  return tool.run(argc, argv, [&] {
    sheet::collide::CollideStage stage;
    sheet::run_filter(tool, filter, [&](sheet::formats::Frame& frame) { stage.step(frame); });
    stage.report();
  });
}
