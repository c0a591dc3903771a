// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/sights.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "libsheet/render/framing.h"
#include "libsheet/render/world.h"

namespace sheet::render {

// Numbers of those that a ray goes through, ascending, each once.
static std::vector<std::size_t> solids_along(const World& solids, const Ray& ray) {
  std::array<Face, 64> faces;
  const std::size_t count = solids.faces(ray, 0, std::numeric_limits<float>::infinity(), faces);
  std::vector<std::size_t> numbers;
  for (const Face& face : std::span(faces).first(count))
    numbers.push_back(face.id - first_solid_id);
  std::ranges::sort(numbers);
  numbers.erase(std::ranges::unique(numbers).begin(), numbers.end());
  return numbers;
}

std::size_t Sights::hidden_by(std::size_t solid, const Hiding& hiding) {
  std::size_t points = 0;
  for (const auto& [solids, count] : hiding)
    points += std::ranges::binary_search(solids, solid) ? count : 0;
  return points;
}

std::size_t Sights::hidden_without(const std::vector<std::size_t>& left_out, const Hiding& hiding) {
  std::size_t points = 0;
  for (const auto& [solids, count] : hiding)
    points += std::ranges::includes(left_out, solids) ? 0 : count;
  return points;
}

Sights::Sights(std::vector<Vector3> toward, std::span<const Vector3> normals) : toward_(std::move(toward)) {
  const std::size_t cameras = toward_.size();
  for (std::size_t i = 0; i < cameras; ++i)
    toward_.push_back(-toward_[i]);
  for (const Vector3& place : toward_)
    behind_plane_.push_back(std::ranges::any_of(normals, [&](const Vector3& n) { return n.dot(place) < 0; }));
  hiding_.resize(toward_.size());
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
      const std::vector<std::size_t> before = solids_along(solids, {solids.to_world(face), toward_[i].cast<float>()});
      if (!before.empty())
        ++hiding_[i][before];
    }
  }
}

std::vector<std::size_t> Sights::enclosing(bool in_picture) const {
  const std::size_t cameras = toward_.size() / 2;
  for (std::size_t i = cameras; in_picture && i < toward_.size(); ++i)
    if (!behind_plane_[i] && !is_most(hidden_without({}, hiding_[i])))
      return {};
  std::vector<std::size_t> result;
  if (cameras > 0)
    for (const auto& [solids, count] : hiding_[0])
      result.insert(result.end(), solids.begin(), solids.end());
  std::ranges::sort(result);
  result.erase(std::ranges::unique(result).begin(), result.end());
  std::erase_if(result, [&](std::size_t solid) {
    return !std::ranges::all_of(std::span(hiding_).first(cameras),
                                [&](const Hiding& hiding) { return is_most(hidden_by(solid, hiding)); });
  });
  return result;
}

std::size_t Sights::best(const std::vector<std::size_t>& left_out) const {
  std::vector<std::size_t> seen;
  for (std::size_t i = 0; i < toward_.size() / 2; ++i)
    seen.push_back(points_ - hidden_without(left_out, hiding_[i]));
  if (seen.empty())
    return 0;
  const std::size_t most = *std::ranges::max_element(seen);
  return static_cast<std::size_t>(std::ranges::find_if(seen, [&](std::size_t points) { return 2 * points >= most; }) -
                                  seen.begin());
}

} // namespace sheet::render
