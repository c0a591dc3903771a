// SPDX-License-Identifier: GPL-3.0-or-later
// All pixels of a picture: tiles in parallel, samples by number or by their noise. Every pixel is the mean of its own
// samples (filter importance sampling [Ernst et al. 2006], a tent two pixels wide), so the same bits come out for any
// number of threads.
#pragma once
#include <functional>

#include "libsheet/render/camera.h"
#include "libsheet/render/image.h"
#include "libsheet/render/world.h"

namespace sheet::render {

// The light along a camera ray; counts its rays.
using Shader = std::function<Colour(const Ray&, Sampler&, std::uint64_t&)>;
// How far a background is covered along a camera ray, 0 to 1; counts its rays.
using Coverage = std::function<float(const Ray&, std::uint64_t&)>;
// Told now and then, by one thread at a time, what part of the picture is done.
using Progress = std::function<void(double)>;

struct DrawOptions {
  int width = 1280, height = 720;
  int samples = 64;     // a pixel; even, at least 2; at most so many if noise is given
  float noise = 0;      // > 0: go on until a tile's noise is below it (Picture::noise)
  float exposure = 1;   // factor on the light
  int first_sample = 0; // where the samples' numbers begin
};

// Noise is measured by comparing the pictures that the two halves of the samples make. With a noise target, the samples
// of a tile are doubled from 16 until it is met. With `coverage` the picture has alpha: the shader's light is then
// that of what covers the background alone.
[[nodiscard]] Picture draw(const World& world, const Camera& camera, const Shader& shader, const DrawOptions& options,
                           const Progress& progress, const Coverage& coverage = {});

inline constexpr int tile_edge = 16; // [pixels]; of the tiles whose noise is looked at

// Where in a tent of half width 1 a uniform number falls.
[[nodiscard]] float tent(float u);

// What the layers have of places that rays hit.
struct LayerSources {
  std::function<Colour(const Hit&, const Vec& direction)> albedo;
  std::function<Vec(const Hit&)> velocity; // [m/s]
};
// The layers alone: one ray through the middle of each pixel.
void fill_layers(const World& world, const Camera& camera, const LayerSources& sources, Picture& picture);

} // namespace sheet::render
