// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/union_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

#include "libsheet/base/error.h"
#include "libsheet/geometry/area.h"
#include "libsheet/geometry/box.h"
#include "libsheet/geometry/vertex_shares.h"
#include "libsheet/shape/export.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

namespace {

using formats::Frame;
using formats::MeshArray;
using formats::MeshPlace;
using formats::Transfer;
using solid::SlabPoint;

constexpr double band = 3, most_across = 4e6; // voxels: carrying a value to either side, and of the whole sheet

struct Part { // of the sheet: a triangle
  double thickness, area;
  Vector3 extent; // of its box
};

// By rising thickness; those without area have none.
std::vector<Part> parts_of(const Frame& frame) {
  const auto x = positions(frame);
  const auto corners = triangles(frame);
  const auto volume = volumes(frame);
  std::vector<Part> parts;
  for (std::size_t t = 0; t < corners.size(); ++t) {
    const Vector3 &a = x[corners[t][0]], &b = x[corners[t][1]], &c = x[corners[t][2]];
    const double area = TriangleArea(a, b, c).area;
    const bool has_area = std::isfinite(area) && area > 0;
    parts.push_back(
        {has_area ? volume[t] / area : 0, has_area ? area : 0, a.cwiseMax(b).cwiseMax(c) - a.cwiseMin(b).cwiseMin(c)});
  }
  std::ranges::sort(parts, {}, &Part::thickness);
  return parts;
}

// The thickness [m] that a share of the area is thinner than.
double quantile(const std::vector<Part>& parts, double share) {
  double left = 0;
  for (const Part& part : parts)
    left += share * part.area;
  for (const Part& part : parts)
    if (left -= part.area; left <= 0)
      return part.thickness;
  return parts.empty() ? 0 : parts.back().thickness;
}

// How many voxels will carry a value, if no layers touch; and what it costs to find the blocks near each triangle.
double voxels_of(const std::vector<Part>& parts, double voxel, double close) {
  constexpr double of_block = 0.1; // voxels that take as long as a block
  double volume = 0, blocks = 0;
  for (const Part& part : parts) {
    volume += 2 * part.area * (std::min(part.thickness / 2, band * voxel) + band * voxel + close);
    blocks += ((part.extent.array() + part.thickness + 2 * close) / (8 * voxel) + 1).prod();
  }
  return volume / std::pow(voxel, 3) + of_block * blocks;
}

// The wanted voxel, or the smallest one with which there are no more than `most`; not finite if there is none.
double coarse_enough(const std::vector<Part>& parts, double wanted, double close, double most) {
  const auto few = [&](double voxel) { return voxels_of(parts, voxel, close) <= most; }; // false where it is no number
  double small = wanted, large = wanted;
  while (!few(large) && std::isfinite(large))
    large *= 2;
  while (std::isfinite(large) && large / small > 1.001) {
    const double middle = std::sqrt(small) * std::sqrt(large);
    (few(middle) ? large : small) = middle;
  }
  return large;
}

// The frame's array that an array of its mesh was made from (to_foreign_mesh), or none for what was computed.
const formats::Array* source_of(const Frame& frame, const MeshArray& array) {
  std::string_view name = array.name;
  for (const std::string_view ending : {".low32", ".high32", ".array"})
    if (frame.find(name) == nullptr && name.ends_with(ending))
      name.remove_suffix(ending.size());
  return frame.find(name);
}

std::vector<double> at_points(const MeshArray& array, bool interpolated, std::span<const Corners> corners,
                              const std::vector<SlabPoint>& origins) {
  const auto components = static_cast<std::size_t>(array.components);
  std::vector<double> values(components * origins.size());
  for (std::size_t i = 0; i < origins.size(); ++i) {
    const Corners& c = corners[origins[i].triangle];
    const auto& weights = origins[i].weights;
    const auto main = static_cast<std::size_t>(std::ranges::max_element(weights) - weights.begin());
    for (std::size_t k = 0; k < components; ++k) {
      const auto of = [&](std::size_t corner) { return array.values[components * c[corner] + k]; };
      values[components * i + k] =
          interpolated ? weights[0] * of(0) + weights[1] * of(1) + weights[2] * of(2) : of(main);
    }
  }
  return values;
}

std::vector<double> at_faces(const MeshArray& array, const std::vector<Corners>& faces,
                             const std::vector<SlabPoint>& origins) {
  const auto components = static_cast<std::size_t>(array.components);
  std::vector<double> values;
  values.reserve(components * faces.size());
  for (const Corners& face : faces) {
    const auto row = array.values.begin() + static_cast<std::ptrdiff_t>(components * origins[face[0]].triangle);
    values.insert(values.end(), row, row + array.components);
  }
  return values;
}

} // namespace

