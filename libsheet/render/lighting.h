// SPDX-License-Identifier: GPL-3.0-or-later
// Light from far away: a sky, or an image of the surroundings, and softboxes. Radiance 1 lights a white matte surface
// to white.
#pragma once
#include <string>
#include <vector>

#include "libsheet/render/image.h"
#include "libsheet/render/sampler.h"
#include "libsheet/render/types.h"

namespace sheet::render {

// A rectangle infinitely far away: directions whose central projection on the plane at distance 1 along `basis.third`
// lies within half_width, half_height. Its radiance is even but for its edges, towards which it fades over `softness`.
struct Softbox {
  Basis basis;
  float half_width, half_height;
  Colour radiance;
  float softness;
  // 0 outside, 1 within.
  [[nodiscard]] float brightness(const Vec& direction) const;
};

class Lighting {
public:
  // The built-in studio: a key light high on the left of the camera, a narrow one behind on its right, a bright sky; or
  // the first two on the other sides. `to_camera`, `up`: where the camera stands as seen from what it looks at.
  static Lighting studio(const Vec& to_camera, const Vec& up, bool from_right = false);
  // The same radiance from everywhere.
  static Lighting uniform(float radiance);
  // An image of all directions: longitude across, the upper edge is up. -to_camera, turned level, is its middle. Then
  // it is turned about `up`, counter-clockwise as seen from above [rad].
  static Lighting surroundings(Image image, const Vec& to_camera, const Vec& up, float turn = 0);

  struct Light {
    Colour radiance;
    float density; // of sample() by solid angle [1/sr], about in proportion to the radiance
  };
  // What a path that comes from a surface sees in that direction.
  [[nodiscard]] Light at(const Vec& direction) const;
  // What the camera sees behind everything: the same without softboxes.
  [[nodiscard]] Colour backdrop(const Vec& direction) const;
  // The same as the radiance of at(), blurred by a lobe cos^4 (some 30 degrees to all sides): for paths that light
  // sampling cannot help.
  [[nodiscard]] Colour softened(const Vec& direction) const;

  // The mean over all directions, of the luminance.
  [[nodiscard]] float mean() const { return mean_; }

  struct Sample {
    Vec direction;
    Light light;
  };
  // A direction; `choice` in [0, 1).
  [[nodiscard]] Sample sample(float choice, Point2 point) const;

private:
  Lighting(Image map, const Basis& axes, std::vector<Softbox> boxes);
  void share_out();
  void soften();
  [[nodiscard]] Vec from_map(float x, float y) const;
  [[nodiscard]] Point2 to_map(const Vec& direction) const; // in [0, 1)
  [[nodiscard]] Light at(const Vec& direction, Point2 on_map) const;
  [[nodiscard]] Colour light_of_boxes(const Vec& direction) const;
  [[nodiscard]] float map_density(Point2 on_map) const;

  Image map_, soft_map_;
  float mean_ = 0;
  Basis axes_; // third is up, first is the middle of the map
  std::vector<Softbox> boxes_;
  // Cells of the map: their power summed up along each row, and the rows' sums.
  int columns_ = 0, rows_ = 0;
  std::vector<float> row_sums_, cell_sums_;
  float map_share_ = 1;         // of samples that go to the map
  std::vector<float> box_sums_; // shares of the boxes summed up, by their power; from map_share_ to 1
};

} // namespace sheet::render
