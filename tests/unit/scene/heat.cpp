// SPDX-License-Identifier: GPL-3.0-or-later
// [heat], and what other tables say of temperature.
#include <cmath>

#include <gtest/gtest.h>

#include "libsheet/scene/write.h"
#include "tests/unit/scene/scenes.h"

namespace sheet::scene {
namespace {

const std::string heat_table = "[heat]\nspecific_heat = \"1.25 kJ/(kg K)\"\ntemperature = \"900 degC\"\n";

Scene parsed(const std::string& text) { return parse_scene(text, "s"); }

TEST(Heat, IsReadWithItsUnits) {
  const Scene s = parsed(disk + liquid + heat_table +
                         "conductivity = \"1.2 W/(m*K)\"\nambient = \"20 °C\"\ntransfer = \"15 W/(m² K)\"\n"
                         "lower = {transfer = 0, emissivity = 0.9, radiant = 400}\nviscous_heating = true\n");
  ASSERT_TRUE(s.heat);
  EXPECT_EQ(s.heat->specific_heat, 1250);
  EXPECT_DOUBLE_EQ(s.heat->temperature, 1173.15);
  EXPECT_EQ(s.heat->conductivity, 1.2);
  EXPECT_EQ(s.heat->upper, (HeatedFace{293.15, 15, 0, 293.15}));
  EXPECT_EQ(s.heat->lower, (HeatedFace{293.15, 0, 0.9, 400}));
  EXPECT_TRUE(s.heat->viscous_heating);
  EXPECT_EQ(parsed(to_toml(s)), s);
}

TEST(Heat, AbsentIsNotThere) { EXPECT_FALSE(parsed(disk + liquid).heat); }

TEST(Heat, LawsOfViscosity) {
  const auto law = [](const std::string& keys, const std::string& viscosity = "viscosity = 100\n") {
    return parsed(disk + "[material]\ndensity = 1000\n" + viscosity + "reference_temperature = \"900 degC\"\n" + keys +
                  heat_table)
        .material;
  };
  EXPECT_EQ(law("viscosity_law = \"arrhenius\"\nactivation_energy = \"60 kJ/mol\"\n").temperature_law.activation_energy,
            60000);
  EXPECT_EQ(law("viscosity_law = \"exponential\"\ntemperature_coefficient = 0.05\n").viscosity, 100);
  const Liquid glass =
      law("viscosity_law = \"vft\"\nvft_a = -2.601\nvft_b = 4330.9\nvft_temperature = \"246.1 °C\"\n", "");
  EXPECT_NEAR(std::log10(glass.viscosity), -2.601 + 4330.9 / (900 - 246.1), 1e-12);
  const Liquid table = law("viscosity_law = \"table\"\ntemperatures = [1000, 1100, 1173.15, 1300]\n"
                           "temperature_viscosities = [1e5, 1e4, 3000, 500]\n",
                           "");
  EXPECT_NEAR(table.viscosity, 3000, 1e-9);
}

TEST(Heat, SheetsInflowsAndSolidsHaveTheirOwn) {
  const std::string strip = "[sheet]\nshape = \"rectangle\"\nsize = [1, 1]\nedge_length = 0.1\nthickness = 0.02\n"
                            "temperature = \"50 degC\"\n";
  const Scene s =
      parsed(strip + liquid + heat_table +
             "[inflow]\nregion = \"x_min\"\nvelocity = [1, 0, 0]\ntemperature = [[0, 300], [2, \"60 °C\"]]\n"
             "[[solid]]\nshape = \"plane\"\ntemperature = 280\ncontact_conductance = 500\n");
  EXPECT_EQ(std::get<double>(*s.sheets[0].temperature), 323.15);
  EXPECT_EQ(s.inflows[0].temperature->entries[1], (Timed<double>::Entry{2, 333.15}));
  EXPECT_EQ(s.solids[0].temperature->entries[0].value, 280);
  EXPECT_EQ(s.solids[0].contact_conductance, 500);
  EXPECT_EQ(parsed(to_toml(s)), s);
}

TEST(Heat, SurroundingsOverTimeAndPlace) {
  const Scene s = parsed(disk + liquid + heat_table +
                         "ambient = [[0, 300], [2, \"60 degC\"]]\ntransfer = {along = \"z\", rows = [[0, 10], "
                         "[\"20 mm\", 30]]}\nlower = {emissivity = 0.9, radiant = {along = \"x\", rows = "
                         "[[-0.1, \"500 degC\"], [0, \"900 degC\"], [0.1, \"500 degC\"]]}}\n");
  const Eigen::Vector3d x(0.05, 9, 0.005);
  EXPECT_DOUBLE_EQ(value_at(s.heat->upper.ambient, 1, x), (300 + 333.15) / 2);
  EXPECT_EQ(value_at(s.heat->upper.ambient, 5, x), 333.15);
  EXPECT_DOUBLE_EQ(value_at(s.heat->upper.transfer, 1, x), 15);
  EXPECT_EQ(value_at(s.heat->upper.transfer, 1, {0, 0, -1}), 10);
  EXPECT_EQ(s.heat->upper.radiant, s.heat->upper.ambient);
  EXPECT_DOUBLE_EQ(value_at(s.heat->lower.radiant, 1, x), 973.15);
  EXPECT_EQ(range_of(s.heat->lower.radiant), std::pair(773.15, 1173.15));
  EXPECT_EQ(range_of(s.heat->lower.ambient), std::pair(300.0, 333.15));
  EXPECT_TRUE(is_constant(parsed(disk + liquid + heat_table + "ambient = 300\ntransfer = 2\n").heat->upper.ambient));
  EXPECT_EQ(parsed(to_toml(s)), s);
}

TEST(Heat, SaysWhatIsWrongWithSurroundings) {
  const auto with = [](const std::string& keys) {
    return problem(disk + liquid + heat_table + "transfer = 3\n" + keys);
  };
  EXPECT_EQ(with("ambient = {along = \"x\"}\n"),
            "s:13:11: missing key \"rows\" in ambient, such as rows = [[0, 300], [\"0.1 m\", 900]]");
  EXPECT_EQ(with("ambient = {along = \"x\", rows = [[0, 300]]}\n"),
            "s:13:32: rows: expected 2 to 1000 rows of a place and the value there");
  EXPECT_EQ(with("ambient = {along = \"x\", rows = [[0, 300], [0, 400]]}\n"),
            "s:13:43: ambient: rows: places must increase from each row to the next, but 0 m follows 0 m");
  EXPECT_EQ(with("ambient = {along = \"x\", rows = [[0, 300], [1, -4]]}\n"),
            "s:13:47: rows must be positive, got -4 K");
  EXPECT_EQ(with("ambient = [[0, 300], [0, 400]]\n"), "s:13:22: ambient: times must increase, but 0 s follows 0 s");
}

class TemperatureCurve : public FolderOfScene {};

TEST_F(TemperatureCurve, IsTheListsOfTheScene) {
  const std::string glass = disk + "[material]\ndensity = 2500\nviscosity_law = \"table\"\nreference_temperature = "
                                   "\"800 degC\"\n";
  const Scene scene =
      read_beside("glass.csv", "temperature [degC], viscosity [P]\n600, 1e11\n700,1e8\n800, 3e6\n900, 2e5\n",
                  glass + "temperature_file = \"glass.csv\"\n" + heat_table);
  EXPECT_EQ(scene, parsed(glass +
                          "temperatures = [873.15, 973.15, 1073.15, 1173.15]\n"
                          "temperature_viscosities = [1e10, 1e7, 3e5, 2e4]\n" +
                          heat_table));
  EXPECT_EQ(parsed(to_toml(scene)), scene); // it needs the file no more
}

TEST(Heat, SaysWhatIsWrong) {
  const auto with = [](const std::string& keys) { return problem(disk + liquid + keys); };
  EXPECT_EQ(with("[heat]\ntemperature = 300\n"), "s:9:1: missing key \"specific_heat\" in [heat], such as "
                                                 "specific_heat = \"1250 J/(kg*K)\"");
  EXPECT_EQ(with(heat_table + "transfer = 3\n"),
            "s:9:1: missing key \"ambient\" in [heat], such as ambient = \"20 degC\"");
  EXPECT_EQ(with(heat_table + "ambient = 300\nemissivity = 2\n"), "s:13:14: emissivity: expected a part from 0 to 1");
  EXPECT_EQ(with(heat_table + "ambient = -3\n"), "s:12:11: ambient must be positive, got -3 K");
  EXPECT_EQ(with("viscosity_law = \"arrhenius\"\nreference_temperature = 300\nactivation_energy = 3e4\n"),
            "s:9:17: viscosity_law: needs a table [heat], without which nothing has a temperature");
  EXPECT_EQ(problem(disk + "temperature = 300\n" + liquid),
            "s:6:15: temperature: needs a table [heat], without which nothing has a temperature");
  EXPECT_EQ(
      with("activation_energy = 3e4\n" + heat_table),
      "s:9:1: key \"activation_energy\" has no meaning in [material]: viscosity_law \"constant\" takes none of these");
  EXPECT_EQ(with("[[solid]]\nshape = \"plane\"\ntemperature = 300\n" + heat_table),
            "s:9:1: missing key \"contact_conductance\" in [[solid]], such as contact_conductance = "
            "\"500 W/(m^2*K)\"");
  EXPECT_EQ(problem(disk + "[material]\nviscosity = 1\n[model]\ninertia = false\n" + heat_table),
            "s:6:1: missing key \"density\" in [material]: [heat] needs it");
}

// Not one temperature for another one, or for a difference.
TEST(Heat, ProposesForEachKeyOfALawWhatItMeans) {
  const auto with = [](const std::string& law) {
    return problem(disk + liquid + "reference_temperature = 373\nviscosity_law = \"" + law + "\"\n" + heat_table);
  };
  EXPECT_EQ(with("wlf"), "s:6:1: missing key \"wlf_c1\" in [material], such as wlf_c1 = 17.44\n"
                         "s:6:1: missing key \"wlf_c2\" in [material], such as wlf_c2 = \"51.6 K\"");
  EXPECT_EQ(with("vft"), "s:6:1: missing key \"vft_b\" in [material], such as vft_b = \"4330.9 K\"\n"
                         "s:6:1: missing key \"vft_temperature\" in [material], such as vft_temperature = "
                         "\"246.1 degC\"");
}

TEST(Heat, SaysWhatIsWrongWithATableOfViscosities) {
  const auto with = [](const std::string& keys) {
    return problem(disk + "[material]\ndensity = 1\nreference_temperature = 2\nviscosity_law = \"table\"\n" + keys +
                   heat_table);
  };
  EXPECT_EQ(with(""),
            "s:6:1: missing key \"temperatures\" in [material], such as temperatures = [\"700 degC\", \"800 degC\", "
            "...], or temperature_file = \"curve.csv\"\n"
            "s:6:1: missing key \"temperature_viscosities\" in [material], such as temperature_viscosities = "
            "[\"4e6 Pa*s\", 2e5, ...]");
  EXPECT_EQ(with("temperatures = [1, 2, 3]\ntemperature_viscosities = [3, 2, 1]\n"),
            "s:10:16: temperatures: a table takes four rows or more");
  EXPECT_EQ(with("viscosity = 3\ntemperatures = [1, 2, 2, 3]\ntemperature_viscosities = [4, 3, 2, 1]\n"),
            "s:10:1: key \"viscosity\" has no meaning in [material]: viscosity_law has it, by temperature\n"
            "s:11:16: temperatures: they must increase from each row to the next");
}

} // namespace
} // namespace sheet::scene
