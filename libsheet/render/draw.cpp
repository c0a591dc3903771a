// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/draw.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>

#include <tbb/parallel_for.h>

#include "libsheet/render/camera_rays.h"
#include "libsheet/render/display.h"

namespace sheet::render {
namespace {

struct Tile {
  int x0, y0, x1, y1;
};

std::vector<Tile> tiles_of(int width, int height) {
  std::vector<Tile> tiles;
  for (int y = 0; y < height; y += tile_edge)
    for (int x = 0; x < width; x += tile_edge)
      tiles.push_back({x, y, std::min(x + tile_edge, width), std::min(y + tile_edge, height)});
  return tiles;
}

struct TileResult {
  double squared_noise = 0; // sum over pixels
  std::uint64_t rays = 0, samples = 0;
};

// Sums over the samples of a pixel.
struct Sum {
  Colour light = Colour::Zero();
  float covered = 0;
  void add(const Sum& other) {
    light += other.light;
    covered += other.covered;
  }
};

class TilePainter {
public:
  // `picture` has its size, and alpha if there is a coverage.
  TilePainter(const World& world, const Camera& camera, const Shader& shader, const Coverage& coverage,
              const DrawOptions& options, Picture& picture)
      : rays_(world, camera), shader_(&shader), coverage_(&coverage), options_(options), picture_(&picture) {}

  TileResult paint(const Tile& tile) const {
    TileResult result;
    const int width = tile.x1 - tile.x0, pixels = width * (tile.y1 - tile.y0);
    std::vector<Sum> before(static_cast<std::size_t>(pixels)), added = before;
    // The first half of the samples against the second: each is a well-spread set of its own.
    int done = options_.noise > 0 ? std::min(8, options_.samples / 2) : options_.samples / 2;
    add_samples(tile, 0, done, before, result.rays);
    do {
      std::fill(added.begin(), added.end(), Sum());
      add_samples(tile, done, 2 * done, added, result.rays);
      result.squared_noise = squared_noise(before, added, done);
      for (std::size_t p = 0; p < before.size(); ++p)
        before[p].add(added[p]);
      done *= 2;
    } while (2 * done <= options_.samples &&
             result.squared_noise > static_cast<double>(options_.noise) * static_cast<double>(options_.noise) * pixels);
    for (int p = 0; p < pixels; ++p) {
      const std::size_t i = picture_->light.index(tile.x0 + p % width, tile.y0 + p / width);
      const Sum& sum = before[static_cast<std::size_t>(p)];
      picture_->light.pixels[i] = sum.light / static_cast<float>(done);
      if (*coverage_)
        picture_->alpha[i] = sum.covered / static_cast<float>(done);
    }
    result.samples = static_cast<std::uint64_t>(done) * static_cast<std::uint64_t>(pixels);
    return result;
  }

private:
  void add_samples(const Tile& tile, int first, int end, std::vector<Sum>& sums, std::uint64_t& rays) const {
    const int width = tile.x1 - tile.x0;
    for (std::size_t p = 0; p < sums.size(); ++p)
      for (int s = first; s < end; ++s)
        sums[p].add(sample(tile.x0 + static_cast<int>(p) % width, tile.y0 + static_cast<int>(p) / width, s, rays));
  }

  [[nodiscard]] Sum sample(int x, int y, int number, std::uint64_t& rays) const {
    const Image& image = picture_->light;
    Sampler sampler(static_cast<std::uint32_t>(image.index(x, y)),
                    static_cast<std::uint32_t>(options_.first_sample + number));
    const Point2 p = sampler.point();
    const double fx = (x + 0.5 + static_cast<double>(tent(p.x))) / image.width,
                 fy = (y + 0.5 + static_cast<double>(tent(p.y))) / image.height;
    const Ray ray = rays_.has_lens() ? rays_.through(fx, fy, sampler.point()) : rays_.middle(fx, fy);
    return {options_.exposure * (*shader_)(ray, sampler, rays), *coverage_ ? (*coverage_)(ray, rays) : 0};
  }

  // Of the mean of two pictures of so many samples each: half of their difference.
  static double squared_noise(const std::vector<Sum>& a, const std::vector<Sum>& b, int samples) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double difference = static_cast<double>(display_level(luminance(a[i].light / static_cast<float>(samples))) -
                                                    display_level(luminance(b[i].light / static_cast<float>(samples))));
      sum += difference * difference / 4;
    }
    return sum;
  }

  CameraRays rays_;
  const Shader* shader_;
  const Coverage* coverage_;
  DrawOptions options_;
  Picture* picture_;
};

} // namespace

float tent(float u) { return u < 0.5F ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u); }

Picture draw(const World& world, const Camera& camera, const Shader& shader, const DrawOptions& options,
             const Progress& progress, const Coverage& coverage) {
  Picture picture;
  picture.light = Image(options.width, options.height);
  if (coverage)
    picture.alpha.resize(picture.light.pixels.size());
  const std::vector<Tile> tiles = tiles_of(options.width, options.height);
  std::vector<TileResult> results(tiles.size());
  const TilePainter painter(world, camera, shader, coverage, options, picture);
  std::atomic<std::size_t> finished = 0;
  std::mutex telling;
  tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t t) {
    results[t] = painter.paint(tiles[t]);
    const std::size_t count = ++finished;
    if (const std::unique_lock lock(telling, std::try_to_lock); lock && progress)
      progress(static_cast<double>(count) / static_cast<double>(tiles.size()));
  });
  double squared = 0, worst = 0;
  std::uint64_t samples = 0;
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    squared += results[t].squared_noise;
    worst = std::max(worst, results[t].squared_noise / ((tiles[t].x1 - tiles[t].x0) * (tiles[t].y1 - tiles[t].y0)));
    samples += results[t].samples;
    picture.rays += results[t].rays;
  }
  const auto pixels = static_cast<double>(picture.light.pixels.size());
  picture.noise = static_cast<float>(std::sqrt(squared / pixels));
  picture.worst_noise = static_cast<float>(std::sqrt(worst));
  picture.samples = static_cast<double>(samples) / pixels;
  return picture;
}

void fill_layers(const World& world, const Camera& camera, const LayerSources& sources, Picture& picture) {
  const Image& image = picture.light;
  Layers& layers = picture.layers;
  const std::size_t pixels = image.pixels.size();
  layers.depth.assign(pixels, std::numeric_limits<float>::infinity());
  layers.normal.assign(pixels, Vec::Zero());
  layers.thickness.assign(pixels, 0);
  layers.id.assign(pixels, nothing_id);
  layers.velocity.assign(pixels, Vec::Zero());
  layers.albedo.assign(pixels, Colour::Zero());
  const Vec eye = world.to_world(camera.eye());
  tbb::parallel_for(0, image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      const Vec d = camera.direction((x + 0.5) / image.width, (y + 0.5) / image.height);
      const Hit hit = world.nearest({eye, d});
      if (!hit.anything())
        continue;
      const std::size_t i = image.index(x, y);
      layers.depth[i] = hit.distance * d.dot(camera.axis()) * static_cast<float>(world.unit());
      layers.normal[i] = d.dot(hit.normal) < 0 ? hit.normal : Vec(-hit.normal);
      layers.id[i] = hit.id;
      layers.velocity[i] = sources.velocity(hit);
      layers.albedo[i] = sources.albedo(hit, d);
      if (hit.id == sheet_id)
        layers.thickness[i] = world.thickness_at(hit);
    }
  });
}

} // namespace sheet::render
