// SPDX-License-Identifier: MIT
// The common end of all importers: polygons to triangles, checks of indices, removal of what no face uses, notes.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "formats/cpp/mesh_import.h"

namespace sheet::formats {

class MeshAssembler {
public:
  // place_word: what the numbers given to add_face count, for messages ("line", "face", "byte")
  MeshAssembler(std::string file, std::string place_word);

  std::vector<std::array<double, 3>> points;

  // Adds one face of the file. All its points must have been added before. Fails if an index is out of range, naming it
  // plus first_index (1 for formats that count from one).
  void add_face(std::span<const std::int64_t> corners, std::uint64_t place, std::int64_t first_index = 0);

  // A remark for the user, without the file's name.
  void note(const std::string& text);

  [[nodiscard]] std::size_t face_count() const { return faces_; }

  // The finished mesh. Arrays hold a tuple for every point, or for every call of add_face.
  [[nodiscard]] MeshImport finish(std::vector<MeshArray> arrays) &&;

private:
  void drop_unused_points(std::vector<MeshArray>& arrays);
  void note_flat_triangles();

  std::string file_;
  std::string place_word_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<std::uint32_t> source_face_; // of each triangle
  std::vector<std::string> notes_;
  std::size_t faces_ = 0;
  std::size_t small_ = 0, degenerate_ = 0; // faces with fewer than three corners, faces that name a point twice
  std::uint64_t first_small_ = 0, first_degenerate_ = 0;
};

} // namespace sheet::formats
