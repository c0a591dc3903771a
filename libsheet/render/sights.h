// SPDX-License-Identifier: GPL-3.0-or-later
// What solids hide of the sheet from where a camera may stand: one sees the bottom of a jar only from high above, and
// into a closed mould from nowhere.
#pragma once
#include <cstddef>
#include <vector>

#include "libsheet/render/solids.h"

namespace sheet::render {

class Sights {
public:
  // Unit vectors to the cameras, far away, the best place first; none: nothing is looked for.
  explicit Sights(std::vector<Vector3> toward);
  // `meshes`: of the frame's scene.
  void add(const formats::Frame& frame, const Scene* scene, const std::vector<SolidMesh>& meshes);
  // Numbers in the scene of those that hide at least two thirds of the sheet from each camera, and, if they are in the
  // picture with it, from as far on the other side. Where they are not, cameras may be within them.
  [[nodiscard]] std::vector<std::size_t> enclosing(bool in_picture) const;
  // The first camera that sees at least half as much of the sheet as the one that sees most, without those solids.
  [[nodiscard]] std::size_t best(const std::vector<std::size_t>& left_out) const;

private:
  std::vector<Vector3> toward_;                     // cameras, then the places opposite to them
  std::vector<std::vector<std::size_t>> hidden_by_; // points of the sheet, by place and by solid
  std::size_t points_ = 0;                          // of the sheet, in all frames
};

} // namespace sheet::render
