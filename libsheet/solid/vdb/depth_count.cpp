// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/vdb/depth_count.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace sheet::solid {
namespace {

constexpr double bins_of_voxel = 1024;

// Of the values that count in part.
double outermost(double last_iso) { return last_iso + 0.5; }

} // namespace

DepthCount::DepthCount(double last_iso)
    : last_iso_(last_iso), counts_(static_cast<std::size_t>(std::ceil(2 * outermost(last_iso) * bins_of_voxel)), 0) {}

void DepthCount::add(std::span<const float> values) {
  const double first = -outermost(last_iso_);
  for (const float value : values) {
    const double place = (static_cast<double>(value) - first) * bins_of_voxel;
    if (place < 0)
      ++deeper_;
    else if (place < static_cast<double>(counts_.size()))
      ++counts_[static_cast<std::size_t>(place)];
  }
}

void DepthCount::add(const DepthCount& other) {
  std::ranges::transform(counts_, other.counts_, counts_.begin(), std::plus<>());
  deeper_ += other.deeper_;
}

double DepthCount::volume(double iso) const {
  double sum = static_cast<double>(deeper_);
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    const double value = (static_cast<double>(i) + 0.5) / bins_of_voxel - outermost(last_iso_);
    sum += static_cast<double>(counts_[i]) * std::clamp(0.5 - (value - iso), 0.0, 1.0);
  }
  return sum;
}

double DepthCount::iso_of(double wanted) const {
  double low = -last_iso_, high = last_iso_;
  while (high - low > 1e-6) {
    const double middle = (low + high) / 2;
    (volume(middle) < wanted ? low : high) = middle;
  }
  return (low + high) / 2;
}

} // namespace sheet::solid
