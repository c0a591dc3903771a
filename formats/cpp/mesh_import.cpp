// SPDX-License-Identifier: MIT
#include "formats/cpp/mesh_import.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include <sys/stat.h>

#include "formats/cpp/text_start.h"

namespace sheet::formats {

namespace {

std::string read_file(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
    throw MeshFileError(MeshFileError::Kind::io, path + ": cannot read: it is not a regular file");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file)
    throw MeshFileError(MeshFileError::Kind::io, path + ": cannot open: " + std::strerror(errno));
  std::string bytes;
  std::array<char, 1 << 16> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), file.get()))
    bytes.append(buffer.data(), n);
  if (std::ferror(file.get()))
    throw MeshFileError(MeshFileError::Kind::io, path + ": cannot read: " + std::strerror(errno));
  return bytes;
}

} // namespace

std::optional<MeshFormat> mesh_format_of(std::string_view path) {
  const std::size_t dot = path.find_last_of("./");
  if (dot == std::string_view::npos || path[dot] != '.')
    return std::nullopt;
  std::string ending;
  for (const char c : path.substr(dot + 1))
    ending += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  if (ending == "obj")
    return MeshFormat::obj;
  if (ending == "off")
    return MeshFormat::off;
  if (ending == "ply")
    return MeshFormat::ply;
  if (ending == "stl")
    return MeshFormat::stl;
  if (ending == "vtu")
    return MeshFormat::vtu;
  return std::nullopt;
}

MeshImport import_mesh(const std::string& path, WantedArrays arrays) {
  const std::optional<MeshFormat> format = mesh_format_of(path);
  if (!format)
    throw MeshFileError(MeshFileError::Kind::content,
                        path + ": unknown kind of mesh file; its name must end in .obj, .off, .ply, .stl or .vtu");
  return import_mesh(read_file(path), *format, path, arrays);
}

MeshImport import_mesh(std::string_view bytes, MeshFormat format, const std::string& name, WantedArrays arrays) {
  if (format != MeshFormat::stl) { // which may be binary and begin with anything
    bytes = without_mark(bytes);
    if (const std::string error = find_no_text(bytes); !error.empty())
      throw MeshFileError(MeshFileError::Kind::content, name + ": " + error);
  }
  switch (format) {
  case MeshFormat::obj:
    return import_obj(bytes, name);
  case MeshFormat::off:
    return import_off(bytes, name);
  case MeshFormat::ply:
    return import_ply(bytes, name, arrays);
  case MeshFormat::stl:
    return import_stl(bytes, name);
  case MeshFormat::vtu:
    return import_vtu(bytes, name);
  }
  throw MeshFileError(MeshFileError::Kind::content, name + ": unknown mesh format");
}

} // namespace sheet::formats
