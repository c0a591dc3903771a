// SPDX-License-Identifier: GPL-3.0-or-later
// How what is drawn moves, and pictures of it while the shutter is open: means of pictures at times between [Haeberli
// and Akeley 1990], each vertex going on straight with its velocity.
#pragma once
#include <vector>

#include "libsheet/render/camera.h"
#include "libsheet/render/image.h"
#include "libsheet/render/solids.h"
#include "libsheet/render/world.h"

namespace sheet::render {

// The frame `later` seconds on.
[[nodiscard]] formats::Frame moved(const formats::Frame& frame, double later);

// How many pixels what moves farthest moves in `duration` seconds, in a picture so many pixels high.
[[nodiscard]] double pixels_moved(const formats::Frame& frame, const Scene* scene, const std::vector<SolidMesh>& meshes,
                                  double duration, const Camera& camera, int height);

// Of what is hit, the frame's sheet or a solid of its scene [m/s]; 0 of the ground.
[[nodiscard]] Vec velocity_at(const formats::Frame& frame, const Scene* scene, const World& world, const Hit& hit);

// Of pictures of one size with as many samples.
[[nodiscard]] Picture mean_of(const std::vector<Picture>& pictures);

} // namespace sheet::render
