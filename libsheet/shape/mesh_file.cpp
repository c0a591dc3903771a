// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/mesh_file.h"

#include <utility>

#include <fmt/format.h>

#include "formats/cpp/mesh_export.h"
#include "formats/cpp/stream_reader.h"
#include "libsheet/base/error.h"
#include "libsheet/base/files.h"
#include "libsheet/base/named_files.h"
#include "libsheet/shape/export.h"
#include "libsheet/sheet/drops.h"

namespace sheet {

namespace {

using formats::MeshArray;
using formats::MeshPlace;

[[noreturn]] void rethrow(const formats::MeshFileError& error) {
  throw Error(error.kind() == formats::MeshFileError::Kind::io ? ExitCode::io : ExitCode::bad_input, error.what());
}

std::vector<double> thickness_of(const formats::ForeignMesh& mesh, MeshPlace place, const std::string& path) {
  const MeshArray* array = mesh.find("thickness", place);
  if (!array)
    return {};
  for (std::size_t i = 0; i < array->values.size(); ++i)
    if (!(array->values[i] > 0.0))
      fail(ExitCode::bad_input, "{}: thickness = {:g} m at {} {} must be positive", path, array->values[i],
           place == MeshPlace::point ? "vertex" : "triangle", i);
  return array->values;
}

bool is_stream(const std::string& path) { return path.ends_with(".sheet"); }

// The mesh of the last frame.
formats::MeshImport import_stream(const std::string& path) try {
  check_named_file(path);
  const InputFile file(path);
  formats::StreamReader reader(file.descriptor(), path);
  formats::Frame next, last;
  while (reader.read(next))
    std::swap(next, last);
  if (reader.frames() == 0)
    fail(ExitCode::bad_input, "{}: the stream has no frames", path);
  formats::MeshImport import{to_foreign_mesh(last), {}};
  for (MeshArray& array : import.mesh.arrays)
    if (const formats::Array* kept = last.find(array.name); kept != nullptr)
      array.whole = kept->type != formats::Type::float32 && kept->type != formats::Type::float64;
  if (const std::size_t drops = read_drops(last).size(); drops > 0)
    import.notes.push_back(fmt::format("{}: its {} drops are passed over", path, drops));
  return import;
} catch (const formats::StreamError& error) {
  fail(error.kind() == formats::StreamError::Kind::io ? ExitCode::io : ExitCode::bad_input,
       "{}; of a stream that was cut short sheet-select --last takes the last whole frame", error.what());
}

// An array that was asked for, at vertices or else at triangles.
MeshArray array_of(const formats::ForeignMesh& mesh, const std::string& name, const std::string& path) {
  const MeshArray* array = mesh.find(name, MeshPlace::point);
  if (!array)
    array = mesh.find(name, MeshPlace::cell);
  if (!array && is_stream(path))
    fail(ExitCode::bad_input, "{}: there is no array \"{}\" of numbers at vertices or triangles; sheet-info lists them",
         path, name);
  if (!array)
    fail(
        ExitCode::bad_input,
        "{}: there is no array \"{}\": a PLY file has it as the property {} of its vertices or faces, or, with several "
        "components, as {}_0, {}_1, ... or {}_x, {}_y, {}_z",
        path, name, name, name, name, name, name, name);
  return *array;
}

void add_thickness(formats::ForeignMesh& mesh, MeshPlace place, const std::vector<double>& values) {
  if (!values.empty())
    mesh.arrays.push_back({"thickness", place, 1, values});
}

} // namespace

LoadedMesh load_mesh(const std::string& path, formats::WantedArrays arrays) {
  formats::MeshImport import = is_stream(path) ? import_stream(path) : import_named_mesh(path, arrays);
  LoadedMesh loaded;
  loaded.notes = std::move(import.notes);
  for (const auto& p : import.mesh.points)
    loaded.mesh.positions.emplace_back(p[0], p[1], p[2]);
  loaded.mesh.vertex_thickness = thickness_of(import.mesh, MeshPlace::point, path);
  loaded.mesh.triangle_thickness = thickness_of(import.mesh, MeshPlace::cell, path);
  if (const MeshArray* velocity = import.mesh.find("velocity", MeshPlace::point))
    for (std::size_t i = 0; i < velocity->values.size(); i += 3)
      loaded.mesh.velocities.emplace_back(velocity->values[i], velocity->values[i + 1], velocity->values[i + 2]);
  if (import.mesh.find("velocity", MeshPlace::cell))
    loaded.notes.push_back(path + ": velocity per triangle passed over; a sheet has it per vertex");
  loaded.mesh.triangles = std::move(import.mesh.triangles);
  for (const std::string& name : arrays)
    loaded.mesh.arrays.push_back(array_of(import.mesh, name, path));
  return loaded;
}

formats::ForeignMesh to_foreign(const TriangleMesh& mesh) {
  formats::ForeignMesh foreign;
  foreign.points.reserve(mesh.positions.size());
  for (const Eigen::Vector3d& x : mesh.positions)
    foreign.points.push_back({x.x(), x.y(), x.z()});
  foreign.triangles = mesh.triangles;
  add_thickness(foreign, MeshPlace::point, mesh.vertex_thickness);
  add_thickness(foreign, MeshPlace::cell, mesh.triangle_thickness);
  if (!mesh.velocities.empty()) {
    MeshArray velocity{"velocity", MeshPlace::point, 3, {}};
    for (const Eigen::Vector3d& v : mesh.velocities)
      velocity.values.insert(velocity.values.end(), {v.x(), v.y(), v.z()});
    foreign.arrays.push_back(std::move(velocity));
  }
  return foreign;
}

void save_mesh(const std::string& path, const TriangleMesh& mesh) try {
  formats::export_mesh(path, to_foreign(mesh));
} catch (const formats::MeshFileError& error) {
  rethrow(error);
}

} // namespace sheet
