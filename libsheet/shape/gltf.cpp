// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/gltf.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <sstream>
#include <tuple>
#include <type_traits>
#include <vector>

#include <Eigen/Geometry>
#include <tiny_gltf.h>

#include "libsheet/base/error.h"
#include "libsheet/base/version.h"
#include "libsheet/shape/mesh_measure.h"

namespace sheet {

namespace {

using formats::ForeignMesh;
using formats::MeshArray;
using formats::MeshPlace;

float single(double x, const char* what, std::size_t vertex) {
  const auto y = static_cast<float>(x);
  if (!std::isfinite(y))
    fail(ExitCode::bad_input, "{} {} at vertex {} is beyond the numbers of glTF, which are single: export to .vtu",
         what, x, vertex);
  return y;
}

// Appends arrays to the model's only buffer.
class Writer {
public:
  Writer() { model.buffers.emplace_back(); }

  // Both return the number of the accessor. `type`: TINYGLTF_TYPE_SCALAR, _VEC2 or _VEC3.
  int floats(const std::vector<float>& values, int type) {
    const auto stride = static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
    tinygltf::Accessor& accessor = add(values, TINYGLTF_COMPONENT_TYPE_FLOAT, type, TINYGLTF_TARGET_ARRAY_BUFFER);
    accessor.count = values.size() / stride;
    for (std::size_t c = 0; c < stride; ++c) {
      accessor.minValues.push_back(values[c]);
      accessor.maxValues.push_back(values[c]);
      for (std::size_t i = c; i < values.size(); i += stride) {
        accessor.minValues[c] = std::min<double>(accessor.minValues[c], values[i]);
        accessor.maxValues[c] = std::max<double>(accessor.maxValues[c], values[i]);
      }
    }
    return last();
  }

