// SPDX-License-Identifier: GPL-3.0-or-later
// Gas that a sheet encloses. Its amount m is the volume that it fills at the pressure p_a outside [m³]; in the
// volume Ω it presses with p = p_a ((m/Ω)^n - 1) more than what is outside, n the polytropic exponent: 1 as it keeps
// its temperature, 1.4 for air that has no time for that. By a leak of conductance c [m³/(Pa s)], and through holes
// of area A, as from orifices with sharp edges, quasi-statically and without friction [contraction: Kirchhoff 1869],
// dm/dt = -c p - k sgn(p) √|p|, k = C_d A √(2/ρ), C_d = 0.61, ρ the density outside; over an implicit stage of
// length τ m = m_reference - τ (c p + k sgn(p) √|p|). Where a hole is as wide as what is enclosed (open), the gas is
// that outside: p = 0, m = Ω.
#pragma once

namespace sheet {

struct GasLaw {
  double amount = 0;       // at the start [m³]
  double ambient = 101325; // p_a [Pa]
  double exponent = 1;     // n
  double leak = 0;         // c [m³/(Pa s)]
  double more_volume = 0;  // that the gas fills besides what the sheet encloses: vessels, pipes [m³]
  double hole = 0;         // A, of all of them [m²]
  double outside = 1.2;    // ρ [kg/m³]
  bool open = false;       // to what is outside
  // Whether the amount changes with time.
  [[nodiscard]] bool flows() const { return leak > 0 || hole > 0 || open; }
};

struct Gas {
  double amount = 0;    // [m³]
  double pressure = 0;  // above that outside [Pa]
  double stiffness = 0; // -dp/dΩ, leak and holes included [Pa/m³]
  double escaped = 0;   // through holes, since the run began; less than 0: air has come in [m³]
};

// Gas in the volume [m³], at the end of a stage of length tau [s] that refers to the amount `reference`; what has
// escaped is that of this stage. NaN unless the volume is positive, or the gas open.
[[nodiscard]] Gas gas_in(const GasLaw& law, double volume, double reference, double tau);

// The mean of its pressure [Pa] over the volumes between two, by Gauss' rule in their logarithm, with holes in the
// root of the pressure: exact to 1e-12 up to a factor of 4 between them.
[[nodiscard]] double mean_pressure(const GasLaw& law, double from, double to, double reference, double tau);

// The amount that presses with `pressure` [Pa] in the volume [m³].
[[nodiscard]] double amount_of_gas(const GasLaw& law, double pressure, double volume);

} // namespace sheet
