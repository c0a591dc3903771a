// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/quantities/sheet_kinds.h"

#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/quantities/fields.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {
namespace {

TEST(SheetKinds, HaveTheNamesOfTheScenesSheetsOrNumbers) {
  Scene scene;
  scene.sheets.resize(10);
  scene.sheets[1].name = "cream";
  const std::vector<std::string> names = sheet_names(scene);
  EXPECT_EQ(names[0], "sheet 1");
  EXPECT_EQ(names[1], "cream");
  const SheetKinds kinds(names);
  const auto& told = kinds.palette().kinds;
  ASSERT_EQ(told.size(), 10);
  EXPECT_EQ(told[9].name, "sheet 10");
  EXPECT_EQ(told[9].colour, told[1].colour);
  for (std::size_t i = 1; i < 8; ++i)
    EXPECT_NE(told[i].colour, told[0].colour);
}

TEST(SheetKinds, AreThoseOfTheArray) {
  const std::vector<Eigen::Vector3d> x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  const std::vector<Corners> triangles{{0, 1, 2}, {0, 3, 1}};
  formats::Frame frame = make_frame(x, triangles, std::vector<double>{1, 1});
  const Field& field = field_named("sheet");
  EXPECT_FALSE(has(frame, field));
  EXPECT_THROW((void)values_of(frame, field), Error);
  formats::Array array = formats::make_standard_array("sheet", 2);
  array.values<std::uint32_t>()[1] = 3;
  frame.put(std::move(array));
  EXPECT_TRUE(has(frame, field));
  EXPECT_EQ(values_of(frame, field), (std::vector<double>{0, 3}));
}

} // namespace
} // namespace sheet
