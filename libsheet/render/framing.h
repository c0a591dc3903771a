// SPDX-License-Identifier: GPL-3.0-or-later
// What there is to see in the frames that will be drawn, so that camera, ground and scale of a film stand still.
#pragma once
#include <vector>

#include "libsheet/render/looks.h"
#include "libsheet/render/solids.h"

namespace sheet::render {

struct Survey {
  Box sheet, solids;              // [m]
  Scale scale = Scale::nothing(); // of the look's values
  // `meshes`: of the frame's scene.
  void add(const formats::Frame& frame, const Scene* scene, const std::vector<SolidMesh>& meshes, Look look);
  // What the picture is about: the sheet, and the finite solids unless they are more than 4 times as large; grown by
  // `growth` of its size to all sides. Empty if there is nothing at all.
  [[nodiscard]] Box subject(double growth) const;
};

// The scene's upward direction; y without gravity or scene.
[[nodiscard]] Vector3 up_of(const Scene* scene);

// A ground for a scene that has no plane of its own, a little below the subject.
[[nodiscard]] Plane ground_below(const Box& subject, const Vector3& up);

} // namespace sheet::render
