// SPDX-License-Identifier: GPL-3.0-or-later
// sheet-info: what is in a stream, and what it measures.
#include "formats/cpp/printable.h"
#include "formats/cpp/stream_reader.h"
#include "libsheet/base/file_roles.h"
#include "libsheet/base/files.h"
#include "libsheet/base/tool.h"
#include "libsheet/measure/figures.h"
#include "libsheet/measure/place_report.h"
#include "libsheet/measure/report.h"
#include "libsheet/quantities/wanted.h"

int main(int argc, char** argv) {
  sheet::Tool tool(
      "sheet-info", "tell what is in a stream and measure it",
      "Prints for each frame its arrays, the programs that made it, and measurements: area, volume, thickness, "
      "energy and momentum, bounding box, quality of the mesh, topology. Quantities are SI.\n"
      "Energy and momentum need the density, which the frame's scene states; without it they are unknown: nan "
      "in CSV, null in JSON. Thickness is volume divided by area of each triangle; its mean is that of the "
      "whole sheet, its percentiles are by area. Where the scene has rolls, or asks for forces "
      "([model] forces = true), those of holds and solids on the sheet at the end of the step are printed [N].");
  std::vector<std::string> inputs;
  bool json = false, csv = false, health = false, quantities = false;
  std::vector<std::string> planes, points;
  std::optional<double> density, wanted;
  std::string output = "-";
  tool.arguments("INPUT", inputs, "streams to read; - for standard input, as is none");
  tool.flag("--csv", csv, "a time series: one row a frame");
  tool.flag("--json", json, "one JSON document: an array with an object for each frame, a line each");
  tool.flag("--health", health,
            "instead, what went wrong on the way to each stream's last frame, how often, and what to do about it");
  tool.flag(
      "--list-quantities", quantities,
      "instead, what is measured and shown, one a line: name (of a look of sheet-render, a column of --csv), where it "
      "is (triangle, vertex or frame), SI unit, caption, fitting units with their sizes, colours; separated by tabs");
  tool.option(
      "--cut", planes, "PLANE",
      "instead, as CSV, thickness and more along the curves in which a plane (x=0, 0.3x+y=1mm) cuts the sheet: two "
      "rows for each triangle that it cuts, s along the curve; may be given again");
  tool.option("--at", points, "X,Y,Z",
              "instead, as CSV, thickness and more over time, at the sheet's place that is nearest to a point; may be "
              "given again");
  sheet::declare_wanted(tool, wanted);
  tool.option("--density", density, "KG/M3", "density to reckon with, whatever the scene states");
  tool.option("-o,--output", output, "FILE", "file to write; - for standard output");
  tool.example("sheet-info run.sheet | less", "all about every frame");
  tool.example("sheet-info --csv run.sheet > run.csv", "volume, area, thickness, energy over time");
  tool.example("sheet-select --last run.sheet | sheet-info --cut z=0 > wall.csv", "thickness along a cut");
  tool.example("sheet-info --at 0,0,0 run.sheet > middle.csv",
               "thickness over time, where the sheet is nearest to there");
  tool.example("sheet-info --csv --wanted 2mm run.sheet > run.csv", "and how far it is from that thickness");
  tool.example("sheet-info --health run.sheet", "did anything go wrong on the way?");
  tool.example("sheet-select --last run.sheet | sheet-info --json", "the last frame, for a program");
  return tool.run(argc, argv, [&] {
    if (json + csv + health > 1)
      sheet::fail(sheet::ExitCode::usage, "--json, --csv and --health exclude each other");
    if (json + health + !planes.empty() + !points.empty() > 1)
      sheet::fail(sheet::ExitCode::usage,
                  "--cut and --at exclude each other, --json and --health: each has a table of its own");
    if (density && !(*density > 0))
      sheet::fail(sheet::ExitCode::usage, "--density: {} is not positive", *density);
    if (quantities) {
      sheet::OutputFile file(output, sheet::OutputFile::Content::text);
      file.write(sheet::list_of_quantities());
      file.close();
      return;
    }
    if (inputs.empty())
      inputs.emplace_back("-");
    for (const std::string& input : inputs)
      sheet::claim_file(input, sheet::FileRole::input); // before the output is emptied
    const auto report = !planes.empty()   ? sheet::make_cut_report(planes)
                        : !points.empty() ? sheet::make_point_report(points)
                        : json            ? sheet::make_json_report()
                        : csv             ? sheet::make_csv_report()
                        : health          ? sheet::make_health_report()
                                          : sheet::make_text_report();
    sheet::OutputFile out(output, sheet::OutputFile::Content::text);
    std::string head = report->begin();
    sheet::SceneDensity scene;
    sheet::SceneForces forces;
    sheet::formats::Frame frame;
    const auto finish = [&] { out.write(sheet::formats::printable(head + report->end())); };
    for (const std::string& input : inputs) {
      const sheet::InputFile in(input);
      sheet::formats::StreamReader reader(in.descriptor(), in.name());
      const auto next = [&] {
        try {
          return reader.read(frame);
        } catch (const sheet::formats::StreamError&) { // what the frames before it say is said
          if (reader.frames() > 0)
            finish();
          throw;
        }
      };
      while (next()) {
        if (wanted)
          sheet::want_thickness(frame, *wanted);
        sheet::Measurements measured =
            sheet::measure(frame, density ? std::optional<sheet::Densities>(*density) : scene.of(frame));
        scene.measure_heat(frame, measured);
        measured.forces = forces.of(frame);
        out.write(sheet::formats::printable(
            std::exchange(head, {}) +
            report->add({in.name(), inputs.size() > 1, reader.frames() - 1, &frame, std::move(measured)})));
      }
    }
    finish();
    out.close();
  });
}
