// SPDX-License-Identifier: GPL-3.0-or-later
// Gas that a sheet encloses. Its amount m is the volume that it fills at the pressure p_a outside [m³]; in the volume Ω
// it presses with p = p_a ((m/Ω)^n - 1) more than what is outside, n the polytropic exponent: 1 as it keeps its
// temperature, 1.4 for air that has no time for that. By a leak of conductance c [m³/(Pa s)] dm/dt = -c p; over an
// implicit stage of length τ m = m_reference - c τ p.
#pragma once

namespace sheet {

struct GasLaw {
  double amount = 0;       // at the start [m³]
  double ambient = 101325; // p_a [Pa]
  double exponent = 1;     // n
  double leak = 0;         // c [m³/(Pa s)]
  double more_volume = 0;  // that the gas fills besides what the sheet encloses: vessels, pipes [m³]
};

struct Gas {
  double amount = 0;    // [m³]
  double pressure = 0;  // above that outside [Pa]
  double stiffness = 0; // -dp/dΩ, the leak included [Pa/m³]
};

// Gas in the volume [m³], at the end of a stage of length tau [s] that refers to the amount `reference`. NaN unless the
// volume is positive.
[[nodiscard]] Gas gas_in(const GasLaw& law, double volume, double reference, double tau);

// The mean of its pressure [Pa] over the volumes between two, by Gauss' rule in their logarithm: exact to 1e-12 up to a
// factor of 4 between them.
[[nodiscard]] double mean_pressure(const GasLaw& law, double from, double to, double reference, double tau);

// The amount that presses with `pressure` [Pa] in the volume [m³].
[[nodiscard]] double amount_of_gas(const GasLaw& law, double pressure, double volume);

} // namespace sheet
