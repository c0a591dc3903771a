// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/borne_layers.h"

#include <algorithm>

namespace sheet {

namespace {

constexpr double least_over = 0.5; // cosine between up and the normal of what lies on a layer

// Of each vertex, whether the sum of its triangles' normals points up.
std::vector<char> faces_up(std::span<const Vector3> x, std::span<const Corners> triangles, const Vector3& up) {
  std::vector<double> area(x.size(), 0); // seen from above, with its sign
  for (const Corners& c : triangles)
    for (const std::uint32_t v : c)
      area[v] += up.dot((x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]));
  std::vector<char> faces(x.size());
  std::ranges::transform(area, faces.begin(), [](double a) { return a > 0 ? 1 : 0; });
  return faces;
}

bool lies_on_triangle(const ContactSpring& spring, const Vector3& up) {
  return spring.of_vertex() && spring.normal.dot(up) > least_over;
}

// Whether most of the triangle under a vertex is so.
bool is_so(const std::vector<char>& of_vertices, const ContactSpring& spring) {
  double part = 0;
  for (std::size_t i = 1; i < 4; ++i)
    part -= of_vertices[spring.vertices[i]] != 0 ? spring.weights[i] : 0;
  return part >= 0.5;
}

} // namespace

std::vector<char> borne_layers(std::span<const Vector3> positions, std::span<const Corners> triangles,
                               std::span<const ContactSpring> contacts, const Vector3& up) {
  std::vector<ContactSpring> on;
  std::ranges::copy_if(contacts, std::back_inserter(on), [&](const auto& s) { return lies_on_triangle(s, up); });
  if (on.empty())
    return {};
  std::vector<char> borne(positions.size(), 0);
  std::vector<char> bears = faces_up(positions, triangles, up);
  for (bool more = true; more;) { // a layer in each round
    more = false;
    for (const ContactSpring& spring : on)
      if (const std::uint32_t v = spring.vertices[0]; borne[v] == 0 && is_so(bears, spring)) {
        borne[v] = bears[v] = 1;
        more = true;
      }
  }
  return borne;
}

} // namespace sheet
