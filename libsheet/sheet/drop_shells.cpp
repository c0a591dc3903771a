// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/sheet/drop_shells.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "libsheet/geometry/area.h"
#include "libsheet/sheet/append.h"
#include "libsheet/sheet/drops.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

using formats::Frame;

namespace {

// Of the unit ball, counter-clockwise seen from outside.
struct BallMesh {
  std::vector<Vector3> positions;
  std::vector<Corners> triangles;
};

BallMesh icosahedron() {
  constexpr double a = 1, b = std::numbers::phi;
  BallMesh mesh{{{-a, b, 0},
                 {a, b, 0},
                 {-a, -b, 0},
                 {a, -b, 0},
                 {0, -a, b},
                 {0, a, b},
                 {0, -a, -b},
                 {0, a, -b},
                 {b, 0, -a},
                 {b, 0, a},
                 {-b, 0, -a},
                 {-b, 0, a}},
                {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                 {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                 {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (Vector3& x : mesh.positions)
    x.normalize();
  return mesh;
}

BallMesh parted(const BallMesh& old) {
  BallMesh mesh{old.positions, {}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t i, std::uint32_t j) {
    const auto [at, is_new] = middles.try_emplace(std::minmax(i, j), mesh.positions.size());
    if (is_new)
      mesh.positions.push_back((old.positions[i] + old.positions[j]).normalized());
    return at->second;
  };
  for (const auto& [a, b, c] : old.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Corners& part : {Corners{a, ab, ca}, Corners{ab, b, bc}, Corners{ca, bc, c}, Corners{ab, bc, ca}})
      mesh.triangles.push_back(part);
  }
  return mesh;
}

// Of the triangles of the unit ball, as parts of their sum.
std::vector<double> area_parts(const BallMesh& ball) {
  std::vector<double> parts;
  double whole = 0;
  for (const auto& [a, b, c] : ball.triangles) {
    parts.push_back(TriangleArea(ball.positions[a], ball.positions[b], ball.positions[c]).area);
    whole += parts.back();
  }
  for (double& part : parts)
    part /= whole;
  return parts;
}

template <class T> void put_of_triangles(Frame& shells, formats::Array array, std::span<const T> of_drops) {
  const auto values = array.values<T>();
  for (std::size_t t = 0; t < values.size(); ++t)
    values[t] = of_drops[t / (values.size() / of_drops.size())];
  shells.put(std::move(array));
}

} // namespace

Frame with_drop_shells(const Frame& frame, const DropShells& how) {
  const std::vector<Drop> drops = read_drops(frame);
  if (drops.empty())
    return frame;
  BallMesh ball = icosahedron();
  for (int i = 0; i < how.partings; ++i)
    ball = parted(ball);
  const std::vector<double> parts = area_parts(ball);
  std::vector<Vector3> x, v;
  std::vector<Corners> corners;
  std::vector<double> volume, temperature;
  std::vector<std::uint32_t> liquid;
  for (const Drop& drop : drops) {
    const auto first = static_cast<std::uint32_t>(x.size());
    for (const Vector3& at : ball.positions)
      x.push_back(drop.position + how.part * drop.radius() * at);
    v.insert(v.end(), ball.positions.size(), drop.velocity);
    for (const auto& [a, b, c] : ball.triangles)
      corners.push_back({a + first, b + first, c + first});
    for (const double part : parts)
      volume.push_back(drop.volume * part);
    temperature.push_back(drop.temperature);
    liquid.push_back(drop.liquid);
  }
  Frame shells = make_frame(x, corners, volume);
  std::ranges::copy(v, velocities(shells).begin());
  if (frame.find("temperature") != nullptr)
    put_of_triangles<double>(shells, formats::make_standard_array("temperature", corners.size()), temperature);
  if (frame.find("liquid") != nullptr)
    put_of_triangles<std::uint32_t>(shells, formats::make_standard_array("liquid", corners.size()), liquid);
  formats::Array marks = formats::make_array("drop.shell", formats::Place::triangle, formats::Type::uint8, 1, "1",
                                             formats::Transfer::copy, corners.size());
  std::ranges::fill(marks.values<std::uint8_t>(), std::uint8_t{1});
  shells.put(std::move(marks));
  Frame result = frame;
  for (const char* array : {"drop_position", "drop_velocity", "drop_volume", "drop_liquid", "drop_temperature",
                            "drop_touch", "drop_start_position"})
    result.erase(array);
  append(shells, result);
  return result;
}

} // namespace sheet
