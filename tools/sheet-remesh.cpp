// SPDX-License-Identifier: GPL-3.0-or-later
// sheet-remesh: keeps the triangles of a sheet good.
#include "libsheet/base/filter.h"
#include "libsheet/remesh/remesh_stage.h"

int main(int argc, char** argv) {
  sheet::Tool tool("sheet-remesh", "good triangles for a sheet that stretches and folds",
                   "Splits long edges, collapses short ones, turns diagonals and repairs flat triangles, in the "
                   "sheet and at its rims. The liquid's volume is kept to round-off, momentum and enclosed volume "
                   "too; thickness gets no new extremes, kinetic energy does not grow, triangles do not come to "
                   "intersect. Velocities, holds, contacts and all other arrays go along by their rules. A frame "
                   "whose mesh needs nothing passes unchanged.\n"
                   "Edges longer than 1.4 times the wanted length are split, those shorter than 0.6 times collapsed. "
                   "The wanted length is the same everywhere, or, with --adaptive, follows curvature, thickness, "
                   "flow and buckling. Strips that are narrower than that get edges of twice their width, down to a "
                   "sixteenth of --edge-length, or --min-edge. What is thicker than the wanted length is not split "
                   "more finely than it is thick. Threads, narrower and thinner than half of that shortest edge, or "
                   "than the scene's [tear] snap, are cut: what they were, next to nothing, is in the frame's arrays "
                   "`tear.volume` and `tear.momentum`, or flies on as drops, if the scene's [tear] has them.");
  sheet::remesh::StageOptions o;
  sheet::FilterOptions filter;
  sheet::declare_filter_options(tool, filter);
  tool.option(
      "--edge-length", o.edge_length, "METRES",
      "wanted length of edges; if not given the scene's, or else their mean in the first frame (of several sheets the "
      "shortest; those with longer ones get edges, and bounds of them, so many times as long); with --adaptive the "
      "middle of their range");
  tool.option("--adaptive", o.remeshing.size.chord_error, "METRES",
              "shorter edges where the sheet needs them, such that its edges lie nearer to the curved sheet than this");
  tool.option("--min-edge", o.remeshing.size.min_edge, "METRES",
              "with --adaptive: shortest wanted length (a quarter of --edge-length)");
  tool.option("--max-edge", o.remeshing.size.max_edge, "METRES",
              "with --adaptive: longest wanted length (four times --edge-length)");
  tool.flag("--smooth", o.remeshing.smooth, "also move vertices along the sheet where angles are below 35 degrees");
  tool.example("sheet-remesh --edge-length 0.01 < a.sheet > b.sheet", "one frame");
  tool.example("sheet-loop --until 2 --fps 24 -- 'sheet-remesh --smooth | sheet-step' < a.sheet > run.sheet",
               "before every step");
  return tool.run(argc, argv, [&] {
    sheet::remesh::RemeshStage stage(o);
    sheet::run_filter(tool, filter, [&](sheet::formats::Frame& frame) { stage.remesh(frame); });
    stage.report();
  });
}
