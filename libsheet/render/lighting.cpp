// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/lighting.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sheet::render {
namespace {

// The sky over the ground, as a function of the sine of the elevation.
Colour studio_sky(float sine) {
  const Colour zenith{0.26F, 0.32F, 0.42F}, horizon{0.60F, 0.63F, 0.68F}, floor{0.36F, 0.35F, 0.34F};
  if (sine < 0)
    return horizon + (floor - horizon) * smooth_step(0, 0.35F, -sine);
  return horizon + (zenith - horizon) * smooth_step(0, 0.8F, sine);
}

// Level with `up`: third is up, first goes with `forward`.
Basis level(const Vec& forward, const Vec& up) {
  Basis axes(up);
  const Vec ahead = forward - forward.dot(up) * up;
  if (ahead.norm() > 1e-4F) {
    axes.first = ahead.normalized();
    axes.second = up.cross(axes.first);
  }
  return axes;
}

// Half as bright at half_width, half_height.
Softbox softbox(const Vec& toward, const Vec& up, float half_width, float half_height, float softness,
                const Colour& radiance) {
  Softbox box{Basis(toward), half_width + softness / 2, half_height + softness / 2, radiance, softness};
  box.basis.first = up.cross(toward).normalized();
  box.basis.second = toward.cross(box.basis.first);
  return box;
}

// The solid angle density of a point chosen evenly on the rectangle.
float box_density(const Softbox& box, float x, float y) {
  const float square = 1 + x * x + y * y;
  return square * std::sqrt(square) / (4 * box.half_width * box.half_height);
}

constexpr int most_columns = 4096; // of the cells that directions are drawn from
constexpr float below_one = 0.9999999F;

// Bilinear between the centres of pixels; p in [0, 1), longitude goes round.
Colour look_up(const Image& map, Point2 p) {
  const float fx = p.x * static_cast<float>(map.width) - 0.5F, fy = p.y * static_cast<float>(map.height) - 0.5F;
  const int x = static_cast<int>(std::floor(fx)), y = static_cast<int>(std::floor(fy));
  const float wx = fx - static_cast<float>(x), wy = fy - static_cast<float>(y);
  const int left = x < 0 ? map.width - 1 : x, right = x + 1 < map.width ? x + 1 : 0;
  const int above = std::max(y, 0), below = std::min(y + 1, map.height - 1);
  return (1 - wy) * ((1 - wx) * map.at(left, above) + wx * map.at(right, above)) +
         wy * ((1 - wx) * map.at(left, below) + wx * map.at(right, below));
}

// The mean luminance of the map, bilinear, over each pixel: a small sun lights its neighbours' halves, too.
std::vector<float> luminances_around(const Image& map) {
  constexpr std::array<float, 3> weights{1 / 8.0F, 6 / 8.0F, 1 / 8.0F};
  std::vector<float> along, result; // smoothed along rows, then along columns
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      along.push_back(weights[0] * luminance(map.at(x > 0 ? x - 1 : map.width - 1, y)) +
                      weights[1] * luminance(map.at(x, y)) +
                      weights[2] * luminance(map.at(x + 1 < map.width ? x + 1 : 0, y)));
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      result.push_back(weights[0] * along[map.index(x, std::max(y - 1, 0))] + weights[1] * along[map.index(x, y)] +
                       weights[2] * along[map.index(x, std::min(y + 1, map.height - 1))]);
  return result;
}

// The same image in fewer pixels, each the mean of those that fall into it.
Image reduced(const Image& image, int columns, int rows) {
  Image result(columns, rows);
  std::vector<float> count(result.pixels.size());
  std::fill(result.pixels.begin(), result.pixels.end(), Colour::Zero());
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::size_t i = result.index(x * columns / image.width, y * rows / image.height);
      result.pixels[i] += image.at(x, y);
      ++count[i];
    }
  for (std::size_t i = 0; i < count.size(); ++i)
    result.pixels[i] /= count[i];
  return result;
}

// The index of the first entry above x in a rising list that starts anew at `begin`, and where x lies in its interval.
int search(const float* begin, int count, float x, float& place) {
  const int i = std::min(static_cast<int>(std::upper_bound(begin, begin + count, x) - begin), count - 1);
  const float below = i > 0 ? begin[i - 1] : 0.0F, width = begin[i] - below;
  place = width > 0 ? std::clamp((x - below) / width, 0.0F, 0.999999F) : 0.5F;
  return i;
}

} // namespace

