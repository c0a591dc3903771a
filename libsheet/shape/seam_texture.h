// SPDX-License-Identifier: GPL-3.0-or-later
// Texture coordinates with seams, where triangles at a vertex differ: no array at vertices can carry those through a
// run. Vertices carry where they were in the sheet's mesh file instead (the array "rest", or NAME.rest), and the file
// has u and v at the corners of its triangles (the array "corner_uv", or NAME.corner_uv, of six components at faces).
// What a triangle has now is found there: from where its middle was the way goes to where its corners were, over sides
// that are no seams, so what reaches over a seam ends at it, and an island that meets itself keeps its sides apart.
#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/cpp/foreign_mesh.h"
#include "libsheet/scene/scene.h"

namespace sheet {

class SeamTextures {
public:
  SeamTextures();
  ~SeamTextures();

  // Adds the array corner_uv to a frame's mesh if one of its sheets has seams; triangles of the others get what
  // ForeignMesh::texture has. Several sheets are told apart by the array "sheet", or NAME.sheet, at triangles. The
  // files are looked for by find_by_name; where one is missing or another mesh, that is warned of once, and nothing is
  // added. Throws Error (bad_input) if a file is no mesh.
  void add(const Scene& scene, formats::ForeignMesh& mesh);

private:
  class Map;
  // The map of a sheet whose array `rest` has these places, if it has one called `name`; or null.
  static std::unique_ptr<Map> find(const scene::SheetTable& sheet, const std::string& rest, const std::string& name,
                                   const std::vector<Eigen::Vector3d>& places);
  std::vector<std::optional<std::unique_ptr<Map>>> maps_; // of each sheet; not looked for yet, or null: there is none
};

} // namespace sheet
