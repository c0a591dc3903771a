// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/quality.h"

#include <algorithm>
#include <cmath>

#include "libsheet/solve/step_stage.h"

namespace sheet {

namespace {

struct Factors {
  double edges, tolerance;
};

Factors factors_of(Quality quality) {
  switch (quality) {
  case Quality::draft:
    return {.edges = 2, .tolerance = 3};
  case Quality::normal:
    return {.edges = 1, .tolerance = 1};
  case Quality::fine:
    return {.edges = 0.5, .tolerance = 0.3};
  }
  return {.edges = 1, .tolerance = 1};
}

} // namespace

Scene at_quality(Scene scene, Quality quality) {
  constexpr int fewest_segments = 3;
  const double factor = factors_of(quality).edges;
  if (factor == 1)
    return scene;
  for (scene::SheetTable& sheet : scene.sheets) {
    if (sheet.edge_length) {
      const auto size = size_of(sheet.shape);
      const double longest = size ? std::max(size->smallest, *sheet.edge_length) : *sheet.edge_length * factor;
      sheet.edge_length = std::min(*sheet.edge_length * factor, longest);
    } else if (sheet.segments) {
      for (int& n : *sheet.segments)
        n = std::max(std::min(n, fewest_segments), static_cast<int>(std::lround(n / factor)));
    }
  }
  return scene;
}

double tolerance_at(Quality quality) { return factors_of(quality).tolerance * default_tolerance; }

} // namespace sheet
