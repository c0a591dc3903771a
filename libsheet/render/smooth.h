// SPDX-License-Identifier: GPL-3.0-or-later
// Smooths noisy light over points of the same surface: the edge-avoiding a-trous wavelet filter [Dammertz et al. 2010]
// with weights from the variance of the light [Schied et al. 2017], which is known from two halves of the samples
// [Rousselle et al. 2012].
#pragma once
#include <vector>

#include "libsheet/render/image.h"

namespace sheet::render {

// What tells points of different surfaces apart.
struct SurfacePoint {
  Vec normal = Vec::Zero(), position = Vec::Zero();
  float reach = 0;       // the distance that a pixel spans there, in units of the position
  std::uint32_t way = 0; // points of different ways have nothing in common; 0: there is no surface
  std::uint32_t end = 0; // points of different ways that end in the same surface have some of the light in common
};

// 1 for points of one plane, 0 for those of different surfaces; `pixels` apart.
[[nodiscard]] float likeness(const SurfacePoint& a, const SurfacePoint& b, float pixels);

// Means of the two halves of a point's samples.
struct Halves {
  Colour a = Colour::Zero(), b = Colour::Zero();
  void add(const Colour& weight, const Halves& other) {
    a += weight * other.a;
    b += weight * other.b;
  }
  [[nodiscard]] Colour mean() const { return 0.5F * (a + b); }
};

// The mean of a quantity of points over those around (x, y) that show the same surface, and how many of even weight
// would tell it as well, about 1 to 14.
struct MeanAround {
  float mean, points;
};
[[nodiscard]] MeanAround mean_around(const std::vector<float>& values, const std::vector<SurfacePoint>& points,
                                     int width, int x, int y);

// Points row by row; so many samples each.
void smooth(std::vector<Halves>& light, const std::vector<SurfacePoint>& points, const std::vector<int>& samples,
            int width);

} // namespace sheet::render
