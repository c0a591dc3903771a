// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/quantities/fields.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/quantities/scaled_unit.h"
#include "libsheet/sheet/sheet.h"
#include "tests/unit/render/scenes.h"

namespace sheet {
namespace {

TEST(Fields, HaveNamesOfTheirOwnAndAValueARow) {
  const formats::Frame frame = render::test::ball(5, 0.01);
  std::set<std::string_view> names;
  for (const Field& field : fields()) {
    EXPECT_TRUE(names.insert(field.name).second);
    EXPECT_EQ(&field_named(field.name), &field);
    EXPECT_NE(field.palette.stops.empty(), field.palette.kinds.empty());
    if (has(frame, field)) {
      EXPECT_EQ(values_of(frame, field).size(), frame.rows_at(field.where));
    }
  }
}

TEST(Fields, WithoutAFormulaAreTheFramesArrayOfThatName) {
  const Field field{"sugar", "sugar", "kg/m^3", formats::Place::triangle, nullptr, amounts, true};
  formats::Frame frame = render::test::flat(1, 0.01);
  EXPECT_FALSE(has(frame, field));
  EXPECT_THROW((void)values_of(frame, field), Error);
  const std::vector<double> values(frame.triangles, 3);
  formats::Array& array = frame.put(formats::make_array("sugar", formats::Place::triangle, formats::Type::float64, 1,
                                                        "kg/m^3", formats::Transfer::interpolate, frame.triangles));
  std::ranges::copy(values, array.values<double>().begin());
  EXPECT_EQ(values_of(frame, field), values);
}

TEST(Fields, CurvatureOfABallAndATrough) {
  const auto middle_of = [](const formats::Frame& frame) {
    const std::vector<double> values = values_of(frame, field_named("curvature"));
    return values[values.size() / 2];
  };
  EXPECT_NEAR(middle_of(render::test::ball(40, 0.01)), 2, 0.04);    // 1/R, positive outwards
  EXPECT_NEAR(middle_of(render::test::trough(40, 0.01)), -1, 0.02); // 1/(2R), its positive side is the inner one
  EXPECT_NEAR(middle_of(render::test::flat(4, 0.01)), 0, 1e-12);
}

TEST(ScaledUnits, FitTheLargestNumber) {
  EXPECT_EQ(fitting_unit("m", 0.002).name, "mm");
  EXPECT_EQ(fitting_unit("m", 1e-12).name, "nm");
  EXPECT_EQ(fitting_unit("m^3", 0.02).name, "l");
  EXPECT_EQ(fitting_unit("K", 1e-9).name, "K");
  EXPECT_EQ(fitting_unit("1", 5).name, "");
}

} // namespace
} // namespace sheet
