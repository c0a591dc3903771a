// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/quantities/fields.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/quantities/scaled_unit.h"
#include "libsheet/quantities/wanted.h"
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

TEST(Fields, DeviationIsThicknessLessWhatIsWanted) {
  formats::Frame frame = render::test::flat(2, 0.01);
  const Field& deviation = field_named("deviation");
  EXPECT_FALSE(has(frame, deviation));
  EXPECT_THROW((void)values_of(frame, deviation), Error);
  for (const double wanted : {0.008, 0.0125}) {
    want_thickness(frame, wanted);
    for (const double value : values_of(frame, deviation))
      EXPECT_NEAR(value, 0.01 - wanted, 1e-12);
  }
  EXPECT_TRUE(deviation.palette.symmetric);
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

// With velocities E x of a stretching E = diag(2, -0.5, 0) in its plane, and a scene.
formats::Frame stretched(const std::string& law) {
  formats::Frame frame = render::test::flat(3, 0.01);
  for (std::size_t v = 0; v < frame.vertices; ++v) {
    const Eigen::Vector3d& x = positions(frame)[v];
    velocities(frame)[v] = {2 * x[0], 0, -0.5 * x[2]};
  }
  frame.put_text("scene", "[sheet]\nshape = \"disk\"\nradius = 1\nedge_length = 0.1\nthickness = 0.02\n"
                          "[material]\ndensity = 1000\n" +
                              law);
  return frame;
}

TEST(Fields, OfLawsFollowFromPositionsAndVelocities) {
  const double rate = std::sqrt(2 * (4 + 0.25 + 1.5 * 1.5)); // sqrt(2 (tr E² + (tr E)²))
  const formats::Frame frame = stretched("law = \"bingham\"\nviscosity = 3\nyield_stress = 20\n");
  for (const double value : values_of(frame, field_named("strain_rate")))
    EXPECT_NEAR(value, rate, 1e-12);
  for (const double value : values_of(frame, field_named("viscosity")))
    EXPECT_NEAR(value, 3 + 20 / rate, 1e-6);
  for (const double value : values_of(frame, field_named("log_viscosity")))
    EXPECT_NEAR(value, std::log10(3 + 20 / rate), 1e-6);
}

TEST(Fields, OfLawsAreThereOnlyWhereThereIsOne) {
  const formats::Frame newtonian = stretched("viscosity = 3\n"), without = render::test::flat(1, 0.01);
  for (const std::string_view name : {"strain_rate", "viscosity", "log_viscosity"}) {
    EXPECT_FALSE(has(newtonian, field_named(name)));
    EXPECT_FALSE(has(without, field_named(name)));
    EXPECT_THROW((void)values_of(newtonian, field_named(name)), Error);
    EXPECT_TRUE(has(stretched("law = \"power\"\nviscosity = 3\nflow_index = 0.5\n"), field_named(name)));
  }
  EXPECT_TRUE(std::isnan(part_at_rest(newtonian)));
}

TEST(Fields, PartAtRestIsThatOfTheVolume) {
  formats::Frame frame = stretched("law = \"bingham\"\nviscosity = 3\nyield_stress = 20\nrest_rate = 1e-3\n");
  EXPECT_EQ(part_at_rest(frame), 0);
  for (Eigen::Vector3d& v : velocities(frame))
    v *= 1e-3; // rates of 3.6e-3 1/s, below ten times that at rest
  EXPECT_EQ(part_at_rest(frame), 1);
  const double moved = 1e3; // one corner: two triangles of 18 or one
  velocities(frame)[0] *= moved;
  EXPECT_NEAR(part_at_rest(frame), 16.0 / 18, 1e-9);
}

} // namespace
} // namespace sheet
