// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/sheet/carried_springs.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "libsheet/sheet/contact_spring.h"

namespace sheet {

using formats::Array;
using formats::Frame;

namespace {

constexpr std::array<std::string_view, 7> names = {"contact_vertex", "contact_weight", "contact_normal",
                                                   "contact_rest",   "contact_anchor", "contact_stiffness",
                                                   "contact_since"};

using Four = std::array<std::uint32_t, 4>;
using Weights = std::array<double, 4>;

} // namespace

bool CarriedSprings::has(std::string_view array) { return std::find(names.begin(), names.end(), array) != names.end(); }

CarriedSprings::CarriedSprings(const Frame& frame) {
  const Array* vertices = frame.find("contact_vertex");
  if (vertices == nullptr || vertices->rows == 0)
    return;
  for (const std::string_view name : names)
    if (const Array* array = frame.find(name)) // contact_since may be absent
      arrays_.push_back(*array);
  const auto corners = arrays_[0].values<Four>();
  const auto weights = arrays_[1].values<Weights>();
  const auto x = positions(frame);
  for (std::uint64_t i = 0; i < corners.size(); ++i)
    springs_.push_back({i, corners[i], weights[i], contact_offset(corners[i], weights[i], x)});
}

void CarriedSprings::move(std::span<const std::uint32_t> successor) {
  std::erase_if(springs_, [&](Spring& spring) {
    for (std::uint32_t& v : spring.vertices)
      v = successor[v];
    return std::find(spring.vertices.begin(), spring.vertices.end(), no_index) != spring.vertices.end() ||
           !merge(spring);
  });
}

// False if the features share a vertex.
bool CarriedSprings::merge(Spring& spring) {
  const std::size_t second = spring.second_feature();
  for (std::size_t i = 1; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (spring.vertices[i] == no_index || spring.vertices[i] != spring.vertices[j])
        continue;
      if (j < second && i >= second)
        return false;
      // The first edge keeps its second place: a weight of 1 in the first one would make it a vertex.
      const auto [keeps, loses] = i < second ? std::pair(i, j) : std::pair(j, i);
      spring.weights[keeps] += std::exchange(spring.weights[loses], 0.0);
      spring.vertices[loses] = no_index;
    }
  return true;
}

// Takes the vertices that are missing from triangles at those that are there; springs for which there is none go.
std::vector<CarriedSprings::Spring> CarriedSprings::completed(std::vector<Spring> springs, const Frame& frame) {
  const auto lacks = [](const Spring& s) {
    return std::find(s.vertices.begin(), s.vertices.end(), no_index) != s.vertices.end();
  };
  if (std::none_of(springs.begin(), springs.end(), lacks))
    return springs;
  const auto all = triangles(frame);
  std::vector<std::vector<std::uint32_t>> at(frame.vertices); // the triangles of each vertex
  for (std::uint32_t t = 0; t < all.size(); ++t)
    for (const std::uint32_t v : all[t])
      at[v].push_back(t);
  const auto complete = [&](Spring& s, std::size_t begin, std::size_t end) {
    const auto has = [](auto first, auto last, std::uint32_t v) { return std::find(first, last, v) != last; };
    const auto first = s.vertices.begin() + static_cast<std::ptrdiff_t>(begin),
               last = s.vertices.begin() + static_cast<std::ptrdiff_t>(end);
    if (!has(first, last, no_index))
      return true;
    const auto there = std::find_if(first, last, [](std::uint32_t v) { return v != no_index; });
    for (const std::uint32_t t : at[*there]) { // one of equal vertices has kept its place
      const Corners& c = all[t];
      if (!std::all_of(first, last, [&](std::uint32_t v) { return v == no_index || has(c.begin(), c.end(), v); }))
        continue;
      Four made = s.vertices;
      for (std::size_t i = begin; i < end; ++i)
        if (made[i] == no_index)
          if (const auto other =
                  std::find_if(c.begin(), c.end(), [&](std::uint32_t v) { return !has(made.begin(), made.end(), v); });
              other != c.end())
            made[i] = *other;
      s.vertices = made;
      if (!has(first, last, no_index))
        return true;
    }
    return false;
  };
  std::erase_if(springs,
                [&](Spring& s) { return !complete(s, 0, s.second_feature()) || !complete(s, s.second_feature(), 4); });
  return springs;
}

void CarriedSprings::put(Frame& frame) const {
  if (arrays_.empty())
    return;
  const auto x = positions(static_cast<const Frame&>(frame));
  const std::vector<Spring> springs = completed(springs_, frame);
  for (const Array& old : arrays_) {
    Array made =
        formats::make_array(old.name, old.place, old.type, old.components, old.unit, old.transfer, springs.size());
    const std::size_t size = formats::size_of(old.type) * old.components;
    for (std::size_t i = 0; i < springs.size(); ++i)
      std::memcpy(made.data.data() + i * size, old.data.data() + springs[i].row * size, size);
    frame.put(std::move(made));
  }
  const auto corners = frame.find("contact_vertex")->values<Four>();
  const auto weights = frame.find("contact_weight")->values<Weights>();
  const auto normals = frame.find("contact_normal")->values<Eigen::Vector3d>();
  const auto rest = frame.find("contact_rest")->values<double>();
  const auto anchors = frame.find("contact_anchor")->values<Eigen::Vector3d>();
  for (std::size_t i = 0; i < springs.size(); ++i) {
    corners[i] = springs[i].vertices;
    weights[i] = springs[i].weights;
    const Eigen::Vector3d change = contact_offset(corners[i], weights[i], x) - springs[i].offset;
    rest[i] += normals[i].dot(change);
    anchors[i] += change;
  }
}

} // namespace sheet
