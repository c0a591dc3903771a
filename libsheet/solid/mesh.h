// SPDX-License-Identifier: GPL-3.0-or-later
// Solids whose surface is a closed triangle mesh: the exact signed distance, from a tree of the triangles; an OpenVDB
// field of distances answers where that is enough, so its voxel size changes the speed and never the result.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "libsheet/scene/scene.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/distance.h"

namespace sheet::solid {

// The surface of a solid, triangles counter-clockwise seen from outside [m].
struct SolidSurface {
  std::vector<Vector3> points;
  std::vector<Corners> triangles;
};

// The mesh of an OBJ, OFF, PLY or STL file, or the zero level of the first level set in a .vdb file, in metres. Throws
// Error (io, bad_input) naming the file. Says in a warning what the reader dropped or merged.
[[nodiscard]] SolidSurface read_surface(const scene::SolidMesh& mesh);

// The distance of the surface in its file, checked (check.h), its field from the cache where it is there.
// `name` stands for the solid in messages. As long as somebody has it, others get the same and no file is read.
[[nodiscard]] std::shared_ptr<const SolidDistance> shared_distance(const scene::SolidMesh& mesh,
                                                                   const std::string& name);

// The same anew, without file and cache. The surface must have passed check_surface. `voxel_size` 0: chosen.
[[nodiscard]] std::unique_ptr<const SolidDistance> make_distance(SolidSurface surface, double voxel_size);

} // namespace sheet::solid
