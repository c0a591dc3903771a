// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/inner_faces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "libsheet/scene/frame_liquids.h"
#include "libsheet/sheet/contact_spring.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::scene {

namespace {

// Unit normals; 0 at a vertex whose triangles cancel.
std::vector<Vector3> vertex_normals(const formats::Frame& frame) {
  const auto x = positions(frame);
  std::vector<Vector3> normals(x.size(), Vector3::Zero());
  for (const Corners& c : triangles(frame)) {
    const Vector3 twice = (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]);
    for (const std::uint32_t v : c)
      normals[v] += twice;
  }
  for (Vector3& n : normals)
    if (n.squaredNorm() > 0)
      n.normalize();
  return normals;
}

} // namespace

std::vector<double> inner_faces(const Scene& scene, const formats::Frame& frame) {
  if (!layers_flow(scene))
    return {};
  const std::vector<ContactSpring> springs = read_springs(frame);
  if (springs.empty())
    return {};
  const std::vector<std::uint32_t> liquids = FrameLiquids(scene, frame).numbers_at_vertices(frame);
  const std::vector<Vector3> normals = vertex_normals(frame);
  std::vector<std::array<double, 2>> covered(frame.vertices, {0, 0}); // the positive and the negative face
  for (const ContactSpring& s : springs) {
    if (!liquids.empty() && liquids[s.vertices[0]] != liquids[s.vertices[s.second_feature()]])
      continue;
    for (std::size_t i = 0; i < 4; ++i) {
      const double towards = -s.weights[i] * s.normal.dot(normals[s.vertices[i]]); // the other feature
      covered[s.vertices[i]][towards > 0 ? 0 : 1] += std::abs(towards);
    }
  }
  std::vector<double> faces;
  for (const auto& [positive, negative] : covered)
    faces.push_back(std::min(1.0, positive) + std::min(1.0, negative));
  return faces;
}

} // namespace sheet::scene
