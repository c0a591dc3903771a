// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/gltf.h"

#include <cmath>
#include <cstring>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include "libsheet/base/error.h"

namespace sheet {
namespace {

using formats::ForeignMesh;
using formats::MeshPlace;

ForeignMesh two_triangles() {
  ForeignMesh mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {0, 0.1, 3}, {1, 1, 1}, {7, 7, 7}};
  mesh.triangles = {{0, 1, 2}, {2, 1, 3}};
  mesh.arrays.push_back({"thickness", MeshPlace::point, 1, {0.1, 0.2, 0.3, 0.4, 0}});
  mesh.arrays.push_back({"thickness", MeshPlace::cell, 1, {0.5, 0.6}});
  mesh.time = 1.25;
  return mesh;
}

tinygltf::Model read(const std::string& bytes) {
  tinygltf::Model model;
  std::string error, warning;
  EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromMemory(&model, &error, &warning,
                                                        reinterpret_cast<const unsigned char*>(bytes.data()),
                                                        static_cast<unsigned>(bytes.size())));
  EXPECT_EQ(error + warning, "");
  return model;
}

template <class T> std::vector<T> values(const tinygltf::Model& model, int accessor) {
  const auto& view =
      model.bufferViews.at(static_cast<std::size_t>(model.accessors.at(static_cast<std::size_t>(accessor)).bufferView));
  std::vector<T> out(view.byteLength / sizeof(T));
  std::memcpy(out.data(), model.buffers.at(0).data.data() + view.byteOffset, view.byteLength);
  return out;
}

TEST(Gltf, HasTheMeshItsThicknessAndTheTime) {
  const ForeignMesh mesh = two_triangles();
  const tinygltf::Model model = read(encode_gltf(mesh, Eigen::Vector3d::UnitY()));
  const tinygltf::Primitive& primitive = model.meshes.at(0).primitives.at(0);
  const std::vector<float> places = values<float>(model, primitive.attributes.at("POSITION"));
  ASSERT_EQ(places.size(), 15);
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(places[3 * i + c], static_cast<float>(mesh.points[i][c]));
  EXPECT_EQ(values<float>(model, primitive.attributes.at("_THICKNESS")),
            (std::vector<float>{0.1F, 0.2F, 0.3F, 0.4F, 0}));
  EXPECT_EQ(values<float>(model, primitive.attributes.at("TEXCOORD_0")),
            (std::vector<float>{0.1F, 0, 0.2F, 0, 0.3F, 0, 0.4F, 0, 0, 0}));
  EXPECT_EQ(values<std::uint32_t>(model, primitive.indices), (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3}));
  const std::vector<float> normals = values<float>(model, primitive.attributes.at("NORMAL"));
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(std::hypot(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]), 1, 1e-6);
  EXPECT_EQ(model.accessors[0].maxValues, (std::vector<double>{7, 7, 7}));
  EXPECT_EQ(model.scenes.at(0).extras.Get("time").GetNumberAsDouble(), 1.25);
}

TEST(Gltf, TurnsUpToY) {
  for (const Eigen::Vector3d& up :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(0.6, 0.8, 0)}) {
    const tinygltf::Model model = read(encode_gltf(two_triangles(), up));
    const std::vector<double>& q = model.nodes.at(0).rotation;
    ASSERT_EQ(q.size(), 4);
    EXPECT_LT((Eigen::Quaterniond(q[3], q[0], q[1], q[2]) * up - Eigen::Vector3d::UnitY()).norm(), 1e-12);
  }
}

TEST(Gltf, WithoutTrianglesThereIsASceneWithoutAMesh) {
  const tinygltf::Model model = read(encode_gltf({}, Eigen::Vector3d::UnitY()));
  EXPECT_EQ(model.meshes.size(), 0);
  EXPECT_EQ(model.scenes.size(), 1);
}

TEST(Gltf, RefusesWhatSinglePrecisionDoesNotHold) {
  ForeignMesh mesh = two_triangles();
  mesh.points[3][1] = 1e39;
  EXPECT_THROW((void)encode_gltf(mesh, Eigen::Vector3d::UnitY()), Error);
  mesh = two_triangles();
  mesh.arrays[0].values[2] = INFINITY;
  EXPECT_THROW((void)encode_gltf(mesh, Eigen::Vector3d::UnitY()), Error);
}

TEST(Gltf, TextureCoordinatesComeFirstAndPointDown) {
  ForeignMesh mesh = two_triangles();
  mesh.arrays.push_back({"uv", MeshPlace::point, 2, {0, 0.25, 1, 0.5, 0.5, 1, 0.75, 0, 0, 0}});
  const tinygltf::Model model = read(encode_gltf(mesh, Eigen::Vector3d::UnitY()));
  const tinygltf::Primitive& primitive = model.meshes.at(0).primitives.at(0);
  EXPECT_EQ(values<float>(model, primitive.attributes.at("TEXCOORD_0")),
            (std::vector<float>{0, 0.75F, 1, 0.5F, 0.5F, 0, 0.75F, 1, 0, 1}));
  EXPECT_EQ(values<float>(model, primitive.attributes.at("TEXCOORD_1")),
            (std::vector<float>{0.1F, 0, 0.2F, 0, 0.3F, 0, 0.4F, 0, 0, 0}));
}

TEST(Gltf, PointsOnSeamsStandOnceForEachTextureCoordinate) {
  ForeignMesh mesh = two_triangles(); // which share the points 1 and 2
  mesh.arrays.push_back({"a.corner_uv", MeshPlace::cell, 6, {0, 0, 1, 0, 0, 1, 0, 1, 0.5, 0.5, 0.75, 0}});
  const tinygltf::Model model = read(encode_gltf(mesh, Eigen::Vector3d::UnitY()));
  const tinygltf::Primitive& primitive = model.meshes.at(0).primitives.at(0);
  EXPECT_EQ(values<std::uint32_t>(model, primitive.indices), (std::vector<std::uint32_t>{0, 1, 2, 2, 3, 4}));
  EXPECT_EQ(values<float>(model, primitive.attributes.at("TEXCOORD_0")),
            (std::vector<float>{0, 1, 1, 1, 0, 0, 0.5F, 0.5F, 0.75F, 1}));
  EXPECT_EQ(values<float>(model, primitive.attributes.at("_THICKNESS")),
            (std::vector<float>{0.1F, 0.2F, 0.3F, 0.2F, 0.4F}));
  const std::vector<float> places = values<float>(model, primitive.attributes.at("POSITION")),
                           normals = values<float>(model, primitive.attributes.at("NORMAL"));
  const std::vector<float> smooth = values<float>(
      read(encode_gltf(two_triangles(), Eigen::Vector3d::UnitY())),
      read(encode_gltf(two_triangles(), Eigen::Vector3d::UnitY())).meshes[0].primitives[0].attributes.at("NORMAL"));
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(places[3 + c], places[9 + c]);
    EXPECT_EQ(normals[3 + c], normals[9 + c]); // a seam of the texture is none of the shape
    EXPECT_EQ(normals[3 + c], smooth[3 + c]);
  }
}

} // namespace
} // namespace sheet
