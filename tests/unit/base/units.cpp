// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/base/units.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace sheet {
namespace {

double read(std::string_view text, const Quantity& kind) { return parse_quantity(text, kind); }

std::string problem(std::string_view text, const Quantity& kind) {
  std::string reason;
  const auto value = read_quantity(text, kind, reason);
  EXPECT_FALSE(value.has_value()) << text;
  return reason;
}

TEST(Units, PowersOfTenAreExact) {
  EXPECT_EQ(read("1 mm", quantity::length), 0.001);
  EXPECT_EQ(read("0.1 mm", quantity::length), 0.0001);
  EXPECT_EQ(read("2.5 mm", quantity::length), 0.0025);
  EXPECT_EQ(read("2.5mm", quantity::length), 0.0025);
  EXPECT_EQ(read("0.3 um", quantity::length), 3e-7);
  EXPECT_EQ(read("0.3 µm", quantity::length), 3e-7);      // U+00B5
  EXPECT_EQ(read("0.3 \u03bcm", quantity::length), 3e-7); // U+03BC
  EXPECT_EQ(read("7 nm", quantity::length), 7e-9);
  EXPECT_EQ(read("21 mN/m", quantity::surface_tension), 0.021);
  EXPECT_EQ(read("72.8 dyn/cm", quantity::surface_tension), 0.0728);
  EXPECT_EQ(read("0.03 N/m", quantity::surface_tension), 0.03);
  EXPECT_EQ(read("1.3 g/cm^3", quantity::density), 1300);
  EXPECT_EQ(read("1.3 g/cm3", quantity::density), 1300);
  EXPECT_EQ(read("1.3 g/cm³", quantity::density), 1300);
  EXPECT_EQ(read("1.3 g cm^-3", quantity::density), 1300);
  EXPECT_EQ(read("980 kg/m^3", quantity::density), 980);
  EXPECT_EQ(read("1 cP", quantity::viscosity), 0.001);
  EXPECT_EQ(read("30 P", quantity::viscosity), 3);
  EXPECT_EQ(read("100 Pa*s", quantity::viscosity), 100);
  EXPECT_EQ(read("100 Pa s", quantity::viscosity), 100);
  EXPECT_EQ(read("100 Pa·s", quantity::viscosity), 100);
  EXPECT_EQ(read("1 kg/(m*s)", quantity::viscosity), 1);
  EXPECT_EQ(read("1 kg/m/s", quantity::viscosity), 1);
  EXPECT_EQ(read("1.5 kPa", quantity::pressure), 1500);
  EXPECT_EQ(read("2 mbar", quantity::pressure), 200);
  EXPECT_EQ(read("25 mm/s", quantity::velocity), 0.025);
  EXPECT_EQ(read("5 %", quantity::number), 0.05);
  EXPECT_EQ(read("1/s", quantity::turning_rate), 1);
  EXPECT_EQ(read("2 1/s", quantity::turning_rate), 2);
  EXPECT_EQ(read("0.3 rad/s", quantity::turning_rate), 0.3);
  EXPECT_EQ(read("1e-6 m^3/(Pa*s)", quantity::conductance), 1e-6);
  EXPECT_EQ(read("1 mL/(Pa*s)", quantity::conductance), 1e-6);
  EXPECT_EQ(read("1.5E+1 mm", quantity::length), 0.015);
  EXPECT_EQ(read("-9.81 m/s^2", quantity::acceleration), -9.81);
}

TEST(Units, AsDataSheetsWriteThem) {
  EXPECT_EQ(read("50 Pas", quantity::viscosity), 50);
  EXPECT_EQ(read("50 mPas", quantity::viscosity), 0.05);
  EXPECT_EQ(read("50 Pa.s", quantity::viscosity), 50);
  EXPECT_EQ(read("350 cps", quantity::viscosity), 0.35);
  EXPECT_EQ(read("1 cc", quantity::volume), 1e-6);
  EXPECT_EQ(read("1 g/cc", quantity::density), 1000);
  EXPECT_EQ(read("2 in", quantity::length), 0.0508);
  EXPECT_EQ(read("0.5 inch", quantity::length), 0.0127);
  EXPECT_EQ(read("6 ft", quantity::length), 1.8288);
  EXPECT_EQ(read("32 ft/s^2", quantity::acceleration), 9.7536);
  EXPECT_DOUBLE_EQ(read("80 lb/ft^3", quantity::density), 80 * 0.45359237 / std::pow(0.3048, 3));
  EXPECT_DOUBLE_EQ(read("1 lb/(ft*s)", quantity::viscosity), 0.45359237 / 0.3048);
  EXPECT_DOUBLE_EQ(read("2 lbf/ft", quantity::surface_tension), 2 * 0.45359237 * 9.80665 / 0.3048);
  EXPECT_DOUBLE_EQ(read("1 psi", quantity::pressure), 0.45359237 * 9.80665 / (0.0254 * 0.0254));
  EXPECT_EQ(read("50 Pa\u22c5s", quantity::viscosity), 50);
  EXPECT_EQ(read("1300 kg·m\u207b³", quantity::density), 1300);
  EXPECT_EQ(read("1300\u00a0kg/m³", quantity::density), 1300);
  EXPECT_EQ(read("2.5\u202fmm", quantity::length), 0.0025);
  EXPECT_EQ(read("\u22129.81 m s\u207b²", quantity::acceleration), -9.81);
  EXPECT_EQ(problem("50,5 Pa*s", quantity::viscosity),
            "expected a viscosity such as \"100 Pa*s\", got \"50,5 Pa*s\": write a decimal point, not a comma");
}

TEST(Units, EveryDecimalIsTheNearestDouble) {
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    const int digits = static_cast<int>(random() % 100000);
    EXPECT_EQ(read(std::to_string(digits) + " um", quantity::length), std::stod(std::to_string(digits) + "e-6"));
    EXPECT_EQ(read("0." + std::to_string(digits) + " mm", quantity::length),
              std::stod("0." + std::to_string(digits) + "e-3"));
  }
}

