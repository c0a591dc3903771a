// SPDX-License-Identifier: MIT
#include "formats/cpp/mesh_export.h"

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>

#include "formats/cpp/byte_store.h"
#include "formats/cpp/export_check.h"
#include "formats/cpp/text_scan.h"

namespace sheet::formats {

namespace {

void write_file(const std::string& path, const std::string& bytes) {
  const auto fail = [&](const char* what) {
    throw MeshFileError(MeshFileError::Kind::io, path + ": cannot " + what + ": " + std::strerror(errno));
  };
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  if (!file)
    fail("create");
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  const int error = errno;
  const bool closed = std::fclose(file) == 0;
  if (!written)
    errno = error;
  if (!written || !closed)
    fail("write");
}

void append_point(std::string& text, std::span<const double> point) {
  for (const double x : point) {
    text += ' ';
    append_real(text, x);
  }
}

// The different texture coordinates in the order in which corners come to them, and the number of each corner's, from
// 0.
struct CornerTexture {
  MeshArray different{"uv", MeshPlace::point, 2, {}};
  std::vector<std::uint64_t> number;
};

CornerTexture numbered(const MeshArray& corners) {
  CornerTexture result;
  std::map<std::array<double, 2>, std::uint64_t> known;
  for (std::size_t i = 0; i < corners.values.size(); i += 2) {
    const std::array uv{corners.values[i], corners.values[i + 1]};
    const auto [place, is_new] = known.try_emplace(uv, known.size());
    if (is_new)
      result.different.values.insert(result.different.values.end(), uv.begin(), uv.end());
    result.number.push_back(place->second);
  }
  return result;
}

// A line for each tuple of an array, if there is one.
void append_lines(std::string& text, const char* keyword, const MeshArray* array) {
  if (!array)
    return;
  const auto width = static_cast<std::size_t>(array->components);
  for (std::size_t i = 0; i < array->values.size(); i += width) {
    text += keyword;
    append_point(text, std::span(array->values).subspan(i, width));
    text += '\n';
  }
}

} // namespace

void check_export(const ForeignMesh& mesh) {
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle)
      if (vertex >= mesh.points.size())
        throw std::invalid_argument("mesh export: vertex index " + std::to_string(vertex) + " of " +
                                    std::to_string(mesh.points.size()));
  for (const MeshArray& array : mesh.arrays) {
    const std::size_t tuples = array.place == MeshPlace::point ? mesh.points.size() : mesh.triangles.size();
    if (array.components < 1 || array.values.size() != tuples * static_cast<std::size_t>(array.components))
      throw std::invalid_argument("mesh export: array '" + array.name + "' has " + std::to_string(array.values.size()) +
                                  " values, not " + std::to_string(array.components) + " for each of " +
                                  std::to_string(tuples));
  }
}

std::string encode_obj(const ForeignMesh& mesh) {
  check_export(mesh);
  const MeshArray *texture = mesh.texture(), *normal = mesh.find("normal", MeshPlace::point);
  CornerTexture corners;
  if (const MeshArray* seamed = mesh.corner_texture()) {
    corners = numbered(*seamed);
    texture = &corners.different;
  }
  if (normal && normal->components != 3)
    normal = nullptr;
  std::string text = "# written by Sheet\n";
  for (const auto& point : mesh.points) {
    text += 'v';
    append_point(text, point);
    text += '\n';
  }
  append_lines(text, "vt", texture);
  append_lines(text, "vn", normal);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    text += 'f';
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string number = std::to_string(mesh.triangles[t][i] + std::uint64_t{1});
      text += " " + number;
      if (!corners.number.empty())
        text += "/" + std::to_string(corners.number[3 * t + i] + 1);
      else if (texture || normal)
        text += "/" + (texture ? number : "");
      if (normal)
        text += "/" + number;
    }
    text += '\n';
  }
  return text;
}

std::string encode_off(const ForeignMesh& mesh) {
  check_export(mesh);
  std::string text =
      "OFF\n" + std::to_string(mesh.points.size()) + " " + std::to_string(mesh.triangles.size()) + " 0\n";
  for (const auto& point : mesh.points) {
    append_point(text, point);
    text += '\n';
  }
  for (const auto& [a, b, c] : mesh.triangles)
    text += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  return text;
}

std::string encode_stl(const ForeignMesh& mesh) {
  check_export(mesh);
  if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max())
    throw std::invalid_argument("mesh export: too many triangles for STL");
  std::string bytes = "binary STL written by Sheet";
  bytes.resize(80, ' ');
  store_number(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto &p = mesh.points[a], &q = mesh.points[b], &r = mesh.points[c];
    std::array<double, 3> n{};
    for (std::size_t d = 0; d < 3; ++d) {
      const std::size_t e = (d + 1) % 3, f = (d + 2) % 3;
      n[d] = (q[e] - p[e]) * (r[f] - p[f]) - (q[f] - p[f]) * (r[e] - p[e]);
    }
    const double length = std::hypot(n[0], n[1], n[2]);
    for (const double x : n)
      store_number(bytes, static_cast<float>(length > 0.0 ? x / length : 0.0));
    for (const auto* point : {&p, &q, &r})
      for (const double x : *point)
        store_number(bytes, static_cast<float>(x));
    store_number(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string encode_mesh(const ForeignMesh& mesh, MeshFormat format) {
  switch (format) {
  case MeshFormat::obj:
    return encode_obj(mesh);
  case MeshFormat::off:
    return encode_off(mesh);
  case MeshFormat::ply:
    return encode_ply(mesh);
  case MeshFormat::stl:
    return encode_stl(mesh);
  case MeshFormat::vtu:
    break;
  }
  return encode_vtu(mesh);
}

void export_mesh(const std::string& path, const ForeignMesh& mesh) {
  const std::optional<MeshFormat> format = mesh_format_of(path);
  if (!format)
    throw MeshFileError(MeshFileError::Kind::content,
                        path + ": unknown kind of mesh file; its name must end in .vtu, .ply, .obj, .off or .stl");
  write_file(path, encode_mesh(mesh, *format));
}

void export_pvd(const std::string& path, std::span<const PvdEntry> entries) { write_file(path, encode_pvd(entries)); }

} // namespace sheet::formats
