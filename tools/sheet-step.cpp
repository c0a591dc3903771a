// SPDX-License-Identifier: GPL-3.0-or-later
// sheet-step: one implicit time step a frame.
#include "libsheet/base/file_roles.h"
#include "libsheet/base/filter.h"
#include "libsheet/solve/step_stage.h"

int main(int argc, char** argv) {
  sheet::Tool tool(
      "sheet-step", "one implicit time step of a viscous sheet",
      "Advances each frame by one time step of the model in its scene: viscous stretching and bending, surface "
      "tension, inertia, gravity, pressure, bath, air, drag of solids, contact of layers, heat, holds, and the motion "
      "of "
      "an inlet. What the scene does not mention is not assembled; -v lists the terms and each one's share of the "
      "time. "
      "Drops fly on parabolas, or as air lets them.\n"
      "Steps end exactly at the output times that sheet-loop stamps, and where a prescribed motion has a kink. A "
      "step that does not converge is retried smaller; if nothing helps, the exit code is 5 and the frame is saved.");
  sheet::StepStageOptions o;
  sheet::FilterOptions filter;
  sheet::declare_filter_options(tool, filter);
  tool.option("--dt", o.dt, "SECONDS",
              "fixed time step, shortened where equal steps must land on an output time; without it, "
              "steps are chosen by --tolerance, which is the better choice unless steps must be equal: then take the "
              "shortest that -v shows with --tolerance, or a tenth of the time in which anything moves by an edge");
  tool.option(
      "--tolerance", o.tolerance, "E",
      fmt::format(
          "choose steps whose estimated error is below this part of the edges' length, in 99 % of the liquid, and "
          "nowhere above twice that (the default, with {})",
          sheet::default_tolerance));
  tool.choice("--scheme", o.scheme,
              {{"sdirk2", sheet::Scheme::sdirk2}, {"backward-euler", sheet::Scheme::backward_euler}},
              "second order, or the paper's first order");
  tool.choice(
      "--bending", o.bending,
      {{"mid-edge", sheet::Bending::mid_edge},
       {"hinge", sheet::Bending::hinge},
       {"hinge-paper", sheet::Bending::hinge_paper}},
      "how bending is discretised, if the scene has bending: directors (converges on any mesh), hinges with the mean "
      "constant, hinges as the paper prints them");
  o.failed = sheet::beside_run(o.failed);
  tool.option(
      "--failed", o.failed, "FILE",
      "where a frame goes whose step fails, by default beside the stream that sheet-loop writes; '' for nowhere",
      sheet::Tool::Provenance::omit);
  tool.may_be_empty();
  tool.example("sheet-init a.toml | sheet-loop --until 2 --fps 24 -- 'sheet-step --tolerance 1e-3' > run.sheet",
               "two seconds, steps as the error asks for");
  tool.example("sheet-step --dt 0.01 < a.sheet > b.sheet", "one step");
  return tool.run(argc, argv, [&] {
    if (!o.failed.empty())
      sheet::claim_file(o.failed, sheet::FileRole::output);
    sheet::StepStage stage(o);
    sheet::run_filter(tool, filter, [&](sheet::formats::Frame& frame) { stage.step(frame); });
    stage.report();
  });
}
