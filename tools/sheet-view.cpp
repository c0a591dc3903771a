// SPDX-License-Identifier: GPL-3.0-or-later
// sheet-view: a page for a browser that shows streams.
#include "libsheet/base/tool.h"
#include "libsheet/base/whole_file.h"
#include "libsheet/quantities/wanted.h"
#include "libsheet/render/material_option.h"
#include "libsheet/view/page.h"

int main(int argc, char** argv) {
  sheet::Tool tool(
      "sheet-view", "make a page for a browser that shows streams",
      "Writes one HTML file that any browser with WebGL 2 opens by a double click, without a network: the sheet as a "
      "slab of its true thickness with the scene's solids, to turn, play, colour by thickness, speed, temperature and "
      "more, cut by a plane, measure; a click on a triangle tells its thickness and how that changes with time. "
      "Several streams are shown side by side with one clock. Press ? in the page for its keys.\n"
      "Positions are rounded by less than a thousandth of an edge, thickness by 0.005 %.");
  sheet::view::ViewOptions o;
  tool.arguments("INPUT", o.inputs, "streams to read; - for standard input, as is none");
  tool.option("-o,--output", o.output, "FILE",
              "file to write; - for standard output. Its folder is made if it is missing");
  tool.option("--title", o.title, "TEXT", "title of the page; without it, the names of the streams");
  tool.may_be_empty();
  sheet::declare_wanted(tool, o.wanted);
  sheet::render::declare_materials(
      tool, o.materials,
      "what the sheet is made of, which gives it its colour; of several liquids the first, the second, ..., and again "
      "from the first, as the scene names them. Without it, brown, and several liquids in colours that tell them "
      "apart");
  tool.example("sheet-view run.sheet -o run.html", "then open run.html by a double click");
  tool.example("sheet-view a.sheet b.sheet -o compare.html", "two runs side by side, with one clock");
  tool.example("sheet-select --every 4 run.sheet | sheet-view > run.html", "every fourth frame: a smaller file");
  tool.example("sheet-view run.sheet --material chocolate,honey -o run.html", "a run of two liquids");
  return tool.run(argc, argv, [&] {
    if (o.inputs.empty())
      o.inputs.emplace_back("-");
    if (o.output != "-")
      sheet::make_folder_of(o.output);
    write_page(o);
  });
}
