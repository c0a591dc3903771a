// SPDX-License-Identifier: GPL-3.0-or-later
// OpenVDB's distances, and their cache: they change the speed, never the result.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/tools/LevelSetSphere.h>

#include "libsheet/base/error.h"
#include "libsheet/base/parallel.h"
#include "libsheet/solid/check.h"
#include "libsheet/solid/distance_cache.h"
#include "libsheet/solid/distance_field.h"
#include "libsheet/solid/solids.h"
#include "tests/unit/own_path.h"
#include "tests/unit/solid/solid_support.h"

namespace sheet::solid {
namespace {

namespace fs = std::filesystem;

// No farther from the truth than promised, anywhere; half a voxel at most on the whole where the surface has corners.
TEST(DistanceField, KeepsItsBound) {
  const auto exact = make_distance(scene::SolidBox{{1, 0.6, 1.4}});
  for (const double voxel : {0.1, 0.05, 0.025}) {
    const DistanceField field(box_surface({1, 0.6, 1.4}), voxel, 6);
    RandomPoints points(1.2);
    double worst = 0;
    for (int i = 0; i < 5000; ++i) {
      const Vector3 x = points.next();
      const double truth = exact->nearest(x).distance, value = field.at(x);
      ASSERT_LE(std::abs(value), std::abs(truth) + field.slack());
      if (std::abs(truth) < 4 * voxel)
        worst = std::max(worst, std::abs(value - truth));
    }
    EXPECT_LT(worst, 0.6 * voxel);
    EXPECT_GT(worst, 0.05 * voxel);
  }
}

TEST(DistanceField, SameBitsForAnyNumberOfThreads) {
  const SolidSurface ball = surface_of(test::icosphere(3));
  std::string first;
  for (const int threads : {1, 2, 2}) {
    const ThreadLimit limit(threads);
    const DistanceField field(ball, 0.03, 6);
    RandomPoints points(1.2);
    std::string bits;
    for (int i = 0; i < 2000; ++i) {
      const double value = field.at(points.next());
      bits.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    if (first.empty())
      first = bits;
    EXPECT_EQ(bits, first);
  }
}

TEST(DistanceField, PrintAndParse) {
  const DistanceField field(surface_of(test::icosphere(1)), 0.07, 6);
  const DistanceField again = DistanceField::parse(field.print());
  EXPECT_EQ(again.voxel_size(), 0.07);
  EXPECT_EQ(again.slack(), field.slack());
  RandomPoints points(1.5);
  for (int i = 0; i < 1000; ++i) {
    const Vector3 x = points.next();
    ASSERT_EQ(again.at(x), field.at(x));
  }
  EXPECT_ANY_THROW((void)DistanceField::parse("nothing of the kind"));
}

TEST(DistanceField, VoxelSizeDoesNotChangeTheResult) {
  const auto coarse = make_distance(surface_of(test::icosphere(2)), 0.3),
             fine = make_distance(surface_of(test::icosphere(2)), 0.02);
  RandomPoints points(1.5);
  for (int i = 0; i < 2000; ++i) {
    const Vector3 x = points.next();
    const Near a = coarse->nearest(x), b = fine->nearest(x);
    ASSERT_EQ(a.distance, b.distance);
    ASSERT_EQ(a.normal, b.normal);
  }
}

class Cache : public testing::Test {
protected:
  void SetUp() override {
    folder_ = test::own_path("distance_fields");
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::ofstream off(folder_ / "box.off");
    const SolidSurface box = box_surface({1, 0.6, 1.4});
    off << "OFF\n" << box.points.size() << ' ' << box.triangles.size() << " 0\n";
    for (const Vector3& x : box.points)
      off << x.transpose() << '\n';
    for (const Corners& c : box.triangles)
      off << "3 " << c[0] << ' ' << c[1] << ' ' << c[2] << '\n';
    setenv("SHEET_CACHE_DIR", (folder_ / "cache").c_str(), 1);
  }
  void TearDown() override {
    unsetenv("SHEET_CACHE_DIR");
    fs::remove_all(folder_);
  }

  // Distances at some points, all their bits.
  std::vector<double> values() {
    Scene scene;
    scene.solids.resize(1);
    scene.solids[0].shape = scene::SolidMesh{(folder_ / "box.off").string(), 1, 0.05};
    const Solids solids(scene);
    RandomPoints points(1.2);
    std::vector<double> result;
    for (int i = 0; i < 500; ++i)
      result.push_back(solids.at(0, points.next(), 0).distance);
    return result;
  }
  std::vector<fs::path> files() {
    std::vector<fs::path> result;
    if (fs::exists(folder_ / "cache"))
      for (const auto& entry : fs::directory_iterator(folder_ / "cache"))
        result.push_back(entry.path());
    return result;
  }

  fs::path folder_;
};

TEST_F(Cache, IsMadeUsedAndMended) {
  const auto fresh = values();
  ASSERT_EQ(files().size(), 1U);
  const fs::path file = files()[0];
  const auto size = fs::file_size(file);
  const auto made = fs::last_write_time(file);
  EXPECT_EQ(values(), fresh);
  EXPECT_EQ(fs::last_write_time(file), made);
  for (const auto cut : {std::uintmax_t{0}, std::uintmax_t{5}, size / 2, size - 1}) {
    fs::resize_file(file, cut);
    EXPECT_EQ(values(), fresh);
    EXPECT_EQ(fs::file_size(file), size);
  }
  {
    std::fstream out(file, std::ios::in | std::ios::out | std::ios::binary);
    out.seekp(static_cast<std::streamoff>(size / 2));
    out.put('\x55');
    out.put('\xaa');
  }
  EXPECT_EQ(values(), fresh);
  EXPECT_EQ(files().size(), 1U);
}

TEST_F(Cache, EmptyMeansNone) {
  setenv("SHEET_CACHE_DIR", "", 1);
  const auto without = values();
  EXPECT_TRUE(files().empty());
  setenv("SHEET_CACHE_DIR", (folder_ / "cache").c_str(), 1);
  EXPECT_EQ(values(), without);
}

TEST_F(Cache, CannotBeWritten) {
  setenv("SHEET_CACHE_DIR", (folder_ / "box.off" / "no_folder").c_str(), 1);
  const auto without = values();
  setenv("SHEET_CACHE_DIR", (folder_ / "cache").c_str(), 1);
  EXPECT_EQ(values(), without);
}

TEST(CacheKey, DependsOnAllThatMatters) {
  const SolidSurface box = box_surface({1, 1, 1});
  SolidSurface moved = box, turned = box;
  moved.points[3].x() += 1e-15;
  std::swap(turned.triangles[0], turned.triangles[1]);
  const std::string key = cache_key(box, 0.1, 6);
  EXPECT_EQ(cache_key(box_surface({1, 1, 1}), 0.1, 6), key);
  for (const std::string& other :
       {cache_key(moved, 0.1, 6), cache_key(turned, 0.1, 6), cache_key(box, 0.11, 6), cache_key(box, 0.1, 5)})
    EXPECT_NE(other, key);
}

class LevelSets : public testing::Test {
protected:
  void SetUp() override {
    setenv("SHEET_CACHE_DIR", "", 1);
    openvdb::initialize();
    file_ = test::own_path("level_set.vdb");
  }
  void TearDown() override {
    unsetenv("SHEET_CACHE_DIR");
    fs::remove(file_);
  }
  void write(const openvdb::GridBase::Ptr& grid) { openvdb::io::File(file_).write({grid}); }
  Solids load(double scale) {
    Scene scene;
    scene.solids.resize(1);
    scene.solids[0].shape = scene::SolidMesh{file_, scale, {}};
    return Solids(scene);
  }
  std::string file_;
};

TEST_F(LevelSets, Sphere) {
  write(openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(1.0F, openvdb::Vec3f(0.3F, 0, 0), 0.05F));
  const Solids solids = load(2);
  RandomPoints points(3);
  for (int i = 0; i < 1000; ++i) {
    const Vector3 x = points.next();
    EXPECT_NEAR(solids.at(0, x, 0).distance, (x - Vector3(0.6, 0, 0)).norm() - 2, 0.005);
  }
}

TEST_F(LevelSets, DensityIsRefused) {
  const auto fog = openvdb::FloatGrid::create(0);
  fog->fill(openvdb::CoordBBox({0, 0, 0}, {5, 5, 5}), 1.0F);
  fog->setGridClass(openvdb::GRID_FOG_VOLUME);
  write(fog);
  EXPECT_THROW((void)load(1), Error);
}

TEST_F(LevelSets, NotFiniteIsRefused) {
  const auto sphere = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(1.0F, openvdb::Vec3f(0), 0.1F);
  sphere->tree().setValue(openvdb::Coord(10, 0, 0), std::numeric_limits<float>::quiet_NaN());
  write(sphere);
  EXPECT_THROW((void)load(1), Error);
}

} // namespace
} // namespace sheet::solid
