// SPDX-License-Identifier: GPL-3.0-or-later
// Mesh files as TriangleMesh: formats/cpp's importers and exporters with this library's errors; and streams.
#pragma once
#include <string>
#include <vector>

#include "formats/cpp/mesh_import.h"
#include "libsheet/shape/triangle_mesh.h"

namespace sheet {

struct LoadedMesh {
  TriangleMesh mesh;
  std::vector<std::string> notes; // what was dropped, merged or passed over
};

// Reads OBJ, OFF, PLY, STL or VTU with thickness and velocity where the file has them, and the arrays of these names;
// of a stream the last frame. Throws Error: io if the file cannot be read, bad_input if its content is wrong, a
// thickness is not positive, or it has not all of the arrays, a finite number everywhere.
[[nodiscard]] LoadedMesh load_mesh(const std::string& path, formats::WantedArrays arrays = {});

// Arrays "thickness" (per vertex, per triangle) and "velocity", as far as the mesh has them.
[[nodiscard]] formats::ForeignMesh to_foreign(const TriangleMesh& mesh);

// Writes VTU, PLY, OBJ, OFF or STL by the ending of the path. Throws Error (io, bad_input).
void save_mesh(const std::string& path, const TriangleMesh& mesh);

} // namespace sheet