ChosenUnion choose_union(const Frame& frame, const UnionSettings& settings) {
  const std::vector<Part> parts = parts_of(frame);
  const double median = quantile(parts, 0.5), close = settings.close.value_or(median / 4);
  const auto volume = volumes(frame);
  Box box;
  for (const Vector3& x : positions(frame))
    box.add(x);
  const double least = box.diagonal() / most_across;
  const double finest = quantile(parts, 0.05) / 4;
  const double wanted = settings.voxel.value_or(finest > 0 ? finest : 1);
  const double most = settings.voxel ? 10 * most_voxels : most_voxels;
  const double voxel = std::max(least, parts.empty() ? wanted : coarse_enough(parts, wanted, close, most));
  if (!std::isfinite(voxel) || !(voxel > 0))
    fail(ExitCode::bad_input, "a sheet of {:.3g} m across with layers of {:.3g} m cannot be divided into voxels",
         box.diagonal(), median);
  const double thickest = parts.empty() ? 0 : parts.back().thickness;
  if (thickest > 0 && voxel > 2 * thickest)
    fail(settings.voxel ? ExitCode::usage : ExitCode::bad_input,
         "--union: nothing is left of layers of {:.3g} m and less on voxels of {:.3g} m: {}", thickest, voxel,
         settings.voxel ? "give a smaller --voxel" : "they are too thin for a sheet of this size");
  if (settings.voxel && voxel > wanted)
    fail(ExitCode::usage, "--voxel: {:.3g} m makes some {:.0e} voxels here, too many for any memory: {:.2g} m or more",
         wanted, voxels_of(parts, wanted, close), 1.01 * voxel);
  return {{.volume = std::accumulate(volume.begin(), volume.end(), 0.0),
           .voxel = voxel,
           .close = close,
           .thickness = median,
           .keep_voids = settings.keep_voids,
           .level_set = settings.level_set,
           .time = frame.time},
          wanted};
}

solid::SlabUnion unite_layers(const Frame& frame, const solid::UnionOptions& options) {
  const auto x = positions(frame);
  const auto corners = triangles(frame);
  const std::vector<double> thickness = thickness_around(x.size(), corners, volumes(frame), [&](std::uint32_t t) {
    return TriangleArea(x[corners[t][0]], x[corners[t][1]], x[corners[t][2]]).area;
  });
  return solid::unite({x, thickness, corners}, options);
}

formats::ForeignMesh union_mesh(const Frame& frame, const solid::SlabUnion& body) {
  const formats::ForeignMesh middle = to_foreign_mesh(frame);
  formats::ForeignMesh mesh;
  mesh.time = frame.time;
  mesh.points.reserve(body.surface.points.size());
  for (const Vector3& x : body.surface.points)
    mesh.points.push_back({x.x(), x.y(), x.z()});
  mesh.triangles = body.surface.triangles;
  for (const MeshArray& array : middle.arrays) {
    const formats::Array* const source = source_of(frame, array);
    const bool computed_of_triangles = source == nullptr && array.place == MeshPlace::cell;
    if (computed_of_triangles || (source != nullptr && source->transfer == Transfer::conserve))
      continue;
    const bool interpolated = source == nullptr || source->transfer == Transfer::interpolate;
    mesh.arrays.push_back({array.name, array.place, array.components,
                           array.place == MeshPlace::point
                               ? at_points(array, interpolated, triangles(frame), body.origins)
                               : at_faces(array, mesh.triangles, body.origins)});
  }
  return mesh;
}

} // namespace sheet
