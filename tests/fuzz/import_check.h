// SPDX-License-Identifier: GPL-3.0-or-later
// What the fuzz targets of the mesh importers share: an import either fails with MeshFileError or gives a sound mesh.
#pragma once
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "formats/cpp/mesh_import.h"

inline int check_import(const std::uint8_t* data, std::size_t size, sheet::formats::MeshFormat format) {
  using namespace sheet::formats;
  const auto require = [](bool holds) {
    if (!holds)
      std::abort();
  };
  try {
    const MeshImport result = import_mesh(std::string_view(reinterpret_cast<const char*>(data), size), format, "fuzz");
    const ForeignMesh& mesh = result.mesh;
    require(!mesh.triangles.empty());
    for (const auto& point : mesh.points)
      for (const double x : point)
        require(std::isfinite(x));
    for (const auto& [a, b, c] : mesh.triangles)
      require(a < mesh.points.size() && b < mesh.points.size() && c < mesh.points.size() && a != b && b != c && c != a);
    for (const MeshArray& array : mesh.arrays) {
      const std::size_t tuples = array.place == MeshPlace::point ? mesh.points.size() : mesh.triangles.size();
      require(array.values.size() == tuples * static_cast<std::size_t>(array.components));
    }
  } catch (const MeshFileError& error) {
    require(std::string_view(error.what()).starts_with("fuzz: "));
  }
  return 0;
}
