// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/sights.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "libsheet/render/framing.h"
#include "libsheet/render/world.h"

namespace sheet::render {

Sights::Sights(std::vector<Vector3> toward) : toward_(std::move(toward)) {
  const std::size_t cameras = toward_.size();
  for (std::size_t i = 0; i < cameras; ++i)
    toward_.push_back(-toward_[i]);
  hidden_by_.resize(toward_.size());
}

void Sights::add(const formats::Frame& frame, const Scene* scene, const std::vector<SolidMesh>& meshes) {
  constexpr std::size_t most_points = 60; // of a frame
  if (toward_.empty() || meshes.empty())
    return;
  Box box;
  std::vector<Eigen::Isometry3d> motions;
  for (const SolidMesh& mesh : meshes) {
    motions.push_back(motion_of(scene->solids[mesh.solid], frame.time));
    for (const Vector3& p : mesh.positions)
      box.add(motions.back() * p);
  }
  const auto x = positions(frame);
  for (const Vector3& p : x)
    box.add(p);
  const World solids({}, meshes, motions, {}, box);
  const std::vector<double> thickness = vertex_thickness(frame);
  const std::size_t stride = frame.triangles / most_points + 1;
  for (std::size_t t = 0; t < frame.triangles; t += stride, ++points_) {
    const std::uint32_t vertex = sheet::triangles(frame)[t][0];
    for (std::size_t i = 0; i < toward_.size(); ++i) {
      const Vector3 face = x[vertex] + thickness[vertex] / 2 * toward_[i];
      const Hit hit = solids.nearest({solids.to_world(face), toward_[i].cast<float>()});
      if (!hit.anything())
        continue;
      const std::size_t solid = hit.id - first_solid_id;
      hidden_by_[i].resize(std::max(hidden_by_[i].size(), solid + 1));
      ++hidden_by_[i][solid];
    }
  }
}

std::vector<std::size_t> Sights::enclosing(bool in_picture) const {
  std::vector<std::size_t> result;
  const auto places = std::span(hidden_by_).first(in_picture ? toward_.size() : toward_.size() / 2);
  for (std::size_t solid = 0; !hidden_by_.empty() && solid < hidden_by_[0].size(); ++solid)
    if (std::ranges::all_of(places, [&](const std::vector<std::size_t>& hidden) {
          return solid < hidden.size() && hidden[solid] > 0 && 3 * hidden[solid] >= 2 * points_;
        }))
      result.push_back(solid);
  return result;
}

std::size_t Sights::best(const std::vector<std::size_t>& left_out) const {
  std::vector<std::size_t> seen;
  for (std::size_t i = 0; i < toward_.size() / 2; ++i) {
    std::size_t hidden = std::accumulate(hidden_by_[i].begin(), hidden_by_[i].end(), std::size_t{0});
    for (const std::size_t solid : left_out)
      hidden -= hidden_by_[i][solid];
    seen.push_back(points_ - hidden);
  }
  if (seen.empty())
    return 0;
  const std::size_t most = *std::ranges::max_element(seen);
  return static_cast<std::size_t>(std::ranges::find_if(seen, [&](std::size_t points) { return 2 * points >= most; }) -
                                  seen.begin());
}

} // namespace sheet::render
