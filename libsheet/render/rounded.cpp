// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/rounded.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace sheet::render {
namespace {

std::uint64_t key(std::uint32_t a, std::uint32_t b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
}

// Adds the middles of edges, each once.
class Middles {
public:
  Middles(Surface& surface, std::vector<float>& roundness) : surface_(&surface), roundness_(&roundness) {}

  std::uint32_t of(std::uint32_t a, std::uint32_t b) {
    const auto [found, is_new] = points_.try_emplace(key(a, b), static_cast<std::uint32_t>(surface_->positions.size()));
    if (is_new)
      add(std::min(a, b), std::max(a, b));
    return found->second;
  }

private:
  void add(std::uint32_t a, std::uint32_t b) {
    Surface& s = *surface_;
    const std::uint32_t source = source_of(s.source_vertex[a], s.source_vertex[b]);
    const Vector3 along = s.positions[b] - s.positions[a];
    const Vector3 na = s.normals[a].cast<double>(), nb = s.normals[b].cast<double>();
    const Vector3 rise = (along.dot(nb) * nb - along.dot(na) * na) / 8;
    const double most = 0.5 * static_cast<double>(s.thickness[source]);
    const double round = static_cast<double>((*roundness_)[source]) * (rise.norm() > most ? most / rise.norm() : 1.0);
    const double size = along.squaredNorm();
    const Vector3 lean = size > 0 ? Vector3(2 * along.dot(na + nb) / size * along) : Vector3(Vector3::Zero());
    const Vector3 normal = na + nb - round * lean;
    s.positions.push_back(0.5 * (s.positions[a] + s.positions[b]) + round * rise);
    s.normals.push_back(normal.norm() > 1e-6 ? Vec(normal.normalized().cast<float>()) : s.normals[a]);
    s.source_vertex.push_back(source);
  }

  // The vertex of the sheet between two; around the rim's bead they are the same.
  std::uint32_t source_of(std::uint32_t a, std::uint32_t b) {
    if (a == b)
      return a;
    std::vector<float>& thickness = surface_->thickness;
    const auto [found, is_new] = sources_.try_emplace(key(a, b), static_cast<std::uint32_t>(thickness.size()));
    if (is_new) {
      thickness.push_back(0.5F * (thickness[a] + thickness[b]));
      roundness_->push_back(0.5F * ((*roundness_)[a] + (*roundness_)[b]));
    }
    return found->second;
  }

  Surface* surface_;
  std::vector<float>* roundness_;
  std::unordered_map<std::uint64_t, std::uint32_t> points_, sources_;
};

} // namespace

Surface rounded(const Surface& surface, std::vector<float>& roundness) {
  Surface result = surface;
  result.triangles.clear();
  result.source_triangle.clear();
  result.on_bead.clear();
  result.liquids.clear();
  Middles middles(result, roundness);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto [a, b, c] = surface.triangles[t];
    const std::uint32_t ab = middles.of(a, b), bc = middles.of(b, c), ca = middles.of(c, a);
    for (const Corners& part : {Corners{a, ab, ca}, Corners{ab, b, bc}, Corners{ca, bc, c}, Corners{ab, bc, ca}}) {
      result.triangles.push_back(part);
      result.source_triangle.push_back(surface.source_triangle[t]);
      result.on_bead.push_back(surface.on_bead[t]);
      if (!surface.liquids.empty())
        result.liquids.push_back(surface.liquids[t]);
    }
  }
  return result;
}

} // namespace sheet::render
