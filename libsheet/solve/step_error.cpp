// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/step_error.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace sheet {

StepError step_error(std::span<const double> errors, std::span<const double> volumes) {
  constexpr double excepted = 0.01, of_greatest = 0.5; // of the liquid
  const auto greatest = std::ranges::max_element(errors);
  if (greatest == errors.end())
    return {};
  StepError result{of_greatest * *greatest, static_cast<std::size_t>(greatest - errors.begin())};
  std::vector<std::size_t> above;
  for (std::size_t v = 0; v < errors.size(); ++v)
    if (errors[v] > result.value)
      above.push_back(v);
  std::ranges::sort(above, [&](std::size_t a, std::size_t b) { return errors[a] > errors[b]; });
  double left = excepted * std::accumulate(volumes.begin(), volumes.end(), 0.0);
  for (const std::size_t v : above) {
    left -= volumes[v];
    if (left < 0) {
      result.value = errors[v];
      break;
    }
  }
  return result;
}

} // namespace sheet
