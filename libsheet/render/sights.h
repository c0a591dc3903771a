// SPDX-License-Identifier: GPL-3.0-or-later
// What solids hide of the sheet from where a camera may stand: one sees the bottom of a jar only from high above, and
// into a closed mould, or between a table and a lid, from nowhere.
#pragma once
#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "libsheet/render/solids.h"

namespace sheet::render {

class Sights {
public:
  // Unit vectors to the cameras, far away, the best place first; none: nothing is looked for. `normals`: unit vectors
  // out of planes, which hide all from places behind them.
  explicit Sights(std::vector<Vector3> toward, std::span<const Vector3> normals = {});
  // `meshes`: of the frame's scene.
  void add(const formats::Frame& frame, const Scene* scene, const std::vector<SolidMesh>& meshes);
  // Numbers in the scene of those that hide at least two thirds of the sheet from each camera, where, if they are in
  // the picture with it, as much is hidden from as far on the other side, by whatever it is. Where they are not,
  // cameras may be within them.
  [[nodiscard]] std::vector<std::size_t> enclosing(bool in_picture) const;
  // The first camera that sees at least half as much of the sheet as the one that sees most, without those solids.
  [[nodiscard]] std::size_t best(const std::vector<std::size_t>& left_out) const;

private:
  // Numbers of solids, ascending, and how many points of the sheet just these stand before.
  using Hiding = std::map<std::vector<std::size_t>, std::size_t>;
  static std::size_t hidden_by(std::size_t solid, const Hiding& hiding);
  static std::size_t hidden_without(const std::vector<std::size_t>& left_out, const Hiding& hiding);
  [[nodiscard]] bool is_most(std::size_t points) const { return points > 0 && 3 * points >= 2 * points_; }

  std::vector<Vector3> toward_;    // cameras, then the places opposite to them
  std::vector<bool> behind_plane_; // likewise
  std::vector<Hiding> hiding_;     // likewise
  std::size_t points_ = 0;         // of the sheet, in all frames
};

} // namespace sheet::render
