// SPDX-License-Identifier: MIT
#include <set>
#include <string>

#include "formats/cpp/byte_store.h"
#include "formats/cpp/export_check.h"
#include "formats/cpp/mesh_export.h"
#include "formats/cpp/text_scan.h"

namespace sheet::formats {

namespace {

// One "property double" line a component. A name that the element has already gets a number behind it.
void declare(std::string& header, const MeshArray& array, std::set<std::string>& taken) {
  std::string name = array.name;
  for (char& c : name)
    if (c <= ' ' || c > '~')
      c = '_';
  for (int k = 0; k < array.components; ++k) {
    std::string property = name;
    if (array.components == 3)
      property.append(1, '_').append(1, static_cast<char>('x' + k));
    else if (array.components > 1)
      property.append(1, '_').append(std::to_string(k));
    std::string free = property;
    for (int i = 2; !taken.insert(free).second; ++i)
      free = property + "_" + std::to_string(i);
    header += "property double " + free + "\n";
  }
}

void declare_all(std::string& header, const ForeignMesh& mesh, MeshPlace place, std::set<std::string> taken) {
  for (const MeshArray& array : mesh.arrays)
    if (array.place == place)
      declare(header, array, taken);
}

void store_tuples(std::string& bytes, const ForeignMesh& mesh, MeshPlace place, std::size_t row) {
  for (const MeshArray& array : mesh.arrays)
    if (array.place == place)
      for (std::size_t k = 0; k < static_cast<std::size_t>(array.components); ++k)
        store_number(bytes, array.values[row * static_cast<std::size_t>(array.components) + k]);
}

} // namespace

std::string encode_ply(const ForeignMesh& mesh) {
  check_export(mesh);
  std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment written by Sheet\n";
  if (mesh.time) {
    bytes += "comment time ";
    append_real(bytes, *mesh.time);
    bytes += '\n';
  }
  bytes += "element vertex " + std::to_string(mesh.points.size()) +
           "\nproperty double x\nproperty double y\nproperty double z\n";
  declare_all(bytes, mesh, MeshPlace::point, {"x", "y", "z"});
  // int is what most readers expect; it holds indices below 2^31
  const bool small = mesh.points.size() < (std::size_t{1} << 31);
  bytes += "element face " + std::to_string(mesh.triangles.size()) + "\nproperty list uchar " +
           (small ? "int" : "uint") + " vertex_indices\n";
  declare_all(bytes, mesh, MeshPlace::cell, {"vertex_indices", "vertex_index"});
  bytes += "end_header\n";
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    for (const double x : mesh.points[v])
      store_number(bytes, x);
    store_tuples(bytes, mesh, MeshPlace::point, v);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    bytes += '\3';
    for (const std::uint32_t vertex : mesh.triangles[t])
      store_number(bytes, vertex);
    store_tuples(bytes, mesh, MeshPlace::cell, t);
  }
  return bytes;
}

} // namespace sheet::formats
