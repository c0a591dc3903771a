// SPDX-License-Identifier: GPL-3.0-or-later
// sheet-emit: inflow of new liquid, outflow.
#include "libsheet/base/filter.h"
#include "libsheet/flow/emit.h"

int main(int argc, char** argv) {
  sheet::Tool tool(
      "sheet-emit", "let liquid flow in at the inlet, and out",
      "Lets liquid enter at the border that the scene's [inflow] names, with its velocity and thickness, as a "
      "curtain or a tube, straight or slanted, or out of a ring. It stands before sheet-step, which moves what is in "
      "the inlet; "
      "sheet-emit fills the gap that has opened behind it. A row of vertices comes in whenever the liquid has moved "
      "on by the length of the inlet's edges, whatever the time steps. The array `emit.volume` of the frame is the "
      "volume that has entered so far [m^3].\n"
      "A [[sheet]] with `enters` comes in at that time, whole; `emit.volume` counts it.\n"
      "What passes the plane of an [[outflow]] leaves, drops too; `outflow.volume` [m^3], `outflow.momentum` [kg m/s] "
      "and "
      "`outflow.energy` (kinetic) [J] are what has left so far.\n"
      "Without any of these in the scene, frames pass unchanged.");
  sheet::FilterOptions filter;
  sheet::declare_filter_options(tool, filter);
  tool.example("sheet-init curtain.toml | sheet-loop --until 2 --fps 24 -- 'sheet-emit | sheet-step' > run.sheet",
               "a curtain pours for two seconds");
  return tool.run(argc, argv, [&] {
    sheet::flow::EmitStage stage;
    sheet::run_filter(tool, filter, [&](sheet::formats::Frame& frame) { stage.emit(frame); });
  });
}
