// SPDX-License-Identifier: GPL-3.0-or-later
// sheet-merge: makes layers of the sheet one that lie on each other.
#include "libsheet/base/filter.h"
#include "libsheet/flow/merge.h"

int main(int argc, char** argv) {
  sheet::Tool tool(
      "sheet-merge", "make layers of the sheet one that lie on each other",
      "What lies wholly on another layer of the sheet, and has touched it for longer than the scene's [merge] after, "
      "gives it its volume and momentum and is taken away. The border of what went is a rim of what stays, welded to "
      "the layer below by contact springs that never part. Volume and momentum stay, the centre of mass stays across "
      "the layers where there is room for it. The frame's arrays `merge.volume` [m^3] and `merge.energy` [J, kinetic, "
      "lost] keep account. Tight folds, where layers cross the border of what would go, stay as they are.\n"
      "Stands first in the ring, and needs sheet-collide at its end, which says what touches since when.\n"
      "Without [merge] in the scene, frames pass unchanged.");
  sheet::FilterOptions filter;
  sheet::declare_filter_options(tool, filter);
  tool.example("sheet-loop -i a.sheet --until 2 --fps 24 -- 'sheet-merge | sheet-step | sheet-collide' > run.sheet",
               "layers that become one as they come to rest on each other");
  return tool.run(argc, argv, [&] {
    sheet::flow::MergeStage stage;
    sheet::run_filter(tool, filter, [&](sheet::formats::Frame& frame) { stage.merge(frame); });
    stage.report();
  });
}
