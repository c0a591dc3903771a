// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/sheet/contact_springs.h"

#include <algorithm>
#include <cstring>

namespace sheet {

using formats::Array;
using formats::Frame;

namespace {

constexpr std::array<std::string_view, 6> names = {"contact_vertex", "contact_weight", "contact_normal",
                                                   "contact_rest",   "contact_anchor", "contact_stiffness"};

using Four = std::array<std::uint32_t, 4>;
using Weights = std::array<double, 4>;

Eigen::Vector3d offset(const Four& vertices, const Weights& weights, std::span<const Eigen::Vector3d> x) {
  Eigen::Vector3d c = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 4; ++i)
    c += weights[i] * x[vertices[i]];
  return c;
}

bool distinct(Four v) {
  std::sort(v.begin(), v.end());
  return std::adjacent_find(v.begin(), v.end()) == v.end();
}

} // namespace

bool ContactSprings::has(std::string_view array) { return std::find(names.begin(), names.end(), array) != names.end(); }

ContactSprings::ContactSprings(const Frame& frame) {
  const Array* vertices = frame.find("contact_vertex");
  if (vertices == nullptr || vertices->rows == 0)
    return;
  for (const std::string_view name : names)
    arrays_.push_back(*frame.find(name));
  const auto corners = arrays_[0].values<Four>();
  const auto weights = arrays_[1].values<Weights>();
  const auto x = positions(frame);
  for (std::uint64_t i = 0; i < corners.size(); ++i)
    springs_.push_back({i, corners[i], offset(corners[i], weights[i], x)});
}

void ContactSprings::move(std::span<const std::uint32_t> successor) {
  std::erase_if(springs_, [&](Spring& spring) {
    for (std::uint32_t& v : spring.vertices)
      v = successor[v];
    return std::find(spring.vertices.begin(), spring.vertices.end(), no_vertex) != spring.vertices.end() ||
           !distinct(spring.vertices);
  });
}

void ContactSprings::put(Frame& frame) const {
  if (arrays_.empty())
    return;
  const auto x = positions(static_cast<const Frame&>(frame));
  for (const Array& old : arrays_) {
    Array made =
        formats::make_array(old.name, old.place, old.type, old.components, old.unit, old.transfer, springs_.size());
    const std::size_t size = formats::size_of(old.type) * old.components;
    for (std::size_t i = 0; i < springs_.size(); ++i)
      std::memcpy(made.data.data() + i * size, old.data.data() + springs_[i].row * size, size);
    frame.put(std::move(made));
  }
  const auto corners = frame.find("contact_vertex")->values<Four>();
  const auto weights = frame.find("contact_weight")->values<Weights>();
  const auto normals = frame.find("contact_normal")->values<Eigen::Vector3d>();
  const auto rest = frame.find("contact_rest")->values<double>();
  const auto anchors = frame.find("contact_anchor")->values<Eigen::Vector3d>();
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    corners[i] = springs_[i].vertices;
    const Eigen::Vector3d change = offset(corners[i], weights[i], x) - springs_[i].offset;
    rest[i] += normals[i].dot(change);
    anchors[i] += change;
  }
}

} // namespace sheet
