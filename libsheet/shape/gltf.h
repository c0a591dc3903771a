// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes as binary glTF 2.0 (.glb), for browsers and what else shows models [Khronos Group, glTF 2.0 specification].
#pragma once
#include <string>

#include <Eigen/Core>

#include "formats/cpp/foreign_mesh.h"

namespace sheet {

// One mesh in single precision: POSITION [m], NORMAL, and _THICKNESS [m] where the mesh has an array thickness at
// points, which is u of TEXCOORD_0, too, for programs that pass over attributes they do not know. Texture coordinates
// (ForeignMesh::texture) come before it; where they have seams (corner_texture), points there stand several times. The
// material shows both sides. Coordinates are the mesh's own; its node turns `up`, a unit vector, to +y, which is
// upwards in glTF. The time [s] is in the scene's extras. A mesh without triangles makes a scene without a mesh. Throws
// Error (bad_input) if a number is beyond single precision.
[[nodiscard]] std::string encode_gltf(const formats::ForeignMesh& mesh, const Eigen::Vector3d& up);

} // namespace sheet
