// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/seam_texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include "libsheet/base/log.h"
#include "libsheet/base/named_files.h"
#include "libsheet/solid/triangle_distance.h"

namespace sheet {

namespace {

using formats::ForeignMesh;
using formats::MeshArray;
using formats::MeshPlace;
using Uv = std::array<double, 2>;
using SeamKernel = CGAL::Simple_cartesian<double>;
using SeamTriangles = std::vector<SeamKernel::Triangle_3>;
using SeamTree = CGAL::AABB_tree<
    CGAL::AABB_traits<SeamKernel, CGAL::AABB_triangle_primitive<SeamKernel, SeamTriangles::const_iterator>>>;

constexpr double seam = 1e-6; // texture coordinates that differ by more do

bool alike(const Uv& a, const Uv& b) { return std::abs(a[0] - b[0]) <= seam && std::abs(a[1] - b[1]) <= seam; }

// Triangles among which the nearest one is found.
class Nearby {
public:
  void add(const solid::Triangle3& c) {
    const auto point = [&](std::size_t i) { return SeamKernel::Point_3(c[i].x(), c[i].y(), c[i].z()); };
    triangles_.emplace_back(point(0), point(1), point(2));
  }
  void build() {
    tree_.insert(triangles_.cbegin(), triangles_.cend());
    tree_.build();
  }
  // The number of a nearest triangle.
  [[nodiscard]] std::uint32_t nearest(const Eigen::Vector3d& x) const {
    const auto [point, primitive] = tree_.closest_point_and_primitive({x.x(), x.y(), x.z()});
    return static_cast<std::uint32_t>(primitive - triangles_.cbegin());
  }

private:
  SeamTriangles triangles_;
  SeamTree tree_;
};

// The weights of a triangle's corners in the foot of a point on its plane.
std::array<double, 3> weights_of(const solid::Triangle3& c, const Eigen::Vector3d& x) {
  const Eigen::Vector3d u = c[1] - c[0], v = c[2] - c[0], w = x - c[0], n = u.cross(v);
  if (n.isZero())
    return {1, 0, 0};
  const double second = w.cross(v).dot(n) / n.squaredNorm(), third = u.cross(w).dot(n) / n.squaredNorm();
  return {1 - second - third, second, third};
}

constexpr std::uint32_t no_triangle = std::numeric_limits<std::uint32_t>::max();

// The triangle on the other side of the side opposite each corner; none at borders and seams.
std::vector<std::array<std::uint32_t, 3>> neighbours_of(const ForeignMesh& mesh,
                                                        const std::vector<std::array<Uv, 3>>& uv) {
  struct Side {
    std::uint32_t triangle;
    std::size_t index; // of the corner opposite
    Uv first, second;
  };
  std::vector<std::array<std::uint32_t, 3>> result(mesh.triangles.size(), {no_triangle, no_triangle, no_triangle});
  std::map<std::array<std::uint32_t, 2>, std::vector<Side>> sides;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      const std::uint32_t a = mesh.triangles[t][j], b = mesh.triangles[t][k];
      const Side side = a < b ? Side{t, i, uv[t][j], uv[t][k]} : Side{t, i, uv[t][k], uv[t][j]};
      std::vector<Side>& others = sides[{std::min(a, b), std::max(a, b)}];
      for (const Side& other : others)
        if (alike(side.first, other.first) && alike(side.second, other.second)) {
          result[t][i] = other.triangle;
          result[other.triangle][other.index] = t;
        }
      others.push_back(side);
    }
  return result;
}

// Arrays that are called so, or NAME.so.
const MeshArray* array_called(const ForeignMesh& mesh, const std::string& name, MeshPlace place, int components) {
  for (const MeshArray& array : mesh.arrays)
    if (array.place == place && array.components == components &&
        (array.name == name || array.name.ends_with("." + name)))
      return &array;
  return nullptr;
}

Eigen::Vector3d place_of(const MeshArray& rest, std::uint32_t vertex) {
  return Eigen::Map<const Eigen::Vector3d>(rest.values.data() + 3 * std::size_t{vertex});
}

} // namespace

