// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/first_frame.h"

#include <gtest/gtest.h>

#include "libsheet/scene/read.h"

namespace sheet {
namespace {

// A second ago the plate was below the sheet.
TEST(FirstFrame, KnowsNothingOfWhereSolidsHaveBeen) {
  const Scene scene = scene::parse_scene("[sheet]\nshape = \"rectangle\"\nsize = [0.2, 0.2]\nedge_length = 0.02\n"
                                         "thickness = 0.005\n[material]\nviscosity = 50\ndensity = 1200\n"
                                         "[[hold]]\nregion = \"rim\"\nkind = \"pinned\"\n"
                                         "[[solid]]\nshape = \"box\"\nsize = [0.3, 0.01, 0.3]\ncenter = [0, 0.1, 0]\n"
                                         "velocity = [0, 0.2, 0]\n[contact]\nself = true\n",
                                         "s");
  testing::internal::CaptureStderr();
  const formats::Frame frame = checked_first_frame(scene);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

} // namespace
} // namespace sheet
