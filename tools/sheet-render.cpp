// SPDX-License-Identifier: GPL-3.0-or-later
// sheet-render: path-traced pictures of a stream.
#include <fmt/format.h>

#include "libsheet/base/files.h"
#include "libsheet/loop/film.h"
#include "libsheet/loop/select.h"
#include "libsheet/quantities/wanted.h"
#include "libsheet/render/render_stage.h"
#include "libsheet/render/slab.h"

int main(int argc, char** argv) {
  sheet::Tool tool(
      "sheet-render", "draw the frames of a stream",
      "Draws each frame by path tracing: the sheet as a slab of its liquid, of its true thickness, glossy, coloured by "
      "what it absorbs, turbid by what it scatters; the scene's solids; a studio's light or that of an image. Or a "
      "quantity of the sheet in false colours with a scale, or its mesh.\n"
      "The camera, unless it is told where to stand, is placed so that everything is in the picture, and stands still: "
      "a stream in a file is read twice, first to see what is in all the frames to draw; of a stream in a pipe only "
      "the first is known, and gets a margin of a quarter of its size to all sides. So do scales and the ground.");
  sheet::render::RenderOptions o;
  sheet::FilmOptions film;
  bool list_liquids = false;
  std::optional<double> wanted;
  tool.argument("INPUT", film.input, "stream to read; - for standard input");
  sheet::render::declare_render_options(tool, o);
  tool.option("--frames", film.frames, "LIST",
              std::string("draw only these frames, ") + sheet::indices_help + "; from the end only of a file");
  tool.option("--view-of", film.view, "LIST",
              "place camera, scale and ground as for these frames of a file; without it, as for those to draw. With 0- "
              "parts of a film that are drawn by themselves fit together");
  sheet::declare_wanted(tool, wanted);
  tool.flag("--list-liquids", list_liquids,
            "instead, the presets of --material, one a line: name, index of refraction, absorption and reduced "
            "scattering of red, green and blue [1/m]; separated by tabs",
            sheet::Tool::Provenance::omit);
  tool.example("sheet-render run.sheet -o frames/%04d.png --material honey", "a picture of each frame");
  tool.example("sheet-render run.sheet --denoise --samples 4 --y4m | ffmpeg -i - bunny.mp4", "a film");
  tool.example("sheet-render run.sheet --frames -1 -o end.png --look thickness", "where the sheet is thin at the end");
  tool.example("sheet-render run.sheet --frames -1 -o end.png --look deviation --wanted 2mm",
               "where it is thicker and thinner than that");
  tool.example("sheet-render run.sheet --frames -1 --turntable 120 --denoise --y4m | ffmpeg -i - turn.mp4",
               "round the last frame in 5 s");
  tool.example("sheet-render run.sheet --frames -1 -o end.exr --noise 1 --samples 4096",
               "light, depth, normals, thickness for other programs");
  return tool.run(argc, argv, [&] {
    if (list_liquids) {
      sheet::OutputFile file("-", sheet::OutputFile::Content::text);
      file.write(sheet::render::list_of_liquids());
      file.close();
      return;
    }
    sheet::render::RenderStage stage(o);
    sheet::formats::Frame changed;
    const auto with_deviation = [&](const sheet::formats::Frame& frame) -> const sheet::formats::Frame& {
      if (!wanted)
        return frame;
      changed = frame;
      sheet::want_thickness(changed, *wanted);
      return changed;
    };
    const auto survey = [&](const sheet::formats::Frame& frame) { stage.survey(with_deviation(frame)); };
    const auto draw = [&](const sheet::formats::Frame& frame, std::uint64_t index,
                          const std::function<void(double)>& progress) {
      const auto report = stage.draw(with_deviation(frame), index, progress);
      return fmt::format("{:.4g} samples a pixel, {:.3g} Mrays, noise {:.2g} of 255 levels (worst tile {:.2g}){}{}",
                         report.samples, 1e-6 * static_cast<double>(report.rays), report.noise, report.worst_noise,
                         report.file.empty() ? "" : ", ", report.file);
    };
    try {
      film.least = static_cast<std::uint64_t>(o.turntable);
      sheet::run_film(film, survey, draw);
    } catch (const sheet::formats::StreamError&) { // of a run that has failed: what is whole is drawn
      stage.finish();
      throw;
    }
    stage.finish();
  });
}