float Softbox::brightness(const Vec& direction) const {
  const float z = direction.dot(basis.third);
  if (!(z > 0))
    return 0;
  const float x = half_width - std::abs(direction.dot(basis.first)) / z,
              y = half_height - std::abs(direction.dot(basis.second)) / z; // from the edges
  return x < 0 || y < 0 ? 0 : smooth_step(0, softness, x) * smooth_step(0, softness, y);
}

Lighting::Lighting(Image map, const Basis& axes, std::vector<Softbox> boxes)
    : map_(std::move(map)), axes_(axes), boxes_(std::move(boxes)) {
  columns_ = std::min(map_.width, most_columns);
  rows_ = std::min(map_.height, most_columns / 2);
  const std::vector<float> around = luminances_around(map_);
  std::vector<float> power(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0.0F);
  for (int y = 0; y < map_.height; ++y) {
    const int row = y * rows_ / map_.height;
    const float ring = std::sin(float_pi * (static_cast<float>(y) + 0.5F) / static_cast<float>(map_.height));
    for (int x = 0; x < map_.width; ++x)
      power[static_cast<std::size_t>(row * columns_ + x * columns_ / map_.width)] += around[map_.index(x, y)] * ring;
  }
  float all = 0;
  for (const float p : power)
    all += p;
  // No direction is left out: what lies between two pixels may be brighter than both cells say.
  const float floor = all > 0 ? 0.05F * all / static_cast<float>(power.size()) : 1.0F;
  float total = 0;
  cell_sums_.resize(power.size());
  for (int row = 0; row < rows_; ++row) {
    float sum = 0;
    for (int x = 0; x < columns_; ++x) {
      sum += power[static_cast<std::size_t>(row * columns_ + x)] + floor;
      cell_sums_[static_cast<std::size_t>(row * columns_ + x)] = sum;
    }
    total += sum;
    row_sums_.push_back(total);
  }
  share_out();
  soften();
}

// Directions that a matte surface chooses find the sky well by themselves; boxes they miss.
void Lighting::share_out() {
  if (boxes_.empty())
    return;
  map_share_ = 0.3F;
  float power = 0;
  for (const Softbox& box : boxes_)
    box_sums_.push_back(power += luminance(box.radiance) * box.half_width * box.half_height);
  for (float& sum : box_sums_)
    sum = map_share_ + (1 - map_share_) * sum / power;
}

void Lighting::soften() {
  constexpr int columns = 128, rows = 64, soft_columns = 16, soft_rows = 8;
  // A small sun may lie between these directions.
  const bool is_fine = map_.width > columns && map_.height > rows;
  const Image sky = is_fine ? reduced(map_, columns, rows) : map_;
  std::vector<Vec> directions;
  std::vector<Colour> power;
  std::vector<float> ring;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const float v = (static_cast<float>(y) + 0.5F) / rows;
      directions.push_back(from_map((static_cast<float>(x) + 0.5F) / columns, v));
      ring.push_back(std::sin(float_pi * v));
      power.push_back(ring.back() * (look_up(sky, to_map(directions.back())) + light_of_boxes(directions.back())));
    }
  Colour all = Colour::Zero();
  float rings = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    all += power[i];
    rings += ring[i];
  }
  mean_ = luminance(all) / rings;
  soft_map_ = Image(soft_columns, soft_rows);
  for (int y = 0; y < soft_rows; ++y)
    for (int x = 0; x < soft_columns; ++x) {
      const Vec middle =
          from_map((static_cast<float>(x) + 0.5F) / soft_columns, (static_cast<float>(y) + 0.5F) / soft_rows);
      Colour sum = Colour::Zero();
      float weights = 0;
      for (std::size_t i = 0; i < directions.size(); ++i) {
        const float cosine = std::max(0.0F, middle.dot(directions[i])), lobe = cosine * cosine * cosine * cosine;
        sum += lobe * power[i];
        weights += lobe * ring[i];
      }
      soft_map_.at(x, y) = sum / weights;
    }
}

Lighting Lighting::studio(const Vec& to_camera, const Vec& up, bool from_right) {
  Image map(4, 256);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      map.at(x, y) = studio_sky(std::cos(float_pi * (static_cast<float>(y) + 0.5F) / static_cast<float>(map.height)));
  const Basis axes = level(-to_camera, up); // first: ahead, second: left
  const Vec aside = from_right ? Vec(-axes.second) : axes.second;
  const Vec key = (-0.35F * axes.first + 0.75F * aside + 0.85F * up).normalized();
  const Vec rim = (0.95F * axes.first - 0.65F * aside + 0.45F * up).normalized();
  return {std::move(map),
          axes,
          {softbox(key, up, 0.24F, 0.30F, 0.10F, Colour(9.0F, 8.6F, 8.0F)),
           softbox(rim, up, 0.09F, 0.42F, 0.06F, Colour(6.0F, 6.3F, 6.8F))}};
}

