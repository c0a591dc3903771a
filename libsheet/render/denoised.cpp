// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/denoised.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numeric>

#include <tbb/parallel_for.h>

#include "libsheet/render/camera_rays.h"
#include "libsheet/render/display.h"
#include "libsheet/render/smooth.h"

namespace sheet::render {
namespace {

constexpr int fewest_edge_rays = 4;           // of a pixel whose neighbours see different things; they are doubled
constexpr int most_edge_rays = 32;            // as long as their levels differ by more than
constexpr int most_blurred_rays = 128;        // of a pixel that a lens blurs
constexpr float levels_a_ray = 2;             // so many times their number
constexpr int edge_width = 2;                 // pixels so near to another surface, and
constexpr int most_samples_factor = 4;        // noisy points get so many times the samples
constexpr float noisy_levels = 15;            // of one sample, in the mean over the points around that see the same
constexpr float least_weight = 0.02F;         // that random light is divided by
constexpr float least_likeness = 1e-3F;       // of a point whose light a ray takes, if it is the best there is
constexpr float least_likeness_behind = 0.2F; // likewise, if it sees the surface behind other layers
constexpr float plain_likeness = 0.2F;        // of neighbours that see one thing, and
constexpr float plain_levels = 6;             // their greatest difference, of 255

// The light of a pixel or ray, and PathTracer::coverage.
struct Seen {
  Halves light;
  float covered = 0;
  void add(float weight, const Seen& other) {
    light.add(Colour::Constant(weight), other.light);
    covered += weight * other.covered;
  }
};

class Painter {
public:
  Painter(const World& world, const Camera& camera, const PathTracer& tracer, const DrawOptions& options,
          const Progress& progress)
      : tracer_(&tracer), rays_of_(world, camera), options_(options), progress_(&progress),
        pixel_angle_(static_cast<float>(camera.pixel_angle(options.height))) {
    const auto pixels = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
    first_.resize(pixels);
    certain_.resize(pixels);
    covered_.resize(pixels);
    near_edge_.resize(pixels);
    samples_.assign(pixels, options.samples);
    whole_.resize(pixels);
    for (Layer& layer : layers_) {
      layer.points.resize(pixels);
      layer.weights.resize(pixels);
      layer.light.resize(pixels);
    }
  }

  Picture paint() {
    each_row([&](int x, int y, std::uint64_t& rays) { look_at(x, y, rays); });
    each_row([&](int x, int y, std::uint64_t&) { near_edge_[index(x, y)] = near_edge(x, y); });
    each_row([&](int x, int y, std::uint64_t& rays) { sample_point(x, y, 0, options_.samples, rays); });
    share_out_samples();
    each_row([&](int x, int y, std::uint64_t& rays) { sample_more(x, y, rays); });
    for (Layer& layer : layers_)
      smooth(layer.light, layer.points, samples_, options_.width);
    for (std::size_t i = 0; i < whole_.size(); ++i)
      whole_[i] = whole(i, 1);
    picture_.light = Image(options_.width, options_.height);
    if (tracer_->cuts_out())
      picture_.alpha.resize(whole_.size());
    std::vector<float> noise(whole_.size());
    each_row([&](int x, int y, std::uint64_t& rays) {
      const auto [halves, covered] = plain(x, y) ? blend(x, y) : gather(x, y, rays);
      noise[index(x, y)] = (level(halves.a) - level(halves.b)) / 2;
      picture_.light.at(x, y) = options_.exposure * halves.mean();
      if (tracer_->cuts_out())
        picture_.alpha[index(x, y)] = covered;
    });
    state_noise(noise);
    picture_.samples = std::accumulate(samples_.begin(), samples_.end(), 0.0) / static_cast<double>(samples_.size());
    picture_.rays = rays_;
    return std::move(picture_);
  }

private:
  // One part of the random light (Light::chance), in the middles of the pixels.
  struct Layer {
    std::vector<SurfacePoint> points;
    std::vector<Colour> weights; // that the light is divided by
    std::vector<Halves> light;
  };

  [[nodiscard]] Ray ray_through(float x, float y) const { // in pixels
    return rays_of_.middle(static_cast<double>(x) / options_.width, static_cast<double>(y) / options_.height);
  }
  [[nodiscard]] SurfacePoint point_of(const SightLayer& layer) const {
    return {layer.normal, layer.position, pixel_angle_ * layer.length, layer.way, layer.end};
  }
  static Colour divisor(const SightLayer& layer) { return layer.weight.max(least_weight); }
  [[nodiscard]] float level(const Colour& light) const { return display_level(luminance(options_.exposure * light)); }

