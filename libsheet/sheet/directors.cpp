// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/sheet/directors.h"

#include <algorithm>

#include "libsheet/geometry/mean_normals.h"

namespace sheet {

using formats::Array;
using formats::Frame;
using formats::Place;

namespace {

constexpr std::string_view array_name = "director_angle";

std::uint64_t key_of(std::uint32_t a, std::uint32_t b) { return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

std::uint32_t heaviest(std::span<const Parent> parents) {
  return std::max_element(parents.begin(), parents.end(),
                          [](const Parent& a, const Parent& b) { return a.weight < b.weight; })
      ->row;
}

} // namespace

void put_director_angles(std::span<const double> angles, Frame& frame) {
  frame.erase(array_name);
  if (angles.empty()) {
    if (std::none_of(frame.arrays.begin(), frame.arrays.end(),
                     [](const Array& array) { return array.place == Place::edge; }))
      frame.edges = 0;
    return;
  }
  Array array = formats::make_standard_array(array_name, angles.size());
  std::copy(angles.begin(), angles.end(), array.values<double>().begin());
  frame.edges = angles.size();
  frame.put(std::move(array));
}

std::vector<Vector3> directors_of(const Frame& frame, const Connectivity& mesh) {
  std::vector<Vector3> directors;
  const Array* angles = frame.find(array_name);
  if (angles == nullptr)
    return directors;
  for (const EdgeFrame& edge : director_frames(mesh, positions(frame), angles->values<double>()))
    directors.push_back(edge.director);
  return directors;
}

void put_directors(std::span<const Vector3> directors, const Connectivity& mesh, Frame& frame) {
  const std::vector<EdgeFrame> means = mean_normal_frames(mesh, positions(static_cast<const Frame&>(frame)));
  std::vector<double> angles;
  angles.reserve(means.size());
  for (std::size_t e = 0; e < means.size(); ++e)
    angles.push_back(directors[e].isZero() ? 0 : means[e].angle_to(directors[e]));
  put_director_angles(angles, frame);
}

Directors::Directors(const Frame& frame) {
  if (frame.find(array_name) == nullptr)
    return;
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  const std::vector<Vector3> directors = directors_of(frame, mesh);
  by_ends_.reserve(directors.size());
  for (std::size_t e = 0; e < directors.size(); ++e)
    by_ends_.emplace(key_of(mesh.edges[e][0], mesh.edges[e][1]), directors[e]);
}

void Directors::put(const Lineage& vertices, Frame& frame) const {
  if (by_ends_.empty())
    return;
  const Connectivity mesh = connect(frame.vertices, triangles(static_cast<const Frame&>(frame)));
  std::vector<Vector3> directors(mesh.edges.size(), Vector3::Zero());
  for (std::size_t e = 0; e < directors.size(); ++e) {
    const auto known =
        by_ends_.find(key_of(heaviest(vertices[mesh.edges[e][0]]), heaviest(vertices[mesh.edges[e][1]])));
    if (known != by_ends_.end())
      directors[e] = known->second;
  }
  put_directors(directors, mesh, frame);
}

} // namespace sheet