  int indices(const std::vector<std::uint32_t>& values) {
    add(values, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    return last();
  }

  tinygltf::Model model;

private:
  [[nodiscard]] int last() const { return static_cast<int>(model.accessors.size()) - 1; }

  template <class T> tinygltf::Accessor& add(const std::vector<T>& values, int component_type, int type, int target) {
    std::vector<unsigned char>& bytes = model.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = bytes.size();
    view.byteLength = values.size() * sizeof(T);
    view.target = target;
    bytes.resize(bytes.size() + view.byteLength);
    std::memcpy(bytes.data() + view.byteOffset, values.data(), view.byteLength);
    model.bufferViews.push_back(view);
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model.bufferViews.size()) - 1;
    accessor.componentType = component_type;
    accessor.type = type;
    accessor.count = values.size();
    model.accessors.push_back(accessor);
    return model.accessors.back();
  }
};

std::vector<float> flat(const std::vector<Eigen::Vector3d>& vectors, const char* what) {
  std::vector<float> out;
  for (std::size_t i = 0; i < vectors.size(); ++i)
    for (const double x : vectors[i])
      out.push_back(single(x, what, i));
  return out;
}

// glTF wants unit vectors; a vertex without triangles gets any.
std::vector<Eigen::Vector3d> normals_of(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3d> normals = vertex_normals(mesh);
  for (Eigen::Vector3d& normal : normals)
    if (normal.isZero())
      normal = Eigen::Vector3d::UnitY();
  return normals;
}

// The vertices that are written: points of the mesh, those on seams once for each texture coordinate that they have.
struct Vertices {
  std::vector<std::uint32_t> point;   // of each vertex
  std::vector<std::uint32_t> corners; // their numbers, triangle after triangle
  std::vector<float> texture;         // u and v of each, v pointing down as in glTF; empty: none
};

Vertices vertices_of(const ForeignMesh& mesh) {
  Vertices out;
  constexpr const char* what = "the texture coordinate";
  if (const MeshArray* seamed = mesh.corner_texture()) {
    std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> known;
    for (std::size_t i = 0; i < 3 * mesh.triangles.size(); ++i) {
      const std::uint32_t point = mesh.triangles[i / 3][i % 3];
      const float u = single(seamed->values[2 * i], what, point),
                  v = single(1 - seamed->values[2 * i + 1], what, point);
      const auto [place, is_new] = known.try_emplace({point, u, v}, static_cast<std::uint32_t>(known.size()));
      if (is_new) {
        out.point.push_back(point);
        out.texture.insert(out.texture.end(), {u, v});
      }
      out.corners.push_back(place->second);
    }
    return out;
  }
  out.point.resize(mesh.points.size());
  std::iota(out.point.begin(), out.point.end(), 0);
  for (const auto& triangle : mesh.triangles)
    out.corners.insert(out.corners.end(), triangle.begin(), triangle.end());
  if (const MeshArray* texture = mesh.texture())
    for (std::size_t i = 0; i < texture->values.size(); i += 2) {
      out.texture.push_back(single(texture->values[i], what, i / 2));
      out.texture.push_back(single(1 - texture->values[i + 1], what, i / 2));
    }
  return out;
}

tinygltf::Primitive pack(const ForeignMesh& mesh, Writer& writer) {
  TriangleMesh shape;
  for (const auto& point : mesh.points)
    shape.positions.emplace_back(point[0], point[1], point[2]);
  shape.triangles = mesh.triangles;
  const Vertices vertices = vertices_of(mesh);
  const auto of_vertices = [&](const auto& of_points) {
    std::vector<std::remove_cvref_t<decltype(of_points[0])>> values;
    for (const std::uint32_t point : vertices.point)
      values.push_back(of_points[point]);
    return values;
  };
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.material = 0;
  primitive.attributes["POSITION"] =
      writer.floats(flat(of_vertices(shape.positions), "the coordinate"), TINYGLTF_TYPE_VEC3);
  primitive.attributes["NORMAL"] =
      writer.floats(flat(of_vertices(normals_of(shape)), "the normal"), TINYGLTF_TYPE_VEC3);
  const bool textured = !vertices.texture.empty();
  if (const MeshArray* thickness = mesh.find("thickness", MeshPlace::point)) {
    std::vector<float> values, as_texture;
    for (const double h : of_vertices(thickness->values)) {
      values.push_back(single(h, "the thickness", values.size()));
      as_texture.insert(as_texture.end(), {values.back(), 0});
    }
    primitive.attributes["_THICKNESS"] = writer.floats(values, TINYGLTF_TYPE_SCALAR);
    primitive.attributes[textured ? "TEXCOORD_1" : "TEXCOORD_0"] = writer.floats(as_texture, TINYGLTF_TYPE_VEC2);
  }
  if (textured)
    primitive.attributes["TEXCOORD_0"] = writer.floats(vertices.texture, TINYGLTF_TYPE_VEC2);
  primitive.indices = writer.indices(vertices.corners);
  return primitive;
}

tinygltf::Material both_sides() {
  tinygltf::Material material;
  material.name = "liquid";
  material.doubleSided = true;
  material.pbrMetallicRoughness.baseColorFactor = {0.55, 0.33, 0.16, 1};
  material.pbrMetallicRoughness.metallicFactor = 0;
  material.pbrMetallicRoughness.roughnessFactor = 0.4;
  return material;
}

} // namespace

std::string encode_gltf(const ForeignMesh& mesh, const Eigen::Vector3d& up) {
  Writer writer;
  tinygltf::Model& model = writer.model;
  model.asset.version = "2.0";
  model.asset.generator = std::string("Sheet ") + version_text;
  tinygltf::Node node;
  node.name = "sheet";
  const auto turn = Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitY());
  node.rotation = {turn.x(), turn.y(), turn.z(), turn.w()};
  if (!mesh.triangles.empty()) {
    model.meshes.emplace_back();
    model.meshes[0].name = "sheet";
    model.meshes[0].primitives.push_back(pack(mesh, writer));
    model.materials.push_back(both_sides());
    node.mesh = 0;
  } else {
    model.buffers.clear();
  }
  model.nodes.push_back(node);
  model.scenes.emplace_back();
  model.scenes[0].nodes = {0};
  model.defaultScene = 0;
  if (mesh.time)
    model.scenes[0].extras = tinygltf::Value(tinygltf::Value::Object{{"time", tinygltf::Value(*mesh.time)}});
  std::ostringstream bytes;
  if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, bytes, false, true))
    fail(ExitCode::internal, "tinygltf could not write the mesh");
  return std::move(bytes).str();
}

} // namespace sheet
