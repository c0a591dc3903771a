// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/face_warnings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/scene/read.h"
#include "libsheet/shape/build.h"

namespace sheet {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> warnings(const std::string& pattern, const std::string& more, double until) {
  const Scene scene = scene::parse_scene("[sheet]\nshape = \"rectangle\"\nsize = [0.1, 0.1]\nedge_length = 0.02\n"
                                         "thickness = 0.001\npattern = \"" +
                                             pattern +
                                             "\"\n[material]\nviscosity = 1\n"
                                             "density = 1000\n" +
                                             more,
                                         "s");
  return face_warnings(scene, build_frame(scene), until);
}

const std::string tension = "surface_tension = 0.05\n", faces = tension + "[model]\nfaces = true\n";

TEST(FaceWarnings, RecommendFacesWhereTensionMovesRims) {
  EXPECT_THAT(warnings("irregular", "", 1), IsEmpty());
  EXPECT_THAT(warnings("irregular", tension, 1e-3), IsEmpty());              // gamma t/(mu h) = 0.05
  const std::string thins = "law = \"power\"\nflow_index = 0.5\n" + tension; // 0.02 Pa s at 50 Pa
  EXPECT_THAT(warnings("irregular", thins, 1e-3), ElementsAre(HasSubstr("sqrt(rho gamma h) = 0.089")));
  EXPECT_THAT(warnings("irregular", tension, 1), ElementsAre(HasSubstr("faces = true")));
  EXPECT_THAT(warnings("irregular", "surface_tension = 2\n", 1e-6), ElementsAre(HasSubstr("sqrt(rho gamma h) = 0.7")));
  EXPECT_THAT(warnings("irregular", tension + "[[hold]]\nregion = \"rim\"\n", 1), IsEmpty());
  EXPECT_THAT(warnings("irregular", faces, 1), IsEmpty());
}

TEST(FaceWarnings, RightAnglesSpoilSlopes) {
  EXPECT_THAT(warnings("structured", faces, 1), ElementsAre(HasSubstr("right-angled")));
  EXPECT_THAT(warnings("equilateral", faces, 1), IsEmpty());
}

} // namespace
} // namespace sheet