// The map of one sheet's file.
class SeamTextures::Map {
public:
  Map(ForeignMesh mesh, const MeshArray& corners) : mesh_(std::move(mesh)), uv_(mesh_.triangles.size()) {
    for (std::size_t i = 0; i < 3 * uv_.size(); ++i)
      uv_[i / 3][i % 3] = {corners.values[2 * i], corners.values[2 * i + 1]};
    neighbour_ = neighbours_of(mesh_, uv_);
    for (std::uint32_t t = 0; t < uv_.size(); ++t) {
      const solid::Triangle3 c = corners_of(t);
      nearby_.add(c);
      for (std::size_t i = 0; i < 3; ++i)
        longest_ = std::max(longest_, (c[(i + 1) % 3] - c[i]).norm());
    }
    nearby_.build();
  }

  // Whether half of these places or more are in the mesh or within an edge of it, as those are that remeshing makes.
  [[nodiscard]] bool fits(const std::vector<Eigen::Vector3d>& places) const {
    const auto is_near = [&](const Eigen::Vector3d& x) {
      return (solid::nearest_on_triangle(x, corners_of(nearby_.nearest(x))).point - x).norm() <= longest_;
    };
    return 2 * std::ranges::count_if(places, is_near) >= std::ssize(places);
  }

  // u and v at the corners of a triangle whose corners were at these places.
  [[nodiscard]] std::array<Uv, 3> at(const std::array<Eigen::Vector3d, 3>& places) const {
    const std::uint32_t start = nearby_.nearest((places[0] + places[1] + places[2]) / 3);
    std::array<Uv, 3> result{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Found found = way_to(places[i], start);
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t c = 0; c < 2; ++c)
          result[i][c] += found.weights[k] * uv_[found.triangle][k][c];
    }
    return result;
  }

private:
  struct Found {
    std::uint32_t triangle;
    std::array<double, 3> weights; // of its corners
    double distance;
  };

  [[nodiscard]] Found found_in(std::uint32_t t, const Eigen::Vector3d& x) const {
    const auto near = solid::nearest_on_triangle(x, corners_of(t));
    return {t, near.weights, (near.point - x).norm()};
  }

  // The triangle nearest to x on the way there from another one: over the side beyond which x is, of two the one beyond
  // which it is further; or, where x is above or below the triangle, that to one that is nearer.
  [[nodiscard]] Found way_to(const Eigen::Vector3d& x, std::uint32_t start) const {
    constexpr int most_steps = 64;
    Found best = found_in(start, x);
    std::uint32_t before = no_triangle, now = start;
    for (int step = 0; step < most_steps && best.distance > 1e-9 * longest_; ++step) {
      const std::uint32_t next = next_to(x, now, before, best.distance);
      if (next == no_triangle)
        break;
      before = now;
      now = next;
      if (const Found found = found_in(now, x); found.distance < best.distance)
        best = found;
    }
    return best;
  }

  [[nodiscard]] std::uint32_t next_to(const Eigen::Vector3d& x, std::uint32_t now, std::uint32_t before,
                                      double distance) const {
    const std::array<double, 3> beyond = weights_of(corners_of(now), x);
    const bool above = std::ranges::all_of(beyond, [](double weight) { return weight >= -1e-12; });
    std::uint32_t next = no_triangle;
    double least = above ? distance : -1e-12; // of the distances, or of the weights
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t t = neighbour_[now][i];
      if (t == no_triangle || t == before)
        continue;
      const double cost = above ? found_in(t, x).distance : beyond[i];
      if (cost < least) {
        least = cost;
        next = t;
      }
    }
    return next;
  }

  [[nodiscard]] solid::Triangle3 corners_of(std::uint32_t t) const {
    const auto point = [&](std::size_t i) {
      return Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(mesh_.points[mesh_.triangles[t][i]].data()));
    };
    return {point(0), point(1), point(2)};
  }

  ForeignMesh mesh_;
  std::vector<std::array<Uv, 3>> uv_; // at the corners of each triangle
  std::vector<std::array<std::uint32_t, 3>> neighbour_;
  Nearby nearby_;
  double longest_ = 0; // edge [units of the file]
};