  [[nodiscard]] Ray middle_ray(int x, int y) const {
    return ray_through(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
  }

  void look_at(int x, int y, std::uint64_t& rays) {
    const std::size_t i = index(x, y);
    const Sight sight = tracer_->look(middle_ray(x, y), rays);
    first_[i] = sight.first;
    certain_[i] = sight.certain;
    covered_[i] = coverage(middle_ray(x, y), rays);
    for (std::size_t l = 0; l < layers_.size(); ++l) {
      layers_[l].points[i] = point_of(sight.layers[l]);
      layers_[l].weights[i] = divisor(sight.layers[l]);
    }
  }

  [[nodiscard]] float coverage(const Ray& ray, std::uint64_t& rays) const {
    return tracer_->cuts_out() ? tracer_->coverage(ray, rays) : 0;
  }

  // Points that are smoothed over others share the sequence of the picture with them.
  [[nodiscard]] Sampler sampler_of(int x, int y, int number) const {
    const std::size_t i = index(x, y);
    if (near_edge_[i])
      return {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(number)};
    return Sampler::on_screen(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                              static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(options_.samples));
  }

  // Adds samples to the halves of a point: those before the middle of all that it is to have to the first.
  void sample_point(int x, int y, int first, int end, std::uint64_t& rays) {
    const std::size_t i = index(x, y);
    const Ray ray = middle_ray(x, y);
    for (int s = first; s < end; ++s) {
      Sampler sampler = sampler_of(x, y, options_.first_sample + s);
      const Light light = tracer_->radiance(ray, first_[i], sampler, rays);
      for (std::size_t l = 0; l < layers_.size(); ++l) {
        Halves& sum = layers_[l].light[i];
        (2 * s < samples_[i] ? sum.a : sum.b) += light.chance[l] / layers_[l].weights[i];
      }
    }
  }

  // Of one sample at a point, by the difference of the halves there: of the displayed luminance.
  [[nodiscard]] float variance_of_levels(std::size_t i) const {
    const Halves halves = whole(i, 2.0F / static_cast<float>(samples_[i]));
    const float difference = level(halves.a) - level(halves.b);
    return difference * difference / 4 * static_cast<float>(samples_[i]);
  }

  // Shadows next to what throws them are too narrow to be smoothed.
  [[nodiscard]] bool near_edge(int x, int y) const {
    const std::vector<SurfacePoint>& points = layers_[0].points;
    for (int j = -edge_width; j <= edge_width; ++j)
      for (int i = -edge_width; i <= edge_width; ++i)
        if (points[nearest_index(x + i, y + j)].way != points[index(x, y)].way)
          return true;
    return false;
  }

  // Noise that the points around cannot take away, since it is great, as in penumbras, or since few of them see the
  // same, as along edges, takes more samples.
  void share_out_samples() {
    std::vector<float> variance(whole_.size());
    for (std::size_t i = 0; i < variance.size(); ++i)
      variance[i] = variance_of_levels(i);
    std::vector<int> wanted(whole_.size());
    each_row([&](int x, int y, std::uint64_t&) {
      const auto [mean, points] = mean_around(variance, layers_[0].points, options_.width, x, y);
      const float need = mean / (points * noisy_levels * noisy_levels);
      int& factor = wanted[index(x, y)];
      if (near_edge_[index(x, y)])
        factor = most_samples_factor;
      else
        for (factor = 1; factor < most_samples_factor && static_cast<float>(factor) < need;)
          factor *= 2;
    });
    for (std::size_t i = 0; i < wanted.size(); ++i)
      samples_[i] *= wanted[i];
  }

  void sample_more(int x, int y, std::uint64_t& rays) {
    const std::size_t i = index(x, y);
    if (samples_[i] > options_.samples) {
      for (Layer& layer : layers_)
        layer.light[i] = {layer.light[i].a + layer.light[i].b, Colour::Zero()};
      sample_point(x, y, options_.samples, samples_[i], rays);
    }
    for (Layer& layer : layers_) {
      layer.light[i].a *= 2.0F / static_cast<float>(samples_[i]);
      layer.light[i].b *= 2.0F / static_cast<float>(samples_[i]);
    }
  }

  // All light of a point; `factor` on what is random about it.
  [[nodiscard]] Halves whole(std::size_t i, float factor) const {
    Halves all{certain_[i], certain_[i]};
    for (const Layer& layer : layers_)
      all.add(factor * layer.weights[i], layer.light[i]);
    return all;
  }

  // Whether a lens mixes what pixels see: what is there, or what is somewhat before it and near.
  [[nodiscard]] bool blurred(int x, int y) const {
    constexpr float pixels = 0.3F;
    constexpr int reach = 4; // farther, what is blurred is seen by a part of the lens too small to matter
    if (!rays_of_.has_lens())
      return false;
    for (int j = -reach; j <= reach; j += reach)
      for (int i = -reach; i <= reach; i += reach)
        if (const Hit& hit = first_[nearest_index(x + i, y + j)];
            hit.anything() && rays_of_.blur(hit.position) * static_cast<float>(options_.height) > pixels)
          return true;
    return false;
  }

  // The least and the greatest level in the middles of the pixels around.
  [[nodiscard]] std::pair<float, float> levels_around(int x, int y) const {
    float low = 255, high = 0;
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        const float brightness = level(whole_[nearest_index(x + i, y + j)].mean());
        low = std::min(low, brightness);
        high = std::max(high, brightness);
      }
    return {low, high};
  }

