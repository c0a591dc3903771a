// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/vdb/depth_count.h"

#include <algorithm>
#include <functional>

namespace sheet::solid {
namespace {

constexpr double outermost = DepthCount::last_iso + 0.5; // of the values that count in part
constexpr std::size_t bins_of_voxel = 1024, bins = static_cast<std::size_t>(2 * outermost * bins_of_voxel);

} // namespace

DepthCount::DepthCount() : counts_(bins, 0) {}

void DepthCount::add(std::span<const float> values) {
  for (const float value : values) {
    const double place = (static_cast<double>(value) + outermost) * bins_of_voxel;
    if (place < 0)
      ++deeper_;
    else if (place < bins)
      ++counts_[static_cast<std::size_t>(place)];
  }
}

void DepthCount::add(const DepthCount& other) {
  std::ranges::transform(counts_, other.counts_, counts_.begin(), std::plus<>());
  deeper_ += other.deeper_;
}

double DepthCount::volume(double iso) const {
  double sum = static_cast<double>(deeper_);
  for (std::size_t i = 0; i < bins; ++i) {
    const double value = (static_cast<double>(i) + 0.5) / bins_of_voxel - outermost;
    sum += static_cast<double>(counts_[i]) * std::clamp(0.5 - (value - iso), 0.0, 1.0);
  }
  return sum;
}

double DepthCount::iso_of(double wanted) const {
  double low = -last_iso, high = last_iso;
  while (high - low > 1e-6) {
    const double middle = (low + high) / 2;
    (volume(middle) < wanted ? low : high) = middle;
  }
  return (low + high) / 2;
}

} // namespace sheet::solid