Lighting Lighting::uniform(float radiance) {
  Image map(4, 2);
  std::fill(map.pixels.begin(), map.pixels.end(), Colour::Constant(radiance));
  return {std::move(map), Basis(Vec::UnitZ()), {}};
}

Lighting Lighting::surroundings(Image image, const Vec& to_camera, const Vec& up, float turn) {
  Basis axes = level(-to_camera, up);
  axes.first = std::cos(turn) * axes.first + std::sin(turn) * axes.second;
  axes.second = up.cross(axes.first);
  return {std::move(image), axes, {}};
}

Point2 Lighting::to_map(const Vec& direction) const {
  const float x = direction.dot(axes_.first), y = direction.dot(axes_.second), z = direction.dot(axes_.third);
  const float longitude = std::atan2(-y, x), polar = std::atan2(std::sqrt(x * x + y * y), z); // acos is rough at poles
  return {std::clamp(0.5F + longitude / (2 * float_pi), 0.0F, below_one),
          std::clamp(polar / float_pi, 0.0F, below_one)};
}

Vec Lighting::from_map(float x, float y) const {
  const float longitude = (x - 0.5F) * 2 * float_pi, polar = y * float_pi;
  return axes_.world(std::sin(polar) * std::cos(longitude), -std::sin(polar) * std::sin(longitude), std::cos(polar));
}

Colour Lighting::light_of_boxes(const Vec& direction) const {
  Colour sum = Colour::Zero();
  for (const Softbox& box : boxes_)
    sum += box.brightness(direction) * box.radiance;
  return sum;
}

Colour Lighting::backdrop(const Vec& direction) const { return look_up(map_, to_map(direction)); }
Colour Lighting::softened(const Vec& direction) const { return look_up(soft_map_, to_map(direction)); }

float Lighting::map_density(Point2 p) const {
  const int row = static_cast<int>(p.y * static_cast<float>(rows_));
  const int column = static_cast<int>(p.x * static_cast<float>(columns_));
  const auto cell = static_cast<std::size_t>(row * columns_ + column);
  const float power = cell_sums_[cell] - (column > 0 ? cell_sums_[cell - 1] : 0.0F);
  const float sine = std::sin(p.y * float_pi); // dω = 2π² sin(polar) dx dy
  return power / row_sums_.back() * static_cast<float>(columns_ * rows_) /
         (2 * float_pi * float_pi * std::max(sine, 1e-6F));
}

Lighting::Light Lighting::at(const Vec& direction) const { return at(direction, to_map(direction)); }

Lighting::Light Lighting::at(const Vec& direction, Point2 on_map) const {
  Light light{look_up(map_, on_map), map_share_ * map_density(on_map)};
  for (std::size_t i = 0; i < boxes_.size(); ++i)
    if (const Softbox& box = boxes_[i]; box.brightness(direction) > 0) {
      const float z = direction.dot(box.basis.third), share = box_sums_[i] - (i > 0 ? box_sums_[i - 1] : map_share_);
      light.density +=
          share * box_density(box, direction.dot(box.basis.first) / z, direction.dot(box.basis.second) / z);
      light.radiance += box.brightness(direction) * box.radiance;
    }
  return light;
}

Lighting::Sample Lighting::sample(float choice, Point2 point) const {
  if (choice < map_share_) {
    float x = 0, y = 0;
    const int row = search(row_sums_.data(), rows_, point.y * row_sums_.back(), y);
    const float* cells = cell_sums_.data() + static_cast<std::ptrdiff_t>(row) * columns_;
    const int column = search(cells, columns_, point.x * cells[columns_ - 1], x);
    const Point2 place{(static_cast<float>(column) + x) / static_cast<float>(columns_),
                       (static_cast<float>(row) + y) / static_cast<float>(rows_)};
    const Vec direction = from_map(place.x, place.y);
    return {direction, at(direction, {std::min(place.x, below_one), std::min(place.y, below_one)})};
  }
  const auto which = std::upper_bound(box_sums_.begin(), box_sums_.end(), choice) - box_sums_.begin();
  const Softbox& box = boxes_[std::min(static_cast<std::size_t>(which), boxes_.size() - 1)];
  const Vec direction =
      box.basis.world((2 * point.x - 1) * box.half_width, (2 * point.y - 1) * box.half_height, 1).normalized();
  return {direction, at(direction)};
}

} // namespace sheet::render
