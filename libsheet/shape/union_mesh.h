// SPDX-License-Identifier: GPL-3.0-or-later
// All layers of a frame as one body: its outer surface (solid/slab_union.h), with the frame's arrays on it.
#pragma once
#include <optional>

#include "formats/cpp/foreign_mesh.h"
#include "formats/cpp/stream_frame.h"
#include "libsheet/solid/slab_union.h"

namespace sheet {

struct UnionSettings {
  std::optional<double> voxel; // [m]; absent: a quarter of the thickness that 5 % of the area are thinner than, or more
  std::optional<double> close; // half the width of gaps that are closed [m]; absent: a quarter of the median thickness
  bool keep_voids = false;
  bool level_set = false; // instead of the mesh
};

// What a frame asks for, with what its settings leave open.
struct ChosenUnion {
  solid::UnionOptions options;
  double wanted_voxel = 0; // [m]; less than that of the options where that many voxels would be too many
};

// A surface of as many active voxels as this is what a voxel is chosen for; ten times as many are refused.
inline constexpr double most_voxels = 5e7;

// Throws Error (usage) if the voxel is so small that there would be more than ten times `most_voxels`, (bad_input) if
// the sheet is larger than numbers can tell.
[[nodiscard]] ChosenUnion choose_union(const formats::Frame& frame, const UnionSettings& settings);

// The surface of the chosen union, closed and facing outward; with "thickness" [m] at points, and the arrays of the
// frame at vertices and triangles but those that are sums (rule conserve). A point has what there is at the point of
// the sheet where it comes from: interpolated between the vertices if the array's rule is that, else what the nearest
// one of them has. A face has what the triangle has where its first point comes from.
[[nodiscard]] formats::ForeignMesh union_mesh(const formats::Frame& frame, const solid::SlabUnion& body);

// The body of a frame. Errors are those of reading OpenVDB's module.
[[nodiscard]] solid::SlabUnion unite_layers(const formats::Frame& frame, const solid::UnionOptions& options);

} // namespace sheet
