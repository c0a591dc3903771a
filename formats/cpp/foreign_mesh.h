// SPDX-License-Identifier: MIT
// A triangle mesh as other programs' files hold it: what every importer returns and every exporter takes.
// Numbers are passed on as the file has them; Sheet's own files are in SI units (lengths and thickness in m, velocity
// in m/s).
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sheet::formats {

// Where an array's values live: one tuple a point (vertex) or one tuple a cell (triangle).
enum class MeshPlace { point, cell };

struct MeshArray {
  std::string name;
  MeshPlace place = MeshPlace::point;
  int components = 1;
  std::vector<double> values; // tuple after tuple
  bool whole = false;         // the file has whole numbers
};

struct ForeignMesh {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<std::uint32_t, 3>> triangles; // counter-clockwise seen from the positive side
  std::vector<MeshArray> arrays;
  std::optional<double> time; // [s], which VTU files can say, and PLY files in a comment

  // The array of that name and place, or nullptr.
  [[nodiscard]] const MeshArray* find(std::string_view name, MeshPlace place) const {
    for (const MeshArray& array : arrays)
      if (array.name == name && array.place == place)
        return &array;
    return nullptr;
  }

  // The texture coordinates: the first array of two components at points that is called "uv", or NAME.uv. Or nullptr.
  [[nodiscard]] const MeshArray* texture() const {
    for (const MeshArray& array : arrays)
      if (array.place == MeshPlace::point && array.components == 2 &&
          (array.name == "uv" || array.name.ends_with(".uv")))
        return &array;
    return nullptr;
  }

  // Those with seams, where triangles at a point differ: the first array of six components at cells that is called
  // "corner_uv", or NAME.corner_uv: u and v at each corner. Where it is, texture() is of no account. Or nullptr.
  [[nodiscard]] const MeshArray* corner_texture() const {
    for (const MeshArray& array : arrays)
      if (array.place == MeshPlace::cell && array.components == 6 &&
          (array.name == "corner_uv" || array.name.ends_with(".corner_uv")))
        return &array;
    return nullptr;
  }
};

enum class MeshFormat { obj, off, ply, stl, vtu };

// The format that a file name's ending stands for (case does not matter), or nothing.
[[nodiscard]] std::optional<MeshFormat> mesh_format_of(std::string_view path);

// A mesh file that cannot be read or written; what() names file, place and remedy.
class MeshFileError : public std::runtime_error {
public:
  enum class Kind { content, io }; // the file says something impossible | the system refused to read or write
  MeshFileError(Kind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  [[nodiscard]] Kind kind() const noexcept { return kind_; }

private:
  Kind kind_;
};

} // namespace sheet::formats
