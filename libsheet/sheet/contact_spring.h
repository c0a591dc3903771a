// SPDX-License-Identifier: GPL-3.0-or-later
// The springs between near features of a sheet, as a frame carries them (formats/sheet.md, section 5, contact_*): a
// vertex and a triangle, or two edges.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/geometry/types.h"

namespace sheet {

// Σ weight x position of four vertices whose weights sum to 0 [m].
[[nodiscard]] inline Vector3 contact_offset(const std::array<std::uint32_t, 4>& vertices,
                                            const std::array<double, 4>& weights, std::span<const Vector3> positions) {
  Vector3 c = Vector3::Zero();
  for (std::size_t i = 1; i < 4; ++i) // from the first vertex, so that far from the origin no digits are lost
    c += weights[i] * (positions[vertices[i]] - positions[vertices[0]]);
  return c;
}

// Whether a triangle is part of a layer, as against a crumb of a strand, which is thicker than 4 edges: where layers
// flow the rest distances of springs go with the thickness of layers. Volume [m³], area [m²].
[[nodiscard]] inline bool of_layer(double volume, double area) {
  return volume * volume < 16 * (4 / std::numbers::sqrt3) * area * area * area;
}

struct ContactSpring {
  std::array<std::uint32_t, 4> vertices{};
  std::array<double, 4> weights{}; // their sum is 0
  Vector3 normal = Vector3::UnitZ();
  double rest = 0;                   // of the offset along the normal [m]
  Vector3 anchor = Vector3::Zero();  // the offset at which nothing pulls sideways [m]
  std::array<double, 2> stiffness{}; // normal, tangential [N/m]
  double since = undated;            // when its features came to touch [s]; of contacts that become one, the earliest

  static constexpr double undated = std::numeric_limits<double>::infinity();
  static constexpr double always = -undated; // of a weld, which never parts
  [[nodiscard]] bool welded() const { return since == always; }

  // Between vertices[0] and the triangle of the others; else between the first two and the last two.
  [[nodiscard]] bool of_vertex() const { return weights[0] == 1; }
  // The corner with which the other feature begins.
  [[nodiscard]] std::size_t second_feature() const { return of_vertex() ? 1 : 2; }
  // From one feature to the other, Σ weight x position [m].
  [[nodiscard]] Vector3 offset(std::span<const Vector3> positions) const {
    return contact_offset(vertices, weights, positions);
  }
  // Σ weight x of(vertex).
  template <class OfVertex> [[nodiscard]] Vector3 sum(OfVertex of) const {
    Vector3 result = Vector3::Zero();
    for (std::size_t i = 0; i < 4; ++i)
      result += weights[i] * of(vertices[i]);
    return result;
  }
  // What of the rest distance goes with the layers' thickness: all, unless remeshing or what other springs bore has
  // made it negative [m].
  [[nodiscard]] double rest_of_layers() const { return std::max(rest, 0.0); }
  // How much farther the features are apart than at rest, given their offset [m].
  [[nodiscard]] double gap(const Vector3& offset) const { return normal.dot(offset) - rest; }
  // How far they have slid along each other [m].
  [[nodiscard]] Vector3 slide(const Vector3& offset) const { return along(offset - anchor); }
  // A vector without its part along the normal.
  [[nodiscard]] Vector3 along(const Vector3& vector) const { return vector - normal.dot(vector) * normal; }
  // adheres: it pulls, too, as welds always do; else it only pushes [N/m].
  [[nodiscard]] double normal_stiffness(double gap, bool adheres) const {
    return adheres || welded() || gap < 0 ? stiffness[0] : 0;
  }
  // (libsheet/energy/contact.h), if its rest distance is longer by so much [J].
  [[nodiscard]] double energy(const Vector3& offset, bool adheres, double longer = 0) const {
    const double g = gap(offset) - longer;
    return 0.5 * normal_stiffness(g, adheres) * g * g + 0.5 * stiffness[1] * slide(offset).squaredNorm();
  }
  // The area that the spring stands for, given those of the vertices (a third of their triangles'): half of its
  // vertex', as the vertices of both layers get springs; of edges half of the mean of their vertices' [m²].
  [[nodiscard]] double area(std::span<const double> of_vertices) const {
    const auto of = [&](std::size_t i) { return of_vertices[vertices[i]]; };
    return of_vertex() ? 0.5 * of(0) : 0.125 * (of(0) + of(1) + of(2) + of(3));
  }
  // Of its vertex, given the vertices', and of the triangle on which that stands, together; of edges of both features
  // [m]. Of a crumb what it was at the start of the step. Triangle: its volume [m³] (0: of edges), its area there and
  // now [m²].
  [[nodiscard]] double thickness(std::span<const double> of_vertices, double volume, double start_area,
                                 double area) const {
    if (volume == 0)
      return 2 * mean(of_vertices);
    return of_vertices[vertices[0]] + volume / (of_layer(volume, start_area) ? area : start_area);
  }
  // Mean of a value over both features.
  [[nodiscard]] double mean(std::span<const double> of_vertices) const {
    return 0.5 * mean_of_corners(0, 4, of_vertices);
  }
  // Mean over one of them, whose corners are first to last - 1.
  template <class Value>
  [[nodiscard]] Value mean_of_corners(std::size_t first, std::size_t last, std::span<const Value> of_vertices) const {
    Value sum = std::abs(weights[first]) * of_vertices[vertices[first]];
    for (std::size_t i = first + 1; i < last; ++i)
      sum += std::abs(weights[i]) * of_vertices[vertices[i]];
    return sum;
  }
};

// None if the frame has no contact arrays.
[[nodiscard]] std::vector<ContactSpring> read_springs(const formats::Frame& frame);
// Replaces the frame's springs; without any, its contact arrays go. contact_since is there if the springs have dates:
// all have, or none.
void write_springs(formats::Frame& frame, std::span<const ContactSpring> springs);

} // namespace sheet
