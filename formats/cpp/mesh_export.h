// SPDX-License-Identifier: MIT
// Writes triangle meshes for other programs: VTU (ParaView; with PVD collections for time series), PLY, OBJ, OFF, STL.
//
//   VTU   points and all arrays as 64-bit reals, appended raw data, little endian
//   PLY   binary little endian, 64-bit reals; arrays become properties: name, or name_x, _y, _z for 3 components, or
//         name_0, name_1, ... for other numbers; spaces in names become underscores; the time as "comment time 0.5"
//   OBJ   points and triangles, shortest text that reads back as the same double; vt of ForeignMesh::texture and vn of
//   an
//         array "normal" of three components at points, if the mesh has them
//   OFF   points and triangles only, as in OBJ
//   STL   binary; 32-bit coordinates (the format has no others), triangles only
//
// Arrays must have one tuple a point or a triangle, indices must be in range: std::invalid_argument otherwise.
#pragma once
#include <span>
#include <string>

#include "formats/cpp/foreign_mesh.h"

namespace sheet::formats {

[[nodiscard]] std::string encode_vtu(const ForeignMesh& mesh);
[[nodiscard]] std::string encode_ply(const ForeignMesh& mesh);
[[nodiscard]] std::string encode_obj(const ForeignMesh& mesh);
[[nodiscard]] std::string encode_off(const ForeignMesh& mesh);
[[nodiscard]] std::string encode_stl(const ForeignMesh& mesh);
[[nodiscard]] std::string encode_mesh(const ForeignMesh& mesh, MeshFormat format);

// Writes the mesh to a file; the format follows from the ending of its name. Throws MeshFileError.
void export_mesh(const std::string& path, const ForeignMesh& mesh);

// One moment of a time series: the time [s] and the VTU file, relative to the folder of the PVD file.
struct PvdEntry {
  double time = 0.0;
  std::string file;
};

[[nodiscard]] std::string encode_pvd(std::span<const PvdEntry> entries);
void export_pvd(const std::string& path, std::span<const PvdEntry> entries);

} // namespace sheet::formats
