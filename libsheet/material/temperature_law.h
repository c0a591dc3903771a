// SPDX-License-Identifier: GPL-3.0-or-later
// How a liquid's viscosity depends on temperature, as a scene says it, and the factor that follows: a_T(T) =
// μ(T)/μ(T_r) with T_r the reference temperature, at which the liquid has its `viscosity`. All of a flow curve is
// shifted by it, η(γ̇, T) = a_T η(a_T γ̇, T_r) [time-temperature superposition: Ferry 1980, chapter 11]. SI units,
// temperatures in K.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace sheet {

enum class TemperatureLawKind {
  constant,    // a_T = 1
  arrhenius,   // ln a_T = (E/R) (1/T - 1/T_r) [Andrade 1930]
  exponential, // ln a_T = -b (T - T_r) [Reynolds 1886; Nahme 1940]
  vft,         // log10 μ = A + B/(T - T_0) [Vogel 1921; Fulcher 1925; Tammann and Hesse 1926]
  wlf,         // log10 a_T = -C_1 (T - T_r)/(C_2 + T - T_r) [Williams, Landel and Ferry 1955]
  table        // ln μ over T, a monotone cubic [Fritsch and Carlson 1980]; constant beyond its ends
};

struct TemperatureLaw {
  TemperatureLawKind kind = TemperatureLawKind::constant;
  double reference_temperature = 0;                        // T_r [K]
  double activation_energy = 0;                            // E [J/mol]
  double temperature_coefficient = 0;                      // b [1/K]
  std::optional<double> vft_a = {};                        // A, of μ in Pa s; absent: the liquid's viscosity stands
  double vft_b = 0, vft_temperature = 0;                   // B, T_0 [K]
  double wlf_c1 = 0, wlf_c2 = 0;                           // C_1, C_2 [K]
  std::vector<double> temperatures = {}, viscosities = {}; // of a table, four rows or more, T ascending [K], [Pa s]
  double greatest_factor =
      1e12; // a_T does not rise above this: colder liquid is as good as solid; nor fall below its inverse

  [[nodiscard]] bool constant() const { return kind == TemperatureLawKind::constant; }
  bool operator==(const TemperatureLaw&) const = default;
};

inline constexpr double gas_constant = 8.31446261815324; // R [J/(mol K)], exact since 2019

// Between which temperatures a law says something [K]: above T_0, above T_r - C_2, in a table. Below the first of a
// vft or wlf law its viscosity is infinite (the factor is the greatest), beyond a table's ends it is that of the end.
struct TemperatureRange {
  double lowest, highest;
  [[nodiscard]] bool holds(double temperature) const { return temperature >= lowest && temperature <= highest; }
};
[[nodiscard]] TemperatureRange range_of(const TemperatureLaw& law);

// Whether the law itself says how great the viscosity is, not only by how much it changes: a table, vft with A.
[[nodiscard]] bool has_viscosity(const TemperatureLaw& law);

// μ(T_r) as such a law has it [Pa s]; nothing for others, and for a table without rows.
[[nodiscard]] std::optional<double> reference_viscosity(const TemperatureLaw& law);

// A law made ready to be asked often.
class ViscosityShift {
public:
  struct Point {
    double factor = 1;    // a_T
    double log_slope = 0; // d ln a_T/dT [1/K]; 0 where the factor is the greatest
  };
  ViscosityShift() : ViscosityShift(TemperatureLaw{}) {} // of a constant viscosity
  explicit ViscosityShift(const TemperatureLaw& law);

  [[nodiscard]] Point at(double temperature) const;
  [[nodiscard]] double factor(double temperature) const { return at(temperature).factor; }
  // The temperature between `lowest` and `highest` at which the factor is `factor`, of a law that falls with T; the
  // nearer end where none is.
  [[nodiscard]] double temperature_of(double factor, double lowest, double highest) const;

private:
  struct Logarithm {
    double value, slope; // ln a_T, and over T
  };
  [[nodiscard]] Logarithm logarithm(double temperature) const;

  TemperatureLaw law_;
  double log_greatest_ = 0;
  std::function<Logarithm(double)> tabulated_; // ln(μ/μ(T_r)) of a table
};

} // namespace sheet
