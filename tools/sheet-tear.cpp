// SPDX-License-Identifier: GPL-3.0-or-later
// sheet-tear: opens and separates a sheet where it has become too thin.
#include "libsheet/base/filter.h"
#include "libsheet/flow/tear.h"

int main(int argc, char** argv) {
  sheet::Tool tool(
      "sheet-tear", "separate a sheet where it has become too thin",
      "Opens holes where inclusions pierce the sheet, if the scene's [tear] has sites: by chance, the more the thinner "
      "it has become (the frame's array `tear.exposure` remembers how thin), and the same chance for any number of "
      "threads. The liquid of a hole goes to its border, with its momentum; strips too narrow for a hole part.\n"
      "Parts the sheet along edges both of whose triangles are thinner than the scene's [tear] below, the thinnest "
      "first: holes open inside, cracks run on and meet. Pieces of fewer than 8 triangles do not come off; or they do "
      "and are taken away, if the scene says crumbs = \"drop\": then the frame's arrays `tear.volume` [m^3] and "
      "`tear.momentum` [kg m/s] keep account of them. Nothing else changes volume or momentum, and energy only falls, "
      "where a hole's liquid meets its border. Vertices at which pieces of the sheet meet in a point come apart.\n"
      "If the scene says drops = true, such crumbs, and pieces by themselves that are about as long as wide and have "
      "fewer than 100 triangles, become drops instead: balls in the frame's arrays `drop_position`, `drop_velocity` "
      "[m/s], `drop_volume` [m^3]. sheet-step lets them fly, sheet-collide lets them land.\n"
      "Strands narrower than the scene's [tear] snap part in sheet-remesh. Without [tear] in the scene, frames pass "
      "unchanged.");
  sheet::FilterOptions filter;
  sheet::declare_filter_options(tool, filter);
  tool.example("sheet-init a.toml | sheet-loop --until 2 --fps 24 -- 'sheet-tear | sheet-step' > run.sheet",
               "a sheet that tears as it is stretched");
  return tool.run(argc, argv, [&] {
    sheet::flow::TearStage stage;
    sheet::run_filter(tool, filter, [&](sheet::formats::Frame& frame) { stage.tear(frame); });
    stage.report();
  });
}
