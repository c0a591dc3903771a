// SPDX-License-Identifier: GPL-3.0-or-later
// The stage sheet-render: a picture of each frame, as a file or as a part of a film.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/base/tool.h"
#include "libsheet/render/camera.h"
#include "libsheet/render/display.h"
#include "libsheet/render/draw.h"
#include "libsheet/render/looks.h"
#include "libsheet/render/slab.h"

namespace sheet::render {

// not_enclosing: but those that hide the sheet from all sides (sights.h).
enum class DrawnSolids : std::uint8_t { not_enclosing, all, none };

struct RenderOptions {
  std::string output;            // name of the picture files (NumberedName), .png or .exr; "" with a video
  bool y4m = false, ppm = false; // a video to standard output
  DrawOptions draw;              // exposure is not used; see below
  bool denoise = false;          // draw_denoised; of materials only
  bool layers = false;           // that touch are drawn each by itself
  bool facets = false;           // materials are drawn flat between the sheet's vertices, as false colours are
  CameraOptions camera;
  std::int64_t turntable = 0; // pictures in which the camera goes once round; 0: it stands
  Look look;
  std::vector<std::size_t> liquids = liquids_told_apart(); // numbers of the presets, of the scene's liquids in turn
  std::optional<double> index;
  std::optional<Colour> absorption, scattering;    // [1/m]
  double optical_scale = 1;                        // factor on absorption and scattering
  double roughness = 0;                            // of the liquid's mirror images
  std::optional<Colour> ground_colour;             // reflectance
  std::vector<Colour> solid_colours;               // in turn, from the first; empty: the built-in ones
  std::optional<double> ground_gloss, solid_gloss; // roughness of a clear coat
  double exposure = 0;                             // [stops]
  Tone tone = Tone::shoulder;                      // of materials
  double aperture = 0;                             // diameter of the lens [m]; 0: a pinhole
  std::optional<Vector3> focus;                    // what is sharp [m]; absent: what is looked at
  double shutter = 0;                              // open so long, half of it before the frame's time [s]
  double environment_turn = 0;                     // [degrees]
  double environment_strength = 1;                 // factor on its light
  std::string environment;                         // image file; "": the studio
  bool ground = true;                              // whether it is drawn
  bool transparent = false;                        // where nothing but planes and what lies behind everything is
  DrawnSolids solids = DrawnSolids::not_enclosing;
  std::optional<Scale> range; // of false colours, in SI; absent: that of the frames
  double frames_per_second = 24;
};

// Declares all of these. The values that cannot be set by themselves are checked by RenderStage.
void declare_render_options(Tool& tool, RenderOptions& options);

struct PictureReport {
  float noise = 0, worst_noise = 0; // Picture::noise
  double samples = 0;               // a pixel
  std::uint64_t rays = 0;
  std::string file; // "" for a video
};

class RenderStage {
public:
  // Throws Error: usage (options that make no picture), io, bad_input (environment image).
  explicit RenderStage(RenderOptions options);
  ~RenderStage();
  RenderStage(const RenderStage&) = delete;
  RenderStage& operator=(const RenderStage&) = delete;

  // To be told of every frame before the first is drawn: camera, ground and scale then fit them all, and stand still.
  // Otherwise they are fitted to the first frame that is drawn, with a margin of a quarter of its size to all sides.
  void survey(const formats::Frame& frame);

  // Draws the frame, which is number `index` of its stream; files of a turntable are numbered by themselves. Throws
  // Error: bad_input (the frame's scene, its solids' files, nothing to see), io.
  PictureReport draw(const formats::Frame& frame, std::uint64_t index, const Progress& progress);

  // There are no more frames: the video is complete, the picture of a name without number is written. Throws Error
  // (io).
  void finish();

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace sheet::render
