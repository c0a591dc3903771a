// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/remesh/thickness.h"

#include <algorithm>
#include <numeric>

#include <Eigen/Dense>

namespace sheet::remesh {

ValueSlope slope_of(const ValueAt& triangle, std::span<const ValueAt> beside) {
  Eigen::Matrix2d left = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  ValueSlope result;
  for (const auto& [middle, value] : beside) {
    const Eigen::Vector2d to = middle - triangle.middle;
    const double rise = value - triangle.value;
    left += to * to.transpose();
    right += rise * to;
    result.least = std::min(result.least, rise);
    result.most = std::max(result.most, rise);
  }
  if (result.most > result.least) {
    left.diagonal().array() += 1e-9 * left.trace(); // one neighbour, or all in a line: no slope across
    result.slope = left.inverse() * right;
  }
  return result;
}

void find_rises(const ValueSlope& slope, std::span<const Eigen::Vector2d> ways, std::span<double> rises) {
  double scale = 1;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const double rise = ways[i].isZero(0) ? 0 : slope.slope.dot(ways[i]);
    if (rise > slope.most || rise < slope.least)
      scale = std::min(scale, (rise > 0 ? slope.most : slope.least) / rise);
    rises[i] = rise;
  }
  for (double& rise : rises)
    rise *= scale;
}

bool share_volume(Edit& edit, std::span<const double> areas_removed, std::span<const double> volumes_removed,
                  std::span<const double> areas_added, double limit) {
  const std::size_t old_count = areas_removed.size(), new_count = areas_added.size();
  const double volume = std::accumulate(volumes_removed.begin(), volumes_removed.end(), 0.0);
  const double mean = volume / std::accumulate(areas_added.begin(), areas_added.end(), 0.0);
  edit.volumes.assign(new_count, 0);
  double total = 0;
  for (std::size_t i = 0; i < new_count; ++i) {
    double weighted = 0, covered = 0;
    for (std::size_t j = 0; j < old_count; ++j) {
      const double overlap = edit.overlap[i * old_count + j];
      if (!(overlap > 0 && areas_removed[j] > 0)) // a triangle without area covers nothing
        continue;
      weighted += overlap * (volumes_removed[j] / areas_removed[j] + edit.rise[i * old_count + j]);
      covered += overlap;
    }
    edit.volumes[i] = (covered > 0 ? weighted / covered : mean) * areas_added[i];
    total += edit.volumes[i];
  }
  const double scale = volume / total;
  if (!(scale <= limit && scale >= 1 / limit))
    return false;
  double others = 0;
  const auto largest = std::max_element(edit.volumes.begin(), edit.volumes.end());
  for (auto it = edit.volumes.begin(); it != edit.volumes.end(); ++it) {
    *it *= scale;
    if (it != largest)
      others += *it;
  }
  *largest = volume - others;
  return *largest > 0 && std::all_of(edit.volumes.begin(), edit.volumes.end(), [](double v) { return v > 0; });
}

std::vector<double> share_mean(const Edit& edit, std::span<const double> areas_removed,
                               std::span<const double> volumes_removed, std::span<const double> values,
                               std::span<const double> rises) {
  const std::size_t old_count = areas_removed.size(), new_count = edit.volumes.size();
  double volume = 0, sum = 0, shared = 0;
  for (std::size_t j = 0; j < old_count; ++j) {
    volume += volumes_removed[j];
    sum += volumes_removed[j] * values[j];
  }
  std::vector<double> means(new_count);
  for (std::size_t i = 0; i < new_count; ++i) {
    double weighted = 0, given = 0;
    for (std::size_t j = 0; j < old_count; ++j) {
      const std::size_t k = i * old_count + j;
      if (!(edit.overlap[k] > 0 && areas_removed[j] > 0))
        continue;
      const double piece = edit.overlap[k] * (volumes_removed[j] / areas_removed[j] + edit.rise[k]);
      weighted += piece * (values[j] + rises[k]);
      given += piece;
    }
    means[i] = given > 0 ? weighted / given : sum / volume;
    shared += edit.volumes[i] * means[i];
  }
  const double least = *std::ranges::min_element(values);
  for (double& mean : means) {
    mean += (sum - shared) / volume;
    if (least > 0) // stays so, whatever the volumes
      mean = std::max(mean, 0.5 * least);
  }
  return means;
}

} // namespace sheet::remesh
