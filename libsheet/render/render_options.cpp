// SPDX-License-Identifier: GPL-3.0-or-later
// The command line of sheet-render.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "libsheet/base/units.h"
#include "libsheet/render/codecs.h"
#include "libsheet/render/material_option.h"
#include "libsheet/render/render_stage.h"

namespace sheet::render {
namespace {

constexpr int most_samples = 1 << 20;

// The numbers between separators, which must be N and finite.
template <std::size_t N>
std::array<double, N> numbers(const std::string& text, char separator, const char* expected,
                              const Quantity& kind = quantity::number) {
  std::array<double, N> values{};
  std::size_t start = 0;
  for (std::size_t i = 0; i < N; ++i) {
    const std::size_t end = i + 1 < N ? text.find(separator, start) : text.size();
    if (end == std::string::npos)
      fail(ExitCode::usage, "\"{}\" is not {}", text, expected);
    values[i] = parse_quantity(text.substr(start, end - start), kind);
    if (!std::isfinite(values[i]))
      fail(ExitCode::usage, "\"{}\" is not {}", text, expected);
    start = end + 1;
  }
  return values;
}

void vector_option(Tool& tool, const char* name, std::optional<Vector3>& value, const char* text) {
  tool.custom(
      name, "X,Y,Z", text,
      [&value](const std::string& s) {
        const auto v = numbers<3>(s, ',', "a point such as 0.1,0.2,1", quantity::length);
        value = Vector3(v[0], v[1], v[2]);
      },
      [&value] { return value ? fmt::format("{},{},{}", value->x(), value->y(), value->z()) : std::string(); });
}

// Red, green and blue, none negative.
Colour colour_of(const std::string& text) {
  const auto v = numbers<3>(text, ',', "three numbers such as 10,40,200");
  if (!(v[0] >= 0 && v[1] >= 0 && v[2] >= 0))
    fail(ExitCode::usage, "\"{}\": none may be negative", text);
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

std::string text_of(const Colour& c) { return fmt::format("{},{},{}", c[0], c[1], c[2]); }

void colour_option(Tool& tool, const char* name, std::optional<Colour>& value, const char* text) {
  tool.custom(
      name, "R,G,B", text, [&value](const std::string& s) { value = colour_of(s); },
      [&value] { return value ? text_of(*value) : std::string(); });
}

void colours_option(Tool& tool, const char* name, std::vector<Colour>& values, const char* text) {
  tool.custom(
      name, "R,G,B[/R,G,B...]", text,
      [&values](const std::string& s) {
        values.clear();
        for (std::size_t start = 0, end = 0; end != std::string::npos; start = end + 1)
          values.push_back(colour_of(s.substr(start, (end = s.find('/', start)) - start)));
      },
      [&values] {
        std::string all;
        for (const Colour& c : values)
          all += (all.empty() ? "" : "/") + text_of(c);
        return all;
      });
}

void quantity_option(Tool& tool, const char* name, const char* placeholder, double& value, const Quantity& kind,
                     const char* text) {
  tool.custom(
      name, placeholder, text, [&value, kind](const std::string& s) { value = parse_quantity(s, kind); },
      [&value] { return fmt::format("{}", value); });
}

void size_option(Tool& tool, DrawOptions& draw) {
  tool.custom(
      "--size", "WIDTHxHEIGHT", "of the picture in pixels",
      [&draw](const std::string& s) {
        const auto [w, h] = numbers<2>(s, 'x', "a size such as 1280x720");
        for (const double side : {w, h})
          if (!(side >= 1 && side <= longest_side) || side != std::floor(side))
            fail(ExitCode::usage, "\"{}\": width and height are whole numbers of pixels from 1 to {}", s, longest_side);
        draw.width = static_cast<int>(w);
        draw.height = static_cast<int>(h);
      },
      [&draw] { return fmt::format("{}x{}", draw.width, draw.height); });
}

void range_option(Tool& tool, std::optional<Scale>& range) {
  tool.custom(
      "--range", "LOW:HIGH",
      "ends of the scale of false colours, in SI units or with their own (1mm:3mm); without it, the least and greatest "
      "value of all frames, as far as they are known",
      [&range](const std::string& s) {
        const auto colon = s.find(':');
        const auto number = [&](const std::string& part) {
          std::string problem;
          for (const Quantity& kind : {quantity::number, quantity::length, quantity::velocity})
            if (const auto value = read_quantity(part, kind, problem); value && std::isfinite(*value))
              return *value;
          fail(ExitCode::usage, "\"{}\" is not a range such as 0.001:0.003 or 1mm:3mm", s);
        };
        if (colon == std::string::npos)
          fail(ExitCode::usage, "\"{}\" is not a range such as 0.001:0.003 or 1mm:3mm", s);
        const Scale scale{number(s.substr(0, colon)), number(s.substr(colon + 1))};
        if (!(scale.low < scale.high))
          fail(ExitCode::usage, "\"{}\": the first end must be below the second", s);
        range = scale;
      },
      [&range] { return range ? fmt::format("{}:{}", range->low, range->high) : std::string(); });
}

} // namespace

void declare_render_options(Tool& tool, RenderOptions& o) {
  tool.option("-o,--output", o.output, "FILE",
              "picture to write, .png or .exr; %d or %04d in its name stands for the frame's number in the stream. Its "
              "folder is made if it is missing");
  tool.flag("--y4m", o.y4m, "write a y4m video to standard output instead, for ffmpeg");
  tool.flag("--ppm", o.ppm, "write PPM images to standard output instead, one behind the other");
  tool.option("--fps", o.frames_per_second, "FPS", "frames a second that a y4m video states");
  size_option(tool, o.draw);
  tool.custom(
      "--samples", "N", "samples a pixel; with --noise, at most",
      [&o](const std::string& s) {
        const double v = numbers<1>(s, ' ', "a whole number")[0];
        if (!(v >= 1 && v <= most_samples) || v != std::floor(v))
          fail(ExitCode::usage, "\"{}\" is not a whole number from 1 to {}", s, most_samples);
        o.draw.samples = static_cast<int>(v);
      },
      [&o] { return fmt::format("{}", o.draw.samples); });
  tool.custom(
      "--noise", "LEVELS",
      "go on sampling until the noise is below so many of 255 levels; 2 looks clean, 0 takes --samples as they are",
      [&o](const std::string& s) {
        const double v = numbers<1>(s, ' ', "a number of levels")[0];
        if (!(v >= 0))
          fail(ExitCode::usage, "\"{}\" is negative", s);
        o.draw.noise = static_cast<float>(v);
      },
      [&o] { return fmt::format("{}", o.draw.noise); });
  tool.flag("--denoise", o.denoise,
            "smooth what is random about the light over places that see the same surface, and draw edges with rays of "
            "their own: looks clean with --samples 4. Of materials; false colours have no noise");
  tool.flag("--facets", o.facets,
            "draw materials flat between the vertices of the sheet, as it is computed; without it, curved");
  tool.flag("--layers", o.layers,
            "draw layers that touch as slabs of their own, each with its two faces; without it, as one body of liquid");
  tool.choice("--look", o.look, looks(), "the material itself, or a quantity in false colours, or the mesh");
  declare_materials(
      tool, o.liquids,
      "what the sheet is made of; of several liquids the first, the second, ..., and again from the first, as the "
      "scene names them");
  tool.option("--index", o.index, "N", "index of refraction, instead of the material's");
  colour_option(tool, "--absorption", o.absorption, "absorption coefficients [1/m], instead of the material's");
  colour_option(tool, "--scattering", o.scattering, "reduced scattering coefficients [1/m], instead of the material's");
  tool.option("--roughness", o.roughness, "R",
              "of the liquid's faces, 0 to 1: how far their mirror images are blurred");
  tool.option("--optical-scale", o.optical_scale, "F",
              "factor on absorption and scattering: the sheet looks as if it were so many times as thick");
  vector_option(tool, "--eye", o.camera.eye, "where the camera stands [m]; without it, so that everything is seen");
  vector_option(tool, "--target", o.camera.target, "what it looks at [m]; without it, the middle of everything");
  quantity_option(tool, "--aperture", "LENGTH", o.aperture, quantity::length,
                  "diameter of the lens, such as 5mm: blurs what is not in focus. 0: all is sharp");
  vector_option(tool, "--focus", o.focus, "a point that is sharp, with --aperture; without it, what is looked at");
  quantity_option(tool, "--shutter", "TIME", o.shutter, quantity::time,
                  "how long it is open, such as 20ms, half before the frame's time: blurs what moves. 0: not at all");
  tool.option("--fov", o.camera.field_of_view, "DEGREES", "field of view from the lower to the upper edge");
  tool.option("--azimuth", o.camera.azimuth, "DEGREES",
              "where the camera stands if it finds its place itself: angle about the upward axis, from z towards x "
              "(default 30, or the nearest to it from which planes are seen by their front)");
  tool.option("--elevation", o.camera.elevation, "DEGREES",
              "likewise: angle above level (default 25; -25 or 0 where planes would hide everything, 50 or 75 where "
              "solids would)");
  tool.option(
      "--turntable", o.turntable, "PICTURES",
      "once round what there is to see in so many pictures, anticlockwise as seen from above, its axis through "
      "what is looked at: of a single frame, or a picture of each while the run plays, the last of them until "
      "the round is complete. %04d in -o is then the picture's number; the studio's light goes round too. 0: not "
      "at all");
  tool.option(
      "--environment", o.environment, "FILE",
      "image of the surroundings to light the scene with instead of the studio, .hdr, .exr or .png, longitude across");
  tool.option("--environment-turn", o.environment_turn, "DEGREES",
              "turn it about the upward axis, counter-clockwise as seen from above");
  tool.option("--environment-strength", o.environment_strength, "F", "factor on its light");
  tool.option("--exposure", o.exposure, "STOPS", "brighter by so many factors of two");
  tool.choice("--tone", o.tone, {{"shoulder", Tone::shoulder}, {"filmic", Tone::filmic}, {"linear", Tone::linear}},
              "how light becomes a .png picture or a film: true but for highlights, which go softly to white; with the "
              "contrast of film; true, and cut off at white");
  tool.choice("--ground", o.ground, {{"auto", true}, {"none", false}},
              "the ground below a scene that has no plane of its own");
  tool.choice("--solids", o.solids,
              {{"auto", DrawnSolids::not_enclosing}, {"all", DrawnSolids::all}, {"none", DrawnSolids::none}},
              "the scene's solids; auto: but those that hide the liquid from all sides, as a closed mould does");
  tool.flag("--transparent", o.transparent,
            "leave the background out, and the ground, planes and baths with the shadows on them: .png with straight "
            "alpha, .exr with alpha, to lay over another picture");
  colour_option(tool, "--ground-colour", o.ground_colour, "reflectance of the ground, 0 to 1");
  colours_option(tool, "--solid-colour", o.solid_colours,
                 "reflectance of the solids, 0 to 1, the first, the second, ..., and again from the first");
  tool.option("--ground-gloss", o.ground_gloss, "R",
              "a clear coat on the ground, of roughness 0 to 1; without it, matte");
  tool.option("--solid-gloss", o.solid_gloss, "R", "likewise, on the solids");
  range_option(tool, o.range);
}

} // namespace sheet::render
