// SPDX-License-Identifier: GPL-3.0-or-later
// The scene's solids as they are drawn: triangle meshes for what is finite, planes for half-spaces.
#pragma once
#include <cstdint>
#include <vector>

#include "libsheet/render/camera.h"
#include "libsheet/render/image.h"
#include "libsheet/scene/scene.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::render {

struct SolidMesh {
  std::size_t solid = 0;          // number in the scene
  std::vector<Vector3> positions; // [m], in the solid's own place at time 0
  std::vector<Vec> normals;       // outwards; a vertex at a sharp edge stands there once a face
  std::vector<Corners> triangles;
};

struct Plane {
  std::uint32_t id = 0;                                       // of Layers
  Vector3 point = Vector3::Zero(), normal = Vector3::UnitY(); // normal of length 1
  bool lets_light_in = false;                                 // only straight looks of the camera meet it
};

// Meshes of all finite solids of a scene. Mesh files are read; one that cannot be is an Error (io, bad_input) that
// names the solid; .vdb files are passed over with a warning.
[[nodiscard]] std::vector<SolidMesh> make_solids(const Scene& scene);
// The half-spaces at `time` [s]. Two that face each other, as walls on both sides, would keep nearly all light out:
// they let it in.
[[nodiscard]] std::vector<Plane> make_planes(const Scene& scene, double time);
// Where the solid has moved to at `time` [s].
[[nodiscard]] Eigen::Isometry3d motion_of(const scene::Solid& solid, double time);

} // namespace sheet::render
