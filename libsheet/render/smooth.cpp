// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/smooth.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

namespace sheet::render {
namespace {

constexpr int levels = 6;             // of the filter; each reaches twice as far as the one before
constexpr float normal_falloff = 40;  // exponent for 1 - cos of the angle between normals
constexpr float plane_falloff = 1;    // for the distance from the tangent plane, in pixels
constexpr float light_deviations = 4; // by which the light of two points of the fewest samples may differ
constexpr float least_variance = 1e-7F;
constexpr std::array<float, 5> kernel{1 / 16.0F, 4 / 16.0F, 6 / 16.0F, 4 / 16.0F, 1 / 16.0F}; // cubic B-spline

// Exponent of the likeness of two points of one way.
float unlikeness(const SurfacePoint& a, const SurfacePoint& b, float pixels) {
  const float off_plane = std::abs((b.position - a.position).dot(a.normal));
  return normal_falloff * (1 - a.normal.dot(b.normal)) + plane_falloff * off_plane / (a.reach * pixels + 1e-12F);
}

// About exp(-x), and 0 from 4 on.
float falloff(float x) {
  const float root = std::max(1 - x / 4, 0.0F), square = root * root;
  return square * square;
}

struct Noisy {
  Halves light;
  float level = 0, variance = 0; // of the mean's luminance
  float deviations = 0;          // by which the luminance of others may differ
};

class Filter {
public:
  Filter(const std::vector<SurfacePoint>& points, int width)
      : points_(&points), width_(width), height_(static_cast<int>(points.size()) / width) {}

  // Calls visit(weight, index) for the 5 x 5 points around (x, y), `step` apart, that show the same surface.
  template <class Visit> void around(int x, int y, int step, Visit&& visit) const {
    const SurfacePoint& here = (*points_)[index(x, y)];
    for (int j = -2; j <= 2; ++j) {
      const int qy = y + j * step;
      if (qy < 0 || qy >= height_)
        continue;
      for (int i = -2; i <= 2; ++i) {
        const int qx = x + i * step;
        if (qx < 0 || qx >= width_)
          continue;
        const SurfacePoint& there = (*points_)[index(qx, qy)];
        if (there.way == here.way)
          visit(kernel[static_cast<std::size_t>(i + 2)] * kernel[static_cast<std::size_t>(j + 2)],
                unlikeness(here, there, static_cast<float>(step)), index(qx, qy));
      }
    }
  }

  // Of a quantity of the points, `step` apart. There is a surface.
  template <class Value> MeanAround mean(int x, int y, int step, Value&& value) const {
    float sum = 0, weights = 0, squares = 0;
    around(x, y, step, [&](float weight, float unlike, std::size_t q) {
      const float w = weight * falloff(unlike);
      sum += w * value(q);
      weights += w;
      squares += w * w;
    });
    return {sum / weights, weights * weights / squares};
  }

  // The variance of single points, from two halves of few samples, says next to nothing: that of the neighbourhood.
  [[nodiscard]] float variance_around(int x, int y, const std::vector<Noisy>& from) const {
    if ((*points_)[index(x, y)].way == 0)
      return 0;
    return mean(x, y, 2, [&](std::size_t q) { return from[q].variance; }).mean;
  }

  [[nodiscard]] Noisy smoothed(int x, int y, int step, const std::vector<Noisy>& from) const {
    const Noisy& here = from[index(x, y)];
    Noisy result;
    result.deviations = here.deviations;
    if ((*points_)[index(x, y)].way == 0)
      return here;
    float weights = 0;
    around(x, y, step, [&](float weight, float unlike, std::size_t q) {
      const Noisy& there = from[q];
      const float difference = there.level - here.level;
      const float scale = 2 * here.deviations * here.deviations * here.variance + least_variance;
      const float w = weight * falloff(unlike + difference * difference / scale);
      weights += w;
      result.light.add(Colour::Constant(w), there.light);
      result.variance += w * w * there.variance;
    });
    result.light.a /= weights;
    result.light.b /= weights;
    result.variance /= weights * weights;
    result.level = luminance(result.light.mean());
    return result;
  }

  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  template <class Each> void each(Each&& body) const {
    tbb::parallel_for(0, height_, [&](int y) {
      for (int x = 0; x < width_; ++x)
        body(x, y);
    });
  }

private:
  const std::vector<SurfacePoint>* points_;
  int width_, height_;
};

} // namespace

float likeness(const SurfacePoint& a, const SurfacePoint& b, float pixels) {
  return a.way == b.way ? falloff(unlikeness(a, b, pixels)) : 0;
}

MeanAround mean_around(const std::vector<float>& values, const std::vector<SurfacePoint>& points, int width, int x,
                       int y) {
  const Filter filter(points, width);
  const std::size_t i = filter.index(x, y);
  if (points[i].way == 0)
    return {values[i], 1};
  return filter.mean(x, y, 1, [&](std::size_t q) { return values[q]; });
}

void smooth(std::vector<Halves>& light, const std::vector<SurfacePoint>& points, const std::vector<int>& samples,
            int width) {
  const Filter filter(points, width);
  std::vector<Noisy> now(light.size()), next(light.size());
  const auto fewest = static_cast<float>(*std::min_element(samples.begin(), samples.end()));
  for (std::size_t i = 0; i < light.size(); ++i) {
    const float difference = luminance(light[i].a) - luminance(light[i].b);
    const auto count = static_cast<float>(samples[i]);
    // Where there are more samples less needs to be smoothed.
    next[i] = {light[i], luminance(light[i].mean()), difference * difference / 4 * count,
               light_deviations * std::sqrt(fewest / count)};
  }
  now = next;
  filter.each([&](int x, int y) {
    const std::size_t i = filter.index(x, y);
    now[i].variance = filter.variance_around(x, y, next) / static_cast<float>(samples[i]);
  });
  for (int level = 0; level < levels; ++level) {
    filter.each([&](int x, int y) { next[filter.index(x, y)] = filter.smoothed(x, y, 1 << level, now); });
    now.swap(next);
  }
  for (std::size_t i = 0; i < light.size(); ++i)
    light[i] = now[i].light;
}

} // namespace sheet::render