  // Whether the pixels around see the same things, evenly enough that the middles of pixels tell all.
  [[nodiscard]] bool plain(int x, int y) const {
    const std::size_t here = index(x, y);
    if (blurred(x, y))
      return false;
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        const std::size_t there = nearest_index(x + i, y + j);
        for (const Layer& layer : layers_)
          if (layer.points[there].way != layer.points[here].way)
            return false;
        if (likeness(layers_[0].points[here], layers_[0].points[there], 1) < plain_likeness)
          return false;
      }
    const auto [low, high] = levels_around(x, y);
    return high - low < plain_levels;
  }

  // The middles of pixels with weights that have the second moments of the tent, 1/6.
  [[nodiscard]] Seen blend(int x, int y) const {
    constexpr std::array<float, 3> weights{1 / 12.0F, 10 / 12.0F, 1 / 12.0F};
    Seen sum;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const std::size_t there = nearest_index(x + i - 1, y + j - 1);
        sum.add(weights[static_cast<std::size_t>(i)] * weights[static_cast<std::size_t>(j)],
                {whole_[there], covered_[there]});
      }
    return sum;
  }

  [[nodiscard]] Seen gather(int x, int y, std::uint64_t& rays) const {
    Seen sum;
    auto [low, high] = levels_around(x, y);
    int done = 0;
    const bool is_blurred = blurred(x, y);
    const int most = is_blurred ? most_blurred_rays : most_edge_rays;
    for (int end = is_blurred ? most_edge_rays : fewest_edge_rays; end <= most; end *= 2) {
      for (; done < end; ++done) {
        const Seen seen = seen_near(x, y, done, rays);
        const float brightness = level(seen.light.mean());
        low = std::min(low, brightness);
        high = std::max(high, brightness);
        sum.add(1, seen);
      }
      if (high - low <= levels_a_ray * static_cast<float>(done))
        break;
    }
    Seen mean;
    mean.add(1 / static_cast<float>(done), sum);
    return mean;
  }

  // Along one of the rays of a pixel.
  [[nodiscard]] Seen seen_near(int x, int y, int number, std::uint64_t& rays) const {
    Sampler sampler(static_cast<std::uint32_t>(index(x, y) + whole_.size()),
                    static_cast<std::uint32_t>(most_blurred_rays * options_.first_sample + number));
    const Point2 p = sampler.point();
    float fx = static_cast<float>(x) + 0.5F + tent(p.x), fy = static_cast<float>(y) + 0.5F + tent(p.y);
    Ray ray = ray_through(fx, fy);
    if (rays_of_.has_lens())
      ray = rays_of_.through(static_cast<double>(fx) / options_.width, static_cast<double>(fy) / options_.height,
                             sampler.point());
    const Sight sight = tracer_->look(ray, rays);
    if (rays_of_.has_lens() && sight.first.anything())
      if (const auto place = rays_of_.place(sight.first.position)) { // where the middles of pixels see it
        fx = static_cast<float>(place->x() * options_.width);
        fy = static_cast<float>(place->y() * options_.height);
      }
    Halves light{sight.certain, sight.certain};
    bool found = true;
    for (std::size_t l = 0; found && l < layers_.size(); ++l)
      found = borrow(fx, fy, sight.layers[l], layers_[l], light);
    if (!found)
      light.a = light.b = tracer_->radiance(ray, sight.first, sampler, rays).sum();
    return {light, coverage(ray, rays)};
  }

