// SPDX-License-Identifier: GPL-3.0-or-later
// Flow curves whose potential has no closed form: ln η is given over s = ln γ̇, the potential φ = ∫ η e^(2s) ds is
// summed up once [Gauss], and from then on a spline of its logarithm, from which η and its slope follow.
#pragma once
#include <functional>
#include <vector>

#include "libsheet/material/flow_curve.h"
#include "libsheet/material/log_spline.h"

namespace sheet {

struct LogViscosity {
  double value = 0, slope = 0; // ln η, d ln η/d ln γ̇
};

// Where ln η is given, and how.
struct LogCurve {
  std::function<LogViscosity(double)> at;
  double first = 0, last = 0;
};

class IntegratedCurve {
public:
  // Beyond its ends the viscosity is that of the end.
  explicit IntegratedCurve(const LogCurve& curve);
  [[nodiscard]] FlowPoint at(double squared_rate) const;

private:
  double first_, last_;                     // ln γ̇ of the ends
  double first_viscosity_, last_viscosity_; // there [Pa s]
  double last_potential_ = 0;               // φ there [Pa/s]
  LogSpline potential_;
};

// Of a liquid whose law needs it: [Carreau 1972; Yasuda 1979], [Cross 1965], and of a table a monotone cubic [Fritsch
// and Carlson 1980].
[[nodiscard]] LogCurve log_curve(const Liquid& liquid);

} // namespace sheet