TEST(Units, OtherFactors) {
  EXPECT_EQ(read("2 min", quantity::time), 120);
  EXPECT_EQ(read("1.5 minutes", quantity::time), 90);
  EXPECT_EQ(read("3 sec", quantity::time), 3);
  EXPECT_EQ(read("1 second", quantity::time), 1);
  EXPECT_EQ(read("3 seconds", quantity::time), 3);
  EXPECT_EQ(read("40 msec", quantity::time), 0.04);
  EXPECT_EQ(read("2 hr", quantity::time), 7200);
  EXPECT_EQ(read("1 hour", quantity::time), 3600);
  EXPECT_EQ(read("2 hours", quantity::time), 7200);
  EXPECT_EQ(read("1 day", quantity::time), 86400);
  EXPECT_EQ(read("2 days", quantity::time), 2 * 86400);
  EXPECT_EQ(read("1 year", quantity::time), read("1 a", quantity::time));
  EXPECT_EQ(read("300 years", quantity::time), read("300 yr", quantity::time));
  EXPECT_EQ(read("3 cm/year", quantity::velocity), read("3 cm/yr", quantity::velocity));
  EXPECT_EQ(read("25 mm/sec", quantity::velocity), 0.025);
  EXPECT_EQ(read("30 Poise", quantity::viscosity), 3);
  EXPECT_EQ(read("30 poise", quantity::viscosity), 3);
  EXPECT_EQ(read("350 centipoise", quantity::viscosity), 0.35);
  EXPECT_EQ(read("350 cP", quantity::viscosity), 0.35);
  EXPECT_DOUBLE_EQ(read("2 rps", quantity::turning_rate), 4 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(read("2 rps", quantity::turning_rate), read("120 rpm", quantity::turning_rate));
  EXPECT_EQ(problem("1000 cSt", quantity::viscosity),
            "expected a viscosity such as \"100 Pa*s\", got a kinematic viscosity (m^2/s): multiply it by the density, "
            "as 1000 cSt * 1.4 g/cm^3 = 1400 mPa*s");
  EXPECT_EQ(read("2 d", quantity::time), 172800);
  EXPECT_EQ(read("10 a", quantity::time), 315576000);
  EXPECT_EQ(read("31557.6 km/a", quantity::velocity), 1);
  EXPECT_EQ(read("31557.6 km/yr", quantity::velocity), 1);
  EXPECT_EQ(read("40 dyne/cm", quantity::surface_tension), 0.04);
  EXPECT_EQ(read("2 ka", quantity::time), 2e3 * 31557600);
  EXPECT_EQ(read("2 kyr", quantity::time), 2e3 * 31557600);
  EXPECT_EQ(read("3 Ma", quantity::time), 3e6 * 31557600);
  EXPECT_EQ(read("3 Myr", quantity::time), 3e6 * 31557600);
  EXPECT_EQ(read("0.1 h", quantity::time), 360);
  EXPECT_EQ(read("180 deg", quantity::angle), std::numbers::pi);
  EXPECT_EQ(read("45°", quantity::angle), std::numbers::pi / 4);
  EXPECT_EQ(read("0.5 turn", quantity::angle), std::numbers::pi);
  EXPECT_DOUBLE_EQ(read("30 rpm", quantity::turning_rate), std::numbers::pi);
  EXPECT_DOUBLE_EQ(read("0.5 turn/s", quantity::turning_rate), std::numbers::pi);
  EXPECT_EQ(read("50 Hz", quantity::strain_rate), 50);
  EXPECT_DOUBLE_EQ(read("90 deg/s", quantity::turning_rate), std::numbers::pi / 2);
  EXPECT_EQ(read("3 m/min", quantity::velocity), 0.05);
}

TEST(Units, TemperaturesInCelsiusStandAlone) {
  const auto read = [](const char* text) { return parse_quantity(text, quantity::temperature); };
  EXPECT_EQ(read("900 degC"), 900 + 273.15);
  EXPECT_EQ(read("-5 °C"), -5 + 273.15);
  EXPECT_EQ(read("300 K"), 300);
  EXPECT_EQ(read("300"), 300);
  EXPECT_EQ(parse_quantity("1.2 W/(m K)", quantity::conductivity), 1.2);
  EXPECT_EQ(parse_quantity("1.25 kJ/(kg K)", quantity::specific_heat), 1250);
  EXPECT_EQ(parse_quantity("60 kJ/mol", quantity::molar_energy), 60000);
  std::string problem;
  EXPECT_FALSE(read_quantity("3 W/(m degC)", quantity::conductivity, problem));
  EXPECT_NE(problem.find("counts from 273.15 K, so it stands behind a temperature alone: write K"), std::string::npos);
  EXPECT_FALSE(read_quantity("3 degC", quantity::length, problem));
}

TEST(Units, BareNumbersAreSi) {
  EXPECT_EQ(read("0.025", quantity::length), 0.025);
  EXPECT_EQ(read(" +3 ", quantity::viscosity), 3);
  EXPECT_EQ(read(".5", quantity::time), 0.5);
}

TEST(Units, ProblemsSayWhatWasExpected) {
  EXPECT_EQ(problem("3 Pa*s", quantity::length), "expected a length such as \"2.5 mm\", got a viscosity (Pa*s)");
  EXPECT_EQ(problem("3 mm", quantity::viscosity), "expected a viscosity such as \"100 Pa*s\", got a length (m)");
  EXPECT_EQ(problem("3 N", quantity::pressure), "expected a pressure such as \"10 Pa\", got a force (N)");
  EXPECT_EQ(problem("3 deg", quantity::length), "expected a length such as \"2.5 mm\", got a plain number or angle");
  EXPECT_EQ(problem("3 kg^2 m", quantity::length), "expected a length such as \"2.5 mm\", got a quantity in kg^2*m");
  EXPECT_EQ(
      problem("3 furlong", quantity::length),
      "expected a length such as \"2.5 mm\": unknown unit \"furlong\"; known: m, in, inch, ft, prefixes as in mm");
  EXPECT_EQ(
      problem("3 fortnights", quantity::time),
      "expected a time such as \"0.5 s\": unknown unit \"fortnights\"; known: s, min, h, d, a, ka, Ma, yr, kyr, Myr, "
      "prefixes as in ms");
  EXPECT_EQ(problem("60 degF", quantity::temperature),
            "expected a temperature such as \"900 degC\": unknown unit \"degF\"; known: K, degC, prefixes as in mK");
  EXPECT_EQ(problem("3 furlong/s", quantity::velocity),
            "expected a velocity such as \"0.1 m/s\": unknown unit \"furlong\"");
  EXPECT_EQ(problem("mm", quantity::length),
            "expected a length such as \"2.5 mm\", got \"mm\", which does not begin with a number");
  EXPECT_EQ(problem("inf", quantity::length),
            "expected a length such as \"2.5 mm\", got \"inf\", which does not begin with a number");
  EXPECT_EQ(problem("", quantity::length), "expected a length such as \"2.5 mm\", got an empty text");
  EXPECT_EQ(problem(std::string(201, '1'), quantity::length),
            "expected a length such as \"2.5 mm\", got a text that is too long");
  EXPECT_EQ(problem("1e999 m", quantity::length), "\"1e999 m\" is beyond the range of numbers");
  EXPECT_EQ(problem("1e99999999999 m", quantity::length), "\"1e99999999999 m\" is beyond the range of numbers");
  EXPECT_EQ(problem("1 m^", quantity::length), "expected a length such as \"2.5 mm\": a power in a unit must be an "
                                               "integer from -9 to 9, in \"m^\"");
  EXPECT_EQ(
      problem("1 kg/m s", quantity::viscosity),
      "expected a viscosity such as \"100 Pa*s\": unit \"kg/m s\" is ambiguous: write brackets, as in \"kg/(m*s)\"");
  EXPECT_EQ(problem("1 Hz", quantity::turning_rate),
            "expected a turning rate such as \"0.3 rad/s\", got \"1 Hz\", which "
            "may be turns or radians: write turn/s, rpm or rad/s");
  EXPECT_EQ(problem("5 10/s", quantity::turning_rate),
            "expected a turning rate such as \"0.3 rad/s\": cannot read \"10/s\" in unit \"10/s\"");
  EXPECT_EQ(problem("1 (m", quantity::length), "expected a length such as \"2.5 mm\": missing \")\" in unit \"(m\"");
  EXPECT_EQ(problem("1 m)", quantity::length),
            "expected a length such as \"2.5 mm\": cannot read \")\" in unit \"m)\"");
  EXPECT_EQ(problem("1 m*", quantity::length), "expected a length such as \"2.5 mm\": unit \"m*\" ends too early");
  EXPECT_EQ(problem("1 ((((((((((m))))))))))", quantity::length),
            "expected a length such as \"2.5 mm\": too many brackets in a unit");
}

TEST(Units, CommandLineErrorsAreUsageErrors) {
  try {
    (void)parse_quantity("3 Pa", quantity::length);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_STREQ(error.what(), "expected a length such as \"2.5 mm\", got a pressure (Pa)");
  }
}

TEST(Units, ShortestTextReadsBack) {
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(1000), "1000");
  std::mt19937_64 random(2);
  for (int i = 0; i < 1000; ++i) {
    const double value = std::ldexp(static_cast<double>(random() >> 11), static_cast<int>(random() % 200) - 150);
    EXPECT_EQ(std::stod(shortest(value)), value);
  }
}

} // namespace
} // namespace sheet
