// SPDX-License-Identifier: MIT
#include "formats/cpp/mesh_assembler.h"

#include <cmath>
#include <limits>
#include <utility>

#include "formats/cpp/polygon.h"
#include "formats/cpp/text_scan.h"

namespace sheet::formats {

namespace {

std::string counted(std::size_t n, const char* one, const char* many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

} // namespace

MeshAssembler::MeshAssembler(std::string file, std::string place_word)
    : file_(std::move(file)), place_word_(std::move(place_word)) {}

void MeshAssembler::note(const std::string& text) { notes_.push_back(file_ + ": " + text); }

void MeshAssembler::add_face(std::span<const std::int64_t> corners, std::uint64_t place, std::int64_t first_index) {
  const auto where = [&] { return place_word_ + " " + std::to_string(place); };
  const std::size_t face = faces_++;
  if (points.size() >= std::numeric_limits<std::uint32_t>::max() || face >= std::numeric_limits<std::uint32_t>::max())
    mesh_fail(file_, where(), "more than 4294967294 vertices or faces; split the mesh");
  for (const std::int64_t corner : corners)
    if (corner < 0 || static_cast<std::uint64_t>(corner) >= points.size()) {
      const std::string index =
          corner > std::numeric_limits<std::int64_t>::max() - first_index ? "" : std::to_string(corner + first_index);
      mesh_fail(file_, where(),
                "vertex index " + index + " is out of range: the file has " +
                    counted(points.size(), "vertex", "vertices") + ", counted from " + std::to_string(first_index));
    }
  if (corners.size() < 3) {
    if (small_++ == 0)
      first_small_ = place;
    return;
  }
  std::vector<std::uint32_t> polygon; // each corner once where it stands several times in a row
  for (const std::int64_t corner : corners)
    if (const auto c = static_cast<std::uint32_t>(corner); polygon.empty() || polygon.back() != c)
      polygon.push_back(c);
  while (polygon.size() > 1 && polygon.front() == polygon.back())
    polygon.pop_back();
  bool degenerate = polygon.size() < corners.size();
  const PolygonTriangles parts = polygon.size() < 3 ? PolygonTriangles{} : triangulate(points, polygon);
  if (!parts.fault.empty())
    mesh_fail(file_, where(),
              "a face with " + std::to_string(corners.size()) + " corners " + parts.fault +
                  "; triangulate it in the program that made it");
  for (const std::array<std::uint32_t, 3>& t : parts.triangles) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
      degenerate = true;
      continue;
    }
    triangles_.push_back(t);
    source_face_.push_back(static_cast<std::uint32_t>(face));
  }
  if (degenerate && degenerate_++ == 0)
    first_degenerate_ = place;
}

void MeshAssembler::drop_unused_points(std::vector<MeshArray>& arrays) {
  constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> new_index(points.size(), unused);
  for (const auto& t : triangles_)
    for (const std::uint32_t v : t)
      new_index[v] = 0;
  std::uint32_t kept = 0;
  for (std::uint32_t& index : new_index)
    if (index != unused)
      index = kept++;
  if (kept == points.size())
    return;
  note(
      counted(points.size() - kept, "vertex that no face uses was dropped", "vertices that no face uses were dropped"));
  for (std::size_t v = 0; v < points.size(); ++v)
    if (new_index[v] != unused) {
      points[new_index[v]] = points[v];
      for (MeshArray& array : arrays)
        if (array.place == MeshPlace::point)
          for (int c = 0; c < array.components; ++c)
            array.values[std::size_t{new_index[v]} * array.components + c] = array.values[v * array.components + c];
    }
  points.resize(kept);
  for (MeshArray& array : arrays)
    if (array.place == MeshPlace::point)
      array.values.resize(std::size_t{kept} * array.components);
  for (auto& t : triangles_)
    for (std::uint32_t& v : t)
      v = new_index[v];
}

void MeshAssembler::note_flat_triangles() {
  std::size_t flat = 0, first = 0;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const auto& [a, b, c] = triangles_[i];
    std::array<double, 3> u{}, v{};
    for (int k = 0; k < 3; ++k) {
      u[k] = points[b][k] - points[a][k];
      v[k] = points[c][k] - points[a][k];
    }
    const double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
    if (x == 0.0 && y == 0.0 && z == 0.0 && flat++ == 0)
      first = source_face_[i];
  }
  if (flat > 0)
    note(counted(flat, "triangle has", "triangles have") + " no area (first: face " + std::to_string(first) +
         ", counted from 0); clean the mesh before using it as a sheet");
}

MeshImport MeshAssembler::finish(std::vector<MeshArray> arrays) && {
  if (small_ > 0)
    note(counted(small_, "face", "faces") + " with fewer than three corners dropped (first: " + place_word_ + " " +
         std::to_string(first_small_) + ")");
  if (degenerate_ > 0)
    note(counted(degenerate_, "face names a vertex twice", "faces name a vertex twice") +
         "; triangles without area dropped (first: " + place_word_ + " " + std::to_string(first_degenerate_) + ")");
  if (triangles_.empty())
    mesh_fail(file_, "",
              points.empty() ? "the file has no vertices and no triangles; is it a mesh?"
                             : "the file has " + counted(points.size(), "vertex", "vertices") +
                                   " but no triangles; a sheet needs faces: triangulate it first");
  for (MeshArray& array : arrays) {
    for (const double value : array.values)
      if (!std::isfinite(value))
        mesh_fail(file_, "", "array " + quoted(array.name) + " has a value that is not finite");
    if (array.place == MeshPlace::cell) {
      std::vector<double> values;
      values.reserve(triangles_.size() * array.components);
      for (const std::uint32_t face : source_face_)
        for (int c = 0; c < array.components; ++c)
          values.push_back(array.values[std::size_t{face} * array.components + c]);
      array.values = std::move(values);
    }
  }
  drop_unused_points(arrays);
  note_flat_triangles();
  MeshImport result;
  result.mesh.points = std::move(points);
  result.mesh.triangles = std::move(triangles_);
  result.mesh.arrays = std::move(arrays);
  result.notes = std::move(notes_);
  return result;
}

} // namespace sheet::formats
