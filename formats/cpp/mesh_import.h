// SPDX-License-Identifier: MIT
// Reads triangle meshes from OBJ, OFF, PLY, STL and VTU files.
//
// Polygons become triangles (polygon.h); those that are not flat or cross themselves are refused. Vertices that no face
// uses are dropped, so are repeated corners of faces; both are told in the notes. A byte order mark of UTF-8 is
// skipped. Arrays "thickness" (1 component) and "velocity" (3 components; PLY: velocity_x, _y, _z or vx, vy, vz), per
// vertex or per face, are picked up from PLY and VTU. Of PLY files those come, too, that are asked for by name: an
// array NAME is the property NAME, or the properties NAME_x, NAME_y and NAME_z, or NAME_0, NAME_1, ... as Sheet writes
// them; "uv" is also s and t, u and v, or texture_u and texture_v, as other programs do. Other arrays are passed over.
// Numbers are read the same in every locale.
//
// The readers trust nothing: counts are held against the size of the file before memory is asked for, indices against
// the number of vertices, numbers must be finite. Every error is a MeshFileError that names file, place and remedy.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/cpp/foreign_mesh.h"

namespace sheet::formats {

struct MeshImport {
  ForeignMesh mesh;
  std::vector<std::string> notes; // what was dropped, merged or passed over; each starts with the file's name
};

// The names of arrays that are wanted beside thickness and velocity.
using WantedArrays = std::span<const std::string>;

// Reads the file; its format follows from the ending of its name.
[[nodiscard]] MeshImport import_mesh(const std::string& path, WantedArrays arrays = {});

// Reads a mesh from memory; `name` stands for the file in messages.
[[nodiscard]] MeshImport import_mesh(std::string_view bytes, MeshFormat format, const std::string& name,
                                     WantedArrays arrays = {});

// One reader a format. STL: binary or ASCII, vertices with equal coordinates are merged. OFF: also with normals or
// colours, which are passed over. PLY: ASCII and both binary orders. VTU: ASCII, inline base64 and appended data (raw
// or base64), not compressed; triangles, quads, polygons and strips, several pieces.
[[nodiscard]] MeshImport import_obj(std::string_view bytes, const std::string& name);
[[nodiscard]] MeshImport import_off(std::string_view bytes, const std::string& name);
[[nodiscard]] MeshImport import_ply(std::string_view bytes, const std::string& name, WantedArrays arrays = {});
[[nodiscard]] MeshImport import_stl(std::string_view bytes, const std::string& name);
[[nodiscard]] MeshImport import_vtu(std::string_view bytes, const std::string& name);

} // namespace sheet::formats