SeamTextures::SeamTextures() = default;
SeamTextures::~SeamTextures() = default;

std::unique_ptr<SeamTextures::Map> SeamTextures::find(const scene::SheetTable& sheet, const std::string& rest,
                                                      const std::string& name,
                                                      const std::vector<Eigen::Vector3d>& places) {
  const auto* named = std::get_if<scene::SheetMesh>(&sheet.shape);
  if (named == nullptr || std::ranges::find(sheet.arrays, rest) == sheet.arrays.end())
    return nullptr;
  const std::optional<std::string> file = find_by_name(named->file);
  if (!file) {
    log::warning("{}: this mesh of the scene, which has texture coordinates with seams, is neither beside the stream "
                 "nor above it: they are left out",
                 named->file);
    return nullptr;
  }
  const std::array wanted{name};
  formats::MeshImport import = import_named_mesh(*file, wanted);
  const MeshArray* corners = import.mesh.find(name, MeshPlace::cell);
  if (corners == nullptr || corners->components != 6)
    return nullptr;
  const MeshArray kept = *corners;
  auto map = std::make_unique<Map>(std::move(import.mesh), kept);
  if (!map->fits(places)) {
    log::warning("{}: this is not the mesh that the run began with: texture coordinates with seams are left out",
                 *file);
    return nullptr;
  }
  return map;
}

void SeamTextures::add(const Scene& scene, ForeignMesh& mesh) {
  const MeshArray* const rest = array_called(mesh, "rest", MeshPlace::point, 3);
  if (rest == nullptr)
    return;
  const std::string name = rest->name.substr(0, rest->name.size() - 4) + "corner_uv";
  const MeshArray* const number = array_called(mesh, "sheet", MeshPlace::cell, 1);
  const MeshArray* const smooth = mesh.texture();
  const auto sheet_of = [&](std::size_t t) { // whatever others call "sheet" may hold any number
    const double value = number == nullptr ? 0 : number->values[t];
    return value >= 0 && value < static_cast<double>(scene.sheets.size()) ? static_cast<std::size_t>(value)
                                                                          : scene.sheets.size();
  };
  const auto places_of = [&](std::size_t t) {
    const auto& corners = mesh.triangles[t];
    return std::array{place_of(*rest, corners[0]), place_of(*rest, corners[1]), place_of(*rest, corners[2])};
  };
  maps_.resize(scene.sheets.size());
  for (std::size_t sheet = 0; sheet < maps_.size(); ++sheet) {
    std::vector<Eigen::Vector3d> places;
    for (std::size_t t = 0; !maps_[sheet] && t < mesh.triangles.size(); ++t)
      if (sheet_of(t) == sheet)
        std::ranges::copy(places_of(t), std::back_inserter(places));
    if (!maps_[sheet] && !places.empty())
      maps_[sheet] = find(scene.sheets[sheet], rest->name, name, places);
  }
  if (std::ranges::none_of(maps_, [](const auto& map) { return map && *map; }))
    return;
  MeshArray result{name, MeshPlace::cell, 6, {}};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<Uv, 3> uv{};
    if (const std::size_t sheet = sheet_of(t); sheet < maps_.size() && maps_[sheet] && *maps_[sheet])
      uv = (*maps_[sheet])->at(places_of(t));
    else if (smooth != nullptr)
      for (std::size_t i = 0; i < 3; ++i)
        std::copy_n(smooth->values.begin() + 2 * std::ptrdiff_t{mesh.triangles[t][i]}, 2, uv[i].begin());
    for (const Uv& corner : uv)
      result.values.insert(result.values.end(), corner.begin(), corner.end());
  }
  mesh.arrays.push_back(std::move(result));
}

} // namespace sheet