  // Adds the light of the points around a place of the picture that see what is seen there, most of it from the nearest
  // and most alike; where there is none, of those that see the same surface behind other layers. False if there is
  // none of these either.
  [[nodiscard]] bool borrow(float fx, float fy, const SightLayer& seen, const Layer& layer, Halves& light) const {
    if (seen.way == 0)
      return true;
    SurfacePoint point = point_of(seen);
    const int left = static_cast<int>(std::floor(fx - 0.5F)), top = static_cast<int>(std::floor(fy - 0.5F));
    float weights = 0, weights_behind = 0;
    Halves sum, sum_behind;
    for (int y = std::max(top - 1, 0); y <= std::min(top + 2, options_.height - 1); ++y)
      for (int x = std::max(left - 1, 0); x <= std::min(left + 2, options_.width - 1); ++x) {
        const SurfacePoint& there = layer.points[index(x, y)];
        if (there.end != seen.end)
          continue;
        point.way = there.way;
        const float like = likeness(point, there, 1);
        const float dx = static_cast<float>(x) + 0.5F - fx, dy = static_cast<float>(y) + 0.5F - fy;
        const float near = std::exp(-3 * (dx * dx + dy * dy));
        if (there.way == seen.way) {
          const float weight = near * std::max(like, least_likeness);
          weights += weight;
          sum.add(Colour::Constant(weight), layer.light[index(x, y)]);
        } else if (like > least_likeness_behind) {
          weights_behind += near * like;
          sum_behind.add(Colour::Constant(near * like), layer.light[index(x, y)]);
        }
      }
    if (weights > 0)
      light.add(divisor(seen) / weights, sum);
    else if (weights_behind > 0)
      light.add(divisor(seen) / weights_behind, sum_behind);
    return weights + weights_behind > 0;
  }

  void state_noise(const std::vector<float>& noise) {
    const int across = (options_.width + tile_edge - 1) / tile_edge;
    std::vector<double> squares(static_cast<std::size_t>(across * ((options_.height + tile_edge - 1) / tile_edge)));
    std::vector<int> pixels(squares.size());
    for (int y = 0; y < options_.height; ++y)
      for (int x = 0; x < options_.width; ++x) {
        const auto tile = static_cast<std::size_t>(y / tile_edge * across + x / tile_edge);
        const auto n = static_cast<double>(noise[index(x, y)]);
        squares[tile] += n * n;
        ++pixels[tile];
      }
    double worst = 0;
    for (std::size_t t = 0; t < squares.size(); ++t)
      worst = std::max(worst, squares[t] / pixels[t]);
    const double all = std::accumulate(squares.begin(), squares.end(), 0.0);
    picture_.noise = static_cast<float>(std::sqrt(all / static_cast<double>(noise.size())));
    picture_.worst_noise = static_cast<float>(std::sqrt(worst));
  }

  // All pixels, rows in parallel.
  template <class Pixel> void each_row(Pixel&& pixel) {
    tbb::parallel_for(0, options_.height, [&](int y) {
      std::uint64_t rays = 0;
      for (int x = 0; x < options_.width; ++x)
        pixel(x, y, rays);
      rays_ += rays;
      const int done = ++rows_done_;
      if (const std::unique_lock lock(telling_, std::try_to_lock); lock && *progress_)
        (*progress_)(done / (5.0 * options_.height));
    });
  }

  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(options_.width) + static_cast<std::size_t>(x);
  }
  [[nodiscard]] std::size_t nearest_index(int x, int y) const { // in the picture
    return index(std::clamp(x, 0, options_.width - 1), std::clamp(y, 0, options_.height - 1));
  }

  const PathTracer* tracer_;
  CameraRays rays_of_;
  DrawOptions options_;
  const Progress* progress_;
  float pixel_angle_;
  std::vector<Hit> first_;
  std::vector<Colour> certain_; // in the middles of the pixels
  std::vector<float> covered_;  // likewise
  std::vector<char> near_edge_; // by pixel
  std::vector<int> samples_;
  std::array<Layer, 2> layers_;
  std::vector<Halves> whole_; // all light there
  Picture picture_;
  std::atomic<std::uint64_t> rays_ = 0;
  std::atomic<int> rows_done_ = 0;
  std::mutex telling_;
};

} // namespace

Picture draw_denoised(const World& world, const Camera& camera, const PathTracer& tracer, const DrawOptions& options,
                      const Progress& progress) {
  return Painter(world, camera, tracer, options, progress).paint();
}

} // namespace sheet::render
