// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/export.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <Eigen/Geometry>

#include "libsheet/base/error.h"
#include "libsheet/geometry/vertex_shares.h"
#include "libsheet/quantities/fields.h"
#include "libsheet/shape/mesh_measure.h"
#include "libsheet/shape/solidify.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

namespace {

using formats::Array;
using formats::ForeignMesh;
using formats::Frame;
using formats::MeshArray;
using formats::MeshPlace;
using formats::Type;

template <class T> std::vector<double> as_doubles(const Array& array) {
  const auto values = array.values<T>();
  std::vector<double> out(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    out[i] = static_cast<double>(values[i]);
  return out;
}

std::vector<double> numbers(const Array& array) {
  switch (array.type) {
  case Type::int8:
    return as_doubles<std::int8_t>(array);
  case Type::uint8:
    return as_doubles<std::uint8_t>(array);
  case Type::int32:
    return as_doubles<std::int32_t>(array);
  case Type::uint32:
    return as_doubles<std::uint32_t>(array);
  case Type::int64:
    return as_doubles<std::int64_t>(array);
  case Type::uint64:
    return as_doubles<std::uint64_t>(array);
  case Type::float32:
    return as_doubles<float>(array);
  case Type::float64:
    return as_doubles<double>(array);
  case Type::text:
    break;
  }
  return {};
}

struct Thickness {
  std::vector<double> of_triangles, of_vertices; // [m]
};

Thickness thickness(const Frame& frame) {
  const auto x = positions(frame);
  const auto corners = triangles(frame);
  const auto v = volumes(frame);
  const auto area = [&](std::uint32_t t) {
    const Corners& c = corners[t];
    return (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).norm() / 2;
  };
  return {values_of(frame, field_named("thickness")), thickness_around(x.size(), corners, v, area)};
}

// Integers of 64 bits that no double can tell from their neighbours.
template <class T> bool needs_halves(const Array& array) {
  const auto exact = [](T value) {
    return value == static_cast<T>(0) || std::abs(static_cast<double>(value)) < 0x1p53;
  };
  const auto values = array.values<T>();
  return !std::all_of(values.begin(), values.end(), exact);
}

bool needs_halves(const Array& array) {
  return array.type == Type::uint64  ? needs_halves<std::uint64_t>(array)
         : array.type == Type::int64 ? needs_halves<std::int64_t>(array)
                                     : false;
}

// The lower or upper 32 bits of such integers.
std::vector<double> half_of(const Array& array, int shift) {
  std::vector<double> half;
  for (std::size_t i = 0; i < array.rows * array.components; ++i) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, array.data.data() + 8 * i, sizeof bits);
    half.push_back(static_cast<double>(bits >> shift & 0xffffffff));
  }
  return half;
}

void add_arrays(const Frame& frame, formats::Place from, MeshPlace to, ForeignMesh& mesh) {
  for (const Array& array : frame.arrays) {
    if (array.place != from || array.type == Type::text || array.name == "position" || array.name == "triangle")
      continue;
    // thickness is volume divided by area, everywhere; an array that somebody has called so keeps its numbers
    const std::string name = array.name == "thickness" ? "thickness.array" : array.name;
    const int components = static_cast<int>(array.components);
    if (needs_halves(array)) {
      mesh.arrays.push_back({name + ".low32", to, components, half_of(array, 0)});
      mesh.arrays.push_back({name + ".high32", to, components, half_of(array, 32)});
    } else {
      mesh.arrays.push_back({name, to, components, numbers(array)});
    }
  }
}

// The tuples of these numbers, in their order.
void take_rows(MeshArray& array, const std::vector<std::uint32_t>& rows) {
  const auto width = static_cast<std::size_t>(array.components);
  std::vector<double> values;
  for (const std::uint32_t row : rows)
    for (std::size_t c = 0; c < width; ++c)
      values.push_back(array.values[row * width + c]);
  array.values = std::move(values);
}

std::array<double, 3> coordinates(const Eigen::Vector3d& x) { return {x[0], x[1], x[2]}; }

} // namespace

ForeignMesh to_foreign_mesh(const Frame& frame) {
  ForeignMesh mesh;
  mesh.time = frame.time;
  for (const Eigen::Vector3d& x : positions(frame))
    mesh.points.push_back(coordinates(x));
  mesh.triangles.assign(triangles(frame).begin(), triangles(frame).end());
  Thickness h = thickness(frame);
  mesh.arrays.push_back({"thickness", MeshPlace::point, 1, std::move(h.of_vertices)});
  mesh.arrays.push_back({"thickness", MeshPlace::cell, 1, std::move(h.of_triangles)});
  add_arrays(frame, formats::Place::vertex, MeshPlace::point, mesh);
  add_arrays(frame, formats::Place::triangle, MeshPlace::cell, mesh);
  for (const Field& field : fields())
    if (field.needs == Needs::law && has(frame, field) && frame.find(field.name) == nullptr)
      mesh.arrays.push_back({std::string(field.name), MeshPlace::cell, 1, values_of(frame, field)});
  return mesh;
}

ForeignMesh to_solid_mesh(const Frame& frame) {
  TriangleMesh middle;
  middle.positions.assign(positions(frame).begin(), positions(frame).end());
  middle.triangles.assign(triangles(frame).begin(), triangles(frame).end());
  const Thickness h = thickness(frame);
  std::vector<std::uint32_t> origin;
  const TriangleMesh solid = solidify(middle, h.of_vertices, &origin);
  ForeignMesh mesh;
  mesh.time = frame.time;
  for (const Eigen::Vector3d& x : solid.positions)
    mesh.points.push_back(coordinates(x));
  mesh.triangles = solid.triangles;
  mesh.arrays.push_back({"thickness", MeshPlace::point, 1, h.of_vertices});
  add_arrays(frame, formats::Place::vertex, MeshPlace::point, mesh);
  for (MeshArray& array : mesh.arrays) {
    const std::vector<double> once = array.values;
    array.values.insert(array.values.end(), once.begin(), once.end());
  }
  const std::size_t at_vertices = mesh.arrays.size();
  add_arrays(frame, formats::Place::triangle, MeshPlace::cell, mesh);
  std::erase_if(mesh.arrays, [&](const MeshArray& array) {
    const formats::Array* from = array.place == MeshPlace::cell ? frame.find(array.name) : nullptr;
    return from && from->transfer == formats::Transfer::conserve;
  });
  for (std::size_t i = at_vertices; i < mesh.arrays.size(); ++i)
    take_rows(mesh.arrays[i], origin);
  return mesh;
}

void add_normals(ForeignMesh& mesh) {
  TriangleMesh shape;
  for (const auto& point : mesh.points)
    shape.positions.emplace_back(point[0], point[1], point[2]);
  shape.triangles = mesh.triangles;
  MeshArray normal{"normal", MeshPlace::point, 3, {}};
  for (const Eigen::Vector3d& n : vertex_normals(shape))
    normal.values.insert(normal.values.end(), n.begin(), n.end());
  std::erase_if(mesh.arrays, [](const MeshArray& a) { return a.name == "normal" && a.place == MeshPlace::point; });
  mesh.arrays.push_back(std::move(normal));
}

} // namespace sheet
