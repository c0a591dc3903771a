// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/mesh_width.h"

#include <gtest/gtest.h>

#include "libsheet/solid/shapes.h"

namespace sheet {
namespace {

TEST(MeshWidth, IsThatOfSimpleBodies) {
  EXPECT_NEAR(narrow_width(*solid::make_distance(scene::Sphere{0.03})), 0.06, 1e-3);
  EXPECT_NEAR(narrow_width(*solid::make_distance(scene::Capsule{0.004, 0.1})), 0.008, 1e-4);
  EXPECT_NEAR(narrow_width(*solid::make_distance(scene::SolidBox{{0.004, 0.1, 0.006}})), 0.006, 6e-4);
}

// 2 mm thin, 40 mm wide.
TEST(MeshWidth, APlateIsAsWideAsItsFace) {
  EXPECT_NEAR(narrow_width(*solid::make_distance(scene::SolidBox{{0.06, 0.002, 0.04}})), 0.04, 4e-3);
}

} // namespace
} // namespace sheet
