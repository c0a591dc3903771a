// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities as people write them, "2.5 mm" or "100 Pa*s", read as SI numbers with their dimension checked.
//
// Grammar: a number, then a unit: names joined by * (or a blank, or a middle dot) and /, worked off from left to right,
// each with an optional integer power ("m^3", "m3", "s^-1", "m²"), in brackets if need be. A number alone is taken as
// SI. Angles count as plain numbers (1 rad = 1). "°C" and "degC" stand alone, behind a temperature.
// Powers of ten go into the decimal number before it becomes a double,
// so "0.1 mm" is the double nearest to 0.0001.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "libsheet/base/error.h"

namespace sheet {

// Exponents of the base units; angles have none.
struct Dimension {
  int kg = 0, m = 0, s = 0, K = 0, mol = 0;
  bool operator==(const Dimension&) const = default;
};

// What a place in a file or a command line expects. `name` carries its article and `example` a value in everyday units.
struct Quantity {
  std::string_view name;
  Dimension dimension;
  std::string_view unit; // SI, as printed
  std::string_view example;
};

namespace quantity {
inline constexpr Quantity number{"a plain number", {0, 0, 0}, "1", "0.5"};
inline constexpr Quantity angle{"an angle", {0, 0, 0}, "rad", "45 deg"};
inline constexpr Quantity length{"a length", {0, 1, 0}, "m", "2.5 mm"};
inline constexpr Quantity time{"a time", {0, 0, 1}, "s", "0.5 s"};
inline constexpr Quantity mass{"a mass", {1, 0, 0}, "kg", "20 g"};
inline constexpr Quantity velocity{"a velocity", {0, 1, -1}, "m/s", "0.1 m/s"};
inline constexpr Quantity acceleration{"an acceleration", {0, 1, -2}, "m/s^2", "9.81 m/s^2"};
inline constexpr Quantity turning_rate{"a turning rate", {0, 0, -1}, "rad/s", "0.3 rad/s"};
inline constexpr Quantity strain_rate{"a rate", {0, 0, -1}, "1/s", "0.1 s^-1"};
inline constexpr Quantity viscosity{"a viscosity", {1, -1, -1}, "Pa*s", "100 Pa*s"};
inline constexpr Quantity density{"a density", {1, -3, 0}, "kg/m^3", "1000 kg/m^3"};
inline constexpr Quantity surface_tension{"a surface tension", {1, 0, -2}, "N/m", "30 mN/m"};
inline constexpr Quantity stiffness{"a stiffness", {1, 0, -2}, "N/m", "1.5 N/m"};
inline constexpr Quantity drag{"a drag", {1, -2, -1}, "Pa*s/m", "100 Pa*s/m"};
inline constexpr Quantity pressure{"a pressure", {1, -1, -2}, "Pa", "10 Pa"};
inline constexpr Quantity volume{"a volume", {0, 3, 0}, "m^3", "1e-3 m^3"};
inline constexpr Quantity number_density{"a number per volume", {0, -3, 0}, "1/m^3", "2e4 1/m^3"};
inline constexpr Quantity temperature{"a temperature", {0, 0, 0, 1}, "K", "900 degC"};
inline constexpr Quantity specific_heat{"a specific heat", {0, 2, -2, -1}, "J/(kg*K)", "1250 J/(kg*K)"};
inline constexpr Quantity conductivity{"a thermal conductivity", {1, 1, -3, -1}, "W/(m*K)", "1.2 W/(m*K)"};
inline constexpr Quantity heat_transfer{"a heat transfer coefficient", {1, 0, -3, -1}, "W/(m^2*K)", "15 W/(m^2*K)"};
inline constexpr Quantity molar_energy{"a molar energy", {1, 2, -2, 0, -1}, "J/mol", "60 kJ/mol"};
inline constexpr Quantity per_kelvin{"a change per kelvin", {0, 0, 0, -1}, "1/K", "0.02 1/K"};
inline constexpr Quantity tension_slope{"a surface tension per kelvin", {1, 0, -2, -1}, "N/(m*K)", "-0.05 mN/(m*K)"};
inline constexpr Quantity conductance{"a conductance", {-1, 4, 1}, "m^3/(Pa*s)", "1e-6 m^3/(Pa*s)"};
} // namespace quantity

// The SI value of `text`, or nothing and the reason in `problem`:
//   expected a length such as "2.5 mm", got a viscosity (Pa*s)
[[nodiscard]] std::optional<double> read_quantity(std::string_view text, const Quantity& expected,
                                                  std::string& problem);

// The same for command lines: throws Error with `code`.
[[nodiscard]] double parse_quantity(std::string_view text, const Quantity& expected, ExitCode code = ExitCode::usage);

// "a viscosity (Pa*s)" for a dimension that has a name, "a quantity in kg^2*m" for one that has not.
[[nodiscard]] std::string describe(const Dimension& dimension);

// "expected a length such as "2.5 mm", got ..." with the caller's own words for what was found instead.
[[nodiscard]] std::string mismatch(const Quantity& expected, std::string_view got);

// Shortest decimal text that reads back as the same double.
[[nodiscard]] std::string shortest(double value);

} // namespace sheet
